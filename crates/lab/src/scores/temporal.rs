//! Temporal error: flicker, ghosting and lag.

use super::image::{check_finite, check_length};
use super::tone::tone_map_rgb;
use super::{QualityError, Rgb};

/// Largest distance between expected and found previous depth, relative to the expected one, at which two pixels still
/// show the same surface.
const DEPTH_TOLERANCE: f32 = 0.02;

/// Guides by which a pixel of the previous frame is found that shows the surface of a pixel of this frame. One element per pixel.
#[derive(Debug, Clone, Copy)]
pub struct TemporalGuides<'a> {
    /// Previous pixel minus current pixel, in pixels, y down, unjittered.
    pub motion_px: &'a [[f32; 2]],
    /// The linear depth that this frame's surface point had in the previous frame's camera, scene units.
    pub expected_previous_depth: &'a [f32],
    /// The linear depth that the previous frame saw at each of its own pixels, scene units.
    pub previous_depth: &'a [f32],
    /// Surface of each pixel of this frame, 0 for the background.
    pub surface_id: &'a [u32],
    /// Surface of each pixel of the previous frame, 0 for the background.
    pub previous_surface_id: &'a [u32],
}

impl TemporalGuides<'_> {
    fn check(&self, extent: [u32; 2]) -> Result<(), QualityError> {
        check_length("motion_px", extent, self.motion_px.len())?;
        check_finite("motion_px", extent[0], self.motion_px)?;
        for (plane, depth) in [("expected_previous_depth", self.expected_previous_depth), ("previous_depth", self.previous_depth)] {
            check_length(plane, extent, depth.len())?;
            check_finite(plane, extent[0], depth.as_chunks::<1>().0)?;
        }
        check_length("surface_id", extent, self.surface_id.len())?;
        check_length("previous_surface_id", extent, self.previous_surface_id.len())
    }

    /// Mean over the channels of every pixel whose surface the previous frame shows too: of the sum for a pixel and its previous one, by index.
    pub(super) fn mean(&self, extent: [u32; 2], sum_of: impl Fn(usize, usize) -> f64) -> Result<f64, QualityError> {
        self.check(extent)?;
        let (mut sum, mut count) = (0.0, 0_u64);
        for (x, y) in (0..extent[1]).flat_map(|y| (0..extent[0]).map(move |x| (x, y))) {
            let Some(before) = self.previous_pixel(x, y, extent) else { continue };
            sum += sum_of(index(x, y, extent[0]), before);
            count += 3;
        }
        if count == 0 {
            return Err(QualityError::NoCommonSurface);
        }
        Ok(sum / count as f64)
    }

    /// Index of the pixel of the previous frame that shows what pixel (`x`, `y`) shows now, if there is one.
    fn previous_pixel(&self, x: u32, y: u32, [width, height]: [u32; 2]) -> Option<usize> {
        let current = index(x, y, width);
        let motion = self.motion_px[current];
        let inside = |centre: u32, motion: f32, size: u32| {
            let moved = (f64::from(centre) + 0.5 + f64::from(motion)).floor();
            (moved >= 0.0 && moved < f64::from(size)).then_some(moved as u32)
        };
        let previous = index(inside(x, motion[0], width)?, inside(y, motion[1], height)?, width);
        let expected = self.expected_previous_depth[current];
        let same_depth = (self.previous_depth[previous] - expected).abs() < DEPTH_TOLERANCE * expected;
        let same_surface = self.previous_surface_id[previous] == self.surface_id[current];
        (same_depth && same_surface).then_some(previous)
    }
}

fn index(x: u32, y: u32, width: u32) -> usize {
    y as usize * width as usize + x as usize
}

/// Mean absolute change along the motion, of which the change that the reference has is subtracted first; tone-mapped,
/// over the channels of all pixels whose surface the previous frame shows too. 0 for a perfect denoiser.
///
/// With T the [`tone_map`](super::tone_map) and p' the previous pixel of p, it is the mean of
/// `|(T(image(p)) - T(previous(p'))) - (T(reference(p)) - T(previous_reference(p')))|`: noise that flickers raises it,
/// and so does a history that lags behind a light that changes. The previous pixel is the nearest one, and it counts
/// if it has the same surface and a depth within 2 % of the expected one.
///
/// # Errors
/// [`QualityError::ExtentMismatch`], [`QualityError::Length`] or [`QualityError::NonFinite`] for inputs that do not fit,
/// and [`QualityError::NoCommonSurface`] if no pixel counts.
pub fn temporal_error(
    image: Rgb<'_>,
    previous: Rgb<'_>,
    reference: Rgb<'_>,
    previous_reference: Rgb<'_>,
    guides: &TemporalGuides<'_>,
) -> Result<f64, QualityError> {
    for other in [previous, reference, previous_reference] {
        image.same_extent(other)?;
    }
    guides.mean(image.extent(), |now, before| {
        let image_change = change(image.pixels()[now], previous.pixels()[before]);
        let reference_change = change(reference.pixels()[now], previous_reference.pixels()[before]);
        image_change.iter().zip(reference_change).map(|(a, b)| f64::from((a - b).abs())).sum()
    })
}

pub(super) fn change(now: [f32; 3], before: [f32; 3]) -> [f32; 3] {
    let (now, before) = (tone_map_rgb(now), tone_map_rgb(before));
    std::array::from_fn(|channel| now[channel] - before[channel])
}

/// Mean absolute difference in luminance (Rec. 709, linear) between two consecutive frames of a scene in which nothing
/// moves or changes: every difference is then an error, and no reference is needed.
///
/// Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", fig. 10.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn static_temporal_error(image: Rgb<'_>, previous: Rgb<'_>) -> Result<f64, QualityError> {
    image.same_extent(previous)?;
    let sum: f64 =
        image.pixels().iter().zip(previous.pixels()).map(|(&now, &before)| (luminance(now) - luminance(before)).abs()).sum();
    Ok(sum / image.pixels().len() as f64)
}

fn luminance([r, g, b]: [f32; 3]) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

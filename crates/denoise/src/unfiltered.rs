//! What passes the filter with its noise, averaged over frames: outlines of lamps, outlines of things before the sky, and albedos.
//!
//! Nothing filters what is emitted, the background, and the albedo that light is multiplied by. But a renderer that spreads a few samples over each
//! pixel does not know how much of the pixel a thing or a part of a texture covers. Here the image of the frame before is carried along, and is worth
//! as many frames as the noise is larger than the blur of carrying it. Both are measured over all edges of an image: of what is converged nothing is
//! averaged, and nothing where all samples lie in the middle of their pixels, so that a thing covers all of a pixel or nothing. docs/lab/denoise.md
//! has the figures.

use crate::frame::{FrameInputs, NOISY};
use crate::frame_images::Texels;
use crate::motion::{self, SurfaceMotion};
use crate::raster::Raster;
use crate::setup::Setup;
use atrous::config::NormalEncoding;
use std::collections::BTreeMap;

pub const EMISSION: &str = "emission";
pub const ALBEDO: &str = "albedo";

/// Contrast of an edge: the range of 3×3 pixels over the brightest of them.
const CONTRAST: f32 = 0.3;
/// Shares of that range between which a pixel is covered in part.
const PART: std::ops::Range<f32> = 0.08..0.92;
/// Share of such pixels among all, below which samples lie in the middle of their pixels.
const LEAST_PARTS: f32 = 0.1;
/// The length of a normal over the largest one in 3×3 pixels, below which it is a mean of several.
const OF_ONE: f32 = 0.98;
/// The weight of a frame in a mean that is tried: how well that tells the next frame, and the frame before does, says what is noise.
const TRIED: f32 = 0.25;
/// How much further off that mean is, in variance, where carrying alone makes a difference. Half of it after two frames.
const TRIED_OFF: f32 = 2.0;
/// What carrying adds to the variance of a mean, over that by which the frame before is off: a mean is smoother.
const OF_MEAN: f32 = 0.6;
/// A departure that is no noise, over what pixels beside each other share of it.
const OF_SHARED: f32 = 1.75;
const MOST_FRAMES: f32 = 16.0;
/// An edge that was carried by less stands still.
const STILL: f32 = 0.01;

/// Whether there are averages of a frame: they follow its motion.
pub fn is_averaged(frame: &FrameInputs, setup: &Setup) -> bool {
    setup.averages() && frame.params.jitter == [0.0; 2]
}

/// Whether guides are means over samples that are spread over their pixels: at outlines, the mean of two normals is shorter than each.
pub fn are_means(frame: &FrameInputs, setup: &Setup) -> bool {
    let scale: fn(f32) -> f32 = match setup.config.conventions.normal {
        NormalEncoding::Xyz => |v| v,
        NormalEncoding::XyzUnorm => |v| 2.0 * v - 1.0,
        _ => return false,
    };
    let Some(normals) = frame.images.get("normal") else { return false };
    let length = |i: usize| normals[i][..3].iter().map(|v| scale(*v).powi(2)).sum::<f32>().sqrt();
    let surface = motion::of_frame(frame, &frame.params, &setup.config.conventions);
    let raster = Raster::new(frame.params.render_extent);
    let is_border = |i: &usize| surface.is_surface[*i] && !is_inner(&surface, raster, *i);
    let is_short = |i: usize| length(i) < OF_ONE * raster.around(i, 1).map(length).fold(0.0, f32::max);
    let borders: Vec<bool> = (0..raster.pixels()).filter(is_border).map(is_short).collect();
    let short = borders.iter().filter(|short| **short).count() as f32;
    short > LEAST_PARTS * borders.len() as f32
}

/// Averages up to a frame.
#[derive(Default)]
pub struct Averages {
    /// By the names of images.
    before: BTreeMap<&'static str, Past>,
}

/// A pixel with its past.
struct Place {
    pixel: usize,
    /// Where something else is beside it: a pixel around it of a background without anything before it.
    open: Option<usize>,
    /// Where it was, in pixels.
    before: [f32; 2],
    /// How far off it may be that was carried, 0 to 1: half a pixel along both axes.
    carried: f32,
}

/// A place where an image has contrast.
struct Edge {
    pixel: usize,
    carried: f32,
    /// The past there; `None` where there is none.
    past: Option<Carried>,
    luminance: f32,
    /// Of the luminance around.
    range: [f32; 2],
    /// Whether the pixel is covered in part.
    is_part: bool,
}

/// An image of the frame before.
struct Past {
    luminance: Vec<f32>,
    mean: Vec<[f32; 3]>,
    /// That the mean is worth.
    frames: Vec<f32>,
    /// Luminance of the mean that is tried.
    tried: Vec<f32>,
    /// Frames in that mean.
    number: i32,
    /// Variance, as measured.
    noise: f32,
}

/// What a past has at a place between the centres of pixels.
#[derive(Clone, Copy)]
struct Carried {
    luminance: f32,
    tried: f32,
    mean: [f32; 3],
    frames: f32,
}

/// Of the edges of an image, in squared ranges.
struct Noise {
    variance: f32,
    /// By which an edge is off that was carried half a pixel along both axes.
    off: f32,
}

impl Averages {
    /// Forgets the frames so far.
    pub fn reset(&mut self) {
        self.before.clear();
    }

    /// Takes the next frame, and puts means into its images: into the outlines of its emission, into those of its light where no surface is, and
    /// into the albedo where `has_means` of it.
    pub fn take(
        &mut self,
        images: &mut BTreeMap<&'static str, Texels>,
        surface: &SurfaceMotion,
        extent: [u32; 2],
        has_means: bool,
    ) {
        let raster = Raster::new(extent);
        let is_border = are_borders(surface, extent);
        for (name, texels) in images.iter_mut() {
            let is_filtered = NOISY.contains(name);
            let is_taken = is_filtered || *name == EMISSION || (has_means && *name == ALBEDO);
            if !is_taken {
                continue;
            }
            let passes = |pixel: &usize| match is_filtered {
                true => is_border[*pixel] && !surface.is_surface[*pixel],
                false => is_border[*pixel] || *name == ALBEDO,
            };
            let before = self.before.get(name);
            let places = (0..raster.pixels()).filter(passes).map(|pixel| Place::of(pixel, is_border[pixel], surface, raster));
            let edges: Vec<_> = places.filter_map(|place| Edge::of(&place, texels, before, raster, is_filtered)).collect();
            let next = Past::next(before, texels, edges, raster);
            for (texel, [r, g, b]) in texels.iter_mut().zip(&next.mean) {
                *texel = [*r, *g, *b, texel[3]];
            }
            self.before.insert(name, next);
        }
    }
}

impl Past {
    fn next(before: Option<&Self>, given: &Texels, mut edges: Vec<Edge>, raster: Raster) -> Self {
        let luminance: Vec<f32> = given.iter().map(luminance).collect();
        let mut next = Self {
            tried: luminance.clone(),
            luminance,
            mean: given.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect(),
            frames: vec![1.0; given.len()],
            number: before.map_or(1, |before| before.number + 1),
            noise: 0.0,
        };
        let Some(before) = before else { return next };
        let parts = edges.iter().filter(|edge| edge.is_part).count() as f32;
        if parts < LEAST_PARTS * edges.len() as f32 {
            edges.retain(|edge| edge.carried < STILL);
        }
        let mut noise = before.noise_of(&edges, raster);
        next.noise = noise.variance;
        // What changes in a single frame is no noise.
        if before.number > 2 {
            noise.variance = noise.variance.min(before.noise);
        }
        for Edge { pixel, carried, past, .. } in edges {
            let Some(past) = past else { continue };
            next.tried[pixel] = past.tried + TRIED * (next.tried[pixel] - past.tried);
            if noise.variance > 0.0 {
                let off = if carried < STILL { 0.0 } else { OF_MEAN * noise.off * carried };
                next.frames[pixel] = (1.0 + past.frames / (1.0 + past.frames * off / noise.variance)).min(MOST_FRAMES);
                let (least, most) = range_of(raster.beside(pixel).map(|i| given[i]));
                for (c, mean) in next.mean[pixel].iter_mut().enumerate() {
                    let kept = past.mean[c].clamp(least[c], most[c]);
                    *mean = kept + (*mean - kept) / next.frames[pixel];
                }
            }
        }
        next
    }

    /// `None` beyond the picture, and where something is not finite.
    fn carried(&self, place: [f32; 2], raster: Raster) -> Option<Carried> {
        let frames = self.frames[raster.at(place)?];
        let (mut sum, mut weights) = ([0.0; 5], 0.0);
        for (i, weight) in raster.taps(place) {
            let [r, g, b] = self.mean[i];
            let values = [self.luminance[i], self.tried[i], r, g, b];
            sum = std::array::from_fn(|k| sum[k] + weight * values[k]);
            weights += weight;
        }
        let [luminance, tried, mean @ ..] = sum.map(|value| value / weights);
        sum.iter().all(|value| value.is_finite()).then_some(Carried { luminance, tried, mean, frames })
    }

    /// With noise alone the mean tells the frame after better than the frame before does, and where carrying alone makes a difference it tells it
    /// less well: two equations. What comes anew in each frame since its motion is another makes the mean better as well, but pixels beside each
    /// other share it.
    fn noise_of(&self, edges: &[Edge], raster: Raster) -> Noise {
        let worse = TRIED_OFF - (TRIED_OFF - 1.0) * 0.5_f32.powi(self.number - 1);
        let (mut better, mut by_noise, mut carried) = (0.0, 0.0, 0.0);
        let (mut squares, mut ranges, mut of_noise, mut of_shared) = (0.0, 0.0, 0.0, 0.0);
        for edge in edges {
            let Some(Carried { luminance, tried, .. }) = edge.past else { continue };
            let range = (edge.range[1] - edge.range[0]).powi(2);
            let [of_given, of_tried] = [luminance, tried].map(|past| (edge.luminance - past).powi(2));
            // Between pixels noise is averaged, and that of a mean each time that it is carried: a geometric series.
            let kept = (1.0 - 0.5 * edge.carried).powi(2);
            let ratio = (1.0 - TRIED).powi(2) * kept;
            let (left, settled) = (ratio.powi(self.number - 1), TRIED * TRIED / (1.0 - ratio));
            let of_mean = left + (1.0 - left) * settled;
            better += worse * of_given - of_tried;
            by_noise += range * (worse * (1.0 + kept) - 1.0 - kept * of_mean);
            squares += of_given;
            ranges += range;
            of_noise += range * (1.0 + kept);
            // Two pasts between the same pixels have a part of their noise from the same pixels.
            of_shared += range * 0.25 * edge.carried * kept.sqrt();
            carried += range * edge.carried;
        }
        let over = |value: f32, whole: f32| if whole > 0.0 { (value / whole).max(0.0) } else { 0.0 };
        let not_shared = squares - OF_SHARED * shared(edges, raster) * ranges;
        let variance = over(better, by_noise).min(over(not_shared, of_noise - OF_SHARED * of_shared));
        Noise { variance, off: over(squares - variance * of_noise, carried) }
    }
}

/// How much of their departure from the past pixels beside each other share, in squared ranges.
fn shared(edges: &[Edge], raster: Raster) -> f32 {
    let mut departures = vec![None; raster.pixels()];
    for Edge { pixel, past, luminance, range, .. } in edges {
        departures[*pixel] = past.map(|past| [luminance - past.luminance, range[1] - range[0]]);
    }
    let (mut products, mut ranges) = (0.0, 0.0);
    for pixel in edges.iter().map(|edge| edge.pixel) {
        let after = raster.beside(pixel).filter(|beside| *beside > pixel);
        for pair in after.filter_map(|beside| departures[pixel].zip(departures[beside])) {
            let ([own, own_range], [beside, beside_range]) = pair;
            products += own * beside;
            ranges += own_range * beside_range;
        }
    }
    if ranges > 0.0 {
        (products / ranges).max(0.0)
    } else {
        0.0
    }
}

impl Edge {
    /// `None` where there is no contrast, and where something is not finite.
    fn of(place: &Place, image: &Texels, before: Option<&Past>, raster: Raster, is_filtered: bool) -> Option<Self> {
        let own = luminance(&image[place.pixel]);
        let (mut least, mut most) = (own, own);
        for l in raster.around(place.pixel, 1).map(|i| luminance(&image[i])) {
            if !l.is_finite() {
                return None;
            }
            (least, most) = (least.min(l), most.max(l));
        }
        let is_part = match place.open {
            _ if !is_filtered => PART.contains(&((own - least) / (most - least))),
            // The light of surfaces around has noise of its own.
            Some(open) => (own - luminance(&image[open])).abs() > PART.start * (most - least),
            None => false,
        };
        let Place { pixel, carried, .. } = *place;
        let past = || before.and_then(|before| before.carried(place.before, raster));
        let edge = || Self { pixel, carried, past: past(), luminance: own, range: [least, most], is_part };
        (most - least > CONTRAST * most).then(edge)
    }
}

/// Whether something else is beside each pixel.
pub fn are_borders(surface: &SurfaceMotion, extent: [u32; 2]) -> Vec<bool> {
    let raster = Raster::new(extent);
    (0..raster.pixels()).map(|pixel| !is_inner(surface, raster, pixel)).collect()
}

/// Whether all pixels around one show the same.
fn is_inner(surface: &SurfaceMotion, raster: Raster, pixel: usize) -> bool {
    let kind = |i: usize| (surface.id[i], surface.is_surface[i]);
    raster.around(pixel, 1).all(|i| kind(i) == kind(pixel))
}

impl Place {
    fn of(pixel: usize, is_border: bool, surface: &SurfaceMotion, raster: Raster) -> Self {
        let around = || raster.around(pixel, 1).filter(|_| is_border);
        // An outline moves with what is in front.
        let distance = |i: usize| if surface.is_surface[i] { surface.depth[i] } else { f32::INFINITY };
        let front = around().min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(pixel);
        let ([x, y], motion) = (raster.place(pixel), surface.motion_px[front]);
        let before = [x as f32 + motion[0], y as f32 + motion[1]];
        let carried = before.iter().map(|at| 2.0 * (at - at.floor()) * (1.0 - at + at.floor())).sum();
        let open = around().find(|i| !surface.is_surface[*i] && is_inner(surface, raster, *i));
        Self { pixel, open, before, carried }
    }
}

fn luminance([r, g, b, _]: &[f32; 4]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The least and the greatest of each component.
fn range_of(texels: impl Iterator<Item = [f32; 4]>) -> ([f32; 3], [f32; 3]) {
    texels.fold(([f32::MAX; 3], [f32::MIN; 3]), |(least, most), texel| {
        (std::array::from_fn(|c| least[c].min(texel[c])), std::array::from_fn(|c| most[c].max(texel[c])))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXTENT: [u32; 2] = [48, 32];
    const LAMP: f32 = 6.0;
    const SKY: f32 = 0.5;
    const LIGHT: &str = "noisy_radiance";

    /// Places of samples in their pixels.
    #[derive(Clone, Copy)]
    enum Samples {
        /// So many, anywhere.
        Spread(u32),
        Middle,
    }

    fn random(seed: u32) -> f32 {
        let mut v = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        v = ((v >> ((v >> 28) + 4)) ^ v).wrapping_mul(277_803_737);
        ((v >> 22) ^ v) as f32 / u32::MAX as f32
    }

    /// A round lamp before the sky, whose middle is at `x`.
    fn emission(x: f32, samples: Samples, frame: u32) -> Texels {
        let covered = |px: f32, py: f32| (px - x).hypot(py - 16.0) < 9.0;
        let pixel = |i: u32| {
            let (px, py) = ((i % EXTENT[0]) as f32, (i / EXTENT[0]) as f32);
            let share = match samples {
                Samples::Middle => f32::from(covered(px + 0.5, py + 0.5)),
                Samples::Spread(count) => {
                    let seed = |s: u32, axis: u32| ((frame * 4096 + i) * 1024 + s) * 2 + axis;
                    let hit = |s: &u32| covered(px + random(seed(*s, 0)), py + random(seed(*s, 1)));
                    (0..count).filter(hit).count() as f32 / count as f32
                }
            };
            [SKY + (LAMP - SKY) * share; 3]
        };
        (0..EXTENT[0] * EXTENT[1]).map(pixel).map(|[r, g, b]| [r, g, b, 0.0]).collect()
    }

    /// Guides of the lamp: of samples in the middle of pixels.
    fn surface(x: f32, motion: f32) -> SurfaceMotion {
        let lit: Vec<bool> = emission(x, Samples::Middle, 0).iter().map(|e| e[0] > 1.0).collect();
        SurfaceMotion {
            motion_px: lit.iter().map(|lit| [if *lit { -motion } else { 0.0 }, 0.0]).collect(),
            previous_depth: vec![1.0; lit.len()],
            depth: lit.iter().map(|lit| if *lit { 4.0 } else { 1e30 }).collect(),
            id: lit.iter().map(|lit| u32::from(*lit)).collect(),
            is_surface: lit,
        }
    }

    /// RMSE over the outlines of the last of ten frames as given, and averaged.
    fn errors(motion: f32, samples: Samples, name: &'static str) -> [f32; 2] {
        let mut averages = Averages::default();
        let mut last = [0.0; 2];
        for frame in 0..10 {
            let x = 18.0 + motion * frame as f32;
            let truth = match samples {
                Samples::Middle => emission(x, Samples::Middle, 0),
                Samples::Spread(_) => emission(x, Samples::Spread(400), 77),
            };
            let (given, surface) = (emission(x, samples, frame), surface(x, motion));
            let mut images = BTreeMap::from([(name, given.clone())]);
            averages.take(&mut images, &surface, EXTENT, true);
            let is_border = are_borders(&surface, EXTENT);
            let passes: Vec<_> = (0..truth.len()).filter(|i| is_border[*i] && (name != LIGHT || !surface.is_surface[*i])).collect();
            let rmse = |image: &Texels| {
                let squares = passes.iter().map(|i| (image[*i][0] - truth[*i][0]).powi(2)).sum::<f32>();
                (squares / passes.len() as f32).sqrt()
            };
            last = [rmse(&given), rmse(&images[name])];
        }
        last
    }

    #[test]
    fn noise_of_an_outline_is_averaged() {
        for (name, in_motion) in [(EMISSION, 0.55), (LIGHT, 0.65), (ALBEDO, 0.55)] {
            let [given, averaged] = errors(0.0, Samples::Spread(4), name);
            assert!(averaged < 0.45 * given, "{name}, at rest: {averaged} of {given}");
            let [given, averaged] = errors(0.4, Samples::Spread(2), name);
            assert!(averaged < in_motion * given, "{name}, in motion: {averaged} of {given}");
        }
    }

    #[test]
    fn converged_outlines_stay() {
        for (motion, name) in [0.0, 0.3, 0.5, 1.0].into_iter().flat_map(|motion| [(motion, EMISSION), (motion, ALBEDO)]) {
            let [given, averaged] = errors(motion, Samples::Spread(400), name);
            assert!(averaged < 1.15 * given + 0.01, "{name}, {motion}: {averaged} of {given}");
        }
    }

    #[test]
    fn outlines_of_samples_in_the_middle_of_pixels_stay() {
        for (motion, name) in [0.0, 0.3, 1.0].into_iter().flat_map(|motion| [(motion, EMISSION), (motion, ALBEDO)]) {
            assert_eq!(errors(motion, Samples::Middle, name), [0.0; 2], "{name}, {motion}");
        }
    }

    #[test]
    fn a_lamp_that_is_dimmed_leaves_nothing_brighter() {
        let mut averages = Averages::default();
        for frame in 0..8 {
            let mut images = BTreeMap::from([(EMISSION, emission(18.0, Samples::Spread(4), frame))]);
            averages.take(&mut images, &surface(18.0, 0.0), EXTENT, true);
        }
        let dimmed =
            emission(18.0, Samples::Spread(4), 8).iter().map(|texel| texel.map(|v| SKY + 0.1 * (v - SKY).max(0.0))).collect();
        let mut images = BTreeMap::from([(EMISSION, dimmed)]);
        averages.take(&mut images, &surface(18.0, 0.0), EXTENT, true);
        let brightest = images[EMISSION].iter().map(|texel| texel[0]).fold(0.0, f32::max);
        assert!(brightest < SKY + 0.101 * (LAMP - SKY), "{brightest}");
    }

    #[test]
    fn light_that_changes_in_one_frame_is_no_noise() {
        let mut averages = Averages::default();
        let converged = emission(18.0, Samples::Spread(400), 0);
        let dimmed: Texels = converged.iter().map(|texel| texel.map(|v| SKY + 0.3 * (v - SKY).max(0.0))).collect();
        for given in std::iter::repeat_n(&converged, 6).chain([&dimmed]) {
            let mut images = BTreeMap::from([(EMISSION, given.clone())]);
            averages.take(&mut images, &surface(18.0, 0.0), EXTENT, true);
            let changed = images[EMISSION].iter().zip(given).filter(|(a, b)| a != b).count();
            assert_eq!(changed, 0);
        }
    }

    #[test]
    fn a_picture_that_comes_anew_in_each_frame_is_no_noise() {
        let spots = |frame: u32| -> Texels {
            let spot = |i: u32| random(frame * 4096 + (i / EXTENT[0] / 4) * EXTENT[0] + (i % EXTENT[0]) / 4);
            crate::smooth::smooth(&(0..EXTENT[0] * EXTENT[1]).map(|i| [spot(i); 4]).collect(), EXTENT[0] as usize)
        };
        let mut averages = Averages::default();
        for frame in 0..8 {
            let given = spots(frame);
            let mut images = BTreeMap::from([(ALBEDO, given.clone())]);
            averages.take(&mut images, &surface(18.0, 0.4), EXTENT, true);
            let rms = |by: &dyn Fn(usize) -> f32| (0..given.len()).map(|i| by(i).powi(2)).sum::<f32>().sqrt();
            let (changed, contrast) = (rms(&|i| images[ALBEDO][i][0] - given[i][0]), rms(&|i| given[i][0] - 0.5));
            assert!(changed < 0.05 * contrast, "{frame}: {changed} of {contrast}");
        }
    }

    #[test]
    fn values_that_are_not_finite_stay_where_they_are() {
        let mut averages = Averages::default();
        for frame in 0..6 {
            let mut given = emission(18.0, Samples::Spread(4), frame);
            if frame > 3 {
                given[16 * EXTENT[0] as usize + 9] = [f32::NAN; 4];
            }
            let mut images = BTreeMap::from([(EMISSION, given.clone())]);
            averages.take(&mut images, &surface(18.0, 0.0), EXTENT, true);
            let bad = images[EMISSION].iter().filter(|texel| !texel[0].is_finite()).count();
            let averaged = images[EMISSION].iter().zip(&given).filter(|(a, b)| a[0].is_finite() && a != b).count();
            assert_eq!((bad, averaged > 0), (usize::from(frame > 3), frame > 1), "{frame}");
        }
    }

    #[test]
    fn after_a_reset_a_frame_is_as_it_came() {
        let mut averages = Averages::default();
        for frame in 0..6 {
            let given = emission(18.0, Samples::Spread(4), frame);
            let mut images = BTreeMap::from([(EMISSION, given.clone())]);
            if frame == 5 {
                averages.reset();
            }
            averages.take(&mut images, &surface(18.0, 0.0), EXTENT, true);
            assert_eq!(images[EMISSION] == given, frame < 2 || frame == 5, "{frame}");
        }
    }
}

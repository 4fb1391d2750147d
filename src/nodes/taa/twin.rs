//! The stage `taa` \[Karis 2014\]: temporal anti-aliasing of the tone-mapped picture.

use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Rule, Tolerance};
use crate::reference::conventions::is_reset;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::luminance::luminance;
use crate::reference::projection::{extent_ratio, sample_offset};
use crate::reference::rules::{pixels, HALF};
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec2, Vec3};

#[cfg(test)]
mod tests;

/// Sharpness of the reconstruction filter, from \[Karis 2014\]'s fit of a Blackman-Harris window of 3.3 pixels.
const COLOUR_SHARPNESS: f32 = 2.29;
/// Sharpness of the box's weights: a Gaussian of 0.6 pixels. A box of nine equal pixels is as wide as a texture's contrast, and lets
/// the blur of a resampled history pass.
const BOX_SHARPNESS: f32 = 1.39;

/// Inputs of [`taa`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TaaInputs<'a> {
    /// rgb: 0..1, as written by `tone_map`.
    pub tone_mapped: &'a Image<[f32; 4]>,
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// `taa_history` of the previous frame. Not read in a reset frame; `None` is treated as one.
    pub previous: Option<&'a Image<[f32; 4]>>,
}

/// The picture to display, which is the next frame's history as well; half precision, alpha 1.
pub(crate) fn taa(frame: &FrameConstants, tuning: &Tuning, inputs: &TaaInputs) -> Image<[f32; 4]> {
    let rect = RenderRect::new(frame.render_extent);
    let extent = inputs.tone_mapped.extent();
    let previous = inputs.previous.filter(|_| !is_reset(frame));
    let surfaces = Image::compute(extent, frame.render_extent, |p| unpack_guide(inputs.guide.at(p)));
    Image::compute(extent, frame.render_extent, |p| {
        let current = unjittered(frame, rect, inputs.tone_mapped, p);
        let s = (p.as_vec2() + 0.5) * extent_ratio(frame) + nearest_motion(rect, &surfaces, inputs.surface_motion, p);
        let before = RenderRect::new(frame.previous_render_extent);
        let [r, g, b] = match previous {
            Some(previous) if before.contains_position(s) => {
                let history = catmull_rom(before, previous, s);
                let clipped = clip(frame, tuning.taa_gamma, rect, inputs.tone_mapped, p, history);
                blend(tuning.taa_alpha, current, clipped)
            }
            _ => current,
        }
        .map(store)
        .to_array();
        [r, g, b, 1.0]
    })
}

/// Motion of the surface that is nearest to the camera: edges of what is in front move with it. Of background alone that of the pixel.
fn nearest_motion(rect: RenderRect, surfaces: &Image<Surface>, surface_motion: &Image<[u16; 4]>, p: IVec2) -> Vec2 {
    let depth = |q: IVec2| match surfaces.at(q) {
        surface if surface.is_background() => f32::INFINITY,
        surface => surface.linear_depth,
    };
    let (mut nearest, mut nearest_depth) = (p, f32::INFINITY);
    for (_, q) in rect.window(p, 1, 1) {
        if depth(q) < nearest_depth {
            (nearest, nearest_depth) = (q, depth(q));
        }
    }
    unpack_surface_motion(surface_motion.at(nearest)).motion.into()
}

fn rgb(image: &Image<[f32; 4]>, p: IVec2) -> Vec3 {
    let [r, g, b, _] = image.at(p);
    Vec3::new(r, g, b)
}

/// The weight of a sample by its distance from the pixel's centre.
fn gaussian(frame: &FrameConstants, sharpness: f32, offset: IVec2) -> f32 {
    (-sharpness * (offset.as_vec2() + sample_offset(frame)).length_squared()).exp()
}

/// The colour at the pixel's centre, from samples that lie `sample_offset` beside theirs.
fn unjittered(frame: &FrameConstants, rect: RenderRect, image: &Image<[f32; 4]>, p: IVec2) -> Vec3 {
    let (mut sum, mut colour) = (0.0, Vec3::ZERO);
    for (offset, q) in rect.window(p, 1, 1) {
        let weight = gaussian(frame, COLOUR_SHARPNESS, offset);
        sum += weight;
        colour += weight * rgb(image, q);
    }
    colour / sum
}

/// The history at a position in pixels, sharper than bilinear, so that it does not blur from frame to frame.
fn catmull_rom(rect: RenderRect, image: &Image<[f32; 4]>, s: Vec2) -> Vec3 {
    let corner = (s - 0.5).floor();
    let f = s - 0.5 - corner;
    let (x, y) = (catmull_rom_weights(f.x), catmull_rom_weights(f.y));
    let mut colour = Vec3::ZERO;
    for (j, wy) in y.iter().enumerate() {
        for (i, wx) in x.iter().enumerate() {
            let q = rect.clamp(corner.as_ivec2() + IVec2::new(i as i32 - 1, j as i32 - 1));
            colour += wx * wy * rgb(image, q);
        }
    }
    colour.max(Vec3::ZERO)
}

fn catmull_rom_weights(t: f32) -> [f32; 4] {
    [t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)]
}

fn to_ycocg(c: Vec3) -> Vec3 {
    Vec3::new(c.x / 4.0 + c.y / 2.0 + c.z / 4.0, (c.x - c.z) / 2.0, -c.x / 4.0 + c.y / 2.0 - c.z / 4.0)
}

fn from_ycocg(c: Vec3) -> Vec3 {
    Vec3::new(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z)
}

/// The smallest half side of the box that history is clipped to, over the mean luma: half a step of an 8-bit display in the middle. Less
/// is the rounding of halves, by which a grey neighbourhood, a box without any width in chroma, would lose its whole history.
const SMALLEST_BOX: f32 = 1.0 / 512.0;

/// The history moved towards the mean of the neighbourhood until it is within `gamma` deviations, in YCoCg.
fn clip(frame: &FrameConstants, gamma: f32, rect: RenderRect, image: &Image<[f32; 4]>, p: IVec2, history: Vec3) -> Vec3 {
    let neighbours = || rect.window(p, 1, 1).map(|(offset, q)| (gaussian(frame, BOX_SHARPNESS, offset), to_ycocg(rgb(image, q))));
    let total = neighbours().map(|(weight, _)| weight).sum::<f32>();
    let mean = neighbours().map(|(weight, c)| weight * c).sum::<Vec3>() / total;
    let variance = neighbours().map(|(weight, c)| weight * (c - mean) * (c - mean)).sum::<Vec3>() / total;
    let half_size = gamma * Vec3::new(variance.x.sqrt(), variance.y.sqrt(), variance.z.sqrt());
    let distance = to_ycocg(history) - mean;
    let smallest = (SMALLEST_BOX * mean.x).max(1e-6);
    let excess = (distance.abs() / half_size.max(Vec3::splat(smallest))).max_element();
    from_ycocg(if excess > 1.0 { mean + distance / excess } else { mean + distance }).max(Vec3::ZERO)
}

/// Weighted by 1/(1 + luminance), so that a single bright sample does not flicker \[Karis 2014\].
fn blend(alpha: f32, current: Vec3, history: Vec3) -> Vec3 {
    let weight = |c: Vec3| 1.0 / (1.0 + luminance(c.to_array()));
    let (now, before) = (alpha * weight(current), (1.0 - alpha) * weight(history));
    (now * current + before * history) / (now + before)
}

/// The clip divides by a deviation that is the root of a difference.
const CLIPPED: Tolerance = Tolerance { absolute: 1e-3, ..HALF };

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("taa_history", CLIPPED), pixels("display", CLIPPED)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = TaaInputs {
        tone_mapped: b.colour("tone_mapped")?,
        guide: b.packed("guide")?,
        surface_motion: b.packed("surface_motion")?,
        previous: Some(b.colour("previous_history")?),
    };
    let display = taa(b.frame, b.tuning, &inputs);
    b.write("taa_history", display.clone())?;
    b.write("display", display)
}

//! The same noise in every frame: the default of some renderers. Accumulating it only sharpens it.

use crate::frame::FrameInputs;
use crate::frame_images::Texels;
use crate::setup::Setup;

/// The least correlation of the noise of two frames, pixel by pixel, that makes it the same, where the
/// albedo has the texture.
const SAME: f64 = 0.6;
/// The same where the texture may be in the light.
const SAME_WITH_TEXTURE: f64 = 0.95;
/// Less deviation of the logarithm of the light than this is no noise.
const LEAST: f64 = 0.05;
/// Fewer pixels prove nothing.
const FEWEST: usize = 256;
/// Largest relative difference of depths, and least cosine of normals, of one surface.
const FLAT: (f32, f32) = (0.05, 0.95);

/// Has every frame filtered by itself where the noise of the first two is the same, and says what to do.
pub fn check(pair: &[FrameInputs; 2], setup: &mut Setup) -> Option<String> {
    let width = setup.config.allocated_extent[0] as usize;
    let noise = pair.each_ref().map(|frame| residuals(frame, width));
    let both: Vec<(f64, f64)> = noise[0].iter().zip(&noise[1]).filter_map(|(a, b)| Some(((*a)?, (*b)?))).collect();
    if both.len() < FEWEST {
        return None;
    }
    let sum = |of: fn(&(f64, f64)) -> f64| both.iter().map(of).sum::<f64>() / both.len() as f64;
    let (first, second, product) = (sum(|v| v.0 * v.0), sum(|v| v.1 * v.1), sum(|v| v.0 * v.1));
    let has_albedo = pair[0].images.contains_key("albedo");
    let limit = if has_albedo { SAME } else { SAME_WITH_TEXTURE };
    if first.min(second).sqrt() < LEAST || product < limit * (first * second).sqrt() {
        return None;
    }
    setup.stills = true;
    let [a, b] = [pair[0].number, pair[1].number];
    Some(format!(
        "the noise of frames {a} and {b} is the same, so that a history is of no use; every frame is filtered by itself. \
         Render with another seed in every frame: Blender: the clock beside Sampling > Advanced > Seed (use_animated_seed); \
         Mitsuba: render(scene, seed=FRAME); LuxCore: renderengine.seed; PBRT: --seed; Arnold: AA_seed at $F; Karma: Random Seed"
    ))
}

/// The logarithm of the light at each pixel without its mean around, where all of it is one surface.
fn residuals(frame: &FrameInputs, width: usize) -> Vec<Option<f64>> {
    let light = light(frame);
    let height = light.len() / width.max(1);
    let mut residuals = vec![None; light.len()];
    for y in 1..height.saturating_sub(1) {
        for x in 1..width.saturating_sub(1) {
            let i = y * width + x;
            let around = [i - width - 1, i - width, i - width + 1, i - 1, i + 1, i + width - 1, i + width, i + width + 1];
            if around.iter().all(|j| is_flat(frame, i, *j)) {
                let mean = around.iter().filter_map(|j| light[*j]).sum::<f64>() / 8.0;
                let all = around.iter().all(|j| light[*j].is_some());
                residuals[i] = light[i].filter(|_| all).map(|l| l - mean);
            }
        }
    }
    residuals
}

/// The logarithm of the light without the albedo.
fn light(frame: &FrameInputs) -> Vec<Option<f64>> {
    let albedo = frame.images.get("albedo");
    let emission = frame.images.get("emission");
    let sum = |t: &[f32]| t[..3].iter().map(|v| f64::from(*v)).sum::<f64>();
    let of = |(i, noisy): (usize, &[f32; 3])| {
        let at = |image: Option<&Texels>| image.and_then(|image| image.get(i)).map(|t| sum(t));
        let light = (sum(noisy) - at(emission).unwrap_or(0.0)) / at(albedo).unwrap_or(3.0).max(0.06);
        (light > 1e-30 && light.is_finite()).then(|| light.ln())
    };
    frame.noisy.iter().enumerate().map(of).collect()
}

/// Whether two pixels are of one surface, by the guides that there are.
fn is_flat(frame: &FrameInputs, i: usize, j: usize) -> bool {
    let both = |name: &str| frame.images.get(name).map(|image| (image[i], image[j]));
    let same_id = frame.surface_id.as_ref().is_none_or(|ids| ids[i] == ids[j] && ids[i] != 0);
    let same_depth = both("depth").is_none_or(|(a, b)| a[0] > 0.0 && (a[0] - b[0]).abs() <= FLAT.0 * a[0]);
    let same_normal = both("normal").is_none_or(|(a, b)| {
        let dot = |a: [f32; 4], b: [f32; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        dot(a, b) >= FLAT.1 * (dot(a, a) * dot(b, b)).sqrt()
    });
    same_id && same_depth && same_normal
}

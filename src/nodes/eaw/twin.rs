//! The stage `eaw` \[EAW\]: one level of the wavelet filter by radiance, normal and position.

use crate::config::EawWeights;
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::projection::view_position;
use crate::reference::rules::FILTERED;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec3};

#[cfg(test)]
mod tests;

/// The B3 spline: one axis of the 5×5 kernel.
const KERNEL: [f32; 5] = [1.0 / 16.0, 1.0 / 4.0, 3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

/// Sum of weights below which a hole sees no pixel of its kind.
const SMALLEST_WEIGHT_SUM: f32 = 1e-6;

/// Inputs of [`eaw`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EawInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// Irradiance of every signal in rgb; alpha: negative where there is none.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// Edge functions that are on.
    pub weights: EawWeights,
    /// Levels that fill holes; 0 where the input has none.
    pub filling_levels: u32,
}

/// Filters every signal with taps `2^level` pixels apart. Texels of the result are as those of the input; holes become fewer.
pub(crate) fn eaw(frame: &FrameConstants, tuning: &Tuning, level: u32, inputs: &EawInputs) -> Vec<Image<[f32; 4]>> {
    let extent = inputs.guide.extent();
    let points = Image::compute(extent, frame.render_extent, |p| {
        let surface = unpack_guide(inputs.guide.at(p));
        (surface, view_position(frame, p, surface.linear_depth))
    });
    let edges = Edges { tuning, weights: inputs.weights, filling_levels: inputs.filling_levels, level };
    let filter =
        |image: &&Image<[f32; 4]>| Image::compute(extent, frame.render_extent, |p| filtered(frame, &edges, &points, image, p));
    inputs.irradiance.iter().map(filter).collect()
}

/// Settings of the edge functions of a level.
struct Edges<'a> {
    tuning: &'a Tuning,
    weights: EawWeights,
    filling_levels: u32,
    level: u32,
}

/// 1/σ of each edge function, 0 where it is off.
struct Sharpness {
    radiance: f32,
    normal: f32,
    position: f32,
}

impl Sharpness {
    fn new(frame: &FrameConstants, edges: &Edges, linear_depth: f32) -> Self {
        let Edges { tuning, weights, filling_levels, level } = *edges;
        let step = (1_u64 << level) as f32;
        let on = |on: bool, sharpness: f32| if on { sharpness } else { 0.0 };
        // While holes are left, radiance says nothing.
        let by_radiance = weights.radiance && level >= filling_levels;
        Self {
            radiance: on(by_radiance, step / (tuning.eaw_sigma_radiance * frame.filter_exposure)),
            normal: on(weights.normal, 1.0 / (step * tuning.eaw_sigma_normal)),
            position: on(weights.position, 1.0 / (tuning.eaw_sigma_position * linear_depth.max(1e-15))),
        }
    }
}

fn filtered(frame: &FrameConstants, edges: &Edges, points: &Image<(Surface, Vec3)>, image: &Image<[f32; 4]>, p: IVec2) -> [f32; 4] {
    let (centre, (surface, position)) = (image.at(p), points.at(p));
    let (is_hole, is_background) = (centre[3] < 0.0, surface.is_background());
    if is_background && !is_hole {
        return centre;
    }
    let sharpness = Sharpness::new(frame, edges, surface.linear_depth);
    let (mut sum, mut plain) = ([0.0; 4], [0.0; 4]);
    for (offset, q) in RenderRect::new(frame.render_extent).window(p, 2, 1 << edges.level) {
        let (texel, (tap, tap_position)) = (image.at(q), points.at(q));
        if texel[3] < 0.0 || tap.is_background() != is_background {
            continue;
        }
        let mut exponent = 0.0;
        if !is_background {
            if tap.is_apart != surface.is_apart {
                exponent = f32::INFINITY;
            }
            let normal = Vec3::from(surface.normal) - Vec3::from(tap.normal);
            exponent +=
                (normal * sharpness.normal).length_squared() + ((position - tap_position) * sharpness.position).length_squared();
            if !is_hole {
                exponent += (rgb(centre) - rgb(texel)).length_squared() * sharpness.radiance * sharpness.radiance;
            }
        }
        let kernel = KERNEL[(offset.x + 2) as usize] * KERNEL[(offset.y + 2) as usize];
        for (sum, weight) in [(&mut sum, kernel * (-exponent).exp()), (&mut plain, kernel)] {
            (0..3).for_each(|i| sum[i] += weight * texel[i]);
            sum[3] += weight;
        }
    }
    let mean = |sum: [f32; 4]| [store(sum[0] / sum[3]), store(sum[1] / sum[3]), store(sum[2] / sum[3]), 0.0];
    match (sum[3] >= SMALLEST_WEIGHT_SUM, is_hole && plain[3] > 0.0) {
        (true, _) => mean(sum),
        (false, true) => mean(plain),
        (false, false) => centre,
    }
}

fn rgb([r, g, b, _]: [f32; 4]) -> Vec3 {
    Vec3::new(r, g, b)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = FILTERED;

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = EawInputs {
        guide: b.packed("guide")?,
        irradiance: &b.colours("input")?,
        weights: EawWeights { radiance: b.is_on("RADIANCE")?, normal: b.is_on("NORMAL")?, position: b.is_on("POSITION")? },
        filling_levels: b.constant("SAMPLING")?,
    };
    let filtered = eaw(b.frame, b.tuning, b.level, &inputs);
    b.write_signals("output", filtered)
}

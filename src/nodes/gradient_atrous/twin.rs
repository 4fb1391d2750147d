//! The stage `gradient_atrous` \[ASVGF 3.4, eq. 7 to 12\]: an iteration of the reconstruction of the temporal gradient.

use crate::nodes::atrous::twin::LUMINANCE_EPSILON;
use crate::reference::binary16::round_to_half;
use crate::reference::bindings::Bindings;
use crate::reference::geometry_weights::depth_and_normal_weight;
use crate::reference::guide::unpack_guide;
use crate::reference::strata::Strata;
use crate::reference::surface_motion::unpack_depth_gradient;
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec2};

#[cfg(test)]
mod tests;

/// Iterations of the presets.
pub const GRADIENT_ITERATIONS: u32 = 5;

/// Inputs of [`gradient_atrous`].
#[derive(Clone, Copy, Debug)]
pub struct GradientAtrousInputs<'a> {
    /// The image `gradient_guide`, from the stage `gradient`.
    pub gradient_guide: &'a Image<[u16; 4]>,
    /// The image `depth_gradient`, from the stage `import`.
    pub depth_gradient: &'a Image<u32>,
    /// Gradients from the stage `gradient`, or from the iteration before.
    pub gradient: &'a Image<[f32; 4]>,
}

/// Filters δ, Δ and mean with taps `2^level` strata apart, and the deviation of the mean along with them.
pub fn gradient_atrous(
    frame: &FrameConstants,
    tuning: &Tuning,
    stratum_size: u32,
    level: u32,
    inputs: &GradientAtrousInputs,
) -> Image<[f32; 4]> {
    let strata = Strata::new(frame, stratum_size);
    Image::compute(inputs.gradient.extent(), strata.count().into(), |s| {
        let centre = inputs.gradient.at(s);
        let surface = unpack_guide(inputs.gradient_guide.at(s));
        if surface.is_background() {
            return centre;
        }
        let p = pixel_of(strata, inputs.gradient_guide, s);
        let slope = Vec2::from(unpack_depth_gradient(inputs.depth_gradient.at(p)));
        let tolerance = tuning.sigma_l * centre[3] + LUMINANCE_EPSILON;
        let (mut sum, mut variance, mut weights) = ([0.0; 3], 0.0, 0.0);
        for i in 0..9 {
            let t = s + IVec2::new(i % 3 - 1, i / 3 - 1) * (1 << level);
            if !strata.contains(t) {
                continue;
            }
            let tap = unpack_guide(inputs.gradient_guide.at(t));
            if tap.is_background() {
                continue;
            }
            let value = inputs.gradient.at(t);
            let weight = if t == s {
                1.0
            } else {
                let offset = (pixel_of(strata, inputs.gradient_guide, t) - p).as_vec2();
                let weight_l = (-(value[2] - centre[2]).abs() / tolerance).exp();
                depth_and_normal_weight([tuning.sigma_z, tuning.sigma_n], tuning.edge_falloff, &surface, &tap, slope, offset)
                    * weight_l
            };
            (0..3).for_each(|i| sum[i] += weight * value[i]);
            variance += weight * weight * value[3] * value[3];
            weights += weight;
        }
        [sum[0], sum[1], sum[2], variance.sqrt()].map(|x| round_to_half(x / weights))
    })
}

/// The pixel that stands for a stratum.
fn pixel_of(strata: Strata, gradient_guide: &Image<[u16; 4]>, s: IVec2) -> IVec2 {
    let place = i32::from(gradient_guide.at(s)[0] & 0xf);
    let size = strata.size as i32;
    strata.first_pixel(s) + IVec2::new(place % size, place / size)
}

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = GradientAtrousInputs {
        gradient_guide: b.packed("gradient_guide")?,
        depth_gradient: b.uint("depth_gradient")?,
        gradient: b.colour("gradient_in")?,
    };
    let filtered = gradient_atrous(b.frame, b.tuning, b.stratum_size()?, b.level, &inputs);
    b.write("gradient_out", filtered)
}

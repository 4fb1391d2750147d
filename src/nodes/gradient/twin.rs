//! The stage `gradient` \[ASVGF eq. 2, 3, 13\]: how much the luminance of the same samples changed, with mean and deviation per
//! stratum.

use crate::nodes::demodulate::twin::{luminances, radiance_luminance};
use crate::reference::binary16::{from_half_bits, round_to_half, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::conventions::{is_reset, is_reshaded};
use crate::reference::guide::unpack_guide;
use crate::reference::projection::extent_ratio;
use crate::reference::strata::{unpack_gradient_sample, Strata};
use crate::reference::surface_motion::{unpack_depth_gradient, unpack_surface_motion};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, UVec2, Vec2};

#[cfg(test)]
mod tests;

/// Source of the second luminance of a sample.
#[derive(Clone, Copy, Debug)]
pub enum GradientInput<'a> {
    /// The noisy radiance itself, at the pixels of `gradient_samples`, which the host re-shaded.
    ForwardProjected {
        /// The image `gradient_samples`, from the stage `forward_project`.
        gradient_samples: &'a Image<[u16; 4]>,
    },
    /// An image at the pixels of the previous frame.
    Reshaded {
        /// rgb: radiance of the previous frame's paths in the scene of this frame; NaN where there is none.
        reshaded_radiance: Option<&'a Image<[f32; 4]>>,
        /// The guide of the previous frame; not read in a reset frame.
        previous_guide: Option<&'a Image<[u16; 4]>>,
        /// The image `surface_motion`, from the stage `import`.
        surface_motion: &'a Image<[u16; 4]>,
        /// The image `depth_gradient`, from the stage `import`.
        depth_gradient: &'a Image<u32>,
    },
    /// The host's own differences, one texel a stratum: x: δ, y: Δ.
    Sparse(Option<&'a Image<[f32; 4]>>),
}

/// Inputs of [`gradient`]; images have the allocated extent where nothing else is noted.
#[derive(Clone, Copy, Debug)]
pub struct GradientInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: noisy radiance of every signal.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo at the primary hit.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// `noisy_luminance` of the previous frame; not read in a reset frame.
    pub previous_luminance: Option<&'a Image<u32>>,
    /// The source.
    pub source: GradientInput<'a>,
}

/// Outputs of [`gradient`].
#[derive(Clone, Debug, PartialEq)]
pub struct GradientOutputs {
    /// One texel a stratum: δ, Δ, mean and standard deviation of luminance, half precision.
    pub gradient: Image<[f32; 4]>,
    /// One texel a stratum: the guide of the pixel that stands for it, with its place instead of the roughness.
    pub gradient_guide: Image<[u16; 4]>,
}

/// Takes the differences.
pub fn gradient(frame: &FrameConstants, tuning: &Tuning, stratum_size: u32, inputs: &GradientInputs) -> GradientOutputs {
    let extent = inputs.guide.extent();
    let strata = Strata::new(frame, stratum_size);
    let luminances = luminances(frame, inputs.guide, inputs.noisy, inputs.albedo);
    let changes = Changes { frame, tuning, stratum_size, inputs, luminances: &luminances };
    let stratum_extent = extent.map(|side| side.div_ceil(stratum_size));
    let texels = Image::compute(stratum_extent, strata.count().into(), |s| changes.stratum(strata, s));
    GradientOutputs { gradient: texels.map(|t| t.0), gradient_guide: texels.map(|t| t.1) }
}

struct Changes<'a> {
    frame: &'a FrameConstants,
    tuning: &'a Tuning,
    stratum_size: u32,
    inputs: &'a GradientInputs<'a>,
    luminances: &'a Image<(f32, f32)>,
}

impl Changes<'_> {
    fn stratum(&self, strata: Strata, s: IVec2) -> ([f32; 4], [u16; 4]) {
        let pixels: Vec<_> = strata.pixels(s).filter(|(_, p)| !unpack_guide(self.inputs.guide.at(*p)).is_background()).collect();
        let values: Vec<f32> = pixels.iter().map(|(_, p)| self.luminances.at(*p)).map(|(l, a)| l / a).collect();
        let mean_of = |values: &[f32]| values.iter().sum::<f32>() / values.len().max(1) as f32;
        let mean = mean_of(&values);
        let variance = mean_of(&values.iter().map(|l| (l - mean) * (l - mean)).collect::<Vec<_>>());
        let sample = self.sample(s);
        let changes: Vec<(f32, f32)> = match self.inputs.source {
            GradientInput::ForwardProjected { .. } => {
                sample.iter().map(|(p, j)| self.change(self.luminances.at(*p).0, *j)).collect()
            }
            GradientInput::Reshaded { .. } => pixels.iter().filter_map(|(_, p)| self.reshaded(*p)).collect(),
            GradientInput::Sparse(host) => host.map(|host| host.at(s)).map(|[d, l, ..]| (d, l)).into_iter().collect(),
        };
        let (change, brightest) = mean_change(&changes);
        // The sample's own pixel stands for the stratum; else its middle, else its first surface.
        let extent = strata.extent_of(s);
        let middle = strata.first_pixel(s) + ((extent - UVec2::ONE) / 2).as_ivec2();
        let wanted = sample.map_or(middle, |(p, _)| p);
        let stands = pixels.iter().find(|(_, p)| *p == wanted).or(pixels.first());
        let guide = stands.map_or([0; 4], |(place, p)| with_place(self.inputs.guide.at(*p), *place));
        ([change, brightest, mean, variance.sqrt()].map(|x| round_to_half(x.clamp(-LARGEST_HALF, LARGEST_HALF))), guide)
    }

    /// The pixel of a stratum that was re-shaded, and the previous pixel that it repeats.
    fn sample(&self, s: IVec2) -> Option<(IVec2, IVec2)> {
        let GradientInput::ForwardProjected { gradient_samples } = self.inputs.source else { return None };
        if is_reset(self.frame) || !is_reshaded(self.frame) {
            return None;
        }
        let sample = unpack_gradient_sample(self.stratum_size, s.as_uvec2().into(), gradient_samples.at(s))?;
        let pixel = |p: [u32; 2]| UVec2::from(p).as_ivec2();
        Some((pixel(sample.pixel), pixel(sample.previous_pixel)))
    }

    /// δ and Δ of a sample that was at `previous`.
    fn change(&self, now: f32, previous: IVec2) -> (f32, f32) {
        let Some(texel) = self.inputs.previous_luminance.map(|l| l.at(previous)) else { return (0.0, 0.0) };
        let (before, albedo) = (from_half_bits(texel as u16), from_half_bits((texel >> 16) as u16));
        let before = (before * self.frame.exposure_ratio).min(LARGEST_HALF);
        // Both luminances are halves: what did not change differs by 0.
        let now = round_to_half(now);
        ((now - before) / albedo, now.max(before) / albedo)
    }

    /// δ and Δ at the previous pixel that showed the surface of `p`.
    fn reshaded(&self, p: IVec2) -> Option<(f32, f32)> {
        let GradientInput::Reshaded { reshaded_radiance, previous_guide, surface_motion, depth_gradient } = self.inputs.source
        else {
            return None;
        };
        if is_reset(self.frame) {
            return None;
        }
        let motion = unpack_surface_motion(surface_motion.at(p));
        let j = ((p.as_vec2() + 0.5) * extent_ratio(self.frame) + Vec2::from(motion.motion)).floor().as_ivec2();
        if !RenderRect::new(self.frame.previous_render_extent).contains(j) {
            return None;
        }
        let (now, before) = (unpack_guide(self.inputs.guide.at(p)), unpack_guide(previous_guide?.at(j)));
        let expected = now.linear_depth * (1.0 + motion.depth_ratio);
        let slope: f32 = unpack_depth_gradient(depth_gradient.at(p)).iter().map(|g| g.abs()).sum();
        let tolerance = self.tuning.depth_tolerance * expected + slope;
        let is_same = !before.is_background() && before.id == now.id && (before.linear_depth - expected).abs() <= tolerance;
        let radiance = reshaded_radiance?.at(j);
        let is_usable = is_same && radiance[..3].iter().all(|c| c.is_finite());
        is_usable.then(|| self.change(radiance_luminance(radiance), j))
    }
}

fn mean_change(changes: &[(f32, f32)]) -> (f32, f32) {
    let usable = || changes.iter().filter(|(d, l)| d.is_finite() && l.is_finite());
    let count = usable().count().max(1) as f32;
    (usable().map(|c| c.0).sum::<f32>() / count, usable().map(|c| c.1.max(0.0)).sum::<f32>() / count)
}

/// A texel of the guide with a place instead of the roughness.
fn with_place([x, y, z, w]: [u16; 4], place: u32) -> [u16; 4] {
    [x & !0xf | place as u16, y, z, w]
}

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let source = match b.constant("SOURCE")? {
        0 => GradientInput::ForwardProjected { gradient_samples: b.packed("gradient_samples")? },
        1 => GradientInput::Reshaded {
            reshaded_radiance: b.optional_colour("reshaded_radiance")?,
            previous_guide: Some(b.packed("previous_guide")?),
            surface_motion: b.packed("surface_motion")?,
            depth_gradient: b.uint("depth_gradient")?,
        },
        _ => GradientInput::Sparse(b.optional_colour("sparse_gradient")?),
    };
    let inputs = GradientInputs {
        guide: b.packed("guide")?,
        noisy: &b.colours("noisy")?,
        albedo: b.optional_colour("albedo")?,
        previous_luminance: b.optional_uint("previous_luminance")?,
        source,
    };
    let outputs = gradient(b.frame, b.tuning, b.stratum_size()?, &inputs);
    b.write("gradient", outputs.gradient)?;
    b.write("gradient_guide", outputs.gradient_guide)
}

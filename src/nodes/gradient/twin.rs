//! The stage `gradient` \[ASVGF eq. 2, 3, 13\]: how much the luminance of the same samples changed, with mean and deviation per
//! stratum.

use crate::nodes::demodulate::twin::luminances;
use crate::reference::binary16::{from_half_bits, round_to_half, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Condition, Rule, Tolerance};
use crate::reference::conventions::{is_reset, is_reshaded};
use crate::reference::guide::unpack_guide;
use crate::reference::kept_radiance::{exposed, is_finite, kept_luminance, kept_radiance, kept_red_blue, radiance_of, storable};
use crate::reference::projection::{extent_ratio, Projections};
use crate::reference::reprojection::{reproject, HostMotion};
use crate::reference::rules::{strata, EXACT};
use crate::reference::strata::{unpack_gradient_sample, Strata};
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, UVec2, Vec2};

#[cfg(test)]
mod tests;

/// Pixels between the motion of a surface and that of the camera, up to which it stands still.
const STILL: f32 = 0.5;
/// The share of the motion that rounding explains.
const STILL_SHARE: f32 = 1.0 / 256.0;

/// Source of the second luminance of a sample.
#[derive(Clone, Copy, Debug)]
pub(crate) enum GradientInput<'a> {
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
    },
    /// The host's own differences, one texel a stratum: x: δ, y: Δ.
    Sparse(Option<&'a Image<[f32; 4]>>),
}

/// Inputs of [`gradient`]; images have the allocated extent where nothing else is noted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GradientInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: noisy radiance of every signal.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo at the primary hit.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// `noisy_luminance` of the previous frame, with re-shaded samples one texel a stratum; not read in a reset frame.
    pub previous_luminance: Option<&'a Image<u32>>,
    /// `noisy_red_blue` of the previous frame, where the ratio of light is wanted; not read in a reset frame.
    pub previous_red_blue: Option<&'a Image<u32>>,
    /// The source.
    pub source: GradientInput<'a>,
}

/// Outputs of [`gradient`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GradientOutputs {
    /// One texel a stratum: δ, Δ, mean and standard deviation of luminance, half precision.
    pub gradient: Image<[f32; 4]>,
    /// One texel a stratum: the guide of the pixel that stands for it, with its place instead of the roughness.
    pub gradient_guide: Image<[u16; 4]>,
    /// One texel a stratum. rgb: mean radiance of its samples in the previous frame over the luminance of the albedo; alpha: mean of
    /// √(before · now), summed over the components. Half precision.
    pub light_before: Image<[f32; 4]>,
    /// One texel a stratum. rgb: mean radiance of the same samples in this frame over the same albedo; alpha: the root of the sum of the
    /// squares of the larger of both lights, each summed over the components, over the number of samples. Half precision.
    pub light_now: Image<[f32; 4]>,
}

/// Takes the differences.
pub(crate) fn gradient(frame: &FrameConstants, tuning: &Tuning, stratum_size: u32, inputs: &GradientInputs) -> GradientOutputs {
    let extent = inputs.guide.extent();
    let strata = Strata::new(frame, stratum_size);
    let luminances = luminances(frame, inputs.guide, inputs.noisy, inputs.albedo);
    let changes = Changes { frame, projections: Projections::new(frame), tuning, stratum_size, inputs, luminances: &luminances };
    let stratum_extent = extent.map(|side| side.div_ceil(stratum_size));
    let texels = Image::compute(stratum_extent, strata.count().into(), |s| changes.stratum(strata, s));
    GradientOutputs {
        gradient: texels.map(|t| t.gradient),
        gradient_guide: texels.map(|t| t.guide),
        light_before: texels.map(|t| t.before),
        light_now: texels.map(|t| t.now),
    }
}

struct Changes<'a> {
    frame: &'a FrameConstants,
    projections: Projections,
    tuning: &'a Tuning,
    stratum_size: u32,
    inputs: &'a GradientInputs<'a>,
    luminances: &'a Image<(Option<f32>, f32)>,
}

/// Texels of a stratum.
#[derive(Clone, Copy, Default)]
struct Texels {
    gradient: [f32; 4],
    guide: [u16; 4],
    before: [f32; 4],
    now: [f32; 4],
}

/// The change of one sample.
#[derive(Clone, Copy, Default)]
struct Change {
    /// δ.
    change: f32,
    /// Δ.
    brightest: f32,
    /// Its light in the previous frame, and in alpha √(before · now), summed over the components.
    before: [f32; 4],
    /// Its light in this frame, and in alpha the larger of both lights, each summed over the components.
    now: [f32; 4],
}

impl Changes<'_> {
    fn stratum(&self, strata: Strata, s: IVec2) -> Texels {
        let pixels: Vec<_> = strata.pixels(s).filter(|(_, p)| !unpack_guide(self.inputs.guide.at(*p)).is_background()).collect();
        let sample = self.sample(s);
        let values: Vec<f32> = pixels.iter().filter_map(|(_, p)| self.relative_luminance(*p, sample)).collect();
        let mean_of = |values: &[f32]| values.iter().sum::<f32>() / values.len().max(1) as f32;
        let mean = mean_of(&values);
        let variance = mean_of(&values.iter().map(|l| (l - mean) * (l - mean)).collect::<Vec<_>>());
        let changes: Vec<Change> = match self.inputs.source {
            GradientInput::ForwardProjected { .. } => {
                sample.iter().filter_map(|(p, j)| self.change(kept_radiance(self.frame, self.inputs.noisy, *p)?, *j)).collect()
            }
            GradientInput::Reshaded { .. } => pixels.iter().filter_map(|(_, p)| self.reshaded(*p)).collect(),
            GradientInput::Sparse(host) => host
                .map(|host| host.at(s))
                .filter(|[change, brightest, ..]| change.is_finite() && brightest.is_finite())
                .map(|sparse| exposed(self.frame, sparse))
                .map(|[change, brightest, ..]| Change { change, brightest: brightest.max(0.0), ..Change::default() })
                .into_iter()
                .collect(),
        };
        let change = mean_change(&changes);
        // The sample's own pixel stands for the stratum; else its middle, else its first surface.
        let extent = strata.extent_of(s);
        let middle = strata.first_pixel(s) + ((extent - UVec2::ONE) / 2).as_ivec2();
        let wanted = sample.map_or(middle, |(p, _)| p);
        let stands = pixels.iter().find(|(_, p)| *p == wanted).or(pixels.first());
        let guide = stands.map_or([0; 4], |(place, p)| with_place(self.inputs.guide.at(*p), *place));
        let stored = |texel: [f32; 4]| texel.map(|x| round_to_half(x.clamp(-LARGEST_HALF, LARGEST_HALF)));
        let gradient = stored([change.change, change.brightest, mean, variance.sqrt()]);
        Texels { gradient, guide, before: stored(change.before), now: stored(change.now) }
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

    /// Luminance over that of the albedo, of a pixel that has a sample of its own: where that is shaded again, of the point where its light
    /// comes from.
    fn relative_luminance(&self, p: IVec2, sample: Option<(IVec2, IVec2)>) -> Option<f32> {
        let (l, albedo) = self.luminances.at(p);
        let repeated = sample.filter(|(pixel, _)| *pixel == p).zip(self.inputs.previous_luminance);
        Some(l? / repeated.map_or(albedo, |((_, previous), kept)| from_half_bits((kept.at(self.kept_at(previous)) >> 16) as u16)))
    }

    /// Where the light of a pixel of the previous frame is: of candidates, one in every stratum, no other is kept.
    fn kept_at(&self, previous: IVec2) -> IVec2 {
        match self.inputs.source {
            GradientInput::ForwardProjected { .. } => previous / self.stratum_size as i32,
            GradientInput::Reshaded { .. } | GradientInput::Sparse(_) => previous,
        }
    }

    /// The change of a sample that was at `previous`; `None` where no light is known of then.
    fn change(&self, radiance: [f32; 3], previous: IVec2) -> Option<Change> {
        let halves = |texel: u32| [texel as u16, (texel >> 16) as u16].map(from_half_bits);
        let exposed = |x: f32| (x * self.frame.exposure_ratio).min(LARGEST_HALF);
        let Some([l, albedo]) = self.inputs.previous_luminance.map(|l| halves(l.at(self.kept_at(previous)))) else {
            return Some(Change::default());
        };
        if l < 0.0 {
            return None;
        }
        // Both luminances are halves: what did not change differs by 0.
        let (l, l_now) = (exposed(l), kept_luminance(radiance));
        let change = Change { change: (l_now - l) / albedo, brightest: l_now.max(l) / albedo, ..Change::default() };
        let Some(red_blue) = self.inputs.previous_red_blue else { return Some(change) };
        let before = radiance_of(l, halves(red_blue.at(self.kept_at(previous))).map(exposed)).map(|c| c / albedo);
        let now = radiance_of(l_now, kept_red_blue(radiance)).map(|c| c / albedo);
        let both = (0..3).map(|i| (before[i] * now[i]).sqrt()).sum();
        let larger = before.iter().sum::<f32>().max(now.iter().sum());
        Some(Change { before: [before[0], before[1], before[2], both], now: [now[0], now[1], now[2], larger], ..change })
    }

    /// Whether a surface has moved as the camera made it: what moved by itself is not where paths of the previous frame are traced again.
    fn stands_still(&self, p: IVec2, linear_depth: f32, motion: Vec2) -> bool {
        let without_own = HostMotion { texel: None, transform: None };
        let of_camera = reproject(self.frame, &self.projections, p, linear_depth, without_own).motion;
        of_camera.distance(motion) <= STILL + STILL_SHARE * motion.length()
    }

    /// The change at the previous pixel that showed the surface of `p`.
    fn reshaded(&self, p: IVec2) -> Option<Change> {
        let GradientInput::Reshaded { reshaded_radiance, previous_guide, surface_motion } = self.inputs.source else {
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
        let slope: f32 = now.gradient.iter().map(|g| g.abs()).sum();
        let tolerance = self.tuning.depth_tolerance * expected + slope;
        let is_same = !before.is_background() && before.id == now.id && (before.linear_depth - expected).abs() <= tolerance;
        let radiance = reshaded_radiance?.at(j);
        let is_same = is_same && self.stands_still(p, now.linear_depth, motion.motion.into());
        (is_same && is_finite(radiance)).then(|| self.change(storable(self.frame, radiance), j)).flatten()
    }
}

fn mean_change(changes: &[Change]) -> Change {
    let share = 1.0 / changes.len().max(1) as f32;
    let add = |sum: [f32; 4], texel: [f32; 4]| std::array::from_fn(|i| sum[i] + share * texel[i]);
    let mean = changes.iter().fold(Change::default(), |sum, c| Change {
        change: sum.change + share * c.change,
        brightest: sum.brightest + share * c.brightest,
        before: add(sum.before, c.before),
        now: add(sum.now, c.now),
    });
    let squares: f32 = changes.iter().map(|c| c.now[3] * c.now[3]).sum();
    let [r, g, b, _] = mean.now;
    Change { now: [r, g, b, share * squares.sqrt()], ..mean }
}

/// A texel of the guide with a place instead of the roughness.
fn with_place([x, y, z, w]: [u16; 4], place: u32) -> [u16; 4] {
    [x & !0xf | place as u16, y, z, w]
}

/// A half of the luminance may be rounded either way, and a gradient is the difference of two.
const CHANGE: Tolerance = Tolerance { relative: 3e-3, absolute: 3e-3, outliers: 0.0 };

/// Components are halves of other halves, and the stage looks for a surface in re-shaded images.
const LIGHT: Tolerance = Tolerance { relative: 5e-3, absolute: 5e-3, outliers: 2e-3 };

/// The stage looks for a surface in re-shaded images, as a tap is looked for.
pub(crate) const RULES: &[Rule] = &[
    Rule { when: Condition::IsNot("SOURCE", 1), ..strata("gradient", CHANGE) },
    Rule { when: Condition::Is("SOURCE", 1), ..strata("gradient", Tolerance { outliers: 2e-3, ..CHANGE }) },
    strata("gradient_guide", EXACT),
    strata("light_before", LIGHT),
    strata("light_now", LIGHT),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let source = match b.constant("SOURCE")? {
        0 => GradientInput::ForwardProjected { gradient_samples: b.packed("gradient_samples")? },
        1 => GradientInput::Reshaded {
            reshaded_radiance: b.optional_colour("reshaded_radiance")?,
            previous_guide: Some(b.packed("previous_guide")?),
            surface_motion: b.packed("surface_motion")?,
        },
        _ => GradientInput::Sparse(b.optional_colour("sparse_gradient")?),
    };
    let inputs = GradientInputs {
        guide: b.packed("guide")?,
        noisy: &b.colours("noisy")?,
        albedo: b.optional_colour("albedo")?,
        previous_luminance: b.optional_uint("previous_luminance")?,
        previous_red_blue: b.optional_uint("previous_red_blue")?,
        source,
    };
    let outputs = gradient(b.frame, b.tuning, b.stratum_size()?, &inputs);
    b.write("gradient", outputs.gradient)?;
    b.write("gradient_guide", outputs.gradient_guide)?;
    if b.has("light_before") {
        b.write("light_before", outputs.light_before)?;
        b.write("light_now", outputs.light_now)?;
    }
    Ok(())
}

//! The stage `gradient_atrous` \[ASVGF 3.4, eq. 7 to 12\]: an iteration of the reconstruction of the temporal gradient.

use crate::nodes::atrous::twin::LUMINANCE_EPSILON;
use crate::reference::binary16::round_to_half;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Condition, Rule, Tolerance};
use crate::reference::geometry_weights::depth_and_normal_weight;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::light_ratio::{floor_of_ratio, sample_coherence, LARGEST_RATIO};
use crate::reference::rules::{strata, WEIGHTED};
use crate::reference::strata::Strata;
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Iterations of the presets.
#[cfg(test)]
pub(crate) const GRADIENT_ITERATIONS: u32 = 5;

/// Light of the samples of the frame before and of this one, from the stage `gradient` or from the iteration before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light<'a> {
    /// The image `light_before`.
    pub before: &'a Image<[f32; 4]>,
    /// The image `light_now`.
    pub now: &'a Image<[f32; 4]>,
}

/// Inputs of [`gradient_atrous`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct GradientAtrousInputs<'a> {
    /// The image `guide`, from the stage `import`: whose pixels have the gradient of the depth.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `gradient_guide`, from the stage `gradient`.
    pub gradient_guide: &'a Image<[u16; 4]>,
    /// Gradients from the stage `gradient`, or from the iteration before.
    pub gradient: &'a Image<[f32; 4]>,
    /// Light, where its ratio is wanted.
    pub light: Option<Light<'a>>,
    /// Whether this is the last iteration, which leaves the ratio in the place of the light before.
    pub last: bool,
}

/// Outputs of [`gradient_atrous`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GradientAtrousOutputs {
    /// δ, Δ, mean and deviation of luminance.
    pub gradient: Image<[f32; 4]>,
    /// Light before and now, where it came in; out of the last iteration [`light_ratio`] in the place of the first.
    pub light: Option<[Image<[f32; 4]>; 2]>,
}

/// Filters δ, Δ, mean and light with taps `2^level` strata apart, and the deviation of the mean along with them.
pub(crate) fn gradient_atrous(
    frame: &FrameConstants,
    tuning: &Tuning,
    stratum_size: u32,
    level: u32,
    inputs: &GradientAtrousInputs,
) -> GradientAtrousOutputs {
    let strata = Strata::new(frame, stratum_size);
    let texels = Image::compute(inputs.gradient.extent(), strata.count().into(), |s| {
        let Some(weights) = weights(tuning, strata, level, inputs, s) else {
            return [inputs.gradient.at(s), if inputs.last { NO_RATIO } else { [0.0; 4] }, [0.0; 4]];
        };
        let [change, brightest, mean, _] = weighted_mean(inputs.gradient, &weights);
        let sum: f32 = weights.iter().map(|tap| tap.1).sum();
        let variance: f32 = weights.iter().map(|(t, weight)| (weight * inputs.gradient.at(*t)[3]).powi(2)).sum();
        let gradient = [change, brightest, mean, variance.sqrt() / sum];
        let [before, now] = inputs.light.map_or([[0.0; 4]; 2], |light| filtered_light(light, inputs.last, s, &weights));
        [gradient, if inputs.last { light_ratio(before, now) } else { before }, now].map(|texel| texel.map(round_to_half))
    });
    let [gradient, before, now] = [0, 1, 2].map(|i| texels.map(|t| t[i]));
    GradientAtrousOutputs { gradient, light: inputs.light.map(|_| [before, now]) }
}

/// Level from which on a gradient of exactly 0 is kept: all samples within 3 strata shaded to the same again, so that light did not change
/// there, whatever it did farther away.
const FIRST_KEPT_LEVEL: u32 = 2;

/// The ratio of the background.
const NO_RATIO: [f32; 4] = [1.0, 1.0, 1.0, -1.0];

/// Few samples that agree may do so by chance: a spread that each sample has besides.
const LEAST_SPREAD: f32 = 0.3;
/// The spread of a ratio that no sample has.
const NO_SPREAD: f32 = 3.0;
/// Rareness of samples up to which they are believed to agree: a single one, of twice as much, agrees with itself.
const LARGEST_RARENESS: f32 = 0.5;
/// Relative error below which a ratio is known, and taps that are farther away only blur it; above twice as much they count in full.
const KNOWN_ERROR: f32 = 0.02;
/// Relative error up to which a ratio is applied in full; from twice as much on only where samples agree.
const LARGEST_ERROR: f32 = 0.05;
/// 1 over the variance of a ratio, of the squared change, from which on its components are not told apart.
const COLOUR_NOISE: f32 = 0.3;

/// rgb: the factor by which light changed, as far as it is known; alpha: its coherence, by the spread of the samples' own factors.
pub(crate) fn light_ratio(before: [f32; 4], now: [f32; 4]) -> [f32; 4] {
    let error = error_of(before, now);
    let believed = (2.0 - rareness_of(before, now) / LARGEST_RARENESS).clamp(0.0, 1.0);
    let coherence = sample_coherence(spread_of(before, now)) * believed;
    let [sum_before, sum_now] = [before, now].map(sum_of);
    let least = floor_of_ratio([before[0], before[1], before[2]]);
    let ratio = |before: f32, now: f32| ((now + least) / (before + least)).min(LARGEST_RATIO);
    let change = (sum_now - sum_before) / sum_before.max(sum_now).max(1e-6);
    let noise = (COLOUR_NOISE * error * error / (change * change).max(1e-8)).clamp(0.0, 1.0);
    let applied = coherence.max((2.0 - error / LARGEST_ERROR).clamp(0.0, 1.0));
    let of_component = |i: usize| {
        let (own, whole) = (ratio(before[i], now[i]), ratio(sum_before, sum_now));
        // A power, so that light which falls and rises again by the same factor leaves a history as it was.
        (own + noise * (whole - own)).powf(applied)
    };
    [of_component(0), of_component(1), of_component(2), coherence]
}

/// Relative spread of the ratio from sample to sample: by how far the mean of √(before · now), in the alpha of `before`, falls short of
/// what one factor for all samples would give (Cauchy and Schwarz).
fn spread_of(before: [f32; 4], now: [f32; 4]) -> f32 {
    let largest: f32 = (0..3).map(|i| (before[i] * now[i]).sqrt()).sum();
    if largest > 0.0 {
        (8.0 * (1.0 - before[3] / largest).max(0.0)).sqrt()
    } else {
        NO_SPREAD
    }
}

/// Relative standard error of the ratio: the spread over the root of the number of samples that hold the light.
fn error_of(before: [f32; 4], now: [f32; 4]) -> f32 {
    spread_of(before, now).hypot(LEAST_SPREAD) * rareness_of(before, now)
}

/// 1 over the root of the number of samples that hold the light.
fn rareness_of(before: [f32; 4], now: [f32; 4]) -> f32 {
    if now[3] > 0.0 {
        (now[3] / sum_of(before).max(sum_of(now))).min(1.0)
    } else {
        1.0
    }
}

fn sum_of(light: [f32; 4]) -> f32 {
    light[..3].iter().sum()
}

/// Light before and now, of taps that count as far as the ratio of the stratum `s` itself is not known. One that is not known by the last
/// iteration would say too little of the place.
fn filtered_light(light: Light, last: bool, s: IVec2, weights: &[(IVec2, f32)]) -> [[f32; 4]; 2] {
    let error = error_of(light.before.at(s), light.now.at(s));
    let unknown = if last { 0.0 } else { (error / KNOWN_ERROR - 1.0).clamp(0.0, 1.0) };
    let weights: Vec<_> = weights.iter().map(|(t, weight)| (*t, if *t == s { 1.0 } else { weight * unknown })).collect();
    let sum: f32 = weights.iter().map(|tap| tap.1).sum();
    let squares: f32 = weights.iter().map(|(t, weight)| (weight * light.now.at(*t)[3]).powi(2)).sum();
    let [r, g, b, _] = weighted_mean(light.now, &weights);
    [weighted_mean(light.before, &weights), [r, g, b, squares.sqrt() / sum]]
}

fn weighted_mean(image: &Image<[f32; 4]>, weights: &[(IVec2, f32)]) -> [f32; 4] {
    let sum: f32 = weights.iter().map(|tap| tap.1).sum();
    std::array::from_fn(|i| weights.iter().map(|(t, weight)| weight * image.at(*t)[i]).sum::<f32>() / sum)
}

/// The strata that count for `s`, itself with weight 1; `None` in the background.
fn weights(tuning: &Tuning, strata: Strata, level: u32, inputs: &GradientAtrousInputs, s: IVec2) -> Option<Vec<(IVec2, f32)>> {
    let centre = inputs.gradient.at(s);
    let surface = unpack_guide(inputs.gradient_guide.at(s));
    if surface.is_background() {
        return None;
    }
    let is_unchanged = level >= FIRST_KEPT_LEVEL && centre[0] == 0.0 && centre[1] > 0.0;
    if is_unchanged {
        return Some(vec![(s, 1.0)]);
    }
    let p = pixel_of(strata, inputs.gradient_guide, s);
    let surface = Surface { gradient: unpack_guide(inputs.guide.at(p)).gradient, ..surface };
    let tolerance = tuning.sigma_l * centre[3] + LUMINANCE_EPSILON;
    let weight = |t: IVec2| {
        if t == s {
            return Some((t, 1.0));
        }
        let tap = Some(t).filter(|t| strata.contains(*t)).map(|t| unpack_guide(inputs.gradient_guide.at(t)));
        let tap = tap.filter(|tap| !tap.is_background())?;
        let offset = (pixel_of(strata, inputs.gradient_guide, t) - p).as_vec2();
        let weight_l = (-(inputs.gradient.at(t)[2] - centre[2]).abs() / tolerance).exp();
        let sigmas = [tuning.sigma_z, tuning.sigma_n];
        Some((t, weight_l * depth_and_normal_weight(sigmas, &surface, &tap, offset)))
    };
    Some((0..9).filter_map(|i| weight(s + IVec2::new(i % 3 - 1, i / 3 - 1) * (1 << level))).collect())
}

/// The pixel that stands for a stratum.
fn pixel_of(strata: Strata, gradient_guide: &Image<[u16; 4]>, s: IVec2) -> IVec2 {
    let place = i32::from(gradient_guide.at(s)[0] & 0xf);
    let size = strata.size as i32;
    strata.first_pixel(s) + IVec2::new(place % size, place / size)
}

/// The ratio is steep: it fades out where samples disagree by a few hundredths more.
pub(crate) const RULES: &[Rule] = &[
    strata("gradient_out", WEIGHTED),
    strata("now_out", WEIGHTED),
    Rule { when: Condition::IsNot("LAST", 1), ..strata("before_out", WEIGHTED) },
    Rule { when: Condition::Is("LAST", 1), ..strata("before_out", Tolerance { absolute: 2e-2, outliers: 2e-3, ..WEIGHTED }) },
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let before = b.optional_colour("before_in")?;
    let light = before.map(|before| b.colour("now_in").map(|now| Light { before, now })).transpose()?;
    let inputs = GradientAtrousInputs {
        guide: b.packed("guide")?,
        gradient_guide: b.packed("gradient_guide")?,
        gradient: b.colour("gradient_in")?,
        light,
        last: light.is_some() && b.is_on("LAST")?,
    };
    let outputs = gradient_atrous(b.frame, b.tuning, b.stratum_size()?, b.level, &inputs);
    b.write("gradient_out", outputs.gradient)?;
    if let Some([before, now]) = outputs.light {
        b.write("before_out", before)?;
        b.write("now_out", now)?;
    }
    Ok(())
}

//! Every stage: its name, its twin, and how what it writes is compared with the GPU.

use super::bindings::Twin;
use super::compare::{Per, Rule, Tolerance, Values, When};
use super::texels::Texels;
use super::*;

/// A stage on the CPU.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Name of the stage: that of its shader.
    pub name: &'static str,
    /// The CPU twin.
    pub twin: Twin,
    /// Rules by which the bindings that it writes are compared, in no particular order. Some have several, all of which must hold.
    pub rules: &'static [Rule],
}

impl Stage {
    /// The stage of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        STAGES.iter().find(|stage| stage.name == name)
    }

    /// Compares what the GPU and the twin wrote to one binding of a pass, in a frame of `render_extent` pixels. `constants` are the
    /// specialisation constants of the pass: they say how large strata are, and which rules hold.
    ///
    /// # Errors
    /// A message that names stage and binding, with the number of texels that differ and the first of them; or says that there is
    /// no rule.
    pub fn compare(
        &self,
        binding: &str,
        constants: &[(&str, u32)],
        render_extent: [u32; 2],
        gpu: &Texels,
        twin: &Texels,
    ) -> Result<(), String> {
        let stratum_size = constants.iter().find(|c| c.0 == "STRATUM_SIZE").map_or(1, |c| c.1);
        let mut rules = self.rules.iter().filter(|rule| rule.binding == binding && rule.holds(constants)).peekable();
        if rules.peek().is_none() {
            return Err(format!("{}: there is no rule by which `{binding}` is compared", self.name));
        }
        rules
            .try_for_each(|rule| rule.compare(stratum_size, render_extent, gpu, twin))
            .map_err(|message| format!("{}: {message}", self.name))
    }
}

const EXACT: Tolerance = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };

/// Half floats have 11 bits and devices round them either way: two steps, and next to nothing near zero.
const HALF: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-5, outliers: 0.0 };

/// A tap's test may fall the other way where a value lies on its threshold.
const TESTED: Tolerance = Tolerance { outliers: 2e-3, ..HALF };

/// 25 weights, each an exponential with the device's own precision.
const WEIGHTED: Tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };

/// Normals are rounded to a grid of 1/511, and either side of a step is right.
const STEP: Tolerance = Tolerance { relative: 1e-5, absolute: 5e-3, outliers: 0.0 };

const MOTION: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-3, outliers: 0.0 };

/// A half of the luminance may be rounded either way, and a gradient is the difference of two.
const CHANGE: Tolerance = Tolerance { relative: 3e-3, absolute: 3e-3, outliers: 0.0 };

/// Slopes are steep: a step of a half float in a percentile or a deviation moves the result by more than one.
const STEEP: Tolerance = Tolerance { absolute: 5e-3, outliers: 2e-3, ..HALF };

/// The clip divides by a deviation that is the root of a difference.
const CLIPPED: Tolerance = Tolerance { absolute: 1e-3, ..HALF };

const fn rule(binding: &'static str, per: Per, values: Values, tolerance: Tolerance) -> Rule {
    Rule { binding, per, values, tolerance, when: When::Always }
}

const fn pixels(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Per::Pixel, Values::Plain, tolerance)
}

const fn strata(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Per::Stratum, Values::Plain, tolerance)
}

const STATISTICS: Rule = rule("statistics", Per::Buffer, Values::Plain, EXACT);

const IMPORT: &[Rule] = &[
    STATISTICS,
    rule("guide", Per::Pixel, Values::Guide, STEP),
    rule("surface_motion", Per::Pixel, Values::PreviousNormal, Tolerance { absolute: 2e-2, ..STEP }),
    rule("surface_motion", Per::Pixel, Values::SurfaceMotion, MOTION),
    rule("depth_gradient", Per::Pixel, Values::DepthGradient, MOTION),
    rule("object_normal_guide", Per::Pixel, Values::Normal, STEP),
];

/// Equal to the bit; claims lie a texel a stratum.
const FORWARD_PROJECT: &[Rule] =
    &[STATISTICS, strata("claims", EXACT), strata("gradient_samples", EXACT), strata("candidates", EXACT)];

/// The stage looks for a surface in re-shaded images, as a tap is looked for.
const GRADIENT: &[Rule] = &[
    Rule { when: When::IsNot("SOURCE", 1), ..strata("gradient", CHANGE) },
    Rule { when: When::Is("SOURCE", 1), ..strata("gradient", Tolerance { outliers: 2e-3, ..CHANGE }) },
    strata("gradient_guide", EXACT),
    rule("noisy_luminance", Per::Pixel, Values::Halves, HALF),
];

/// A pixel whose position or depth lies on its threshold may count on one side alone.
const BLOCK_DIFFERENCE: &[Rule] =
    &[rule("block_difference", Per::Block, Values::Difference, Tolerance { absolute: 2e-3, outliers: 2e-2, ..HALF })];

/// A deviation near 0 is the root of a difference that rounding decides.
const ACCUMULATED_MOMENTS: Tolerance = Tolerance { absolute: 2e-3, ..TESTED };

const TEMPORAL_ACCUMULATION: &[Rule] = &[
    pixels("irradiance_0", TESTED),
    pixels("irradiance_1", TESTED),
    rule("moments_0", Per::Pixel, Values::Moments, ACCUMULATED_MOMENTS),
    rule("moments_1", Per::Pixel, Values::Moments, ACCUMULATED_MOMENTS),
];

/// The root of a difference of moments: where the variance is next to 0, rounding decides it.
const ESTIMATED: Tolerance = Tolerance { relative: 3e-3, absolute: 2e-3, ..HALF };

/// Colours go through a power, which devices round each in its own way.
const PICTURE: Tolerance = Tolerance { relative: 4e-3, absolute: 2e-4, ..HALF };

const fn stage(name: &'static str, twin: Twin, rules: &'static [Rule]) -> Stage {
    Stage { name, twin, rules }
}

/// Compares the output of a host's stage, one texel for every `divisor` × `divisor` pixels: half floats whose weights have the
/// device's own precision.
pub(super) fn compare_host_stage(divisor: u32, render_extent: [u32; 2], gpu: &Texels, twin: &Texels) -> Result<(), String> {
    strata("its output", WEIGHTED).compare(divisor, render_extent, gpu, twin)
}

/// Every stage that has a twin.
pub static STAGES: &[Stage] = &[
    stage("import", import::twin, IMPORT),
    stage("forward_project", forward_project::twin, FORWARD_PROJECT),
    stage("gradient", gradient::twin, GRADIENT),
    stage("gradient_atrous", gradient_atrous::twin, &[strata("gradient_out", WEIGHTED)]),
    stage("adaptive_alpha", adaptive_alpha::twin, &[pixels("history_confidence", HALF)]),
    stage("demodulate", demodulate::twin, &[STATISTICS, pixels("irradiance_0", HALF), pixels("irradiance_1", HALF)]),
    stage("block_percentiles", block_percentiles::twin, &[rule("block_percentiles", Per::Block, Values::Percentiles, HALF)]),
    stage("firefly", firefly::twin, &[pixels("irradiance", HALF)]),
    stage("block_difference", block_difference::twin, BLOCK_DIFFERENCE),
    stage("percentile_rule", percentile_rule::twin, &[pixels("history_confidence", STEEP)]),
    stage("change_test", change_test::twin, &[pixels("history_confidence", STEEP)]),
    stage("temporal_accumulation", temporal_accumulation::twin, TEMPORAL_ACCUMULATION),
    stage("variance", variance::twin, &[pixels("estimated_0", ESTIMATED), pixels("estimated_1", ESTIMATED)]),
    stage("atrous", atrous::twin, &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED)]),
    stage("eaw", eaw::twin, &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED)]),
    stage("modulate", modulate::twin, &[STATISTICS, pixels("denoised_radiance", HALF)]),
    stage(
        "volume_motion",
        volume_motion::twin,
        &[pixels("claims", EXACT), rule("volume_motion", Per::Pixel, Values::Halves, EXACT)],
    ),
    stage("volume_points", volume_points::twin, &[STATISTICS, pixels("radiance", HALF), pixels("volume_points", EXACT)]),
    stage("tone_map", tone_map::twin, &[pixels("tone_mapped", HALF)]),
    stage("taa", taa::twin, &[pixels("taa_history", CLIPPED), pixels("display", CLIPPED)]),
    stage("debug_view", debug_view::twin, &[pixels("debug_view", PICTURE)]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_stage_has_one_name() {
        let names: BTreeSet<_> = STAGES.iter().map(|stage| stage.name).collect();
        assert_eq!(names.len(), STAGES.len());
        assert!(Stage::find("atrous").is_some() && Stage::find("atrous_0").is_none());
    }

    #[test]
    fn a_constant_may_choose_the_rule() {
        let stage = Stage::find("gradient").expect("known");
        let grey = |l: f32| Texels::Colour(test_scene::paint([4, 4], |x, y| [if (x, y) == (1, 1) { l } else { 1.0 }; 4]));
        let compare =
            |source| stage.compare("gradient", &[("SOURCE", source), ("STRATUM_SIZE", 3)], [12, 12], &grey(1.0), &grey(2.0));
        assert!(compare(1).is_ok(), "one stratum of sixteen may differ");
        let message = compare(0).expect_err("none may");
        assert!(message.contains("gradient") && message.contains("1,1"), "{message}");
    }

    #[test]
    fn what_has_no_rule_is_not_equal() {
        let texels = Texels::Scalar(Image::new([1, 1], 0.0));
        let message = Stage::find("taa").expect("known").compare("output_0", &[], [1, 1], &texels, &texels);
        assert!(message.expect_err("no rule").contains("output_0"));
    }
}

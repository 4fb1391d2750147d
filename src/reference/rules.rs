//! Rules by which outputs of stages are compared with the GPU: named tolerances with their reasons, and rules of more than a line.

use super::compare::{Per, Rule, Tolerance, Values, When};

pub(crate) const EXACT: Tolerance = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };

/// Half floats have 11 bits and devices round them either way: two steps, and next to nothing near zero.
pub(crate) const HALF: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-5, outliers: 0.0 };

/// Light is rounded by the shader, whatever the device's stores do: most texels are equal to the bit, and others had values on either side
/// of the middle of two halves. Of a device that cut bits off half of them would differ.
pub(crate) const fn rounded(binding: &'static str) -> Rule {
    rule(binding, Per::Pixel, Values::Rgb, Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.25 })
}

/// A tap's test may fall the other way where a value lies on its threshold.
pub(crate) const TESTED: Tolerance = Tolerance { outliers: 2e-3, ..HALF };

/// 25 weights, each an exponential with the device's own precision.
pub(crate) const WEIGHTED: Tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };

/// Normals are rounded to a grid of 1/511, and either side of a step is right.
pub(crate) const STEP: Tolerance = Tolerance { relative: 1e-5, absolute: 5e-3, outliers: 0.0 };

/// As above, with the guide's grid of 1/127.
pub(crate) const GUIDE_STEP: Tolerance = Tolerance { absolute: 8e-3, ..STEP };

pub(crate) const MOTION: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-3, outliers: 0.0 };

/// A half of the luminance may be rounded either way, and a gradient is the difference of two.
pub(crate) const CHANGE: Tolerance = Tolerance { relative: 3e-3, absolute: 3e-3, outliers: 0.0 };

/// Slopes are steep: a step of a half float in a percentile or a deviation moves the result by more than one.
pub(crate) const STEEP: Tolerance = Tolerance { absolute: 5e-3, outliers: 2e-3, ..HALF };

/// The clip divides by a deviation that is the root of a difference.
pub(crate) const CLIPPED: Tolerance = Tolerance { absolute: 1e-3, ..HALF };

pub(crate) const fn rule(binding: &'static str, per: Per, values: Values, tolerance: Tolerance) -> Rule {
    Rule { binding, per, values, tolerance, when: When::Always }
}

pub(crate) const fn pixels(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Per::Pixel, Values::Plain, tolerance)
}

pub(crate) const fn strata(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Per::Stratum, Values::Plain, tolerance)
}

pub(crate) const STATISTICS: Rule = rule("statistics", Per::Buffer, Values::Plain, EXACT);

pub(crate) const IMPORT: &[Rule] = &[
    STATISTICS,
    rule("guide", Per::Pixel, Values::Guide, GUIDE_STEP),
    rule("surface_motion", Per::Pixel, Values::PreviousNormal, Tolerance { absolute: 2e-2, ..STEP }),
    rule("surface_motion", Per::Pixel, Values::SurfaceMotion, MOTION),
    rule("depth_gradient", Per::Pixel, Values::DepthGradient, MOTION),
    rule("object_normal_guide", Per::Pixel, Values::Normal, STEP),
];

/// Equal to the bit; claims lie a texel a stratum.
pub(crate) const FORWARD_PROJECT: &[Rule] =
    &[STATISTICS, strata("claims", EXACT), strata("gradient_samples", EXACT), strata("candidates", EXACT)];

/// The stage looks for a surface in re-shaded images, as a tap is looked for.
pub(crate) const GRADIENT: &[Rule] = &[
    Rule { when: When::IsNot("SOURCE", 1), ..strata("gradient", CHANGE) },
    Rule { when: When::Is("SOURCE", 1), ..strata("gradient", Tolerance { outliers: 2e-3, ..CHANGE }) },
    strata("gradient_guide", EXACT),
    strata("light_before", LIGHT),
    strata("light_now", LIGHT),
];

/// Components are halves of other halves, and the stage looks for a surface in re-shaded images.
pub(crate) const LIGHT: Tolerance = Tolerance { relative: 5e-3, absolute: 5e-3, outliers: 2e-3 };

/// The ratio is steep: it fades out where samples disagree by a few hundredths more.
pub(crate) const GRADIENT_ATROUS: &[Rule] = &[
    strata("gradient_out", WEIGHTED),
    strata("now_out", WEIGHTED),
    Rule { when: When::IsNot("LAST", 1), ..strata("before_out", WEIGHTED) },
    Rule { when: When::Is("LAST", 1), ..strata("before_out", Tolerance { absolute: 2e-2, outliers: 2e-3, ..WEIGHTED }) },
];

pub(crate) const DEMODULATE: &[Rule] = &[
    STATISTICS,
    pixels("irradiance_0", HALF),
    pixels("irradiance_1", HALF),
    rounded("irradiance_0"),
    rounded("irradiance_1"),
    rule("noisy_luminance", Per::Pixel, Values::Halves, HALF),
    rule("noisy_red_blue", Per::Pixel, Values::Halves, HALF),
];

pub(crate) const FILTERED: &[Rule] =
    &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED), rounded("output_0"), rounded("output_1")];

pub(crate) const SAMPLE_ALBEDO: &[Rule] =
    &[pixels("irradiance_0", HALF), pixels("irradiance_1", HALF), strata("candidate_albedo", HALF)];

/// A pixel whose position or depth lies on its threshold may count on one side alone.
pub(crate) const BLOCK_DIFFERENCE: &[Rule] =
    &[rule("block_difference", Per::Block, Values::Difference, Tolerance { absolute: 2e-3, outliers: 2e-2, ..HALF })];

/// A deviation near 0 is the root of a difference that rounding decides.
pub(crate) const ACCUMULATED_MOMENTS: Tolerance = Tolerance { absolute: 2e-3, ..TESTED };

/// A pixel whose test falls the other way moves from one counter to another.
pub(crate) const HISTORY_COUNTS: Tolerance = Tolerance { relative: 2e-2, absolute: 4.0, outliers: 0.0 };

pub(crate) const TEMPORAL_ACCUMULATION: &[Rule] = &[
    rule("statistics", Per::Buffer, Values::Counts, HISTORY_COUNTS),
    pixels("irradiance_0", TESTED),
    pixels("irradiance_1", TESTED),
    rounded("irradiance_0"),
    rounded("irradiance_1"),
    rule("new_moments_0", Per::Pixel, Values::Halves, ACCUMULATED_MOMENTS),
    rule("new_moments_1", Per::Pixel, Values::Halves, ACCUMULATED_MOMENTS),
];

/// Where what was seen before lies is computed by quotients, and a pixel of it counts or not.
pub(crate) const SPECULAR_ACCUMULATION: &[Rule] = &[
    pixels("accumulated", TRACKED),
    rule("new_moments", Per::Pixel, Values::Halves, Tolerance { absolute: 3e-3, ..TRACKED }),
    rule("reflection", Per::Pixel, Values::Reflection, Tolerance { absolute: ROUGHNESS_STEP, ..HALF }),
    rule("reflection", Per::Pixel, Values::ImageShare, Tolerance { absolute: 0.05, ..TRACKED }),
];

/// Roughness may be rounded either way.
const ROUGHNESS_STEP: f32 = 1.01 / 1023.0;

pub(crate) const TRACKED: Tolerance = Tolerance { relative: 3e-3, absolute: 1e-3, outliers: 5e-3 };

/// Moments pass through to the history as they came.
pub(crate) const VARIANCE: &[Rule] = &[
    pixels("irradiance_0", ESTIMATED),
    pixels("irradiance_1", ESTIMATED),
    rule("moments_0", Per::Pixel, Values::Moments, EXACT),
    rule("moments_1", Per::Pixel, Values::Moments, EXACT),
];

/// The root of a difference of moments: where the variance is next to 0, rounding decides it.
pub(crate) const ESTIMATED: Tolerance = Tolerance { relative: 3e-3, absolute: 2e-3, ..HALF };

/// Colours go through a power, which devices round each in its own way.
pub(crate) const PICTURE: Tolerance = Tolerance { relative: 4e-3, absolute: 2e-4, ..HALF };

pub(crate) const VISIBILITY_SAMPLES: &[Rule] = &[STATISTICS, rule("visibility_samples", Per::Pixel, Values::Halves, HALF)];

/// A step of the packing, next to a test that may fall the other way: whether a penumbra reaches a pixel.
pub(crate) const VISIBILITY_ACCUMULATION: &[Rule] = &[
    rule("visibility_history", Per::Pixel, Values::Visibility, Tolerance { relative: 0.0, absolute: 1e-3, outliers: 2e-3 }),
    rule("visibility_history", Per::Pixel, Values::VisibilitySteps, Tolerance { relative: 0.0, absolute: 1.0, outliers: 2e-3 }),
];

pub(crate) const VISIBILITY_FILTER: &[Rule] =
    &[rule("filter_out", Per::Pixel, Values::Halves, WEIGHTED), pixels("denoised_visibility", WEIGHTED)];

//! Rules by which outputs of stages are compared with the GPU: named tolerances with their reasons, and rules of more than a line.

use super::compare::{Condition, Reading, Rule, Tolerance, Unit};

pub(crate) const EXACT: Tolerance = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };

/// Half floats have 11 bits and devices round them either way: two steps, and next to nothing near zero.
pub(crate) const HALF: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-5, outliers: 0.0 };

/// Light is rounded by the shader, whatever the device's stores do: most texels are equal to the bit, and others had values on either side
/// of the middle of two halves. Of a device that cut bits off half of them would differ.
pub(crate) const fn rounded(binding: &'static str) -> Rule {
    rule(binding, Unit::Pixel, Reading::Rgb, Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.25 })
}

/// A tap's test may fall the other way where a value lies on its threshold.
pub(crate) const TESTED: Tolerance = Tolerance { outliers: 2e-3, ..HALF };

/// A pixel whose test falls the other way is counted elsewhere, or not at all.
pub(crate) const TESTED_COUNTS: Tolerance = Tolerance { relative: 2e-2, absolute: 4.0, outliers: 0.0 };

/// 25 weights, each an exponential with the device's own precision.
pub(crate) const WEIGHTED: Tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };

/// Normals are rounded to a grid of 1/511, and either side of a step is right.
pub(crate) const STEP: Tolerance = Tolerance { relative: 1e-5, absolute: 5e-3, outliers: 0.0 };

/// Slopes are steep: a step of a half float in a percentile or a deviation moves the result by more than one.
pub(crate) const STEEP: Tolerance = Tolerance { absolute: 5e-3, outliers: 2e-3, ..HALF };

pub(crate) const fn rule(binding: &'static str, per: Unit, values: Reading, tolerance: Tolerance) -> Rule {
    Rule { binding, per, values, tolerance, when: Condition::Always }
}

pub(crate) const fn pixels(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Unit::Pixel, Reading::Plain, tolerance)
}

pub(crate) const fn strata(binding: &'static str, tolerance: Tolerance) -> Rule {
    rule(binding, Unit::Stratum, Reading::Plain, tolerance)
}

/// Where deviations are marked. The marks are the bits that rounding decides elsewhere.
pub(crate) const fn rare_light(binding: &'static str) -> Rule {
    Rule {
        when: Condition::Is("MARKED", 1),
        ..rule(binding, Unit::Pixel, Reading::RareLight, Tolerance { outliers: 2e-3, ..EXACT })
    }
}

pub(crate) const STATISTICS: Rule = rule("statistics", Unit::Buffer, Reading::Plain, EXACT);

pub(crate) const FILTERED: &[Rule] =
    &[pixels("output_0", WEIGHTED), pixels("output_1", WEIGHTED), rounded("output_0"), rounded("output_1")];

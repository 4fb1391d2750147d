//! `variance`.

use super::compare::{halves, Tolerance, HALF};
use super::{each, Captured};
use atrous::config::Preset;
use atrous::reference::{fading_variance, variance, VarianceInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let (irradiance, moments) = (c.signals("filter_ping", UseFrame::Current), c.packed_signals("moments", UseFrame::Current));
    let inputs = VarianceInputs {
        guide: &c.packed("guide", UseFrame::Current),
        depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
        irradiance: &each(&irradiance),
        moments: &each(&moments),
    };
    let estimate = if c.config.preset == Preset::Percentile { fading_variance } else { variance };
    let twin = estimate(&c.frame.constants, c.tuning, &inputs);
    for (suffix, twin) in c.suffixes().iter().zip(&twin) {
        let name = format!("filter_pong{suffix}");
        // The root of a difference of moments: where the variance is next to 0, rounding decides it.
        halves(&name, c, &c.written_halves(&name), twin, Tolerance { relative: 3e-3, absolute: 2e-3, ..HALF });
    }
}

//! `atrous`, every level.

use super::compare::{halves, Tolerance, HALF};
use super::{each, Captured};
use atrous::config::Preset;
use atrous::reference::{atrous, box_atrous, AtrousInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, level: u32) {
    let (from, to) = match level {
        0 => ("filter_pong", "irradiance_history"),
        1 => ("irradiance_history", "filter_ping"),
        l if l % 2 == 0 => ("filter_ping", "filter_pong"),
        _ => ("filter_pong", "filter_ping"),
    };
    let irradiance = c.signals(from, UseFrame::Current);
    let inputs = AtrousInputs {
        guide: &c.packed("guide", UseFrame::Current),
        depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
        irradiance: &each(&irradiance),
    };
    let twin = match c.config.preset {
        Preset::Asvgf | Preset::Percentile => box_atrous(&c.frame.constants, c.tuning, level, &inputs),
        _ => atrous(&c.frame.constants, c.tuning, level, &inputs),
    };
    for (suffix, twin) in c.suffixes().iter().zip(&twin) {
        let name = format!("{to}{suffix}");
        // 25 weights, each an exponential with the device's own precision.
        let tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };
        halves(&format!("{name} of level {level}"), c, &c.written_halves(&name), twin, tolerance);
    }
}

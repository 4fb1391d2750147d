//! `eaw`, every level.

use super::compare::{halves, Tolerance, HALF};
use super::{each, Captured};
use atrous::reference::{eaw, EawInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, level: u32) {
    let (from, to) = if level.is_multiple_of(2) { ("filter_ping", "filter_pong") } else { ("filter_pong", "filter_ping") };
    let irradiance = c.signals(from, UseFrame::Current);
    let inputs = EawInputs {
        guide: &c.packed("guide", UseFrame::Current),
        irradiance: &each(&irradiance),
        weights: c.config.eaw_weights,
        painting_levels: c.config.sampling as u32,
    };
    let twin = eaw(&c.frame.constants, c.tuning, level, &inputs);
    for (suffix, twin) in c.suffixes().iter().zip(&twin) {
        let name = format!("{to}{suffix}");
        let tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };
        halves(&format!("{name} of level {level}"), c, &c.written_halves(&name), twin, tolerance);
    }
}

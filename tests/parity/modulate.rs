//! `modulate`.

use super::compare::{halves, HALF};
use super::{each, Captured};
use atrous::config::Preset;
use atrous::reference::{modulate, ModulateInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let last = match c.config.levels - 1 {
        _ if c.config.preset == Preset::Stabilize => "irradiance_history",
        0 => "irradiance_history",
        l if l % 2 == 1 => "filter_ping",
        _ => "filter_pong",
    };
    let irradiance = c.signals(last, UseFrame::Current);
    let (albedo, emission) = (c.optional_host("albedo"), c.optional_host("emission"));
    let inputs = ModulateInputs {
        guide: &c.packed("guide", UseFrame::Current),
        irradiance: &each(&irradiance),
        albedo: albedo.as_ref(),
        emission: emission.as_ref(),
    };
    let twin = modulate(&c.frame.constants, &inputs);
    halves("denoised_radiance", c, &c.written_halves("denoised_radiance"), &twin.denoised_radiance, HALF);
}

//! `demodulate`.

use super::compare::{halves, HALF};
use super::{each, Captured};
use atrous::config::{Preset, Sampling};
use atrous::reference::{demodulate, DemodulateInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let guide = c.packed("guide", UseFrame::Current);
    let albedo = c.optional_host("albedo");
    let noisy: Vec<_> = c.filtered().iter().map(|n| c.host(n)).collect();
    let has_holes = c.config.preset == Preset::Eaw && c.config.sampling != Sampling::Full;
    let inputs = DemodulateInputs { guide: &guide, noisy: &each(&noisy), albedo: albedo.as_ref(), has_holes };
    let twin = demodulate(&c.frame.constants, &inputs);
    for (suffix, twin) in c.suffixes().iter().zip(&twin.irradiance) {
        let name = format!("{}{suffix}", c.accumulated());
        halves(&name, c, &c.written_halves(&name), twin, HALF);
    }
}

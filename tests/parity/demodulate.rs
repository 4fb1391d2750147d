//! `demodulate`.

use super::compare::{halves, HALF};
use super::{each, Captured};
use atrous::reference::{demodulate, DemodulateInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let guide = c.packed("guide", UseFrame::Current);
    let albedo = c.optional_host("albedo");
    let noisy: Vec<_> = c.filtered().iter().map(|n| c.host(n)).collect();
    let twin = demodulate(&c.frame.constants, &DemodulateInputs { guide: &guide, noisy: &each(&noisy), albedo: albedo.as_ref() });
    for (suffix, twin) in c.suffixes().iter().zip(&twin.irradiance) {
        let name = format!("{}{suffix}", c.accumulated());
        halves(&name, c, &c.written_halves(&name), twin, HALF);
    }
}

//! `demodulate`.

use super::compare::{halves, HALF};
use super::{each, Captured};
use atrous::reference::{demodulate, DemodulateInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let guide = c.packed("guide", UseFrame::Current);
    let albedo = c.optional_host("albedo");
    let names: &[&str] = if c.suffixes().len() == 1 { &["noisy_radiance"] } else { &["noisy_direct", "noisy_indirect"] };
    let noisy: Vec<_> = names.iter().map(|n| c.host(n)).collect();
    let twin = demodulate(&c.frame.constants, &DemodulateInputs { guide: &guide, noisy: &each(&noisy), albedo: albedo.as_ref() });
    for (suffix, twin) in c.suffixes().iter().zip(&twin.irradiance) {
        let name = format!("filter_ping{suffix}");
        halves(&name, c, &c.written_halves(&name), twin, HALF);
    }
}

//! `firefly`.

use super::compare::{halves, HALF};
use super::Captured;
use atrous::reference::{firefly, FireflyInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, suffix: &str) {
    let name = format!("filter_ping{suffix}");
    let inputs = FireflyInputs {
        guide: &c.packed("guide", UseFrame::Current),
        block_percentiles: &c.block_uints(&format!("block_percentiles{suffix}")),
        irradiance: &c.halves(&name, UseFrame::Current),
    };
    halves(&name, c, &c.written_halves(&name), &firefly(&c.frame.constants, &inputs), HALF);
}

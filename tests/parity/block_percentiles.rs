//! `block_percentiles`.

use super::compare::{blocks, HALF};
use super::Captured;
use atrous::reference::{block_percentiles, unpack_percentiles, BlockPercentilesInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, suffix: &str) {
    let (guide, irradiance) = (c.packed("guide", UseFrame::Current), c.halves(&format!("filter_ping{suffix}"), UseFrame::Current));
    let twin = block_percentiles(&c.frame.constants, &BlockPercentilesInputs { guide: &guide, irradiance: &irradiance });
    let name = format!("block_percentiles{suffix}");
    blocks(&name, c, &c.written_blocks(&name), &twin, HALF, |t| {
        let p = unpack_percentiles(t);
        [p.low, p.up]
    });
}

//! `block_percentiles`.

use super::compare::{blocks, HALF};
use super::Captured;
use atrous::reference::{block_percentiles, unpack_percentiles, BlockPercentilesInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, suffix: &str) {
    // Every pixel of a volume takes part.
    let guide = c.has("guide").then(|| c.packed("guide", UseFrame::Current));
    assert_eq!(guide.is_none(), suffix == "_volume");
    let irradiance = c.halves(&format!("{}{suffix}", c.accumulated()), UseFrame::Current);
    let twin =
        block_percentiles(&c.frame.constants, c.tuning, &BlockPercentilesInputs { guide: guide.as_ref(), irradiance: &irradiance });
    let name = format!("block_percentiles{suffix}");
    blocks(&name, c, &c.written_blocks(&name), &twin, HALF, |t| {
        let p = unpack_percentiles(t);
        [p.low, p.up]
    });
}

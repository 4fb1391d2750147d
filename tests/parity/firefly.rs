//! `firefly`.

use super::compare::{halves, HALF};
use super::Captured;
use atrous::reference::{firefly, FireflyInputs};
use atrous::UseFrame;

pub fn check(c: &Captured, suffix: &str) {
    let name = format!("{}{suffix}", c.accumulated());
    // Every pixel of a volume takes part.
    let guide = c.has("guide").then(|| c.packed("guide", UseFrame::Current));
    assert_eq!(guide.is_none(), suffix == "_volume");
    let inputs = FireflyInputs {
        guide: guide.as_ref(),
        block_percentiles: &c.block_uints(&format!("block_percentiles{suffix}")),
        irradiance: &c.halves(&name, UseFrame::Current),
    };
    halves(&name, c, &c.written_halves(&name), &firefly(&c.frame.constants, c.tuning, &inputs), HALF);
}

//! `taa`.

use super::compare::{halves, Tolerance, HALF};
use super::Captured;
use atrous::reference::{taa, TaaInputs};
use atrous::UseFrame;

pub fn check(c: &Captured) {
    let tone_mapped = c.halves("tone_mapped", UseFrame::Current);
    let previous = c.halves("taa_history", UseFrame::Previous);
    let inputs = TaaInputs {
        tone_mapped: &tone_mapped,
        guide: &c.packed("guide", UseFrame::Current),
        surface_motion: &c.packed("surface_motion", UseFrame::Current),
        previous: Some(&previous),
    };
    let twin = taa(&c.frame.constants, c.tuning, &inputs);
    // The clip divides by a deviation that is the root of a difference.
    let tolerance = Tolerance { absolute: 1e-3, ..HALF };
    for name in ["taa_history", "display"] {
        halves(name, c, &c.written_halves(name), &twin, tolerance);
    }
}

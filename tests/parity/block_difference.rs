//! `block_difference`.

use super::compare::{blocks, Tolerance, HALF};
use super::Captured;
use atrous::reference::{block_difference, unpack_difference, BlockDifferenceInputs, HistoryGuides, SignalHistory};
use atrous::UseFrame;

pub fn check(c: &Captured, suffix: &str) {
    let inputs = BlockDifferenceInputs {
        guides: HistoryGuides {
            guide: &c.packed("guide", UseFrame::Current),
            surface_motion: &c.packed("surface_motion", UseFrame::Current),
            depth_gradient: &c.uints("depth_gradient", UseFrame::Current),
            previous_guide: &c.packed("guide", UseFrame::Previous),
        },
        irradiance: &c.halves(&format!("filter_ping{suffix}"), UseFrame::Current),
        history: SignalHistory {
            irradiance: &c.halves(&format!("irradiance_history{suffix}"), UseFrame::Previous),
            moments: &c.packed(&format!("moments{suffix}"), UseFrame::Previous),
        },
    };
    let twin = block_difference(&c.frame.constants, c.tuning, &inputs);
    let name = format!("block_difference{suffix}");
    // A pixel whose position or depth lies on its threshold may count on one side alone.
    let tolerance = Tolerance { absolute: 2e-3, outliers: 2e-2, ..HALF };
    blocks(&name, c, &c.written_blocks(&name), &twin, tolerance, |t| {
        let d = unpack_difference(t);
        [d.mean, d.deviation, d.count, d.brighter]
    });
}

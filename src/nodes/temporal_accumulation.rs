//! Blends each pixel with its own past, found by motion and tested tap by tap. \[SVGF\] 4.1.

use super::{Builder, Frame, Guides, Signal};
use crate::contract::Phase;
use crate::shaders;

/// Reads and writes `filter_ping*` in place: an invocation touches its own texel alone.
pub(crate) fn temporal_accumulation(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal]) {
    let mut uses = vec![
        frame.constants.uniform(),
        guides.guide.sampled(),
        guides.guide.previous(),
        guides.surface_motion.sampled(),
        guides.depth_gradient.sampled(),
    ];
    for signal in signals {
        uses.extend([signal.history.previous(), signal.moments.previous(), signal.ping.updated(), signal.moments.written()]);
    }
    if let Some(packed) = guides.object_normal {
        uses.extend([packed.sampled(), packed.previous()]);
    }
    let shader = match (signals.len(), guides.object_normal.is_some()) {
        (1, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0,
        (1, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1,
        (_, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0,
        (_, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1,
    };
    b.dispatch("temporal_accumulation", Phase::AfterLighting, shader, 0, uses);
}

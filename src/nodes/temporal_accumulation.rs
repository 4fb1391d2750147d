//! Blends each pixel with its own past, found by motion and tested tap by tap. \[SVGF\] 4.1.

use super::{Builder, Frame, Guides, Signal};
use crate::contract::{Phase, ResourceId};
use crate::shaders;

/// `history_confidence`: by how much each pixel's alpha rises \[ASVGF\]. Reads and writes `filter_ping*` in place: an invocation touches its own texel alone.
pub(crate) fn temporal_accumulation(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    signals: &[Signal],
    history_confidence: Option<ResourceId>,
) {
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
    uses.extend(history_confidence.map(ResourceId::sampled));
    let shader = match (signals.len(), guides.object_normal.is_some(), history_confidence.is_some()) {
        (1, false, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0,
        (1, true, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1,
        (_, false, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0,
        (_, true, false) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1,
        (1, false, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1,
        (1, true, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1,
        (_, false, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1,
        (_, true, true) => &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1,
    };
    b.dispatch("temporal_accumulation", Phase::AfterLighting, shader, 0, uses);
}

//! Blends each pixel with its own past, found by motion and tested tap by tap. \[SVGF\] 4.1.

use super::{Builder, Frame, Guides, Signal, Volume};
use crate::contract::{Phase, ResourceId};
use crate::shaders::{self, Shader};

/// What may shorten the history of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Adaptation {
    /// Nothing [SVGF].
    None,
    /// `history_confidence`, by which each pixel's alpha rises [ASVGF].
    Alpha(ResourceId),
    /// The same, with the repair of disocclusions [PSVGF].
    Repaired(ResourceId),
}

/// Reads and writes `filter_ping*` in place: an invocation touches its own texel alone.
pub(crate) fn temporal_accumulation(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], adaptation: Adaptation) {
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
    let variants: [&'static Shader; 4] = match adaptation {
        Adaptation::None => [
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1,
        ],
        Adaptation::Alpha(_) => [
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1,
        ],
        Adaptation::Repaired(_) => [
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1,
            &shaders::TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1,
        ],
    };
    if let Adaptation::Alpha(confidence) | Adaptation::Repaired(confidence) = adaptation {
        uses.push(confidence.sampled());
    }
    let shader = variants[2 * usize::from(signals.len() == 2) + usize::from(guides.object_normal.is_some())];
    b.dispatch("temporal_accumulation", Phase::AfterLighting, shader, 0, uses);
}

/// The same for a volume, along its own motion, tested by the depth of the surface behind alone [PSVGF].
pub(crate) fn volume_accumulation(b: &mut Builder, frame: Frame, guides: Guides, volume: &Volume, volume_motion: ResourceId) {
    let Signal { history, moments, ping, .. } = volume.signal;
    let uses = vec![
        frame.constants.uniform(),
        guides.guide.sampled(),
        guides.guide.previous(),
        volume_motion.sampled(),
        history.previous(),
        moments.previous(),
        ping.updated(),
        moments.written(),
    ];
    let shader = &shaders::TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_VOLUME_1;
    b.dispatch("temporal_accumulation_volume", Phase::AfterLighting, shader, 0, uses);
}

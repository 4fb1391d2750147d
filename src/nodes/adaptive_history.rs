//! How far the history of a pixel is still true, from statistics of blocks. [PSVGF], adaptive accumulation.

use super::{by_signals, Builder, Frame, Guides, Signal};
use crate::contract::{ImageFormat, Lifetime, Phase, ResourceId};
use crate::shaders;
use ash::vk;

/// A number from 0 to 1 that a host may use elsewhere.
const CONFIDENCE: ImageFormat = ImageFormat::Exactly(vk::Format::R32_SFLOAT);

const NAME: &str = "adaptive_history";

/// The published rule: history that leaves the percentiles of this frame is dropped. Returns `history_confidence`, which is an output as well.
pub(crate) fn percentile_rule(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    signals: &[Signal],
    block_percentiles: &[ResourceId],
) -> ResourceId {
    let confidence = b.image("history_confidence", CONFIDENCE, Lifetime::Output);
    let mut uses = vec![
        frame.constants.uniform(),
        confidence.written(),
        guides.guide.sampled(),
        guides.guide.previous(),
        guides.surface_motion.sampled(),
        guides.depth_gradient.sampled(),
    ];
    for (signal, percentiles) in signals.iter().zip(block_percentiles) {
        uses.extend([percentiles.sampled(), signal.history.previous()]);
    }
    let shader = by_signals(signals, &shaders::ADAPTIVE_HISTORY_SIGNALS_1_RULE_0, &shaders::ADAPTIVE_HISTORY_SIGNALS_2_RULE_0);
    b.dispatch(NAME, Phase::AfterLighting, shader, 0, uses);
    confidence
}

/// The test in both directions.
pub(crate) fn change_test(b: &mut Builder, frame: Frame, signals: &[Signal], block_difference: &[ResourceId]) -> ResourceId {
    let confidence = b.image("history_confidence", CONFIDENCE, Lifetime::Output);
    let mut uses = vec![frame.constants.uniform(), confidence.written()];
    uses.extend(block_difference.iter().map(|image| image.sampled()));
    let shader = by_signals(signals, &shaders::ADAPTIVE_HISTORY_SIGNALS_1_RULE_1, &shaders::ADAPTIVE_HISTORY_SIGNALS_2_RULE_1);
    b.dispatch(NAME, Phase::AfterLighting, shader, 0, uses);
    confidence
}

//! Scales outliers down before they reach the history. [PSVGF], firefly filter.

use super::{Builder, Frame, Guides, Signal, Volume};
use crate::contract::{Phase, ResourceId};
use crate::shaders;

/// One pass for every signal. In place: an invocation touches its own texel of `filter_ping*` alone.
pub(crate) fn firefly(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], block_percentiles: &[ResourceId]) {
    const NAMES: [&str; 3] = ["firefly", "firefly_direct", "firefly_indirect"];
    for ((signal, percentiles), name) in signals.iter().zip(block_percentiles).zip(&NAMES[signals.len() - 1..]) {
        let uses = vec![frame.constants.uniform(), guides.guide.sampled(), percentiles.sampled(), signal.ping.updated()];
        b.dispatch(name, Phase::AfterLighting, &shaders::FIREFLY_VOLUME_0, 0, uses);
    }
}

/// The same for a volume, with the background.
pub(crate) fn volume_firefly(b: &mut Builder, frame: Frame, volume: &Volume, percentiles: ResourceId) {
    let uses = vec![frame.constants.uniform(), percentiles.sampled(), volume.signal.ping.updated()];
    b.dispatch("firefly_volume", Phase::AfterLighting, &shaders::FIREFLY_VOLUME_1, 0, uses);
}

//! How far a frame departs from its own history, block by block.

use super::{Builder, Frame, Guides, Signal, PACKED_64};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// One pass and one image for every signal.
pub(crate) fn block_difference(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal]) -> Vec<ResourceId> {
    const NAMES: [&str; 3] = ["block_difference", "block_difference_direct", "block_difference_indirect"];
    let mut images = Vec::with_capacity(signals.len());
    for (signal, name) in signals.iter().zip(&NAMES[signals.len() - 1..]) {
        let difference = b.block_image(name, PACKED_64, Lifetime::Transient);
        let uses = vec![
            frame.constants.uniform(),
            guides.guide.sampled(),
            guides.guide.previous(),
            guides.surface_motion.sampled(),
            guides.depth_gradient.sampled(),
            signal.ping.sampled(),
            signal.history.previous(),
            signal.moments.previous(),
            difference.written(),
        ];
        b.dispatch(name, Phase::AfterLighting, &shaders::BLOCK_DIFFERENCE, 0, uses);
        images.push(difference);
    }
    images
}

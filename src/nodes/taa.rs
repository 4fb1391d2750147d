//! Temporal anti-aliasing. \[Karis 2014\]

use super::{Builder, Frame, Guides, HDR};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

pub(crate) fn taa(b: &mut Builder, frame: Frame, guides: Guides, tone_mapped: ResourceId, display: ResourceId) {
    let history = b.image("taa_history", HDR, Lifetime::History);
    let uses = vec![
        frame.constants.uniform(),
        guides.guide.sampled(),
        guides.surface_motion.sampled(),
        tone_mapped.sampled(),
        history.previous(),
        history.written(),
        display.written(),
    ];
    b.dispatch("taa", Phase::PostProcess, &shaders::TAA, 0, uses);
}

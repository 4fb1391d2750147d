//! How far the history of a pixel is still true. \[ASVGF\] 3.5, eq. 14.

use super::{Builder, Frame, HOST_SCALAR};
use crate::contract::{ImageFormat, Lifetime, Phase, ResourceId};
use crate::shaders;
use ash::vk;

/// A number from 0 to 1 that a host may use elsewhere.
const CONFIDENCE: ImageFormat = ImageFormat::Exactly(vk::Format::R32_SFLOAT);

/// From the reconstructed gradient. Returns `history_confidence`, which is an output as well.
pub(crate) fn adaptive_alpha(b: &mut Builder, frame: Frame, gradient: ResourceId) -> ResourceId {
    let confidence = b.image("history_confidence", CONFIDENCE, Lifetime::Output);
    let uses = vec![frame.constants.uniform(), gradient.sampled(), confidence.written()];
    b.dispatch("adaptive_alpha", Phase::AfterLighting, &shaders::ADAPTIVE_ALPHA_SOURCE_0, 0, uses);
    confidence
}

/// The same from the host's own estimate.
pub(crate) fn host_confidence(b: &mut Builder, frame: Frame) -> ResourceId {
    let host = b.input("confidence", HOST_SCALAR, false);
    let confidence = b.image("history_confidence", CONFIDENCE, Lifetime::Output);
    let uses = vec![frame.constants.uniform(), host.sampled(), confidence.written()];
    b.dispatch("adaptive_alpha", Phase::AfterLighting, &shaders::ADAPTIVE_ALPHA_SOURCE_1, 0, uses);
    confidence
}

//! HDR radiance to display-referred linear values.

use super::{Builder, Frame};
use crate::contract::{Phase, ResourceId};
use crate::shaders;

/// Writes `tone_mapped`, a transient before temporal anti-aliasing or the output `display`.
pub(crate) fn tone_map(b: &mut Builder, frame: Frame, denoised: ResourceId, tone_mapped: ResourceId) {
    let uses = vec![frame.constants.uniform(), denoised.sampled(), tone_mapped.written()];
    b.dispatch("tone_map", Phase::PostProcess, &shaders::TONE_MAP, 0, uses);
}

//! HDR radiance to display-referred linear values.

use super::{Builder, Frame};
use crate::contract::{Phase, ResourceId};
use crate::shaders;

/// Of the sum of one or two radiances. Writes `tone_mapped`, a transient before temporal anti-aliasing or the output `display`.
pub(crate) fn tone_map(b: &mut Builder, frame: Frame, denoised: &[ResourceId], tone_mapped: ResourceId) {
    let mut uses = vec![frame.constants.uniform()];
    uses.extend(denoised.iter().map(|radiance| radiance.sampled()));
    uses.push(tone_mapped.written());
    let shader = if denoised.len() == 1 { &shaders::TONE_MAP_VOLUME_0 } else { &shaders::TONE_MAP_VOLUME_1 };
    b.dispatch("tone_map", Phase::PostProcess, shader, 0, uses);
}

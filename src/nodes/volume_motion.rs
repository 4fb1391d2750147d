//! Carries the points of a volume forward from the previous frame, for motion vectors of its own. [PSVGF], volumes.

use super::{Builder, Frame, Guides, Volume, PACKED_32};
use crate::contract::{Lifetime, Phase, ResourceId};
use crate::shaders;

/// Three passes: clear the claims, let the points claim pixels, write down the motion of those that won. Returns `volume_motion`.
pub(crate) fn volume_motion(b: &mut Builder, frame: Frame, guides: Guides, volume: &Volume) -> ResourceId {
    let claims = b.image("volume_claims", PACKED_32, Lifetime::Transient);
    let motion = b.image("volume_motion", PACKED_32, Lifetime::Transient);
    b.clear("volume_motion_clear", Phase::AfterLighting, claims);
    let claim = vec![frame.constants.uniform(), volume.points.previous(), guides.guide.sampled(), claims.updated()];
    b.dispatch_either("volume_motion_claim", Phase::AfterLighting, &shaders::VOLUME_MOTION_RESOLVE_0, claim);
    let resolve = vec![
        frame.constants.uniform(),
        volume.points.previous(),
        guides.surface_motion.sampled(),
        claims.sampled(),
        motion.written(),
    ];
    b.dispatch("volume_motion_resolve", Phase::AfterLighting, &shaders::VOLUME_MOTION_RESOLVE_1, 0, resolve);
    motion
}

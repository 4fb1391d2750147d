//! Carries the points of a volume forward from the previous frame, for its own motion vectors.
//! \[PSVGF\], volumes.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, Volume};
use crate::contract::{Grid, Lifetime, Phase};
use crate::graph::{Graph, Guides, Port, VolumeMotion, PACKED_32};
use crate::shaders;

impl Graph {
    /// Motion of a volume. Three passes: clear the claims, let the points claim pixels, write down
    /// the motion of the winners.
    pub fn volume_motion(&mut self, guides: &Guides, volume: &Volume) -> VolumeMotion {
        let node = self.node("volume_motion", "");
        let claims = self.named_image("volume_claims", "", PACKED_32, 1, Lifetime::Transient);
        let motion = self.named_image("volume_motion", "", PACKED_32, 1, Lifetime::Transient);
        self.clear_claims(&node, Phase::AfterLighting, claims, 1);
        // Points of the previous frame may lie outside this one.
        let claim = pass(&node, &shaders::VOLUME_MOTION_RESOLVE_0)
            .named(format!("{node}_claim"))
            .grid(Grid::Strata(1))
            .previous("previous_points", volume.points)
            .bind("guide", guides.guide)
            .bind("claims", self.refreshed(claims));
        self.add(claim);
        let resolve = pass(&node, &shaders::VOLUME_MOTION_RESOLVE_1)
            .named(format!("{node}_resolve"))
            .previous("previous_points", volume.points)
            .bind("surface_motion", guides.surface_motion)
            .bind("claims", self.refreshed(claims))
            .bind("volume_motion", motion);
        self.add(resolve);
        Port::of(self.refreshed(motion))
    }
}

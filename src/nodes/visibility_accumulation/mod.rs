//! Blends the visibility of a light with its past, and measures its penumbra. \[Mehta et al. 2012\], \[SVGF\] 4.1.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
use crate::graph::{Graph, Guides, Port, VisibilityAccumulated, VisibilitySamples, PACKED_32};
use crate::shaders;

impl Graph {
    /// Accumulates the visibility of a light in a history of its own: mean, deviation, history length and distance of the occluder
    /// in 32 bits. The optional inputs `occluder_id` with `instance_transforms`, or `occluder_motion`, and the places of lights in
    /// [`crate::FrameParams`] follow shadows that move.
    pub fn visibility_accumulation(&mut self, guides: &Guides, samples: &VisibilitySamples) -> VisibilityAccumulated {
        let node = self.node("visibility_accumulation", "");
        let history = self.named_image("visibility_history", "", PACKED_32, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::VISIBILITY_ACCUMULATION)
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .bind("depth_gradient", guides.depth_gradient)
            .bind("visibility_samples", samples.image())
            .previous("previous_visibility_history", history)
            .bind("occluder_id", self.input(Input::OCCLUDER_ID))
            .bind("occluder_motion", self.input(Input::OCCLUDER_MOTION))
            .bind("occluder_distance", self.input(Input::OCCLUDER_DISTANCE))
            .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
            .bind("visibility_history", history);
        self.add(pass);
        Port::of(self.refreshed(history))
    }
}

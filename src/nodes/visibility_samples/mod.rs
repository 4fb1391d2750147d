//! Takes in the visibility of one light, and the distance of its occluder.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Input, Lifetime};
use crate::graph::{Graph, Guides, Port, VisibilitySamples, PACKED_32};
use crate::shaders;

impl Graph {
    /// Valid samples of the visibility of a light. Inputs: `noisy_visibility`, 0 (occluded) to 1
    /// (lit), and `occluder_distance`.
    pub fn visibility_samples(&mut self, guides: &Guides) -> VisibilitySamples {
        let node = self.node("visibility_samples", "");
        let samples = self.named_image("visibility_samples", "", PACKED_32, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::VISIBILITY_SAMPLES)
            .bind("guide", guides.guide)
            .bind("noisy_visibility", self.input(Input::NOISY_VISIBILITY))
            .bind("occluder_distance", self.input(Input::OCCLUDER_DISTANCE))
            .bind("visibility_samples", samples);
        self.add(pass);
        Port::of(self.refreshed(samples))
    }
}

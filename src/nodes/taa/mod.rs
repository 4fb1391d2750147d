//! Temporal anti-aliasing. \[Karis 2014\]
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Lifetime, Phase};
use crate::graph::{Display, Graph, Guides, Port, HDR};
use crate::shaders;

impl Graph {
    /// Anti-aliased picture, from this frame and its own history.
    pub fn taa(&mut self, guides: &Guides, tone_mapped: &Display) -> Display {
        let node = self.node("taa", "");
        let history = self.named_image("taa_history", "", HDR, 1, Lifetime::History);
        let display = self.named_image("anti_aliased", "", HDR, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::TAA)
            .phase(Phase::PostProcess)
            .bind("guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .bind("tone_mapped", tone_mapped.image())
            .previous("previous_history", history)
            .bind("taa_history", history)
            .bind("display", display);
        self.add(pass);
        Port::of(self.refreshed(display))
    }
}

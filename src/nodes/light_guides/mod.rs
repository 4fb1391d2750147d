//! Picks the guides of the pixels that light was traced for.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Phase;
use crate::graph::{Graph, Guides};
use crate::shaders;

impl Graph {
    /// Guides of the pixels that light was traced for, where the light has fewer pixels: [`crate::Config::light_extent`].
    /// Otherwise the guides as they are.
    pub(crate) fn light_guides(&mut self, rendered: Guides) -> Guides {
        if !self.has_light_extent() {
            return rendered;
        }
        let node = self.node("light_guides", "");
        let made = self.guide_images("", 1, rendered.object_normal.is_some());
        let pass = pass(&node, &shaders::LIGHT_GUIDES)
            .phase(Phase::BeforeLighting)
            .bind("rendered_guide", rendered.guide)
            .bind("rendered_surface_motion", rendered.surface_motion)
            .bind("rendered_depth_gradient", rendered.depth_gradient)
            .bind("guide", made.guide)
            .bind("surface_motion", made.surface_motion)
            .bind("depth_gradient", made.depth_gradient)
            .bind_some("rendered_object_normal_guide", rendered.object_normal)
            .bind_some("object_normal_guide", made.object_normal);
        self.add(pass);
        Guides { rendered: rendered.rendered, ..self.refreshed_guides(made) }
    }
}

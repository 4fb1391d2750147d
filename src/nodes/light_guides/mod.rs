//! Picks the guides of the pixels that light was traced for.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Lifetime, Phase};
use crate::graph::{Graph, Guides, PACKED_32, PACKED_64};
use crate::shaders;

impl Graph {
    /// Guides of the pixels that light was traced for, where the light has fewer pixels: [`crate::Config::light_extent`].
    /// Otherwise the guides as they are.
    pub(crate) fn light_guides(&mut self, rendered: Guides) -> Guides {
        if !self.has_light_extent() {
            return rendered;
        }
        let node = self.node("light_guides", "");
        let mut image = |name: &str, format| self.named_image(name, "", format, 1, Lifetime::Transient);
        let guide = image("guide", PACKED_64);
        let surface_motion = image("surface_motion", PACKED_64);
        let depth_gradient = image("depth_gradient", PACKED_32);
        let object_normal = rendered.object_normal.map(|_| image("object_normal_guide", PACKED_32));
        let pass = pass(&node, &shaders::LIGHT_GUIDES)
            .phase(Phase::BeforeLighting)
            .bind("rendered_guide", rendered.guide)
            .bind("rendered_surface_motion", rendered.surface_motion)
            .bind("rendered_depth_gradient", rendered.depth_gradient)
            .bind("guide", guide)
            .bind("surface_motion", surface_motion)
            .bind("depth_gradient", depth_gradient)
            .bind_some("rendered_object_normal_guide", rendered.object_normal)
            .bind_some("object_normal_guide", object_normal);
        self.add(pass);
        let [guide, surface_motion, depth_gradient] = [guide, surface_motion, depth_gradient].map(|image| self.refreshed(image));
        let object_normal = object_normal.map(|image| self.refreshed(image));
        Guides { guide, surface_motion, depth_gradient, object_normal, ..rendered }
    }
}

//! The guide of every rendered pixel, where light has fewer.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, Import};
use crate::contract::{Grid, Input, Lifetime, TexelGrid};
use crate::graph::{Graph, Motion, RenderedGuides, PACKED_64};
use crate::shaders;

impl Graph {
    /// Guides of every rendered pixel, from the images that `import` has.
    pub(super) fn rendered_guides(&mut self, import: Import) -> RenderedGuides {
        let node = self.node("rendered_guide", "");
        let guide = self.named_image("rendered_guide", "", PACKED_64, TexelGrid::Rendered(1), Lifetime::Transient);
        let module = [&shaders::RENDERED_GUIDE_SURFACE_ID_0, &shaders::RENDERED_GUIDE_SURFACE_ID_1][usize::from(import.surface_id)];
        let mut pass = pass(&node, module)
            .grid(Grid::Guides)
            .bind("depth", self.input(Input::DEPTH))
            .bind("normal", self.input(Input::NORMAL))
            .bind("rendered_guide", guide);
        if import.albedo {
            pass = pass.bind_some("albedo", self.dividing_albedo());
        }
        if import.surface_id {
            pass = pass.bind("surface_id", self.input(Input::SURFACE_ID));
        }
        self.add_before_reader(guide, pass);
        RenderedGuides { guide, motion: Motion::Host { surface_id: import.surface_id } }
    }
}

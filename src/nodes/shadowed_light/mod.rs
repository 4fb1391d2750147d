//! Adds the light of the source whose visibility was filtered.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input};
use crate::graph::{Graph, Port, Radiance, Visibility, WIDE_HDR};
use crate::shaders;

impl Graph {
    /// Adds to radiance, in place, your optional input `unshadowed_direct` times the visibility:
    /// the light as it would be if nothing stood in between, albedo and BSDF included. A host that
    /// leaves the input out multiplies by itself.
    pub fn shadowed_light(&mut self, radiance: &Radiance, visibility: &Visibility) -> Radiance {
        let node = self.node("shadowed_light", "");
        let is_wide = self.format_of(radiance.image()) == Some(WIDE_HDR);
        let module = if is_wide { &shaders::SHADOWED_LIGHT_FLOAT_1 } else { &shaders::SHADOWED_LIGHT_FLOAT_0 };
        let pass = pass(&node, module)
            .grid(Grid::Guides)
            .bind("denoised_visibility", visibility.image())
            .bind("unshadowed_direct", self.input(Input::UNSHADOWED_DIRECT))
            .bind("radiance", radiance.image());
        self.add(pass);
        Port::of(self.refreshed(radiance.image()))
    }
}

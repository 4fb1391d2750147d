//! Adds the light of the source whose visibility was filtered.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Input;
use crate::graph::{Graph, Port, Radiance, Visibility};
use crate::shaders;

impl Graph {
    /// Adds to radiance, in place, your optional input `unshadowed_direct` times the visibility:
    /// the light as it would be if nothing stood in between, albedo and BSDF included. A host that
    /// leaves the input out multiplies by itself.
    pub fn shadowed_light(&mut self, radiance: &Radiance, visibility: &Visibility) -> Radiance {
        let node = self.node("shadowed_light", "");
        let pass = pass(&node, &shaders::SHADOWED_LIGHT)
            .bind("denoised_visibility", visibility.image())
            .bind("unshadowed_direct", self.input(Input::UNSHADOWED_DIRECT))
            .bind("radiance", radiance.image());
        self.add(pass);
        Port::of(self.refreshed(radiance.image()))
    }
}

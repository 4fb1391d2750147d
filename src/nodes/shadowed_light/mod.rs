//! Adds the light of the sources whose visibility was filtered.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input};
use crate::graph::{Graph, Port, Radiance, Visibility, HDR, WIDE_HDR};
use crate::nodes::visibility_filter::OUTPUTS;
use crate::shaders;

impl Graph {
    /// Adds to radiance, in place, your optional input `unshadowed_direct` times the visibility: the light as it would be if nothing
    /// stood in between, albedo and BSDF included. The names of further lights end in `_1` to `_3`. A host that leaves an input out
    /// multiplies by itself.
    pub fn shadowed_light(&mut self, radiance: &Radiance, visibility: &Visibility) -> Radiance {
        let node = self.node("shadowed_light", "");
        let is_wide = self.format_of(radiance.image()) == Some(WIDE_HDR);
        let module = if is_wide { &shaders::SHADOWED_LIGHT_FLOAT_1 } else { &shaders::SHADOWED_LIGHT_FLOAT_0 };
        let coloured = self.format_of(visibility.image()) == Some(HDR);
        let mut pass =
            pass(&node, module).grid(Grid::Guides).constant("COLOURED", u32::from(coloured)).bind("radiance", radiance.image());
        for ((binding, visible), light) in OUTPUTS.iter().zip(visibility.images()).zip(Input::UNSHADOWED_DIRECT) {
            pass = pass.bind(binding, *visible).bind(light.name, self.input(light));
        }
        self.add(pass);
        Port::of(self.refreshed(radiance.image()))
    }
}

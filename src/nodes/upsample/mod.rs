//! Brings filtered light of fewer pixels to each pixel of the guides. \[Kopf 2007\]
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::TexelGrid;
use crate::graph::{Graph, Guides, Port, Radiance, CONFIDENCE, HDR};
use crate::shaders;

impl Graph {
    /// Irradiance of one or two signals, or visibility, of every rendered pixel, from that of the pixels with light:
    /// [`crate::Config::light_extent`]. Where every pixel has light, the port as it is.
    pub fn upsample<K>(&mut self, guides: &Guides, filtered: &Port<K>) -> Port<K> {
        self.upsampled(guides, filtered, false)
    }

    /// Radiance of a volume of every rendered pixel, by the depth behind it.
    pub(crate) fn upsample_volume(&mut self, guides: &Guides, filtered: &Radiance) -> Radiance {
        self.upsampled(guides, filtered, true)
    }

    fn upsampled<K>(&mut self, guides: &Guides, filtered: &Port<K>, is_volume: bool) -> Port<K> {
        if !self.has_light_extent() {
            return *filtered;
        }
        let label = self.label_of(filtered);
        let node = self.node("upsample", &label);
        let (module, base, format) = match self.format_of(filtered.image()) == Some(CONFIDENCE) {
            true => (&shaders::UPSAMPLE_NUMBER_1, "upsampled_visibility", CONFIDENCE),
            false => (&shaders::UPSAMPLE_NUMBER_0, "upsampled", HDR),
        };
        let upsampled: Port<K> = self.image_each(filtered, base, format, TexelGrid::Rendered(1));
        let rendered = self.rendered_inputs(guides);
        let pass = pass(&node, module)
            .constant("VOLUME", is_volume.into())
            .bind("guide", guides.guide)
            .bind_some("depth", rendered.depth)
            .bind_some("normal", rendered.normal)
            .bind_some("surface_id", rendered.surface_id)
            .bind_some("albedo", rendered.albedo)
            .each("filtered", filtered.images())
            .each("upsampled", upsampled.images());
        self.add(pass);
        self.renewed(&upsampled)
    }
}

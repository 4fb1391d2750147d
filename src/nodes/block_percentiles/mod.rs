//! Percentiles of luminance in every 8×8 pixels. \[PSVGF\], block percentiles.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::graph::{Graph, Guides, Irradiance, Percentiles, Port, VolumeRadiance, PACKED_32};
use crate::shaders;

/// Pixels a side of a block, which is a workgroup.
pub const BLOCK_SIZE: u32 = 8;

impl Graph {
    /// Percentiles of one signal or two, one image each.
    pub fn block_percentiles(&mut self, guides: &Guides, irradiance: &Irradiance) -> Percentiles {
        self.percentiles_of(guides, irradiance, false)
    }

    /// Percentiles of a volume, with the pixels of the background.
    pub fn volume_percentiles(&mut self, guides: &Guides, radiance: &VolumeRadiance) -> Percentiles {
        self.percentiles_of(guides, radiance, true)
    }

    fn percentiles_of<K>(&mut self, guides: &Guides, port: &Port<K>, volume: bool) -> Percentiles {
        let percentiles: Percentiles = self.image_each(port, "block_percentiles", PACKED_32, BLOCK_SIZE);
        let node = self.node("block_percentiles", &self.label_of(port));
        let pass = pass(&node, &shaders::BLOCK_PERCENTILES)
            .constant("VOLUME", u32::from(volume))
            .bind("guide", guides.guide)
            .each("irradiance", port.images())
            .each("block_percentiles", percentiles.images());
        self.add(pass);
        self.renewed(&percentiles)
    }
}

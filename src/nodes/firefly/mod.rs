//! Scales outliers down before they reach the history, and spreads the light that this removes.
//! \[PSVGF\], firefly filter.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::Grid;
use crate::graph::{Graph, Guides, Irradiance, Percentiles, Port, VolumeRadiance};
use crate::shaders;

impl Graph {
    /// Irradiance without outliers, in place; one pass for every signal.
    pub fn firefly(&mut self, guides: &Guides, irradiance: &Irradiance, percentiles: &Percentiles) -> Irradiance {
        self.without_outliers(guides, irradiance, percentiles, false)
    }

    /// Radiance of a volume without outliers, in place.
    pub fn volume_firefly(&mut self, guides: &Guides, radiance: &VolumeRadiance, percentiles: &Percentiles) -> VolumeRadiance {
        self.without_outliers(guides, radiance, percentiles, true)
    }

    fn without_outliers<K>(&mut self, guides: &Guides, port: &Port<K>, percentiles: &Percentiles, volume: bool) -> Port<K> {
        if percentiles.signals() != port.signals() {
            let problem = format!("percentiles of {} signals were given for {}", percentiles.signals(), port.signals());
            self.fail("firefly", "percentiles", format!("{problem}; make them of the same port"));
        }
        for (image, percentiles) in port.images().iter().zip(percentiles.images()) {
            let label = self.label(*image).to_owned();
            let node = self.node("firefly", &label);
            let pass = pass(&node, &shaders::FIREFLY)
                .grid(Grid::Columns(BLOCK_SIZE))
                .constant("VOLUME", u32::from(volume))
                .bind("guide", guides.guide)
                .bind("block_percentiles", *percentiles)
                .bind("irradiance", *image);
            self.add(pass);
        }
        self.renewed(port)
    }
}

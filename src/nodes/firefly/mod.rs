//! Scales outliers down before they reach the history, and spreads the light that this removes.
//! \[PSVGF\], firefly filter.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::Grid;
use crate::graph::{FireflyLimits, Graph, Guides, Irradiance, Port, VolumeRadiance};
use crate::shaders;

impl Graph {
    /// Irradiance without outliers, in place; one pass for every signal.
    pub fn firefly(&mut self, guides: &Guides, irradiance: &Irradiance, limits: &FireflyLimits) -> Irradiance {
        self.without_outliers(guides, irradiance, limits, false)
    }

    /// Radiance of a volume without outliers, in place.
    pub fn volume_firefly(&mut self, guides: &Guides, radiance: &VolumeRadiance, limits: &FireflyLimits) -> VolumeRadiance {
        self.without_outliers(guides, radiance, limits, true)
    }

    fn without_outliers<K>(&mut self, guides: &Guides, port: &Port<K>, limits: &FireflyLimits, volume: bool) -> Port<K> {
        if limits.signals() != port.signals() {
            let problem = format!("limits of {} signals were given for {}", limits.signals(), port.signals());
            self.fail("firefly", "limits", format!("{problem}; make them of the same port"));
        }
        for (image, limits) in port.images().iter().zip(limits.images()) {
            let label = self.label(*image).to_owned();
            let node = self.node("firefly", &label);
            let pass = pass(&node, &shaders::FIREFLY)
                .grid(Grid::Columns(BLOCK_SIZE))
                .constant("VOLUME", u32::from(volume))
                .bind("guide", guides.guide)
                .bind("firefly_limits", *limits)
                .bind("irradiance", *image);
            self.add(pass);
        }
        self.renewed(port)
    }
}

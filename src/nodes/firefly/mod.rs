//! Scales outliers down before they reach the history, and spreads the light that this removes.
//! \[PSVGF\], firefly filter.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{block_difference, pass, BLOCK_SIZE};
use crate::contract::{Grid, Lifetime};
use crate::graph::{
    Difference, FireflyLimits, Graph, Guides, History, Image, Irradiance, Pass, Percentiles, Port, VolumeRadiance, PACKED_128,
};
use crate::shaders::{self, Shader};

impl Graph {
    /// Irradiance without outliers, in place; one pass for every signal.
    pub fn firefly(&mut self, guides: &Guides, irradiance: &Irradiance, limits: &FireflyLimits) -> Irradiance {
        self.without_outliers(guides, irradiance, limits, false)
    }

    /// [`Self::firefly_limits`], [`Self::firefly`], and of what is left [`Self::block_difference`]: one pass for every signal. Of specular
    /// light more is usual.
    pub(crate) fn firefly_and_difference(
        &mut self,
        guides: &Guides,
        irradiance: &Irradiance,
        percentiles: &Percentiles,
        history: &History,
        is_specular: bool,
    ) -> (Irradiance, Difference, FireflyLimits) {
        let difference: Difference = self.image_each(irradiance, "block_difference", PACKED_128, BLOCK_SIZE);
        let mut all = Vec::new();
        for (i, image) in irradiance.images().iter().enumerate() {
            let label = self.label(*image).to_owned();
            let node = self.node("firefly", &label);
            let limits = self.limits_image(&label, Lifetime::History);
            let pass = described(&node, &shaders::FIREFLY_DIFFERENCE_1, guides, *image)
                .constant("SPECULAR", is_specular.into())
                .bind("block_percentiles", percentiles.images()[i])
                .previous("previous_firefly_limits", limits)
                .bind("firefly_limits", limits)
                .bind("block_difference", difference.images()[i]);
            self.add(block_difference::compared(pass, guides, history, i));
            all.push(self.refreshed(limits));
        }
        let limits = Port::of_images(&all).unwrap_or_else(|| percentiles.cast());
        (self.renewed(irradiance), self.renewed(&difference), limits)
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
            let pass = described(&node, &shaders::FIREFLY_DIFFERENCE_0, guides, *image);
            self.add(pass.constant("VOLUME", u32::from(volume)).constant("SPECULAR", 0).bind("firefly_limits", *limits));
        }
        self.renewed(port)
    }
}

fn described(node: &str, module: &'static Shader, guides: &Guides, irradiance: Image) -> Pass {
    pass(node, module).grid(Grid::Columns(BLOCK_SIZE)).bind("guide", guides.guide).bind("irradiance", irradiance)
}

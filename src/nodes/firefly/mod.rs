//! Scales outliers down before they reach the history, and spreads the light that this removes.
//! \[PSVGF\], firefly filter.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{block_difference, pass, BLOCK_SIZE};
use crate::contract::Grid;
use crate::graph::{Difference, FireflyLimits, Graph, Guides, History, Irradiance, Port, VolumeRadiance, PACKED_64};
use crate::shaders;

impl Graph {
    /// Irradiance without outliers, in place; one pass for every signal.
    pub fn firefly(&mut self, guides: &Guides, irradiance: &Irradiance, limits: &FireflyLimits) -> Irradiance {
        self.without_outliers(guides, irradiance, limits, false, None)
    }

    /// [`Self::firefly`], and of what is left [`Self::block_difference`] in the same pass.
    pub(crate) fn firefly_and_difference(
        &mut self,
        guides: &Guides,
        irradiance: &Irradiance,
        limits: &FireflyLimits,
        history: &History,
    ) -> (Irradiance, Difference) {
        let difference: Difference = self.image_each(irradiance, "block_difference", PACKED_64, BLOCK_SIZE);
        let filtered = self.without_outliers(guides, irradiance, limits, false, Some((history, &difference)));
        (filtered, self.renewed(&difference))
    }

    /// Radiance of a volume without outliers, in place.
    pub fn volume_firefly(&mut self, guides: &Guides, radiance: &VolumeRadiance, limits: &FireflyLimits) -> VolumeRadiance {
        self.without_outliers(guides, radiance, limits, true, None)
    }

    fn without_outliers<K>(
        &mut self,
        guides: &Guides,
        port: &Port<K>,
        limits: &FireflyLimits,
        volume: bool,
        compared: Option<(&History, &Difference)>,
    ) -> Port<K> {
        let module = if compared.is_some() { &shaders::FIREFLY_DIFFERENCE_1 } else { &shaders::FIREFLY_DIFFERENCE_0 };
        if limits.signals() != port.signals() {
            let problem = format!("limits of {} signals were given for {}", limits.signals(), port.signals());
            self.fail("firefly", "limits", format!("{problem}; make them of the same port"));
        }
        for (i, (image, limits)) in port.images().iter().zip(limits.images()).enumerate() {
            let label = self.label(*image).to_owned();
            let node = self.node("firefly", &label);
            let pass = pass(&node, module)
                .grid(Grid::Columns(BLOCK_SIZE))
                .constant("VOLUME", u32::from(volume))
                .bind("guide", guides.guide)
                .bind("firefly_limits", *limits)
                .bind("irradiance", *image);
            let pass = match compared {
                Some((history, difference)) => {
                    block_difference::compared(pass, guides, history, i).bind("block_difference", difference.images()[i])
                }
                None => pass,
            };
            self.add(pass);
        }
        self.renewed(port)
    }
}

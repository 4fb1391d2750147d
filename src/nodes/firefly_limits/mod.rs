//! Finds the brightest luminance that is no outlier, in cells of 4×4 pixels: by the blocks around, and by the frames before.
//! \[PSVGF\], firefly filter.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::{Grid, Lifetime};
use crate::graph::{FireflyLimits, Graph, Guides, Image, Irradiance, Pass, Percentiles, Port, PACKED_32};
use crate::reference::blocks::CELL_SIZE;
use crate::shaders;

/// Luminances that are usual, by which a firefly filter goes.
#[derive(Clone, Copy, Debug)]
pub struct Usual {
    /// In this frame, of blocks.
    pub percentiles: Percentiles,
    /// The brightest of them, with those of the frames before.
    pub limits: FireflyLimits,
}

impl Graph {
    /// Limits for [`Self::firefly`], by the percentiles of this frame and of the light that returns
    /// from frame to frame, as that of a caustic does. Keeps 4 bytes for every 4×4 pixels.
    pub fn firefly_limits(&mut self, guides: &Guides, irradiance: &Irradiance, percentiles: &Percentiles) -> FireflyLimits {
        self.limits_of(irradiance, percentiles, Lifetime::History, |pass, limits| {
            pass.bind("guide", guides.guide)
                .previous("previous_guide", guides.guide)
                .bind("surface_motion", guides.surface_motion)
                .previous("previous_firefly_limits", limits)
        })
    }

    /// Limits for [`Self::firefly`] and [`Self::volume_firefly`], by the percentiles of this frame
    /// alone.
    pub fn firefly_limits_of_frame<K>(&mut self, port: &Port<K>, percentiles: &Percentiles) -> FireflyLimits {
        self.limits_of(port, percentiles, Lifetime::Transient, |pass, _| pass)
    }

    /// Limits of a signal.
    pub(super) fn limits_image(&mut self, label: &str, lifetime: Lifetime) -> Image {
        self.named_image("firefly_limits", label, PACKED_32, CELL_SIZE, lifetime)
    }

    fn limits_of<K>(
        &mut self,
        port: &Port<K>,
        percentiles: &Percentiles,
        lifetime: Lifetime,
        history: impl Fn(Pass, Image) -> Pass,
    ) -> FireflyLimits {
        let shader = match lifetime {
            Lifetime::History => &shaders::FIREFLY_LIMITS_RETURNING_1,
            _ => &shaders::FIREFLY_LIMITS_RETURNING_0,
        };
        if percentiles.signals() != port.signals() {
            let problem = format!("percentiles of {} signals were given for {}", percentiles.signals(), port.signals());
            self.fail("firefly_limits", "percentiles", format!("{problem}; make them of the same port"));
        }
        let mut all = Vec::new();
        for (percentiles, irradiance) in percentiles.images().iter().zip(port.images()) {
            let label = self.label(*percentiles).to_owned();
            let node = self.node("firefly_limits", &label);
            let limits = self.limits_image(&label, lifetime);
            let pass = pass(&node, shader)
                .grid(Grid::Columns(BLOCK_SIZE))
                .bind("block_percentiles", *percentiles)
                .bind("irradiance", *irradiance)
                .bind("firefly_limits", limits);
            self.add(history(pass, limits));
            all.push(self.refreshed(limits));
        }
        Port::of_images(&all).unwrap_or_else(|| percentiles.cast())
    }
}

//! Fills pixels without a sample from those around them, before the accumulation. Ours.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::config::Sampling;
use crate::graph::{Graph, Guides, Irradiance, HDR};
use crate::shaders;

impl Graph {
    /// Irradiance whose holes are filled, which [`Self::demodulate`] marked; one pass for every signal. Filled pixels keep their mark,
    /// and the accumulation behind it counts them for half a frame. With [`Sampling::Full`] they are rare, and [`Self::demodulate`]
    /// fills them itself: the irradiance is returned as it came.
    pub fn fill_holes(&mut self, guides: &Guides, irradiance: &Irradiance, sampling: Sampling) -> Irradiance {
        // As far as the one sample of a block of pixels may lie.
        let radius = match sampling {
            Sampling::Full => return *irradiance,
            Sampling::OneOf2x2 => 1,
            Sampling::OneOf4x4 => 3,
        };
        let filled: Irradiance = self.image_each(irradiance, "filled_irradiance", HDR, 1);
        for (from, to) in irradiance.images().iter().zip(filled.images()) {
            let label = self.label(*from).to_owned();
            let node = self.node("fill_holes", &label);
            let pass = pass(&node, &shaders::FILL_HOLES)
                .constant("RADIUS", radius)
                .bind("guide", guides.guide)
                .bind("holed", *from)
                .bind("filled", *to);
            self.add(pass);
        }
        self.renewed(&filled).with_filled_holes()
    }
}

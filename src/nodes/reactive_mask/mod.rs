//! Tells an upscaler where its own history of the denoised picture is worth little.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input, Lifetime, TexelGrid};
use crate::graph::{Confidence, Graph, Guides, History, Port, Radiance, HDR};
use crate::shaders;

impl Graph {
    /// Shares of new and of emitted light in each pixel of `denoised`, by the history that the accumulation left.
    pub(crate) fn reactive_mask(
        &mut self,
        guides: &Guides,
        denoised: &Radiance,
        history: &History,
        confidence: Option<Confidence>,
    ) -> Radiance {
        let node = self.node("reactive_mask", "");
        let mask = self.named_image("reactive", "", HDR, TexelGrid::Rendered(1), Lifetime::Transient);
        let rendered = self.rendered_inputs(guides);
        let pass = pass(&node, &shaders::REACTIVE_MASK)
            .grid(Grid::Guides)
            .bind("guide", guides.guide)
            .bind_some("depth", rendered.depth)
            .bind_some("surface_id", rendered.surface_id)
            .each("luminance_history", &self.current_luminance_history(history))
            .bind_some("history_confidence", confidence.map(|confidence| confidence.image()))
            .bind("radiance", denoised.image())
            .bind("emission", self.input(Input::EMISSION))
            .bind("reactive_mask", mask);
        self.add(pass);
        Port::of(self.refreshed(mask))
    }
}

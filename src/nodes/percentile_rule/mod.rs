//! Turns percentiles into confidence in the history of each pixel, by the published rule. \[PSVGF\], adaptive accumulation.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::Lifetime;
use crate::graph::{Confidence, Graph, Guides, History, Percentiles, Port, CONFIDENCE};
use crate::shaders;

impl Graph {
    /// Confidence in the history, which falls where it leaves the percentiles of this frame.
    pub fn percentile_rule(&mut self, guides: &Guides, percentiles: &Percentiles, history: &History) -> Confidence {
        let label = self.label_of(percentiles);
        let node = self.node("percentile_rule", &label);
        let confidence = self.named_image("history_confidence", &label, CONFIDENCE, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::PERCENTILE_RULE)
            .bind("history_confidence", confidence)
            .bind("guide", guides.guide)
            .previous("previous_guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .each("block_percentiles", percentiles.images())
            .each_previous("history", history.colour());
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }
}

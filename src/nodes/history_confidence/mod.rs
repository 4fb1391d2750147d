//! Turns temporal gradients into confidence in the history of each pixel. \[ASVGF\] 3.5, eq. 14.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, ChangeTest, BLOCK_SIZE};
use crate::contract::{Grid, Input, Lifetime};
use crate::graph::{Confidence, Difference, Gradient, Graph, LightRatio, Pass, Port, CONFIDENCE};
use crate::shaders;

impl Graph {
    /// Confidence in the history, from the reconstructed gradient. With a ratio of light it is
    /// confidence in the history that [`crate::nodes::Accumulation::light_ratio`] scales. Pixels
    /// without a known gradient take the confidence of `tested`: all pixels, in frames without
    /// re-shaded samples. Where the test is sure that nothing changed, a gradient does not count;
    /// where it is sure of a change that no gradient shows, the history is dropped.
    pub fn history_confidence(&mut self, gradient: &Gradient, tested: Option<&ChangeTest>) -> Confidence {
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_0)
            .bind_some("other_confidence", tested.map(|tested| tested.confidence.image()))
            .bind_some("steadiness", tested.and_then(|tested| tested.steadiness).map(|steadiness| steadiness.image()));
        self.confidence_by(of_gradient(pass, gradient))
    }

    /// [`Self::history_confidence`] with [`Self::change_and_steadiness`] of `difference` in the same pass; without a gradient
    /// [`Self::change_test`]. With the ratio by which the light changed, if it is known. `of_both`: of diffuse light, and beside it, in the last bits, that of specular light without the ratio, by the
    /// differences of both, or of light that is mixed.
    pub(crate) fn tested_confidence(
        &mut self,
        gradient: Option<&Gradient>,
        difference: &Difference,
        of_both: bool,
    ) -> (Confidence, Option<LightRatio>) {
        let Some(gradient) = gradient else {
            let (confidence, ratio) = self.change_and_ratio(difference, of_both);
            return (confidence, Some(ratio));
        };
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_2)
            .grid(Grid::Columns(BLOCK_SIZE))
            .constant("BOTH", of_both.into())
            .each("block_difference", difference.images());
        (self.confidence_by(of_gradient(pass, gradient)), gradient.light_ratio)
    }

    /// Whether a confidence has that of specular light beside it.
    pub(super) fn is_of_both(&self, confidence: &Confidence) -> bool {
        self.writer_has(confidence.image(), "BOTH")
    }

    /// Confidence in the history, from your own estimate: the input `confidence`.
    pub fn host_confidence(&mut self) -> Confidence {
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_1).bind("confidence", self.input(Input::CONFIDENCE));
        self.confidence_by(pass)
    }

    fn confidence_by(&mut self, pass: Pass) -> Confidence {
        let confidence = self.named_image("history_confidence", "", CONFIDENCE, 1, Lifetime::Transient);
        self.add(pass.bind("history_confidence", confidence));
        Port::of(self.refreshed(confidence))
    }
}

fn of_gradient(pass: Pass, gradient: &Gradient) -> Pass {
    pass.constant("STRATUM_SIZE", gradient.stratum_size)
        .bind("gradient", gradient.image)
        .bind_some("light_ratio", gradient.light_ratio.map(|ratio| ratio.image))
}

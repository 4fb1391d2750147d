//! Turns temporal gradients into confidence in the history of each pixel. \[ASVGF\] 3.5, eq. 14.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, ChangeTest, BLOCK_SIZE};
use crate::contract::{Grid, Input, Lifetime};
use crate::graph::{Confidence, Difference, Gradient, Graph, Pass, Port, CONFIDENCE};
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

    /// [`Self::history_confidence`] with [`Self::change_and_steadiness`] of `difference` in the same pass.
    pub(crate) fn tested_confidence(&mut self, gradient: &Gradient, difference: &Difference) -> Confidence {
        let pass = self.tested(gradient, difference);
        self.confidence_by(pass)
    }

    /// [`Self::tested_confidence`] of diffuse light, and beside it, in the last bits, that of specular light without the ratio. `differences`: of
    /// both, or of light that is mixed.
    pub(crate) fn tested_confidence_of_both(&mut self, gradient: &Gradient, differences: &Difference) -> Confidence {
        let pass = self.tested(gradient, differences).constant("BOTH", 1);
        self.confidence_by(pass)
    }

    /// Whether a confidence has that of specular light beside it.
    pub(super) fn is_of_both(&self, confidence: &Confidence) -> bool {
        self.writer_has(confidence.image(), "BOTH")
    }

    fn tested(&mut self, gradient: &Gradient, difference: &Difference) -> Pass {
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_2).grid(Grid::Columns(BLOCK_SIZE));
        of_gradient(pass.each("block_difference", difference.images()), gradient)
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

//! Turns temporal gradients into confidence in the history of each pixel. \[ASVGF\] 3.5, eq. 14.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, ChangeTest, BLOCK_SIZE};
use crate::contract::{Grid, Input, Lifetime};
use crate::graph::{Confidence, Difference, Gradient, Graph, Image, Pass, Port, CONFIDENCE};
use crate::shaders;

/// Confidence from gradients in two kinds of history.
#[derive(Clone, Copy, Debug)]
pub struct Confidences {
    /// For a history that the ratio of light scales: [`crate::nodes::Accumulation::light_ratio`].
    pub scaled: Confidence,
    /// For an unscaled history, such as that of specular light.
    pub unscaled: Confidence,
}

impl Confidences {
    /// The same in both.
    pub(crate) fn equal(confidence: Confidence) -> Self {
        Self { scaled: confidence, unscaled: confidence }
    }
}

impl Graph {
    /// Confidence in the history, from the reconstructed gradient. With a ratio of light it is
    /// confidence in the history that [`crate::nodes::Accumulation::light_ratio`] scales. Pixels
    /// without a known gradient take the confidence of `tested`: all pixels, in frames without
    /// re-shaded samples. Where the test is sure that nothing changed, a gradient does not count.
    pub fn history_confidence(&mut self, gradient: &Gradient, tested: Option<&ChangeTest>) -> Confidence {
        self.confidence_of_gradient(gradient, tested, None)
    }

    /// [`Self::history_confidence`], and in the same pass the confidence in a history that the ratio of
    /// light does not scale. There gradients always count, since the test compared the other
    /// history.
    pub fn history_confidences(&mut self, gradient: &Gradient, tested: Option<&ChangeTest>) -> Confidences {
        let unscaled = gradient.light_ratio.map(|_| self.confidence_image("unscaled_confidence"));
        // Without the ratio one confidence is for both, so that gradients count.
        let tested = tested.map(|tested| ChangeTest { steadiness: tested.steadiness.filter(|_| unscaled.is_some()), ..*tested });
        let scaled = self.confidence_of_gradient(gradient, tested.as_ref(), unscaled);
        Confidences { scaled, unscaled: unscaled.map_or(scaled, |image| Port::of(self.refreshed(image))) }
    }

    /// [`Self::history_confidences`] with the change test of `difference` in the same pass; `both`: with a confidence of its own in a
    /// history that the ratio of light does not scale.
    pub(crate) fn tested_confidences(&mut self, gradient: &Gradient, difference: &Difference, both: bool) -> Confidences {
        let unscaled = gradient.light_ratio.filter(|_| both).map(|_| self.confidence_image("unscaled_confidence"));
        // Without the ratio one confidence is for both, so that gradients count.
        let steady = !both || unscaled.is_some();
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_2)
            .grid(Grid::Columns(BLOCK_SIZE))
            .constant("TEST", 1 + u32::from(steady))
            .each("block_difference", difference.images());
        let scaled = self.add_history_confidence(pass, gradient, unscaled);
        Confidences { scaled, unscaled: unscaled.map_or(scaled, |image| Port::of(self.refreshed(image))) }
    }

    fn confidence_of_gradient(&mut self, gradient: &Gradient, tested: Option<&ChangeTest>, unscaled: Option<Image>) -> Confidence {
        let node = self.node("history_confidence", "");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_0)
            .bind_some("other_confidence", tested.map(|tested| tested.confidence.image()))
            .bind_some("steadiness", tested.and_then(|tested| tested.steadiness).map(|steadiness| steadiness.image()));
        self.add_history_confidence(pass, gradient, unscaled)
    }

    fn add_history_confidence(&mut self, pass: Pass, gradient: &Gradient, unscaled: Option<Image>) -> Confidence {
        let confidence = self.confidence_image("history_confidence");
        let pass = pass
            .constant("STRATUM_SIZE", gradient.stratum_size)
            .bind("gradient", gradient.image)
            .bind_some("light_ratio", gradient.light_ratio.map(|ratio| ratio.image))
            .bind("history_confidence", confidence)
            .bind_some("unscaled_confidence", unscaled);
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }

    /// Confidence in the history, from your own estimate: the input `confidence`.
    pub fn host_confidence(&mut self) -> Confidence {
        let node = self.node("history_confidence", "");
        let confidence = self.confidence_image("history_confidence");
        let pass = pass(&node, &shaders::HISTORY_CONFIDENCE_SOURCE_1)
            .bind("confidence", self.input(Input::CONFIDENCE))
            .bind("history_confidence", confidence);
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }

    fn confidence_image(&mut self, name: &str) -> Image {
        self.named_image(name, "", CONFIDENCE, 1, Lifetime::Transient)
    }
}

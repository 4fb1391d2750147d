//! Turns temporal gradients into confidence in the history of each pixel. \[ASVGF\] 3.5, eq. 14.

pub(crate) mod twin;

use crate::contract::Lifetime;
use crate::graph::{Confidence, Gradient, Graph, Image, Pass, Port, CONFIDENCE, HOST_SCALAR};
use crate::shaders;

impl Graph {
    /// Confidence in the history, from the reconstructed gradient. With a ratio of light it is confidence in the history that
    /// [`crate::nodes::Accumulation::light_ratio`] scales.
    pub fn adaptive_alpha(&mut self, gradient: &Gradient) -> Confidence {
        self.add_adaptive_alpha(gradient, None)
    }

    /// [`Self::adaptive_alpha`], which takes the confidence of pixels that no gradient is known for from `other`: of all pixels in frames
    /// that the host did not shade again.
    pub fn adaptive_alpha_or(&mut self, gradient: &Gradient, other: &Confidence) -> Confidence {
        self.add_adaptive_alpha(gradient, Some(other.image()))
    }

    fn add_adaptive_alpha(&mut self, gradient: &Gradient, other: Option<Image>) -> Confidence {
        let node = self.node("adaptive_alpha", "");
        let confidence = self.confidence_image();
        let pass = Pass::new(&node, &shaders::ADAPTIVE_ALPHA_SOURCE_0)
            .constant("STRATUM_SIZE", gradient.stratum_size)
            .bind("gradient", gradient.image)
            .bind_some("light_ratio", gradient.light_ratio.map(|ratio| ratio.image))
            .bind_some("other_confidence", other)
            .bind("history_confidence", confidence);
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }

    /// Confidence in the history, from the host's own estimate: its input `confidence`.
    pub fn host_confidence(&mut self) -> Confidence {
        let node = self.node("adaptive_alpha", "");
        let confidence = self.confidence_image();
        let pass = Pass::new(&node, &shaders::ADAPTIVE_ALPHA_SOURCE_1)
            .bind("confidence", self.input("confidence", HOST_SCALAR, 1, false))
            .bind("history_confidence", confidence);
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }

    fn confidence_image(&mut self) -> Image {
        self.named_image("history_confidence", "", CONFIDENCE, 1, Lifetime::Transient)
    }
}

//! Turns temporal gradients into confidence in the history of each pixel. \[ASVGF\] 3.5, eq. 14.

pub(crate) mod twin;

use crate::contract::Lifetime;
use crate::graph::{Confidence, Gradient, Graph, Image, Pass, Port, CONFIDENCE, HOST_SCALAR};
use crate::shaders;

impl Graph {
    /// Confidence in the history, from the reconstructed gradient.
    pub fn adaptive_alpha(&mut self, gradient: &Gradient) -> Confidence {
        let node = self.node("adaptive_alpha", "");
        let confidence = self.confidence_image();
        let pass = Pass::new(&node, &shaders::ADAPTIVE_ALPHA_SOURCE_0)
            .constant("STRATUM_SIZE", gradient.stratum_size)
            .bind("gradient", gradient.image)
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

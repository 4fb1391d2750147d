//! Divides the noisy radiance by the albedo, and stops what is not finite.

pub(crate) mod twin;

use crate::config::Sampling;
use crate::graph::{Gradient, Graph, Guides, Irradiance, Pass, Radiance, HDR, HOST_COLOUR};
use crate::shaders;

/// Parameters of the node `demodulate`.
#[derive(Clone, Copy, Debug)]
pub struct Demodulate {
    /// Whether the optional input `albedo` of the host divides the radiance; else it passes as it is. Default: true.
    pub albedo: bool,
    /// Share of the pixels that have a sample: holes are marked for the node `eaw` to paint in. Default: all of them.
    pub sampling: Sampling,
    /// Gradients that compare the luminance of the noisy radiance with that of the frame before, which this node keeps for them.
    /// Default: none.
    pub gradient: Option<Gradient>,
}

impl Default for Demodulate {
    fn default() -> Self {
        Self { albedo: true, sampling: Sampling::Full, gradient: None }
    }
}

impl Graph {
    /// Irradiance of one or two signals. Values that are not finite become 0 and are counted.
    pub fn demodulate(&mut self, guides: &Guides, noisy: &Radiance, demodulate: Demodulate) -> Irradiance {
        let node = self.node("demodulate", &self.label_of(noisy));
        let irradiance: Irradiance = self.image_each(noisy, "filter_ping", HDR, 1);
        let kept = demodulate.gradient.and_then(|gradient| gradient.kept);
        let module = if kept.is_some() { &shaders::DEMODULATE_LUMINANCE_1 } else { &shaders::DEMODULATE_LUMINANCE_0 };
        let mut pass = Pass::new(&node, module)
            .constant("PAINTING", demodulate.sampling as u32)
            .bind("guide", guides.guide)
            .each("noisy", noisy.images())
            .each("irradiance", irradiance.images());
        if demodulate.albedo {
            pass = pass.bind("albedo", self.input("albedo", HOST_COLOUR, 1, true));
        }
        if let Some(kept) = kept {
            pass = pass.bind("noisy_luminance", kept.image).bind_some("noisy_red_blue", kept.red_blue);
            if kept.of.images() != noisy.images() {
                pass = pass.each("compared", kept.of.images());
            }
        }
        self.add(pass);
        self.renewed(&irradiance)
    }
}

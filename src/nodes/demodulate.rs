//! Divides the noisy radiance by the albedo, and stops what is not finite.

pub(crate) mod twin;

use super::by_signals;
use crate::config::Sampling;
use crate::graph::{Graph, Guides, Irradiance, Pass, Radiance, HDR, HOST_COLOUR};
use crate::shaders;

/// Parameters of the node `demodulate`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Demodulate {
    /// Whether the optional input `albedo` of the host divides the radiance; else it passes as it is. Default: true.
    pub albedo: bool,
    /// Share of the pixels that have a sample: holes are marked for the node `eaw` to paint in. Default: all of them.
    pub sampling: Sampling,
}

impl Default for Demodulate {
    fn default() -> Self {
        Self { albedo: true, sampling: Sampling::Full }
    }
}

impl Graph {
    /// Irradiance of one or two signals. Values that are not finite become 0 and are counted.
    pub fn demodulate(&mut self, guides: &Guides, noisy: &Radiance, demodulate: Demodulate) -> Irradiance {
        let node = self.node("demodulate", &self.label_of(noisy));
        let irradiance: Irradiance = self.image_each(noisy, "filter_ping", HDR, 1);
        let mut pass = Pass::new(&node, by_signals(noisy, &shaders::DEMODULATE_SIGNALS_1, &shaders::DEMODULATE_SIGNALS_2))
            .constant("PAINTING", demodulate.sampling as u32)
            .bind("guide", guides.guide)
            .each("noisy", noisy.images())
            .each("irradiance", irradiance.images());
        if demodulate.albedo {
            pass = pass.bind("albedo", self.input("albedo", HOST_COLOUR, 1, true));
        }
        self.add(pass);
        self.renewed(&irradiance)
    }
}

//! Multiplies the albedo back, adds the signals and the emission.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Input, Lifetime, TexelGrid};
use crate::graph::{Graph, Guides, Irradiance, Port, Radiance, HDR, WIDE_HDR};
use crate::shaders;

/// Parameters of the node `modulate`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modulate {
    /// Whether your optional input `albedo` multiplies the irradiance, as for the node
    /// `demodulate`. Default: true.
    pub albedo: bool,
    /// Whether the second signal is specular light, with the optional inputs `specular_albedo` or
    /// `specular_f0` instead of `albedo`: see [`crate::nodes::Albedo::Specular`]. Default: false.
    pub specular: bool,
    /// Whether your optional input `emission` is added. Default: true.
    pub emission: bool,
    /// Whether the radiance is of 32-bit floats instead of halves, as with [`crate::Config::float_output`]. Default: false.
    pub float_output: bool,
}

impl Default for Modulate {
    fn default() -> Self {
        Self { albedo: true, specular: false, emission: true, float_output: false }
    }
}

impl Graph {
    /// Radiance of the sum of one or two signals, each with an irradiance for every rendered pixel.
    pub fn modulate(&mut self, guides: &Guides, filtered: &Irradiance, modulate: Modulate) -> Radiance {
        let label = self.label_of(filtered);
        let node = self.node("modulate", &label);
        let (module, format) = match modulate.float_output {
            true => (&shaders::MODULATE_FLOAT_1, WIDE_HDR),
            false => (&shaders::MODULATE_FLOAT_0, HDR),
        };
        if filtered.images().iter().any(|image| matches!(self.texels_of(*image), Some(TexelGrid::Light(_)))) {
            let problem = "it has the pixels of the light, not of the guides; give it to `upsample` first";
            self.fail(&node, "filtered", problem.to_owned());
        }
        let denoised = self.named_image("modulated", &label, format, TexelGrid::Rendered(1), Lifetime::Transient);
        let mut pass = pass(&node, module)
            .grid(Grid::Guides)
            .bind("guide", guides.rendered.guide)
            .bind("denoised_radiance", denoised)
            .each("filtered", filtered.images());
        if modulate.albedo {
            pass = pass.bind("albedo", self.input(Input::ALBEDO));
        }
        if modulate.specular {
            pass = pass
                .constant("SPECULAR", 1)
                .bind("specular_albedo", self.input(Input::SPECULAR_ALBEDO))
                .bind("specular_f0", self.input(Input::SPECULAR_F0));
        }
        if modulate.emission {
            pass = pass.bind("emission", self.input(Input::EMISSION));
        }
        self.add(pass);
        Port::of(self.refreshed(denoised))
    }
}

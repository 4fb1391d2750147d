//! Divides the noisy radiance by the albedo, and stops what is not finite.

pub(crate) mod twin;

use crate::config::Sampling;
use crate::graph::{Gradient, Graph, Guides, Irradiance, Pass, Radiance, HDR, HOST_COLOUR, HOST_SCALAR};
use crate::shaders;

/// The reflectance that divides radiance, and multiplies it again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Albedo {
    /// None: the radiance passes as it is.
    None,
    /// The optional input `albedo` of the host.
    #[default]
    Diffuse,
    /// The optional input `specular_albedo` of the host: what the coat or metal reflects of light from everywhere. A host without one
    /// may give `specular_f0`, the reflectance at normal incidence, from which it is computed \[Karis 2014\]. The optional input
    /// `specular_hit_distance` says how far away is what is seen in the surface.
    Specular,
}

/// Parameters of the node `demodulate`.
#[derive(Clone, Copy, Debug)]
pub struct Demodulate {
    /// The divisor. Default: [`Albedo::Diffuse`].
    pub albedo: Albedo,
    /// Share of the pixels that have a sample: holes are marked, for the node `fill_holes` or for the node `eaw` to paint in. Default: all
    /// of them.
    pub sampling: Sampling,
    /// Gradients that compare the luminance of the noisy radiance with that of the frame before, which this node keeps for them.
    /// Default: none.
    pub gradient: Option<Gradient>,
}

impl Default for Demodulate {
    fn default() -> Self {
        Self { albedo: Albedo::Diffuse, sampling: Sampling::Full, gradient: None }
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
        pass = match demodulate.albedo {
            Albedo::None => pass,
            Albedo::Diffuse => pass.bind("albedo", self.input("albedo", HOST_COLOUR, 1, true)),
            Albedo::Specular => pass
                .bind("albedo", self.input("specular_albedo", HOST_COLOUR, 1, true))
                .bind("specular_f0", self.input("specular_f0", HOST_COLOUR, 1, true))
                .bind("specular_hit_distance", self.input("specular_hit_distance", HOST_SCALAR, 1, true)),
        };
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

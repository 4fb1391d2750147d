//! Divides the noisy radiance by the albedo, and stops what is not finite.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::choice::choices;
use crate::config::Sampling;
use crate::contract::Input;
use crate::graph::{Gradient, GradientSamples, Graph, Guides, Image, Irradiance, Pass, Port, Radiance, Value, HDR};
use crate::shaders;

choices! {
    /// The reflectance that divides radiance, and multiplies it again.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Albedo {
        /// None: the radiance passes as it is.
        None = 0 => "none",
        /// The optional input `albedo` of the host.
        #[default]
        Diffuse = 1 => "diffuse",
        /// The optional input `specular_albedo` of the host: what the coat or metal reflects of light from everywhere. A host without one
        /// may give `specular_f0`, the reflectance at normal incidence, from which it is computed \[Karis 2014\]. The optional input
        /// `specular_hit_distance` says how far away is what is seen in the surface.
        Specular = 2 => "specular",
        /// Of light that is diffuse and specular together: the sum of the optional inputs `albedo` and `specular_albedo`. Without the
        /// latter `albedo` is that of both. `specular_hit_distance` as of [`Self::Specular`].
        Mixed = 3 => "mixed",
        /// Of two signals: [`Self::Diffuse`] for the first, [`Self::Specular`] for the second.
        Each = 4 => "each",
    }
}

/// Parameters of the node `demodulate`.
#[derive(Clone, Copy, Debug)]
pub struct Demodulate {
    /// The divisor. Default: [`Albedo::Diffuse`].
    pub albedo: Albedo,
    /// Share of the pixels that have a sample: holes are marked, for the node `fill_holes` or for the node `eaw` to fill. Default: all
    /// of them, and the few whose radiance is not finite are filled here.
    pub sampling: Sampling,
    /// Gradients that compare the luminance of the noisy radiance with that of the frame before, which this node keeps for them.
    /// Default: none.
    pub gradient: Option<Gradient>,
    /// Pixels of the noisy radiance that the host shades again: their light comes from points whose albedo is not that of the pixel. It is
    /// divided by that of the point instead, in a pass of its own, `sample_albedo`. Default: none.
    pub samples: Option<GradientSamples>,
}

/// Edges over which a pixel without a sample takes nothing from its neighbours: no tunables, since such pixels are rare.
const HOLE_SIGMA_N: f32 = 32.0;
const HOLE_SIGMA_Z: f32 = 1.0;

/// The images that make the divisor.
#[derive(Clone, Copy, Default)]
pub(super) struct Divisor {
    albedo: Option<Image>,
    specular_f0: Option<Image>,
    /// Beside `specular_f0`.
    roughness: Option<Image>,
    /// Added to `albedo`, or with `of_each` the albedo of the second signal.
    coat: Option<Image>,
    /// Whether `albedo` divides the first of two signals alone, and `coat` or `specular_f0` the second.
    pub(super) of_each: bool,
    /// Whether `albedo` is that of specular light.
    pub(super) of_coat: bool,
}

impl Divisor {
    fn new(graph: &mut Graph, albedo: Albedo) -> Self {
        match albedo {
            Albedo::None => Self::default(),
            Albedo::Diffuse => Self { albedo: graph.dividing_albedo(), ..Self::default() },
            Albedo::Mixed => {
                let albedo = graph.dividing_albedo();
                Self { albedo, coat: albedo.map(|_| graph.input(Input::SPECULAR_ALBEDO)), ..Self::default() }
            }
            Albedo::Specular => {
                let mut input = |input| Some(graph.input(input));
                Self {
                    albedo: input(Input::SPECULAR_ALBEDO),
                    specular_f0: input(Input::SPECULAR_F0),
                    roughness: input(Input::ROUGHNESS),
                    of_coat: true,
                    ..Self::default()
                }
            }
            Albedo::Each => {
                let albedo = graph.dividing_albedo();
                let mut input = |input| Some(graph.input(input));
                Self {
                    albedo,
                    specular_f0: input(Input::SPECULAR_F0),
                    roughness: input(Input::ROUGHNESS),
                    coat: input(Input::SPECULAR_ALBEDO),
                    of_each: true,
                    of_coat: false,
                }
            }
        }
    }

    /// The signals that have a divisor, with it.
    fn of_divided(self, irradiance: &Irradiance) -> Option<(Irradiance, Self)> {
        match (self.albedo, irradiance.images()) {
            (None, [_, second]) if self.of_each => {
                Some((Port::of(*second), Self { albedo: self.coat, coat: None, of_each: false, of_coat: true, ..self }))
            }
            (albedo, _) => albedo.map(|_| (*irradiance, self)),
        }
    }

    pub(super) fn bind(self, pass: Pass) -> Pass {
        pass.bind_some("albedo", self.albedo)
            .bind_some("specular_f0", self.specular_f0)
            .bind_some("roughness", self.roughness)
            .bind_some("specular_albedo", self.coat)
    }
}

impl Default for Demodulate {
    fn default() -> Self {
        Self { albedo: Albedo::Diffuse, sampling: Sampling::Full, gradient: None, samples: None }
    }
}

impl Graph {
    /// The albedo that light is divided by; none where it comes divided.
    pub(crate) fn dividing_albedo(&mut self) -> Option<Image> {
        (!self.gets_irradiance()).then(|| self.input(Input::ALBEDO))
    }

    /// Irradiance of one or two signals. Radiance that is not finite is no sample: it is counted, its pixel takes the mean of the samples
    /// around it, and a negative alpha tells the accumulation so.
    pub fn demodulate(&mut self, guides: &Guides, noisy: &Radiance, demodulate: Demodulate) -> Irradiance {
        let node = self.node("demodulate", &self.label_of(noisy));
        let irradiance: Irradiance = self.image_each(noisy, "irradiance", HDR, 1);
        let kept = demodulate.gradient.and_then(|gradient| gradient.kept);
        let module = if kept.is_some() { &shaders::DEMODULATE_LUMINANCE_1 } else { &shaders::DEMODULATE_LUMINANCE_0 };
        let mut pass = pass(&node, module)
            .constant("SAMPLING", demodulate.sampling as u32)
            .constant("SPECULAR", u32::from(demodulate.albedo == Albedo::Each))
            .constant("COAT", u32::from(demodulate.albedo == Albedo::Specular))
            .value("sigma_n", Value::Fixed(HOLE_SIGMA_N))
            .value("sigma_z", Value::Fixed(HOLE_SIGMA_Z))
            .bind("guide", guides.guide)
            .each("noisy", noisy.images())
            .each("irradiance", irradiance.images());
        let divisor = Divisor::new(self, demodulate.albedo);
        if divisor.of_each && noisy.signals() != 2 {
            let problem = "the albedo is that of each of two signals, and one was given; pair it with specular light";
            self.fail(&node, "albedo", problem.to_owned());
        }
        pass = divisor.bind(pass);
        if matches!(demodulate.albedo, Albedo::Specular | Albedo::Mixed | Albedo::Each) {
            pass = pass.bind("specular_hit_distance", self.input(Input::SPECULAR_HIT_DISTANCE));
        }
        if let Some(kept) = kept {
            pass = pass.constant("STRATUM_SIZE", kept.side).bind_some("candidates", kept.candidates);
            pass = pass.bind("noisy_luminance", kept.image).bind_some("noisy_red_blue", kept.red_blue);
            if kept.of.images() != noisy.images() {
                pass = pass.each("compared", kept.of.images());
            }
        }
        self.add(pass);
        let irradiance = self.renewed(&irradiance);
        if let (Some(samples), Some((divided, divisor))) = (demodulate.samples, divisor.of_divided(&irradiance)) {
            self.sample_albedo(guides, &divided, divisor, &samples);
        }
        self.renewed(&irradiance)
    }
}

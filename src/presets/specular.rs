//! The filter of specular light, beside that of diffuse light.

use crate::config::{Config, Signals};
use crate::graph::{Confidence, Difference, Feedback, GradientSamples, Graph, Guides, Irradiance, Radiance, Reflection};
use crate::nodes::{Albedo, Atrous, Demodulate, Estimator, Kernel, LuminanceWeight, Modulate, SpecularAccumulation, Variance};

/// Parameters of [`specular`], which differ from preset to preset.
#[derive(Clone, Copy, Debug)]
pub struct Specular {
    /// Source of the history.
    pub feedback: Feedback,
    /// Estimator of the variance.
    pub variance: Variance,
    /// Kernel of the wavelet levels.
    pub kernel: Kernel,
    /// Weight by luminance.
    pub luminance_weight: LuminanceWeight,
    /// Whether history is read by a cubic: [`SpecularAccumulation::sharp`].
    pub sharp: bool,
    /// Confidence in the history, which no ratio of light scales.
    pub confidence: Option<Confidence>,
    /// Difference of diffuse light from its history. A change test of it and of specular light then
    /// replaces `confidence`. Default: none.
    pub difference: Option<Difference>,
    /// Re-shaded pixels.
    pub samples: Option<GradientSamples>,
}

impl Default for Specular {
    fn default() -> Self {
        Self {
            feedback: Feedback::Accumulated,
            variance: Variance { estimator: Estimator::OfMean, ..Variance::default() },
            kernel: Kernel::Box,
            luminance_weight: LuminanceWeight::OfMeans,
            sharp: false,
            confidence: None,
            difference: None,
            samples: None,
        }
    }
}

/// Filters `noisy_specular`: irradiance by the specular albedo, and the reflections in the
/// surfaces.
///
/// It reads `sampling` and `levels` of the configuration.
pub fn specular(g: &mut Graph, guides: &Guides, config: &Config, specular: Specular) -> (Irradiance, Reflection) {
    let noisy = g.radiance("noisy_specular");
    let Specular { feedback, variance, kernel, luminance_weight, sharp, samples, .. } = specular;
    let demodulate = Demodulate { albedo: Albedo::Specular, samples, sampling: config.sampling, ..Demodulate::default() };
    let irradiance = g.demodulate(guides, &noisy, demodulate);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let history = g.specular_history(&irradiance, feedback);
    let confidence = match specular.difference {
        Some(diffuse) => {
            let own = g.block_difference(guides, &irradiance, &history.history);
            let both = g.pair(&own, &diffuse);
            Some(g.scope(SCOPE, |g| g.change_test(&both)))
        }
        None => specular.confidence,
    };
    let accumulation = SpecularAccumulation { confidence, sharp, ..SpecularAccumulation::default() };
    let found = g.specular_accumulation(guides, &irradiance, &history, accumulation);
    let estimate = g.variance(guides, &found.accumulated, &history.history, variance);
    let feedback = (feedback == Feedback::Filtered).then_some(history.history);
    let shape = Atrous { levels: config.levels(), kernel, luminance_weight, ..Atrous::default() };
    let atrous = Atrous { feedback, reflection: Some(found.reflection), ..shape };
    (g.atrous(guides, &estimate, atrous).into(), found.reflection)
}

/// Behind the names of nodes that diffuse light has, too.
const SCOPE: &str = "specular";

/// Radiance of the filtered irradiance of a preset; with [`Signals::Specular`] plus specular light,
/// and its reflections.
pub(super) fn modulated(
    g: &mut Graph,
    guides: &Guides,
    config: &Config,
    filtered: Irradiance,
    parameters: Specular,
) -> (Radiance, Option<Reflection>) {
    if config.signals != Signals::Specular {
        return (g.modulate(guides, &filtered, modulate(config)), None);
    }
    let (reflected, reflection) = specular(g, guides, config, parameters);
    (sum(g, guides, config, &filtered, &reflected), Some(reflection))
}

/// Radiance of diffuse and specular irradiance.
pub(super) fn sum(g: &mut Graph, guides: &Guides, config: &Config, diffuse: &Irradiance, specular: &Irradiance) -> Radiance {
    let both = g.pair(diffuse, specular);
    g.modulate(guides, &both, Modulate { specular: true, ..modulate(config) })
}

/// Radiance of the whole picture, as the configuration has it.
pub(super) fn modulate(config: &Config) -> Modulate {
    Modulate { float_output: config.float_output, mixed: config.signals == Signals::Mixed, ..Modulate::default() }
}

/// The noisy radiance of the whole picture, of which gradients are made: diffuse and specular light as a pair.
pub(super) fn compared(g: &mut Graph, noisy: &Radiance, config: &Config) -> Radiance {
    if config.signals != Signals::Specular {
        return *noisy;
    }
    let specular = g.radiance("noisy_specular");
    g.pair(noisy, &specular)
}

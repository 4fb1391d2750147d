//! The filter of specular light, beside that of diffuse light.

use crate::config::{Config, Signals};
use crate::graph::{
    Confidence, Difference, Estimate, Feedback, Gradient, GradientSamples, Graph, Guides, History, Irradiance, Radiance, Reflection,
};
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
    /// Gradient of both signals, which replaces `confidence`. Default: none.
    pub gradient: Option<Gradient>,
    /// Whether a change test of specular light replaces unknown gradients, and overrules gradients
    /// where it is sure that nothing changed. Default: true.
    pub change_test: bool,
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
            gradient: None,
            change_test: true,
            samples: None,
        }
    }
}

/// Specular light before its spatial filter.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpecularEstimate {
    estimate: Estimate,
    history: History,
    reflection: Reflection,
    parameters: Specular,
}

/// Filters `noisy_specular`: irradiance by the specular albedo, and the reflections in the
/// surfaces.
///
/// It reads `sampling` and `levels` of the configuration.
pub fn specular(g: &mut Graph, guides: &Guides, config: &Config, specular: Specular) -> (Irradiance, Reflection) {
    let estimate = estimated(g, guides, config, specular);
    filtered(g, guides, config, estimate)
}

/// [`estimated`] where the configuration has specular light. Call it before the spatial filter of diffuse light: the images that
/// accumulations alone read are dead then.
pub(super) fn beside(g: &mut Graph, guides: &Guides, config: &Config, specular: Specular) -> Option<SpecularEstimate> {
    (config.signals == Signals::Specular).then(|| estimated(g, guides, config, specular))
}

/// Accumulates `noisy_specular` and estimates its deviation.
fn estimated(g: &mut Graph, guides: &Guides, config: &Config, specular: Specular) -> SpecularEstimate {
    let noisy = g.radiance("noisy_specular");
    let Specular { feedback, variance, sharp, samples, .. } = specular;
    let demodulate = Demodulate { albedo: Albedo::Specular, samples, sampling: config.sampling, ..Demodulate::default() };
    let irradiance = g.demodulate(guides, &noisy, demodulate);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let history = g.specular_history(&irradiance, feedback);
    let confidence = if let Some(diffuse) = specular.difference {
        let own = g.block_difference(guides, &irradiance, &history.history);
        let both = g.pair(&own, &diffuse);
        Some(g.scope(SCOPE, |g| g.change_test(&both)))
    } else if let Some(gradient) = specular.gradient {
        let tested = specular.change_test.then(|| {
            let own = g.block_difference(guides, &irradiance, &history.history);
            g.scope("tested", |g| g.change_and_steadiness(&own))
        });
        Some(g.scope(SCOPE, |g| g.history_confidence(&gradient.without_ratio(), tested.as_ref())))
    } else {
        specular.confidence
    };
    let accumulation = SpecularAccumulation { confidence, sharp, ..SpecularAccumulation::default() };
    let found = g.specular_accumulation(guides, &irradiance, &history, accumulation);
    let estimate = g.variance(guides, &found.accumulated, &history.history, variance);
    SpecularEstimate { estimate, history: history.history, reflection: found.reflection, parameters: specular }
}

fn filtered(g: &mut Graph, guides: &Guides, config: &Config, specular: SpecularEstimate) -> (Irradiance, Reflection) {
    let SpecularEstimate { estimate, history, reflection, parameters } = specular;
    let Specular { feedback, kernel, luminance_weight, .. } = parameters;
    let feedback = (feedback == Feedback::Filtered).then_some(history);
    let shape = Atrous { levels: config.levels(), kernel, luminance_weight, ..Atrous::default() };
    let atrous = Atrous { feedback, reflection: Some(reflection), ..shape };
    (g.atrous(guides, &estimate, atrous).into(), reflection)
}

/// Behind the names of nodes that diffuse light has, too.
const SCOPE: &str = "specular";

/// Radiance of the filtered irradiance of a preset; with specular light, filtered and added, and its reflections.
pub(super) fn modulated(
    g: &mut Graph,
    guides: &Guides,
    config: &Config,
    diffuse: Irradiance,
    specular: Option<SpecularEstimate>,
) -> (Radiance, Option<Reflection>) {
    let Some(specular) = specular else { return (g.modulate(guides, &diffuse, modulate(config)), None) };
    let (reflected, reflection) = filtered(g, guides, config, specular);
    (sum(g, guides, config, &diffuse, &reflected), Some(reflection))
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

//! The filter of specular light, beside that of diffuse light.

use super::past::Estimated;
use crate::config::{Config, Sampling, Signals};
use crate::graph::{
    Confidence, Difference, Estimate, Feedback, Gradient, GradientSamples, Graph, Guides, History, Irradiance, Port, Radiance,
    Reflection,
};
use crate::nodes::{Albedo, Atrous, Demodulate, Estimator, Modulate, SpecularAccumulation, SpecularHistory, Variance};

/// Parameters of [`specular`], which differ from preset to preset.
#[derive(Clone, Copy, Debug)]
pub struct Specular {
    /// Source of the history.
    pub feedback: Feedback,
    /// Estimator of the variance.
    pub variance: Variance,
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
    /// Re-shaded pixels, for [`specular`].
    pub samples: Option<GradientSamples>,
}

impl Default for Specular {
    fn default() -> Self {
        Self {
            feedback: Feedback::Accumulated,
            variance: Variance { estimator: Estimator::OfMean, ..Variance::default() },
            sharp: false,
            confidence: None,
            difference: None,
            gradient: None,
            change_test: true,
            samples: None,
        }
    }
}

/// The light of surfaces over its albedo, and specular light beside it in the same passes.
pub(super) fn demodulated(
    g: &mut Graph,
    guides: &Guides,
    config: &Config,
    noisy: &Radiance,
    gradient: Option<Gradient>,
    samples: Option<GradientSamples>,
) -> (Irradiance, Option<Irradiance>) {
    let albedo = match config.signals {
        Signals::Mixed => Albedo::Mixed,
        Signals::Specular => Albedo::Each,
        Signals::Together | Signals::Apart => Albedo::Diffuse,
    };
    let noisy = compared(g, noisy, config);
    let irradiance = g.demodulate(guides, &noisy, Demodulate { albedo, gradient, samples, sampling: config.sampling });
    match (config.signals, irradiance.images()) {
        (Signals::Specular, &[diffuse, specular]) => (Port::of(diffuse), Some(Port::of(specular))),
        _ => (irradiance, None),
    }
}

/// Specular light beside that of a preset, and its history, made before the nodes that read the previous frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reflected {
    pub irradiance: Irradiance,
    pub history: SpecularHistory,
    /// From its own history, where another pass has it.
    pub difference: Option<Difference>,
}

impl Reflected {
    pub(super) fn new(g: &mut Graph, irradiance: Irradiance, feedback: Feedback) -> Self {
        Self { irradiance, history: g.specular_history(&irradiance, feedback), difference: None }
    }
}

/// Specular light before its spatial filter.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpecularEstimate {
    estimate: Estimate,
    history: History,
    pub reflection: Reflection,
}

/// Filters `noisy_specular` alone: irradiance by the specular albedo, and the reflections in the
/// surfaces. `spatial` takes its feedback and its reflections from here.
///
/// It reads `sampling` of the configuration.
pub fn specular(g: &mut Graph, guides: &Guides, config: &Config, specular: Specular, spatial: Atrous) -> (Irradiance, Reflection) {
    let noisy = g.radiance("noisy_specular");
    let demodulate =
        Demodulate { albedo: Albedo::Specular, samples: specular.samples, sampling: config.sampling, ..Demodulate::default() };
    let irradiance = g.demodulate(guides, &noisy, demodulate);
    let reflected = Reflected::new(g, irradiance, specular.feedback);
    let SpecularEstimate { estimate, history, reflection } = estimated(g, guides, config, &reflected, specular);
    let feedback = (specular.feedback == Feedback::Filtered).then_some(history);
    (g.atrous(guides, &estimate, Atrous { feedback, reflection: Some(reflection), ..spatial }).into(), reflection)
}

/// Accumulates specular light and estimates its deviation. Call it before the spatial filter of diffuse light: the images that
/// accumulations alone read are dead then.
pub(super) fn estimated(
    g: &mut Graph,
    guides: &Guides,
    config: &Config,
    reflected: &Reflected,
    specular: Specular,
) -> SpecularEstimate {
    let Specular { variance, sharp, .. } = specular;
    let Reflected { history, .. } = *reflected;
    let own = |g: &mut Graph| {
        let Reflected { irradiance, history, difference } = reflected;
        difference.unwrap_or_else(|| g.block_difference(guides, irradiance, &history.history))
    };
    let confidence = if let Some(diffuse) = specular.difference {
        let own = own(g);
        let both = g.pair(&own, &diffuse);
        Some(g.scope(SCOPE, |g| g.change_test(&both)))
    } else if let Some(gradient) = specular.gradient {
        let own = specular.change_test.then(|| own(g));
        Some(g.scope(SCOPE, |g| match own {
            Some(own) => g.tested_confidence(Some(&gradient.without_ratio()), &own, false).0,
            None => g.history_confidence(&gradient.without_ratio(), None),
        }))
    } else {
        specular.confidence
    };
    let irradiance = g.fill_holes(guides, &reflected.irradiance, config.sampling);
    let accumulation = SpecularAccumulation { confidence, sharp, ..SpecularAccumulation::default() };
    let found = g.specular_accumulation(guides, &irradiance, &history, accumulation);
    let estimate = g.variance(guides, &found.accumulated, &history.history, variance);
    SpecularEstimate { estimate, history: history.history, reflection: found.reflection }
}

/// Behind the names of nodes that diffuse light has, too.
const SCOPE: &str = "specular";

/// Filters the light of a preset and multiplies its albedo back; with specular light both in the same passes.
pub(super) fn filtered(g: &mut Graph, guides: &Guides, config: &Config, estimated: &Estimated, spatial: Atrous) -> Radiance {
    let spatial = Atrous { reflection: estimated.reflection(), ..spatial };
    let Some(specular) = estimated.specular else {
        let filtered = g.atrous(guides, &estimated.estimate, spatial).into();
        let detail = detail(g, config, estimated.history);
        return g.modulate(guides, &filtered, Modulate { detail, ..modulate(config) });
    };
    let feedback = spatial.feedback.map(|diffuse| diffuse.beside(specular.history));
    let both = g.pair(&estimated.estimate, &specular.estimate);
    let filtered = g.atrous(guides, &both, Atrous { feedback, ..spatial }).into();
    let detail = detail(g, config, estimated.history.beside(specular.history));
    g.modulate(guides, &filtered, Modulate { specular: true, detail, ..modulate(config) })
}

/// The source of the detail that noise does not explain. Pixels that were filled in tell nothing of it, and light of fewer pixels has none of its own.
fn detail(g: &Graph, config: &Config, history: History) -> Option<History> {
    let has_own = !g.has_light_extent() && config.sampling == Sampling::Full;
    (has_own && history.feedback == Feedback::Accumulated).then_some(history)
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

//! The filter of choice: everything that made pictures better, in one graph.

use super::specular::{compared, modulated, Specular};
use super::{gradient_samples, noisy, Denoised};
use crate::config::{Config, Signals};
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Confidences, Demodulate, Estimator, GradientAtrous, Kernel, Known, Variance};

/// A-SVGF whose history follows the light instead of being dropped where all samples of a place agree on how the light changed, is not
/// filtered, and is not blurred by motion; outliers are taken out before it. Where no gradient is known, the change test of [`super::percentile`] takes its place. `docs/stages.md` has what each of these is worth.
///
/// It reads `signals`, `sampling`, `levels`, `block_sort`, `gradient_source`, `stratum_size`, `forward_motion` and `surface_id` of the
/// configuration.
pub fn best(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    best_with(g, guides, config, Atrous { levels: config.levels(), kernel: Kernel::Box, ..Atrous::default() })
}

/// [`best`] with another spatial filter of the light that is not apart; `shared_deviation` is true whatever it says.
pub fn best_with(g: &mut Graph, guides: &Guides, config: &Config, spatial: Atrous) -> Denoised {
    let gradients = gradient_samples(g, guides, config);
    let noisy = noisy(g, config.signals);
    let compared = compared(g, &noisy, config);
    let gradient = gradients.map(|source| {
        let gradient = g.gradient_and_ratio(guides, &compared, source);
        g.gradient_atrous(guides, &gradient, GradientAtrous::default())
    });
    let samples = gradients.and_then(|gradients| gradients.samples());
    let demodulate = Demodulate { gradient, samples, sampling: config.sampling, ..Demodulate::default() };
    let irradiance = g.demodulate(guides, &noisy, demodulate);
    let percentiles = g.block_percentiles(guides, &irradiance, config.block_sort);
    let irradiance = g.firefly(guides, &irradiance, &percentiles);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let history = g.history(&irradiance, Feedback::Accumulated);
    let Confidences { scaled: confidence, unscaled } = match &gradient {
        Some(gradient) => {
            let difference = g.block_difference(guides, &irradiance, &history);
            let tested = g.scope("tested", |g| g.change_and_steadiness(&difference));
            match config.signals {
                Signals::Specular => g.adaptive_alphas_or(gradient, &tested),
                _ => Confidences::equal(g.adaptive_alpha_or(gradient, &tested)),
            }
        }
        None => Confidences::equal(g.host_confidence()),
    };
    let light_ratio = gradient.and_then(|gradient| gradient.light_ratio());
    let accumulation = Accumulation { confidence: Some(confidence), sharp: true, light_ratio, ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let variance = Variance { estimator: Estimator::Fading, averaged: true, ..Variance::default() };
    let estimate = g.variance(guides, &accumulated, &history, variance);
    let filtered = g.atrous(guides, &estimate, Atrous { shared_deviation: true, ..spatial });
    let specular = Specular { variance, shared_deviation: true, samples, confidence: Some(unscaled), ..Specular::default() };
    let (radiance, reflection) = modulated(g, guides, config, filtered.into(), specular);
    let known = Known {
        history: Some(history),
        reflection,
        deviation: true,
        confidence: Some(confidence),
        gradient,
        percentiles: Some(percentiles),
        ..Known::new(&noisy)
    };
    Denoised { radiance, known }
}

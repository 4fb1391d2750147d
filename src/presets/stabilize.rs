//! A temporal accumulation over the output of any other denoiser, driven by the gradients of the noisy radiance (A-RAE, \[ASVGF\]
//! 4).

use super::specular::modulate;
use super::{change_of_light, firefly_filter, gradient_samples, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Demodulate, Estimator, Intermediates, Variance};

/// A-RAE: `noisy_radiance` is compared and `other_denoised_radiance` is accumulated. Both are
/// divided by the albedo, so that textures stay. \[ASVGF\] 4
///
/// It reads `firefly_filter`, `gradient_source`, `stratum_size`, `forward_motion` and `surface_id` of the
/// configuration.
pub fn stabilize(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let gradients = gradient_samples(g, guides, config);
    let other = g.radiance("other_denoised_radiance");
    // A host that knows what changed need not show the noisy picture.
    let compared = if gradients.is_some() { g.radiance("noisy_radiance") } else { other };
    let change = change_of_light(g, guides, config, &compared, gradients);
    let irradiance = g.demodulate(guides, &other, Demodulate { gradient: change.gradient, ..Demodulate::default() });
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let history = g.history(&irradiance, Feedback::Accumulated);
    let confidence = change.confidence.unwrap_or_else(|| {
        let difference = g.block_difference(guides, &irradiance, &history);
        g.change_test(&difference)
    });
    let accumulation = Accumulation { confidence: Some(confidence), ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(guides, &irradiance, &history, accumulation);
    let variance = Variance { estimator: Estimator::Temporal, ..Variance::default() };
    let estimate = g.variance(guides, &accumulated, &history, variance);
    let radiance = g.modulate(guides, &estimate.into(), modulate(config));
    let intermediates = Intermediates {
        history: Some(history),
        confidence: Some(confidence),
        gradient: change.gradient,
        usual,
        ..Intermediates::new(&other)
    };
    Denoised { radiance, intermediates }
}

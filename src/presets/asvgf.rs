//! Adaptive temporal filtering by temporal gradients \[ASVGF\].

use super::past::Past;
use super::specular::{compared, demodulated, estimated, filtered, Specular};
use super::{box_filter, change_of_light, firefly_filter, gradient_samples, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Estimator, Intermediates, Variance};

/// A-SVGF: temporal gradients measure how outdated the history of each pixel is. The rest is SVGF
/// with a 3×3 box, and with the fading estimate of variance \[PSVGF\]. \[ASVGF\] 3.
///
/// It reads `signals`, `sampling`, `levels`, `firefly_filter`, `gradient_source`, `stratum_size`, `forward_motion` and
/// `surface_id` of the configuration.
pub fn asvgf(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let gradients = gradient_samples(g, guides, config);
    let noisy = noisy(g, config.signals);
    let compared = compared(g, &noisy, config);
    let change = change_of_light(g, guides, &compared, gradients);
    let samples = gradients.and_then(|gradients| gradients.samples());
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, change.gradient, samples);
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let past = Past::new(g, config, &irradiance, Feedback::Accumulated);
    let history = past.history;
    let accumulation = Accumulation { confidence: Some(change.confidence), ..Accumulation::default() };
    let (accumulated, mixed) = past.accumulated(g, guides, &irradiance, accumulation);
    // Light that changes makes many histories short: the fading estimate costs as much for them as for long ones.
    let variance = Variance { estimator: Estimator::OfMean, ..Variance::default() };
    let estimate = g.variance(guides, &accumulated, &history, variance);
    let specular = Specular { confidence: Some(change.confidence), ..Specular::default() };
    let specular = reflected.map(|reflected| estimated(g, guides, config, &reflected, specular));
    let spatial = Atrous { reflection: mixed, ..box_filter(config) };
    let radiance = filtered(g, guides, config, &estimate, spatial, specular);
    let intermediates = Intermediates {
        history: Some(history),
        reflection: specular.map(|specular| specular.reflection).or(mixed),
        deviation: true,
        confidence: Some(change.confidence),
        gradient: change.gradient,
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

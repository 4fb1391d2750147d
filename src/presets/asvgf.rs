//! Adaptive temporal filtering by temporal gradients \[ASVGF\].

use super::past::Past;
use super::specular::{compared, demodulated, filtered, Specular};
use super::{box_filter, change_of_light, firefly_filter, gradient_samples, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Estimator, Intermediates, Variance};

/// A-SVGF: temporal gradients measure how outdated the history of each pixel is. The rest is SVGF
/// with a 3×3 box, and with the fading estimate of variance \[PSVGF\]. \[ASVGF\] 3.
///
/// It reads `signals`, `sampling`, `levels`, `firefly_filter`, `gradient_source`, `stratum_size`, `forward_motion` and
/// `surface_id` of the configuration.
pub fn asvgf(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let gradients = gradient_samples(g, guides, config);
    let noisy = noisy(g, config.signals);
    let compared = compared(g, &noisy, config);
    let change = change_of_light(g, guides, config, &compared, gradients);
    let samples = gradients.and_then(|gradients| gradients.samples());
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, change.gradient, samples);
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let past = Past::new(g, config, &irradiance, reflected, Feedback::Accumulated);
    let history = past.history;
    let difference = change.confidence.is_none().then(|| g.block_difference(guides, &irradiance, &history));
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let confidence = change.confidence.or_else(|| difference.map(|difference| g.change_test(&difference)));
    let accumulation = Accumulation { confidence, ..Accumulation::default() };
    // Light that changes makes many histories short: the fading estimate costs as much for them as for long ones.
    let variance = Variance { estimator: Estimator::OfMean, ..Variance::default() };
    let specular = Specular { confidence, difference, variance, ..Specular::default() };
    let estimated = past.estimated(g, guides, config, &irradiance, accumulation, specular);
    let radiance = filtered(g, guides, config, &estimated, box_filter(config));
    let intermediates = Intermediates {
        history: Some(history),
        reflection: estimated.reflection(),
        deviation: true,
        confidence,
        gradient: change.gradient,
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

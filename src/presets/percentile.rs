//! Percentile-based adaptive SVGF [PSVGF].

use super::past::Past;
use super::specular::{demodulated, estimated, filtered, Specular};
use super::{box_filter, compared_with_history, firefly_filter, noisy, Denoised};
use crate::config::{AdaptiveRule, Config};
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Estimator, Intermediates, Variance};

/// Percentile-adaptive SVGF: statistics of 8×8 pixels remove fireflies and detect outdated history.
/// \[PSVGF\]
///
/// It reads `signals`, `sampling`, `levels` and `adaptive_rule` of the configuration.
pub fn percentile(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let noisy = noisy(g, config.signals);
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, None, None);
    let past = Past::new(g, config, &irradiance, Feedback::Accumulated);
    let history = past.history;
    let (irradiance, difference, usual) = match config.adaptive_rule {
        AdaptiveRule::Percentiles => {
            let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, true);
            (irradiance, None, usual)
        }
        AdaptiveRule::ChangeTest => {
            let (irradiance, difference, usual) = compared_with_history(g, guides, irradiance, &history, true);
            (irradiance, Some(difference), usual)
        }
    };
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let confidence = match &difference {
        Some(difference) => Some(g.change_test(difference)),
        None => usual.map(|usual| g.percentile_rule(guides, &usual.percentiles, &history)),
    };
    let accumulation = Accumulation { confidence, repair: true, ..Accumulation::default() };
    let (accumulated, mixed) = past.accumulated(g, guides, &irradiance, accumulation);
    let variance = Variance { estimator: Estimator::OfMean, ..Variance::default() };
    let estimate = g.variance(guides, &accumulated, &history, variance);
    let specular = Specular { confidence, difference, ..Specular::default() };
    let specular = reflected.map(|reflected| estimated(g, guides, config, &reflected, specular));
    // The 3x3 box costs 9 taps of 25 and pays for the statistics; on the flickering box it is no worse.
    let spatial = Atrous { reflection: mixed, ..box_filter(config) };
    let radiance = filtered(g, guides, config, &estimate, spatial, specular);
    let intermediates = Intermediates {
        history: Some(history),
        reflection: specular.map(|specular| specular.reflection).or(mixed),
        deviation: true,
        confidence,
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

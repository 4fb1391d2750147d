//! The cheapest filter that follows changing light.

use super::past::Past;
use super::specular::{demodulated, estimated, filtered, Specular};
use super::{box_filter, compared_with_history, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Estimator, Intermediates, Variance};

/// SVGF with 4 levels of 9 taps, and with the change test of [`super::percentile`] before the
/// history. Take it if you count every microsecond. `docs/lab/performance.md` compares its cost and
/// quality with the others.
///
/// It reads `signals`, `sampling`, `levels` and `firefly_filter` of the configuration.
pub fn fast(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    fast_with(g, guides, config, box_filter(config))
}

/// [`fast`] with a different spatial filter.
pub fn fast_with(g: &mut Graph, guides: &Guides, config: &Config, spatial: Atrous) -> Denoised {
    let noisy = noisy(g, config.signals);
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, None, None);
    let past = Past::new(g, config, &irradiance, Feedback::Accumulated);
    let history = past.history;
    let (irradiance, difference, usual) = compared_with_history(g, guides, irradiance, &history, config.firefly_filter);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let confidence = g.change_test(&difference);
    let accumulation = Accumulation { confidence: Some(confidence), ..Accumulation::default() };
    let (accumulated, mixed) = past.accumulated(g, guides, &irradiance, accumulation);
    let estimate = g.variance(guides, &accumulated, &history, Variance { estimator: Estimator::OfMean, ..Variance::default() });
    let specular = reflected.map(|reflected| {
        estimated(g, guides, config, &reflected, Specular { difference: Some(difference), ..Specular::default() })
    });
    let spatial = Atrous { reflection: mixed, ..spatial };
    let radiance = filtered(g, guides, config, &estimate, spatial, specular);
    let intermediates = Intermediates {
        history: Some(history),
        reflection: specular.map(|specular| specular.reflection).or(mixed),
        deviation: true,
        confidence: Some(confidence),
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

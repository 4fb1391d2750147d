//! Percentile-based adaptive SVGF [PSVGF].

use super::past::{Compared, Past};
use super::specular::{demodulated, filtered, Specular};
use super::{box_filter, firefly_filter, noisy, Denoised};
use crate::config::{AdaptiveRule, Config};
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Intermediates};

/// Percentile-adaptive SVGF: statistics of 8×8 pixels remove fireflies and detect outdated history.
/// \[PSVGF\]
///
/// It reads `signals`, `sampling`, `levels` and `adaptive_rule` of the configuration.
pub fn percentile(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let noisy = noisy(g, config.signals);
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, None, None);
    let mut past = Past::new(g, config, &irradiance, reflected, Feedback::Accumulated);
    let history = past.history;
    let (irradiance, difference, usual) = match config.adaptive_rule {
        AdaptiveRule::Percentiles => {
            let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, true);
            (irradiance, None, usual)
        }
        AdaptiveRule::ChangeTest => {
            let Compared { irradiance, difference, usual } = past.compared(g, guides, irradiance, true);
            (irradiance, Some(difference), usual)
        }
    };
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let confidence = match &difference {
        Some(difference) => Some(g.change_test(difference)),
        None => usual.map(|usual| g.percentile_rule(guides, &usual.percentiles, &history)),
    };
    let accumulation = Accumulation { confidence, repair: true, ..Accumulation::default() };
    let specular = Specular { confidence, difference, ..Specular::default() };
    let estimated = past.estimated(g, guides, config, &irradiance, accumulation, specular);
    // The 3x3 box costs 9 taps of 25 and pays for the statistics; on the flickering box it is no worse.
    let radiance = filtered(g, guides, config, &estimated, box_filter(config));
    let intermediates = Intermediates {
        history: Some(history),
        reflection: estimated.reflection(),
        deviation: true,
        confidence,
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

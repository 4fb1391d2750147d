//! The cheapest filter that follows changing light.

use super::past::{Compared, Past};
use super::specular::{demodulated, filtered, Specular};
use super::{box_filter, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Intermediates};

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
    let mut past = Past::new(g, config, &irradiance, reflected, Feedback::Accumulated);
    let Compared { irradiance, difference, usual } = past.compared(g, guides, irradiance, config.firefly_filter);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let confidence = g.change_test(&difference);
    let accumulation = Accumulation { confidence: Some(confidence), ..Accumulation::default() };
    let specular = Specular { difference: Some(difference), ..Specular::default() };
    let estimated = past.estimated(g, guides, config, &irradiance, accumulation, specular);
    let radiance = filtered(g, guides, config, &estimated, spatial);
    let intermediates = Intermediates {
        history: Some(past.history),
        reflection: estimated.reflection(),
        deviation: true,
        confidence: Some(confidence),
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

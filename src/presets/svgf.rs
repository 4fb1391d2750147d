//! Spatiotemporal variance-guided filtering \[SVGF\].

use super::past::Past;
use super::specular::{demodulated, filtered, Specular};
use super::{firefly_filter, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Intermediates, Variance};

/// SVGF: temporal accumulation, variance, à-trous levels of which the first feeds the history back. \[SVGF\] 4.
///
/// It reads `signals`, `sampling`, `levels` and `firefly_filter` of the configuration.
pub fn svgf(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let noisy = noisy(g, config.signals);
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, None, None);
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let past = Past::new(g, config, &irradiance, reflected, Feedback::Filtered);
    let history = past.history;
    let specular = Specular { feedback: Feedback::Filtered, variance: Variance::default(), ..Specular::default() };
    let estimated = past.estimated(g, guides, config, &irradiance, Accumulation::default(), specular);
    let spatial = Atrous { levels: config.levels(), feedback: Some(history), ..Atrous::default() };
    let radiance = filtered(g, guides, config, &estimated, spatial);
    Denoised {
        radiance,
        intermediates: Intermediates {
            history: Some(history),
            reflection: estimated.reflection(),
            deviation: true,
            usual,
            ..Intermediates::new(&noisy)
        },
    }
}

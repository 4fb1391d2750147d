//! Spatiotemporal variance-guided filtering \[SVGF\].

use super::past::{albedo, Past};
use super::specular::{beside, filtered, Specular};
use super::{firefly_filter, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Demodulate, Intermediates, Variance};

/// SVGF: temporal accumulation, variance, à-trous levels of which the first feeds the history back. \[SVGF\] 4.
///
/// It reads `signals`, `sampling`, `levels` and `firefly_filter` of the configuration.
pub fn svgf(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let noisy = noisy(g, config.signals);
    let irradiance =
        g.demodulate(guides, &noisy, Demodulate { albedo: albedo(config), sampling: config.sampling, ..Demodulate::default() });
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let past = Past::new(g, config, &irradiance, Feedback::Filtered);
    let history = past.history;
    let (accumulated, mixed) = past.accumulated(g, guides, &irradiance, Accumulation::default());
    let estimate = g.variance(guides, &accumulated, &history, Variance::default());
    let specular = Specular { feedback: Feedback::Filtered, variance: Variance::default(), ..Specular::default() };
    let specular = beside(g, guides, config, specular);
    let spatial = Atrous { levels: config.levels(), feedback: Some(history), reflection: mixed, ..Atrous::default() };
    let radiance = filtered(g, guides, config, &estimate, spatial, specular);
    Denoised {
        radiance,
        intermediates: Intermediates {
            history: Some(history),
            reflection: specular.map(|specular| specular.reflection).or(mixed),
            deviation: true,
            usual,
            ..Intermediates::new(&noisy)
        },
    }
}

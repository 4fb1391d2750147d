//! The default filter: every part that made pictures better, in one graph.

use super::past::{Compared, Past};
use super::specular::{compared, demodulated, filtered, Specular};
use super::{firefly_filter, gradient_samples, noisy, Denoised};
use crate::config::{Config, GradientSource, Signals};
use crate::graph::{Feedback, Graph, Guides};
use crate::nodes::{Accumulation, Atrous, Estimator, Intermediates, Kernel, LuminanceWeight, Variance};

/// Parameters of [`best_with`]: the parts of [`best`] beyond A-SVGF, one by one.
/// `docs/lab/quality.md` measures the worth of each.
#[derive(Clone, Copy, Debug)]
pub struct Best {
    /// Whether history is scaled by the ratio of light, where the samples around a pixel agree on
    /// it. Default: true.
    pub light_ratio: bool,
    /// Whether the change test of [`super::percentile`] replaces unknown gradients, and overrules
    /// gradients where it is sure that nothing changed. Default: true.
    pub change_test: bool,
    /// Whether the firefly filter runs before the history. Default: true.
    pub firefly_filter: bool,
    /// Source of the history. Default: [`Feedback::Accumulated`].
    pub feedback: Feedback,
    /// Whether history is read by a cubic: [`Accumulation::sharp`], [`super::Specular::sharp`].
    /// Default: true.
    pub sharp: bool,
    /// Default: [`Estimator::OfMean`].
    pub variance: Variance,
    /// Spatial filter; `feedback` sets its own.
    /// Default: the levels of the configuration with 9 taps, and [`LuminanceWeight::OfMeans`].
    pub spatial: Atrous,
}

impl Best {
    /// The defaults, with the levels of a configuration.
    pub fn new(config: &Config) -> Self {
        Self {
            light_ratio: true,
            change_test: true,
            firefly_filter: true,
            feedback: Feedback::Accumulated,
            sharp: true,
            variance: Variance { estimator: Estimator::OfMean, ..Variance::default() },
            spatial: Atrous {
                levels: config.levels(),
                kernel: Kernel::Box,
                luminance_weight: LuminanceWeight::OfMeans,
                ..Atrous::default()
            },
        }
    }
}

/// A-SVGF whose history follows the light instead of being dropped, where the samples around a
/// pixel agree on the change. The history is not filtered and not blurred by motion; a firefly
/// filter runs before it. Where no gradient is known, the change test of [`super::percentile`]
/// replaces it. `docs/lab/quality.md` measures the worth of each part.
///
/// It reads `signals`, `sampling`, `levels`, `gradient_source`, `stratum_size`, `forward_motion` and `surface_id` of the
/// configuration.
pub fn best(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    best_with(g, guides, config, Best::new(config))
}

/// [`best`] with other parts.
pub fn best_with(g: &mut Graph, guides: &Guides, config: &Config, best: Best) -> Denoised {
    let gradients = gradient_samples(g, guides, config);
    let noisy = noisy(g, config.signals);
    let compared = compared(g, &noisy, config);
    let gradient = gradients.map(|source| {
        let gradient = match best.light_ratio {
            true => g.gradient_and_ratio(guides, &compared, source),
            false => g.gradient(guides, &compared, source),
        };
        g.gradient_atrous(guides, &gradient)
    });
    let samples = gradients.and_then(|gradients| gradients.samples());
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, gradient, samples);
    let mut past = Past::new(g, config, &irradiance, reflected, best.feedback);
    let history = past.history;
    let is_known = config.gradient_source == GradientSource::Confidence;
    let (irradiance, difference, usual) = match best.change_test && !is_known {
        true => {
            let Compared { irradiance, difference, usual } = past.compared(g, guides, irradiance, best.firefly_filter);
            (irradiance, Some(difference), usual)
        }
        false => {
            let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, best.firefly_filter);
            (irradiance, None, usual)
        }
    };
    let irradiance = g.fill_holes(guides, &irradiance, config.sampling);
    let reflected = past.reflected.and_then(|reflected| reflected.difference);
    let (confidence, light_ratio) = match (&difference, &gradient) {
        (Some(difference), gradient) => {
            let both = reflected.map(|specular| g.pair(difference, &specular));
            let of_both = both.is_some() || config.signals == Signals::Mixed;
            let (confidence, ratio) = g.tested_confidence(gradient.as_ref(), &both.unwrap_or(*difference), of_both);
            (Some(confidence), ratio)
        }
        (None, Some(gradient)) => (Some(g.history_confidence(gradient, None)), gradient.light_ratio()),
        (None, None) => (is_known.then(|| g.host_confidence()), None),
    };
    let light_ratio = light_ratio.filter(|_| best.light_ratio);
    let accumulation = Accumulation { confidence, sharp: best.sharp, light_ratio, ..Accumulation::default() };
    let Best { variance, feedback, spatial, .. } = best;
    let specular = Specular {
        feedback,
        variance,
        sharp: best.sharp,
        confidence,
        difference: difference.filter(|_| gradient.is_none() && reflected.is_none()),
        gradient: gradient.filter(|_| reflected.is_none()),
        change_test: best.change_test,
        ..Specular::default()
    };
    let estimated = past.estimated(g, guides, config, &irradiance, accumulation, specular);
    let spatial = Atrous { feedback: (feedback == Feedback::Filtered).then_some(history), ..spatial };
    let radiance = filtered(g, guides, config, &estimated, spatial);
    let intermediates = Intermediates {
        history: Some(history),
        reflection: estimated.reflection(),
        deviation: true,
        confidence,
        gradient,
        usual,
        ..Intermediates::new(&noisy)
    };
    Denoised { radiance, intermediates }
}

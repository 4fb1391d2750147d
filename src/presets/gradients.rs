//! The part that presets with temporal gradients share: samples before lighting, and the confidence
//! in each pixel's history after it.

use crate::config::{Config, GradientSource};
use crate::graph::{Confidence, Gradient, Graph, Guides, Radiance};
use crate::nodes::{ForwardProject, Gradients};

/// The source of gradients, by [`Config::gradient_source`]; for
/// [`GradientSource::ForwardProjected`] with the output `gradient_samples`. `None`: your own
/// confidence, or a change test, replaces gradients.
pub fn gradient_samples(g: &mut Graph, guides: &Guides, config: &Config) -> Option<Gradients> {
    let &Config { stratum_size, forward_motion, surface_id, .. } = config;
    match config.gradient_source {
        GradientSource::ForwardProjected => {
            let samples = g.forward_project(guides, ForwardProject { stratum_size, forward_motion, surface_id });
            g.output_samples("gradient_samples", &samples);
            Some(Gradients::ForwardProjected(samples))
        }
        GradientSource::Reshaded => Some(Gradients::Reshaded { stratum_size }),
        GradientSource::Sparse => Some(Gradients::Sparse { stratum_size }),
        GradientSource::Confidence | GradientSource::ChangeTest => None,
    }
}

/// The change of light.
#[derive(Clone, Copy, Debug)]
pub struct ChangeOfLight {
    /// Confidence in the history. `None`: a change test has yet to tell it.
    pub confidence: Option<Confidence>,
    /// The reconstructed gradients; `None`: your own confidence, or a change test, replaces them.
    pub gradient: Option<Gradient>,
}

/// Confidence in the history from the gradients of `noisy`, or your own, by [`Config::gradient_source`].
pub fn change_of_light(
    g: &mut Graph,
    guides: &Guides,
    config: &Config,
    noisy: &Radiance,
    gradients: Option<Gradients>,
) -> ChangeOfLight {
    let Some(source) = gradients else {
        let is_known = config.gradient_source == GradientSource::Confidence;
        return ChangeOfLight { confidence: is_known.then(|| g.host_confidence()), gradient: None };
    };
    let gradient = g.gradient(guides, noisy, source);
    let gradient = g.gradient_atrous(guides, &gradient);
    ChangeOfLight { confidence: Some(g.history_confidence(&gradient, None)), gradient: Some(gradient) }
}

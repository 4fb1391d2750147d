//! The part that presets with temporal gradients share: before lighting the samples, after it the confidence in each pixel's history.

use crate::config::{Config, GradientSource};
use crate::contract::ResourceId;
use crate::nodes::{self, Builder, Frame, Gradients, Guides, Signal, Strata};

/// Passes before lighting. `None`: the host's own confidence takes the place of gradients.
pub(super) fn before_lighting(b: &mut Builder, frame: Frame, guides: Guides, config: &Config) -> Option<Gradients> {
    match config.gradient_source {
        GradientSource::ForwardProjected => {
            let samples = nodes::forward_project(b, frame, guides, strata(config), config);
            Some(Gradients::ForwardProjected(samples))
        }
        GradientSource::Reshaded => Some(Gradients::Reshaded),
        GradientSource::Sparse => Some(Gradients::Sparse),
        GradientSource::Confidence => None,
    }
}

/// Passes after lighting; returns `history_confidence`. `signals`: those whose noisy radiance is compared.
pub(super) fn after_lighting(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    config: &Config,
    gradients: Option<Gradients>,
    signals: &[Signal],
) -> ResourceId {
    let Some(source) = gradients else { return nodes::host_confidence(b, frame) };
    let images = nodes::gradient(b, frame, guides, signals, strata(config), source);
    let reconstructed = nodes::gradient_atrous(b, frame, guides, strata(config), images);
    nodes::adaptive_alpha(b, frame, reconstructed)
}

fn strata(config: &Config) -> Strata {
    Strata { size: config.stratum_size }
}

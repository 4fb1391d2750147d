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

/// How light changed.
pub(super) struct Change {
    /// `history_confidence`.
    pub confidence: ResourceId,
    /// The reconstructed gradients; `None`: the host's own confidence takes their place.
    pub gradient: Option<ResourceId>,
}

/// Passes after lighting. `signals`: those whose noisy radiance is compared.
pub(super) fn after_lighting(
    b: &mut Builder,
    frame: Frame,
    guides: Guides,
    config: &Config,
    gradients: Option<Gradients>,
    signals: &[Signal],
) -> Change {
    let Some(source) = gradients else {
        return Change { confidence: nodes::host_confidence(b, frame), gradient: None };
    };
    let images = nodes::gradient(b, frame, guides, signals, strata(config), source);
    let reconstructed = nodes::gradient_atrous(b, frame, guides, strata(config), images);
    Change { confidence: nodes::adaptive_alpha(b, frame, reconstructed), gradient: Some(reconstructed) }
}

fn strata(config: &Config) -> Strata {
    Strata { size: config.stratum_size }
}

//! Shows the state of each pixel as a picture. It is no stage of a filter, since nothing reads it.
//!
#![doc = include_str!("specification.md")]

mod legend;
pub(crate) mod twin;

use super::{pass, Usual};
use crate::contract::{Input, Lifetime, Phase};
use crate::graph::{Confidence, Display, Gradient, Graph, Guides, History, Port, Radiance, Reflection, VisibilityAccumulated, HDR};
use crate::shaders;
pub use legend::{Ramp, ViewLegend};

/// Images of a graph beside the guides. The views of a missing image are a dark chequer.
#[derive(Clone, Copy, Debug)]
pub struct Intermediates {
    /// Your noisy radiance, one or two signals.
    pub noisy: Radiance,
    /// Whether it is divided by the optional input `albedo`. Default: true.
    pub albedo: bool,
    /// The history that accumulations left.
    pub history: Option<History>,
    /// Whether the colour of the history holds the standard deviation of luminance: a filter wrote it.
    pub deviation: bool,
    /// Confidence in the history.
    pub confidence: Option<Confidence>,
    /// Reconstructed temporal gradients.
    pub gradient: Option<Gradient>,
    /// Reflections in the surfaces.
    pub reflection: Option<Reflection>,
    /// Visibility of a light, blended with its past.
    pub visibility: Option<VisibilityAccumulated>,
    /// The measures of a firefly filter.
    pub usual: Option<Usual>,
}

impl Intermediates {
    /// A filter with nothing but its input.
    pub fn new(noisy: &Radiance) -> Self {
        Self {
            noisy: *noisy,
            albedo: true,
            history: None,
            deviation: false,
            confidence: None,
            gradient: None,
            reflection: None,
            visibility: None,
            usual: None,
        }
    }
}

impl Graph {
    /// A picture of the state of each pixel, one view per frame:
    /// [`crate::FrameParams::debug_view`]. The shown images are kept until then.
    pub fn debug_view(&mut self, guides: &Guides, intermediates: &Intermediates) -> Display {
        let node = self.node("debug_view", "");
        let shown = self.named_image("view", "", HDR, 1, Lifetime::Transient);
        let mut pass = pass(&node, &shaders::DEBUG_VIEW)
            .phase(Phase::PostProcess)
            .view()
            .bind("guide", guides.guide)
            .bind("surface_motion", guides.surface_motion)
            .each("noisy", intermediates.noisy.images())
            .bind("debug_view", shown)
            .bind_some("history_confidence", intermediates.confidence.map(|confidence| confidence.image()))
            .bind_some("reflection", intermediates.reflection.map(|reflection| reflection.image))
            .bind_some("specular_hit_id", self.given(Input::SPECULAR_HIT_ID))
            .bind_some("specular_motion", self.given(Input::SPECULAR_MOTION))
            .bind_some("surface_id", self.given(Input::SURFACE_ID))
            .bind_some("instance_transforms", self.given(Input::INSTANCE_TRANSFORMS))
            .bind_some("visibility_history", intermediates.visibility.map(|visibility| visibility.image()));
        if intermediates.albedo {
            pass = pass.bind_some("albedo", self.dividing_albedo());
        }
        if let Some(history) = &intermediates.history {
            pass = pass.each("luminance_history", &self.current_luminance_history(history));
            if intermediates.deviation {
                let colour: Vec<_> = history.colour().iter().map(|image| self.refreshed(*image)).collect();
                pass = pass.each("history", &colour);
            }
        }
        if let Some(gradient) = &intermediates.gradient {
            pass = pass.constant("STRATUM_SIZE", gradient.stratum_size).bind("gradient", gradient.image);
        }
        if let Some(Usual { percentiles, limits }) = &intermediates.usual {
            pass = pass.each("block_percentiles", percentiles.images()).each("firefly_limits", limits.images());
        }
        self.add(pass);
        Port::of(self.refreshed(shown))
    }
}

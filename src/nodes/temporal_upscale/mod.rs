//! Jittered frames, gathered at the size of the output. \[Karis 2014\]
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, UNREAD};
use crate::contract::{Grid, Input, Lifetime, Phase, TexelGrid};
use crate::graph::{Graph, Guides, Port, Radiance, Value, HDR, PACKED_64, WIDE_HDR};
use crate::shaders;

/// Parameters of the node `temporal_upscale`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TemporalUpscale {
    /// Whether the node `tone_map` follows. Edges of lamps are then as smooth as a display shows them. Default: false.
    pub tone_mapped: bool,
}

impl Graph {
    /// Radiance at the size of the output, of the sum of one or two radiances: of surfaces, and of a volume before them. Without
    /// an output extent it is temporal anti-aliasing. It has the format of the first radiance.
    pub fn temporal_upscale(&mut self, guides: &Guides, radiance: &Radiance, upscale: TemporalUpscale) -> Radiance {
        let node = self.node("temporal_upscale", "");
        let (module, format) = match self.format_of(radiance.image()) == Some(WIDE_HDR) {
            true => (&shaders::TEMPORAL_UPSCALE_FLOAT_1, WIDE_HDR),
            false => (&shaders::TEMPORAL_UPSCALE_FLOAT_0, HDR),
        };
        let history = self.named_image("upscale_history", "", PACKED_64, TexelGrid::Output, Lifetime::History);
        let upscaled = self.named_image("upscaled_radiance", "", format, TexelGrid::Output, Lifetime::Transient);
        let value = if upscale.tone_mapped { Value::Own } else { UNREAD };
        let pass = pass(&node, module)
            .phase(Phase::PostProcess)
            .constant("SHOWN", upscale.tone_mapped.into())
            .value("exposure", value)
            .grid(Grid::Output)
            .each("radiance", radiance.images())
            .bind_some("albedo", self.given(Input::ALBEDO))
            .bind("guide", guides.rendered.guide)
            .bind("surface_motion", guides.rendered.surface_motion)
            .previous("previous_history", history)
            .bind("upscale_history", history)
            .bind("upscaled_radiance", upscaled);
        self.add(pass);
        Port::of(self.refreshed(upscaled))
    }
}

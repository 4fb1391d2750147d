//! Jittered frames, gathered at the size of the output. \[Karis 2014\]
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, UNREAD};
use crate::contract::{Grid, Input, Lifetime, Phase, TexelGrid};
use crate::graph::{Graph, Guides, Port, Radiance, Rendered, Value, HDR, PACKED_64, WIDE_HDR};
use crate::shaders;

/// Pixels of the output that an invocation has, one below the other: they have most of their samples in common.
const COLUMN: u32 = 2;

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
        let format = self.format_of(radiance.image()).filter(|format| *format == WIDE_HDR).unwrap_or(HDR);
        let module = match guides.rendered {
            Rendered::Stored => [&shaders::TEMPORAL_UPSCALE_FLOAT_0, &shaders::TEMPORAL_UPSCALE_FLOAT_1],
            Rendered::Host { surface_id: false, .. } => {
                [&shaders::TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_0, &shaders::TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_0]
            }
            Rendered::Host { surface_id: true, .. } => {
                [&shaders::TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_1, &shaders::TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_1]
            }
        }[usize::from(format == WIDE_HDR)];
        let history = self.named_image("upscale_history", "", PACKED_64, TexelGrid::Output, Lifetime::History);
        let upscaled = self.named_image("upscaled_radiance", "", format, TexelGrid::Output, Lifetime::Transient);
        let value = if upscale.tone_mapped { Value::Own } else { UNREAD };
        let rendered = self.rendered_inputs(guides);
        let mut pass = pass(&node, module)
            .phase(Phase::PostProcess)
            .constant("SHOWN", upscale.tone_mapped.into())
            .value("exposure", value)
            .grid(Grid::Output(COLUMN))
            .each("radiance", radiance.images())
            .bind_some("albedo", self.given(Input::ALBEDO))
            .previous("previous_upscale_history", history)
            .bind("upscale_history", history)
            .bind("upscaled_radiance", upscaled);
        pass = match guides.rendered {
            Rendered::Stored => pass.bind("guide", guides.guide).bind("surface_motion", guides.surface_motion),
            Rendered::Host { .. } => pass
                .bind("motion", self.input(Input::MOTION))
                .bind("instance_transforms", self.input(Input::INSTANCE_TRANSFORMS))
                .bind_some("depth", rendered.depth)
                .bind_some("surface_id", rendered.surface_id),
        };
        self.add(pass);
        Port::of(self.refreshed(upscaled))
    }
}

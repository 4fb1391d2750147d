//! HDR radiance to display-referred linear values.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Lifetime, Phase, TexelGrid};
use crate::graph::{Display, Graph, Port, Radiance, HDR};
use crate::shaders;

impl Graph {
    /// Tone-mapped sum of one or two radiances: of surfaces, and of a volume before them.
    pub fn tone_map(&mut self, denoised: &Radiance) -> Display {
        let node = self.node("tone_map", "");
        let texels = self.texels_of(denoised.image()).unwrap_or(TexelGrid::Rendered(1));
        let tone_mapped = self.named_image("tone_mapped", "", HDR, texels, Lifetime::Transient);
        let is_output = texels == TexelGrid::Output;
        let pass = pass(&node, &shaders::TONE_MAP)
            .phase(Phase::PostProcess)
            .grid(if is_output { Grid::Output(1) } else { Grid::Guides })
            .constant("OUTPUT", is_output.into())
            .each("radiance", denoised.images())
            .bind("tone_mapped", tone_mapped);
        self.add(pass);
        Port::of(self.refreshed(tone_mapped))
    }
}

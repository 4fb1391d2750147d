//! HDR radiance to display-referred linear values.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Lifetime, Phase};
use crate::graph::{Display, Graph, Port, Radiance, HDR};
use crate::shaders;

impl Graph {
    /// Tone-mapped sum of one or two radiances: of surfaces, and of a volume before them.
    pub fn tone_map(&mut self, denoised: &Radiance) -> Display {
        let node = self.node("tone_map", "");
        let tone_mapped = self.named_image("tone_mapped", "", HDR, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::TONE_MAP)
            .phase(Phase::PostProcess)
            .each("radiance", denoised.images())
            .bind("tone_mapped", tone_mapped);
        self.add(pass);
        Port::of(self.refreshed(tone_mapped))
    }
}

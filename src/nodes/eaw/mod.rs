//! The edge-avoiding à-trous wavelet transform by radiance, normal and position. \[EAW\].
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::atrous::Levels;
use super::by_signals;
use super::pass;
use crate::config::{EawWeights, Sampling};
use crate::graph::{Graph, Guides, History, Irradiance};
use crate::shaders;

/// Parameters of the node `eaw`.
#[derive(Clone, Copy, Debug)]
pub struct Eaw {
    /// Levels, 1 to 10. Default: 5.
    pub levels: u32,
    /// Edge-stopping functions. Default: all three.
    pub weights: EawWeights,
    /// Share of the pixels that have a sample, as for the node `demodulate`: the first levels fill
    /// the holes. Default: all of them.
    pub sampling: Sampling,
    /// The history that the first level writes: one with [`crate::graph::Feedback::Filtered`]. Default: none.
    pub feedback: Option<History>,
}

impl Default for Eaw {
    fn default() -> Self {
        Self { levels: 5, weights: EawWeights::default(), sampling: Sampling::Full, feedback: None }
    }
}

impl Graph {
    /// Filters one or two signals level by level, each from the image of the level before it.
    pub fn eaw(&mut self, guides: &Guides, irradiance: &Irradiance, eaw: Eaw) -> Irradiance {
        let node = self.node("eaw", &self.label_of(irradiance));
        let module = by_signals(irradiance, &shaders::EAW_SIGNALS_1, &shaders::EAW_SIGNALS_2);
        let levels = Levels { node: &node, count: eaw.levels, feedback: eaw.feedback };
        self.levels(levels, irradiance, |name, level| {
            pass(&node, module)
                .named(name)
                .level(level)
                .constant("RADIANCE", u32::from(eaw.weights.radiance))
                .constant("NORMAL", u32::from(eaw.weights.normal))
                .constant("POSITION", u32::from(eaw.weights.position))
                .constant("SAMPLING", eaw.sampling as u32)
                .bind("guide", guides.guide)
        })
    }
}

//! Chooses the exposure of the filter, so that half floats hold light in whatever unit the host counts.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::config::Config;
use crate::contract::{Grid, Lifetime};
use crate::graph::{Graph, Radiance, PACKED_32};
use crate::shaders;

impl Graph {
    /// A power of 2 by which the stages behind it multiply light where it comes in, and divide it where it goes out: the one that brings
    /// the mean of log2 of the luminance of what is given here near 0. It stays while that mean is between −10 and 6, so that pictures
    /// whose light is around 1 are left as they are. Up to three images; once in a graph, before the first stage that reads light.
    pub fn filter_exposure(&mut self, noisy: &[Radiance]) {
        let node = self.node("filter_exposure", "");
        let images: Vec<_> = noisy.iter().flat_map(|port| port.images().to_vec()).collect();
        if !(1..=3).contains(&images.len()) {
            let given = images.len();
            return self.fail(
                &node,
                "noisy",
                format!("{given} images were given; give one to three, those that are the brightest"),
            );
        }
        // One texel: no picture is larger.
        let exposure = self.named_image("filter_exposure", "", PACKED_32, Config::MAX_SIDE, Lifetime::Transient);
        let pass = pass(&node, &shaders::FILTER_EXPOSURE)
            .grid(Grid::Strata(Config::MAX_SIDE))
            .previous("previous_exposure", exposure)
            .bind("exposure", exposure)
            .each("noisy", &images);
        self.add(pass);
    }
}

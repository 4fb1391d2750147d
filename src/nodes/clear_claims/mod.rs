//! Takes back the claims of the previous frame.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::pass;
use crate::contract::{Grid, Phase};
use crate::graph::{Graph, Image};
use crate::shaders;

impl Graph {
    /// Sets a claim of each stratum to none: the first pass of a node.
    pub(crate) fn clear_claims(&mut self, node: &str, phase: Phase, claims: Image, stratum_size: u32) {
        let pass = pass(node, &shaders::CLEAR_CLAIMS)
            .named(format!("{node}_clear"))
            .phase(phase)
            .grid(Grid::Strata(stratum_size))
            .constant("STRATUM_SIZE", stratum_size)
            .bind("claims", claims);
        self.add(pass);
    }
}

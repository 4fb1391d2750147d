//! Measures the departure of a frame from its own history, block by block.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::Grid;
use crate::graph::{Difference, Graph, Guides, History, Irradiance, Pass, PACKED_128};
use crate::shaders;

impl Graph {
    /// Mean difference from the history with its standard error, one pass and one image for every signal.
    pub fn block_difference(&mut self, guides: &Guides, irradiance: &Irradiance, history: &History) -> Difference {
        let difference: Difference = self.image_each(irradiance, "block_difference", PACKED_128, BLOCK_SIZE);
        for (i, (input, output)) in irradiance.images().iter().zip(difference.images()).enumerate() {
            let label = self.label(*input).to_owned();
            let node = self.node("block_difference", &label);
            if i >= history.colour().len() {
                self.fail(
                    &node,
                    "history",
                    "the history has fewer signals than the irradiance; make it of the same port".to_owned(),
                );
                continue;
            }
            let pass = pass(&node, &shaders::BLOCK_DIFFERENCE)
                .grid(Grid::Columns(BLOCK_SIZE))
                .bind("guide", guides.guide)
                .bind("irradiance", *input);
            self.add(compared(pass, guides, history, i).bind("block_difference", *output));
        }
        self.renewed(&difference)
    }
}

/// What a pass that compares signal `i` with its history reads of the past.
pub(super) fn compared(pass: Pass, guides: &Guides, history: &History, i: usize) -> Pass {
    pass.previous("previous_guide", guides.guide)
        .bind("surface_motion", guides.surface_motion)
        .previous("history", history.colour()[i])
        .previous("previous_luminance_history", history.luminance_history()[i])
}

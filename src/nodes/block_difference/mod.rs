//! Measures the departure of a frame from its own history, block by block.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::Grid;
use crate::graph::{Difference, Graph, Guides, History, Irradiance, PACKED_64};
use crate::shaders;

impl Graph {
    /// Mean difference from the history with its standard error, one pass and one image for every signal.
    pub fn block_difference(&mut self, guides: &Guides, irradiance: &Irradiance, history: &History) -> Difference {
        let difference: Difference = self.image_each(irradiance, "block_difference", PACKED_64, BLOCK_SIZE);
        for (i, (input, output)) in irradiance.images().iter().zip(difference.images()).enumerate() {
            let label = self.label(*input).to_owned();
            let node = self.node("block_difference", &label);
            let (Some(colour), Some(luminance_history)) = (history.colour().get(i), history.luminance_history().get(i)) else {
                self.fail(
                    &node,
                    "history",
                    "the history has fewer signals than the irradiance; make it of the same port".to_owned(),
                );
                continue;
            };
            let pass = pass(&node, &shaders::BLOCK_DIFFERENCE)
                .grid(Grid::Columns(BLOCK_SIZE))
                .bind("guide", guides.guide)
                .previous("previous_guide", guides.guide)
                .bind("surface_motion", guides.surface_motion)
                .bind("depth_gradient", guides.depth_gradient)
                .bind("irradiance", *input)
                .previous("history", *colour)
                .previous("previous_luminance_history", *luminance_history)
                .bind("block_difference", *output);
            self.add(pass);
        }
        self.renewed(&difference)
    }
}

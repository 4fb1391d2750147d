//! Turns the departure of blocks into confidence in the history of each pixel: a test in both directions.

pub(crate) mod twin;

use super::BLOCK_SIZE;
use crate::contract::{Grid, Lifetime};
use crate::graph::{Confidence, Difference, Graph, Pass, Port, CONFIDENCE};
use crate::shaders;

impl Graph {
    /// Confidence in the history, which falls where a mean over 24×24 pixels departs by more than its standard error explains.
    pub fn change_test(&mut self, difference: &Difference) -> Confidence {
        let label = self.label_of(difference);
        let node = self.node("change_test", &label);
        let confidence = self.named_image("history_confidence", &label, CONFIDENCE, 1, Lifetime::Transient);
        let pass = Pass::new(&node, &shaders::CHANGE_TEST)
            .grid(Grid::Columns(BLOCK_SIZE))
            .bind("history_confidence", confidence)
            .each("block_difference", difference.images());
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }
}

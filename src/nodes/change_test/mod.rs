//! Turns the departure of blocks into confidence in the history of each pixel: a test in both directions.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::{Grid, Lifetime};
use crate::graph::{Confidence, Difference, Graph, Image, Port, Steadiness, CONFIDENCE};
use crate::shaders;

/// Result of the change test of a history, for [`Graph::history_confidence`].
#[derive(Clone, Copy, Debug)]
pub struct ChangeTest {
    /// Confidence in the history.
    pub confidence: Confidence,
    /// Certainty of no change, block by block: there a gradient is noise. Below 0, certainty of a change, which a gradient may miss.
    pub steadiness: Option<Steadiness>,
}

impl From<Confidence> for ChangeTest {
    fn from(confidence: Confidence) -> Self {
        Self { confidence, steadiness: None }
    }
}

impl Graph {
    /// Confidence in the history, which falls where a mean over 24×24 pixels departs by more than its standard error explains.
    pub fn change_test(&mut self, difference: &Difference) -> Confidence {
        self.add_change_test(difference, None, false)
    }

    /// [`Self::change_test`], and in the same pass the certainty that nothing changed, from 1 to −1: neither that
    /// mean nor one of its nine blocks departs by more than noise, or they do for sure.
    pub fn change_and_steadiness(&mut self, difference: &Difference) -> ChangeTest {
        let label = self.label_of(difference);
        let steadiness = self.named_image("steadiness", &label, CONFIDENCE, BLOCK_SIZE, Lifetime::Transient);
        let confidence = self.add_change_test(difference, Some(steadiness), false);
        ChangeTest { confidence, steadiness: Some(Port::of(self.refreshed(steadiness))) }
    }

    /// `of_both`: both signals have a confidence of their own, in one number.
    pub(super) fn add_change_test(&mut self, difference: &Difference, steadiness: Option<Image>, of_both: bool) -> Confidence {
        let label = self.label_of(difference);
        let node = self.node("change_test", &label);
        let confidence = self.named_image("history_confidence", &label, CONFIDENCE, 1, Lifetime::Transient);
        let pass = pass(&node, &shaders::CHANGE_TEST)
            .grid(Grid::Columns(BLOCK_SIZE))
            .constant("BOTH", of_both.into())
            .bind("history_confidence", confidence)
            .each("block_difference", difference.images())
            .bind_some("steadiness", steadiness);
        self.add(pass);
        Port::of(self.refreshed(confidence))
    }
}

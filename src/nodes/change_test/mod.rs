//! Turns the departure of blocks into confidence in the history of each pixel: a test in both directions.
//!
#![doc = include_str!("specification.md")]

pub(crate) mod twin;

use super::{pass, BLOCK_SIZE};
use crate::contract::{Grid, Lifetime};
use crate::graph::{Confidence, Difference, Graph, LightRatio, Pass, Port, Steadiness, CONFIDENCE, HDR};
use crate::shaders::{self, Shader};

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
        let pass = self.testing(&shaders::CHANGE_TEST_RATIO_0, difference);
        self.confidence_of(pass, difference)
    }

    /// [`Self::change_test`], and in the same pass the certainty that nothing changed, from 1 to −1: neither that
    /// mean nor one of its nine blocks departs by more than noise, or they do for sure.
    pub fn change_and_steadiness(&mut self, difference: &Difference) -> ChangeTest {
        let label = self.label_of(difference);
        let steadiness = self.named_image("steadiness", &label, CONFIDENCE, BLOCK_SIZE, Lifetime::Transient);
        let pass = self.testing(&shaders::CHANGE_TEST_RATIO_0, difference).bind("steadiness", steadiness);
        let confidence = self.confidence_of(pass, difference);
        ChangeTest { confidence, steadiness: Some(Port::of(self.refreshed(steadiness))) }
    }

    /// [`Self::change_test`], and by how much the light of each component changed, block by block. `of_both`: both signals have a confidence
    /// of their own, in one number, and the ratio is that of the first.
    pub(super) fn change_and_ratio(&mut self, difference: &Difference, of_both: bool) -> (Confidence, LightRatio) {
        let label = self.label_of(difference);
        let ratio = self.named_image("light_ratio", &label, HDR, BLOCK_SIZE, Lifetime::Transient);
        let pass =
            self.testing(&shaders::CHANGE_TEST_RATIO_1, difference).constant("BOTH", of_both.into()).bind("light_ratio", ratio);
        (self.confidence_of(pass, difference), LightRatio { image: self.refreshed(ratio), stratum_size: BLOCK_SIZE })
    }

    fn testing(&mut self, shader: &'static Shader, difference: &Difference) -> Pass {
        let node = self.node("change_test", &self.label_of(difference));
        pass(&node, shader).grid(Grid::Columns(BLOCK_SIZE)).each("block_difference", difference.images())
    }

    fn confidence_of(&mut self, pass: Pass, difference: &Difference) -> Confidence {
        let label = self.label_of(difference);
        let confidence = self.named_image("history_confidence", &label, CONFIDENCE, 1, Lifetime::Transient);
        self.add(pass.bind("history_confidence", confidence));
        Port::of(self.refreshed(confidence))
    }
}

//! The test of z of the motion, where it is declared to be something.

use crate::contest::{explained, Residuals, Rule, Votes};
use crate::report::{Finding, Measure, Verdict};
use crate::trial::{Contest, Trial};
use atrous::config::{Conventions, MotionDepth};

/// Percent of the depth.
const MOTION_DEPTH: Rule = Rule { explains: 0.3, margin: 0.3 };

/// One way to read it, and whether with the opposite sign.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reading {
    kind: MotionDepth,
    negated: bool,
}

impl Reading {
    fn previous_depth(self, z: f32, texel: f32) -> f32 {
        let texel = if self.negated { -texel } else { texel };
        match self.kind {
            MotionDepth::Difference => z + texel,
            MotionDepth::Absolute => texel,
            MotionDepth::None => f32::NAN,
        }
    }

    fn changes(self) -> (Vec<String>, Vec<String>) {
        let what = match self.kind {
            MotionDepth::Absolute => "z of the motion is the previous depth",
            _ => "z of the motion is a difference of depths",
        };
        let mut remedies = vec![format!("motion_depth: {}", self.kind)];
        if !self.negated {
            return (vec![what.to_owned()], remedies);
        }
        remedies.push("no field says this: negate z where the motion is written".to_owned());
        (vec![format!("{what}, with the opposite sign")], remedies)
    }
}

impl Trial<'_> {
    /// Whether z of the motion is as declared, given this geometry; and its meaning.
    pub fn motion_depth_finding(&self, declared: &Conventions) -> (Finding, MotionDepth) {
        let kind = declared.motion_depth;
        if kind == MotionDepth::None || !self.scene.has_motion() {
            return (Finding::new(Verdict::Absent, ""), kind);
        }
        let other = if kind == MotionDepth::Difference { MotionDepth::Absolute } else { MotionDepth::Difference };
        let readings =
            [(kind, false), (other, false), (kind, true), (other, true)].map(|(kind, negated)| Reading { kind, negated });
        let residuals = readings.map(|reading| self.motion_depth_residuals(reading));
        let pairwise = |a: usize, b: usize| Votes::of(MOTION_DEPTH, &residuals[a], &residuals[b]);
        let contest = Contest::new(readings.len(), self.pair.pixels.len(), pairwise);
        let mut finding = contest.finding(Measure::MotionDepth, |i| readings[i].changes(), |_| true, |_| true);
        if finding.verdict != Verdict::Mistake && explained(MOTION_DEPTH, &residuals[0]).is_some_and(|part| part < 0.5) {
            finding = Finding::new(Verdict::Unexplained, "z of the motion is neither the previous depth nor a difference");
        } else if finding.verdict == Verdict::Inconclusive {
            finding = self.nothing_tells();
        }
        if finding.evidence.is_empty() {
            finding.evidence.push(self.agreement(Measure::MotionDepth, &residuals[0]));
        }
        (finding, readings[contest.champion].kind)
    }

    fn motion_depth_residuals(&self, reading: Reading) -> Residuals {
        let residual = |(p, point): (&glam::IVec2, &super::evidence::Point)| match self.scene.motion_depth_texel(*p) {
            Some(texel) => {
                let [z, expected] = point.depths;
                (reading.previous_depth(z, texel) - expected).abs() / expected * 100.0
            }
            None => f32::NAN,
        };
        self.pair.pixels.iter().zip(&self.points).map(residual).collect()
    }
}

//! Comparison of two hypotheses by the pixels that each explains.
//!
//! A pixel votes for the hypothesis that explains it where the other one does not. So neither the scale of a residual nor the
//! pixels that no hypothesis explains (things that move by themselves, disocclusions, values that are not finite) decide anything,
//! as long as they are the fewer.

/// The residual up to which a pixel counts as explained, and the factor by which that of the other hypothesis must be larger.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    pub explains: f32,
    pub margin: f32,
}

/// Depth reprojected into the previous frame, in pixels: the cell of four depths that is interpolated is one pixel large.
pub(super) const DEPTH: Rule = Rule { explains: 0.35, margin: 0.25 };
/// Motion, in pixels: what it takes for two frames to look different.
pub(super) const MOTION: Rule = Rule { explains: 0.1, margin: 0.1 };
/// Normals against those of the depth, in degrees: shading normals lean, and depth is noisy.
pub(super) const NORMALS: Rule = Rule { explains: 20.0, margin: 10.0 };

/// The part of the votes that decides.
const CLEAR: f32 = 0.8;
/// Fewer votes than this part of the pixels say nothing, and fewer than this number neither.
const LEAST_PART: f32 = 0.005;
pub(super) const LEAST: usize = 24;

/// Residuals of the pixels that were looked at: infinite where the pixel contradicts, NaN where it says nothing.
pub(super) type Residuals = Vec<f32>;

/// The votes of one measure, with the residuals of the pixels that voted.
#[derive(Clone, Debug, Default)]
pub(super) struct Votes {
    pub for_first: usize,
    pub for_second: usize,
    voters: Vec<(f32, f32)>,
}

impl Votes {
    pub fn count(&mut self, rule: Rule, first: f32, second: f32) {
        let wins = |winner: f32, loser: f32| winner <= rule.explains && loser > 2.0 * winner && loser - winner > rule.margin;
        let (a, b) = (wins(first, second), wins(second, first));
        self.for_first += usize::from(a);
        self.for_second += usize::from(b);
        if a || b {
            self.voters.push((first, second));
        }
    }

    pub fn of(rule: Rule, first: &[f32], second: &[f32]) -> Self {
        let mut votes = Self::default();
        first.iter().zip(second).for_each(|(a, b)| votes.count(rule, *a, *b));
        votes
    }

    pub fn voters(&self) -> usize {
        self.voters.len()
    }

    /// Medians of the residuals of the voters under both hypotheses.
    pub fn medians(&self) -> (f32, f32) {
        (median(self.voters.iter().map(|v| v.0)), median(self.voters.iter().map(|v| v.1)))
    }
}

/// The result of a contest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    First,
    Second,
    /// Too few pixels see a difference.
    Undecided,
}

/// Judges the sum of votes among `pixels`.
pub(super) fn judge(for_first: usize, for_second: usize, pixels: usize) -> Outcome {
    let total = for_first + for_second;
    if total < LEAST.max((pixels as f32 * LEAST_PART) as usize) {
        Outcome::Undecided
    } else if for_first as f32 >= CLEAR * total as f32 {
        Outcome::First
    } else if for_second as f32 >= CLEAR * total as f32 {
        Outcome::Second
    } else {
        Outcome::Undecided
    }
}

/// The median of what is not NaN; NaN of nothing.
pub(super) fn median(values: impl Iterator<Item = f32>) -> f32 {
    let mut values: Vec<f32> = values.filter(|v| !v.is_nan()).collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f32::NAN)
}

/// The part of the pixels with a residual that it explains; `None` where they are too few.
pub(super) fn explained(rule: Rule, residuals: &[f32]) -> Option<f32> {
    let (mut all, mut explained) = (0, 0);
    for r in residuals.iter().filter(|r| !r.is_nan()) {
        all += 1;
        explained += usize::from(*r <= rule.explains);
    }
    (all >= LEAST).then(|| explained as f32 / all as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: f32 = f32::NAN;

    #[test]
    fn a_pixel_votes_for_what_explains_it_where_the_other_does_not() {
        let rule = Rule { explains: 1.0, margin: 0.5 };
        for (first, second, votes) in [
            (0.0, 5.0, (1, 0)),
            (5.0, 0.0, (0, 1)),
            (0.2, f32::INFINITY, (1, 0)),
            (0.4, 0.7, (0, 0)),
            (0.0, 0.5, (0, 0)),
            (5.0, 1.5, (0, 0)),
            (NONE, 0.0, (0, 0)),
            (0.0, NONE, (0, 0)),
            (f32::INFINITY, f32::INFINITY, (0, 0)),
        ] {
            let counted = Votes::of(rule, &[first], &[second]);
            assert_eq!((counted.for_first, counted.for_second), votes, "{first}, {second}");
            assert_eq!(counted.voters(), votes.0 + votes.1);
        }
        let votes = Votes::of(rule, &[0.0, 0.1, 0.2, 9.0], &[4.0, 5.0, 6.0, 9.0]);
        assert_eq!(votes.medians(), (0.1, 5.0));
    }

    #[test]
    fn four_of_five_votes_decide() {
        for (first, second, pixels, outcome) in [
            (80, 20, 1000, Outcome::First),
            (20, 80, 1000, Outcome::Second),
            (79, 21, 1000, Outcome::Undecided),
            (21, 79, 1000, Outcome::Undecided),
            (0, LEAST, 1000, Outcome::Second),
            (0, LEAST - 1, 1000, Outcome::Undecided),
            (0, 49, 10_000, Outcome::Undecided),
            (0, 50, 10_000, Outcome::Second),
            (0, 0, 0, Outcome::Undecided),
        ] {
            assert_eq!(judge(first, second, pixels), outcome, "{first}, {second} of {pixels}");
        }
    }

    #[test]
    fn what_is_not_a_number_is_no_evidence() {
        assert_eq!(median([3.0, NONE, 1.0, 2.0].into_iter()), 2.0);
        assert!(median([NONE].into_iter()).is_nan());
        let rule = Rule { explains: 1.0, margin: 0.5 };
        let residuals = [[0.5; 30].as_slice(), &[2.0; 10], &[NONE; 60]].concat();
        assert_eq!(explained(rule, &residuals), Some(0.75));
        assert_eq!(explained(rule, &[0.5; 5]), None);
    }
}

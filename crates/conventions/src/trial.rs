//! One geometry tested on two frames, and the consequences for motion and normals.

use crate::contest::{self, explained, judge, median, Outcome, Residuals, Rule, Votes, DEPTH, MOTION, NORMALS};
use crate::evidence::{Affine, Pair, Point, Scene};
use crate::geometry::Geometry;
use crate::readings::{MotionReading, NormalReading};
use crate::report::{Evidence, Finding, Measure, Verdict};
use atrous::config::Conventions;
use atrous::Error;

/// Motion below this many pixels is not called motion.
const MOVES: f32 = 0.25;

/// The part of the moving pixels that a constant factor has to explain, up to this share of their motion.
const SCALED: f32 = 0.8;
const SCALED_SLACK: f32 = 0.02;

/// Four digits.
fn rounded(v: f32) -> f32 {
    let unit = 10.0_f32.powf(3.0 - v.abs().log10().floor());
    if unit.is_finite() {
        (v * unit).round() / unit
    } else {
        v
    }
}

/// A geometry with its residuals. Those of motion and normals are by the readings that fit best, so that a mistake there is not
/// blamed on it.
pub(super) struct Trial<'a> {
    pub geometry: Geometry,
    pub(super) scene: Scene<'a>,
    pub(super) pair: &'a Pair<'a>,
    pub(super) points: Vec<Point>,
    depth: Residuals,
    motion: Residuals,
    normals: Residuals,
}

impl<'a> Trial<'a> {
    /// # Errors
    /// Names the field of the parameters that is unusable.
    pub fn new(geometry: Geometry, pair: &'a Pair<'a>) -> Result<Self, Error> {
        let scene = Scene::new(&geometry, pair)?;
        let points: Vec<_> = pair.pixels.iter().map(|p| scene.point(*p)).collect();
        let depth = points.iter().map(|p| p.depth).collect();
        let motions = MotionReading::declared(&geometry.conventions).all();
        let motion = best(MOTION, motions.into_iter().map(|m| scene.motion_residuals(m, &points)));
        let normals = NormalReading::declared(&geometry.conventions).all();
        let normals = best(NORMALS, normals.into_iter().map(|n| scene.normal_residuals(n, &points)));
        Ok(Self { geometry, scene, pair, points, depth, motion, normals })
    }

    fn measures(&self) -> [(Measure, Rule, &Residuals); 3] {
        [(Measure::Depth, DEPTH, &self.depth), (Measure::Motion, MOTION, &self.motion), (Measure::Normals, NORMALS, &self.normals)]
    }

    /// The votes of each measure between this geometry and a different one. If the camera stands still, a place in the previous
    /// frame tells nothing, unless it lies behind the camera.
    fn votes(&self, other: &Self) -> [(Measure, Votes); 3] {
        let others = other.measures();
        let mut i = 0;
        self.measures().map(|(measure, rule, residuals)| {
            let is_place = measure != Measure::Normals && self.pair.camera_stands;
            let is_behind = |n: usize| [self, other].iter().any(|trial| trial.points[n].motion.x.is_infinite());
            let mut votes = Votes::default();
            for (n, (a, b)) in residuals.iter().zip(others[i].2).enumerate() {
                if !is_place || is_behind(n) {
                    votes.count(rule, *a, *b);
                }
            }
            i += 1;
            (measure, votes)
        })
    }

    fn against(&self, other: &Self) -> Outcome {
        let votes = self.votes(other);
        let sum = |f: fn(&Votes) -> usize| votes.iter().map(|(_, v)| f(v)).sum();
        match judge(sum(|v| v.for_first), sum(|v| v.for_second), self.pair.pixels.len()) {
            // What happens to fit where this one is silent, and nothing else, does not fit.
            Outcome::Second if other.explains() <= self.explains() => Outcome::Undecided,
            outcome => outcome,
        }
    }

    /// Residuals that are explained.
    fn explains(&self) -> usize {
        self.measures().into_iter().map(|(_, rule, residuals)| residuals.iter().filter(|r| **r <= rule.explains).count()).sum()
    }

    fn surfaces(&self) -> usize {
        self.points.iter().filter(|p| !p.motion.is_nan()).count()
    }

    fn median_motion(&self) -> f32 {
        median(self.points.iter().map(|p| p.motion.length()))
    }

    pub(super) fn agreement(&self, measure: Measure, residuals: &[f32]) -> Evidence {
        let declared = median(residuals.iter().copied());
        Evidence { measure, declared, fitting: None, pixels: residuals.iter().filter(|r| !r.is_nan()).count() }
    }

    /// The finding for frames that show nothing, with the reason.
    pub(super) fn nothing_tells(&self) -> Finding {
        let (surfaces, pixels, motion) = (self.surfaces(), self.pair.pixels.len(), self.median_motion());
        let why = if surfaces < contest::LEAST {
            format!("{surfaces} of {pixels} pixels are surfaces; check depth, background_depth and surface_id")
        } else if motion < MOVES || self.pair.camera_stands {
            format!(
                "nothing moves: by depth and matrices, pixels move by {motion:.2}; give two frames between which the camera moves"
            )
        } else {
            "too few pixels see a difference; give two frames between which the camera moves and turns, with slanted surfaces"
                .to_owned()
        };
        Finding::new(Verdict::Inconclusive, why)
    }

    /// Whether the motion is as declared, given this geometry; and how to read it.
    pub fn motion_finding(&self, declared: &Conventions) -> (Finding, MotionReading) {
        let declared = MotionReading::declared(declared);
        if !self.scene.has_motion() {
            return (Finding::new(Verdict::Absent, ""), declared);
        }
        let candidates: Vec<_> =
            declared.all().into_iter().map(|m| (m, self.scene.affine(m), self.scene.motion_residuals(m, &self.points))).collect();
        let pairwise = |a: usize, b: usize| self.motion_votes(&candidates[a], &candidates[b]);
        let contest = Contest::new(candidates.len(), self.pair.pixels.len(), pairwise);
        let name = |i: usize| declared.changes(candidates[i].0);
        let is_single = |i: usize| declared.differences(candidates[i].0) == 1 && candidates[i].1 != candidates[0].1;
        let moving: Residuals =
            self.points.iter().zip(&candidates[0].2).filter(|(p, _)| p.motion.length() > MOVES).map(|(_, r)| *r).collect();
        // Jitter alone says nothing of sign and unit.
        let is_sign = |i: usize| candidates[i].0 == declared.negated();
        let mut finding = contest.finding(Measure::Motion, name, is_single, is_sign);
        if finding.verdict != Verdict::Mistake && explained(MOTION, &moving).is_some_and(|part| part < 0.5) {
            let is_zero = self.pair.pixels.iter().all(|p| self.scene.motion_texel(*p).is_none_or(|m| m == glam::Vec2::ZERO));
            let what = if is_zero { "the motion is 0 everywhere, though the camera moves" } else { "no unit, sign or axis fits" };
            finding = Finding::new(Verdict::Unexplained, what);
            if let Some((reading, factor)) = self.motion_factor(declared).filter(|_| !is_zero) {
                return (self.scaled_motion(declared, reading, factor, &moving), reading);
            }
        } else if finding.verdict == Verdict::Inconclusive {
            finding = self.nothing_tells();
        }
        if finding.evidence.is_empty() && !moving.is_empty() {
            finding.evidence.push(self.agreement(Measure::Motion, &moving));
        }
        (finding, candidates[contest.champion].0)
    }

    /// The sign and the axes by which the motion is that of what stands still but for a constant factor,
    /// and that factor: the motion has to be multiplied by it.
    fn motion_factor(&self, declared: MotionReading) -> Option<(MotionReading, f32)> {
        let signs = declared.all().into_iter().filter(|m| m.unit == declared.unit && m.jittered == declared.jittered);
        let fits = signs.filter_map(|reading| {
            let affine = self.scene.affine(reading);
            let zero = affine.read(glam::Vec2::ZERO);
            let read = |p| self.scene.motion_texel(p).map(|texel| affine.read(texel) - zero);
            let pixels = self.pair.pixels.iter().zip(&self.points).filter(|(_, point)| point.motion.length() > MOVES);
            let pairs: Vec<_> = pixels.filter_map(|(p, point)| Some((read(*p)?, point.motion - zero))).collect();
            let ratios = pairs.iter().filter(|(host, _)| host.length() > 0.0);
            let factor = median(ratios.map(|(host, true_motion)| host.dot(*true_motion) / host.length_squared()));
            let slack = |motion: glam::Vec2| MOTION.explains + SCALED_SLACK * motion.length();
            let explained = pairs.iter().filter(|(host, motion)| (*host * factor - *motion).length() <= slack(*motion)).count();
            let is_most = pairs.len() >= contest::LEAST && explained as f32 >= SCALED * pairs.len() as f32;
            (is_most && factor > 0.0 && factor.is_finite()).then_some((reading, factor, explained))
        });
        fits.max_by_key(|(.., explained)| *explained).map(|(reading, factor, _)| (reading, factor))
    }

    fn scaled_motion(&self, declared: MotionReading, reading: MotionReading, factor: f32, moving: &Residuals) -> Finding {
        let (mut mistakes, mut remedies) = declared.changes(reading);
        mistakes.push(format!("the motion is {} times as long as in {}", rounded(1.0 / factor), declared.unit));
        remedies.push(format!("multiply the motion by {}", rounded(factor)));
        Finding {
            remedy: remedies.join("; "),
            factor: Some(rounded(factor)),
            evidence: vec![self.agreement(Measure::Motion, moving)],
            ..Finding::new(Verdict::Mistake, mistakes.join("; "))
        }
    }

    /// Votes of the pixels where the two readings of a host's motion differ.
    fn motion_votes(&self, a: &(MotionReading, Affine, Residuals), b: &(MotionReading, Affine, Residuals)) -> Votes {
        let mut votes = Votes::default();
        for ((point, first), second) in self.points.iter().zip(&a.2).zip(&b.2) {
            let misread = |from: &Affine, to: &Affine| (to.read(from.write(point.motion)) - point.motion).length() > MOTION.margin;
            if misread(&a.1, &b.1) && misread(&b.1, &a.1) {
                votes.count(MOTION, *first, *second);
            }
        }
        votes
    }

    /// The finding for normals.
    pub fn normals_finding(&self, declared: &Conventions) -> (Finding, NormalReading) {
        let declared = NormalReading::declared(declared);
        if !self.scene.has_normals() {
            return (Finding::new(Verdict::Absent, ""), declared);
        }
        let candidates: Vec<_> = declared.all().into_iter().map(|n| (n, self.scene.normal_residuals(n, &self.points))).collect();
        let pairwise = |a: usize, b: usize| Votes::of(NORMALS, &candidates[a].1, &candidates[b].1);
        let contest = Contest::new(candidates.len(), self.pair.pixels.len(), pairwise);
        let name = |i: usize| declared.changes(candidates[i].0);
        let mut finding = contest.finding(Measure::Normals, name, |i| declared.differences(candidates[i].0) == 1, |_| true);
        let residuals = &candidates[0].1;
        if finding.verdict != Verdict::Mistake && explained(NORMALS, residuals).is_some_and(|part| part < 0.5) {
            finding = Finding::new(Verdict::Unexplained, "no encoding, space or axis fits");
        } else if finding.verdict == Verdict::Inconclusive {
            finding = self.nothing_tells();
        }
        if finding.evidence.is_empty() && residuals.iter().any(|r| !r.is_nan()) {
            finding.evidence.push(self.agreement(Measure::Normals, residuals));
        }
        (finding, candidates[contest.champion].0)
    }
}

/// Residuals of the reading that explains most; of the earliest where several do.
fn best(rule: Rule, readings: impl Iterator<Item = Residuals>) -> Residuals {
    let count = |residuals: &Residuals| residuals.iter().filter(|r| **r <= rule.explains).count();
    readings.reduce(|best, other| if count(&other) > count(&best) { other } else { best }).unwrap_or_default()
}

/// The first candidate against all others.
pub(super) struct Contest {
    outcomes: Vec<Outcome>,
    /// The candidate that fits: the first one, or the one that beat it and is not beaten itself.
    pub(super) champion: usize,
    /// Contest between the first candidate and the champion.
    votes: Votes,
}

impl Contest {
    pub(super) fn new(count: usize, pixels: usize, pairwise: impl Fn(usize, usize) -> Votes) -> Self {
        let outcome = |a: usize, b: usize| {
            let votes = pairwise(a, b);
            judge(votes.for_first, votes.for_second, pixels)
        };
        let outcomes: Vec<_> = (0..count).map(|i| if i == 0 { Outcome::Undecided } else { outcome(0, i) }).collect();
        let champion = champion(&outcomes, outcome);
        Self { votes: pairwise(0, champion), outcomes, champion }
    }

    /// The finding: a mistake where another candidate won; agreement where a decisive one was ruled
    /// out. `name` gives the mistake and the remedy; single mistakes that could not be told apart
    /// are listed.
    pub(super) fn finding(
        &self,
        measure: Measure,
        name: impl Fn(usize) -> (Vec<String>, Vec<String>),
        is_single: impl Fn(usize) -> bool,
        is_decisive: impl Fn(usize) -> bool,
    ) -> Finding {
        if self.champion != 0 {
            let (mistakes, remedies) = name(self.champion);
            let (declared, fitting) = self.votes.medians();
            let evidence = Evidence { measure, declared, fitting: Some(fitting), pixels: self.votes.voters() };
            return Finding {
                remedy: remedies.join("; "),
                evidence: vec![evidence],
                ..Finding::new(Verdict::Mistake, mistakes.join("; "))
            };
        }
        let of = |outcome| (1..self.outcomes.len()).filter(move |i| self.outcomes[*i] == outcome);
        if !of(Outcome::First).any(&is_decisive) {
            return Finding::new(Verdict::Inconclusive, "");
        }
        let untested = of(Outcome::Undecided).filter(|i| is_single(*i)).map(|i| name(i).0.join("; ")).collect();
        Finding { untested, ..Finding::new(Verdict::Agrees, "") }
    }
}

/// The earliest candidate that beats the first one and that no other such candidate beats; 0 where none does.
fn champion(outcomes: &[Outcome], outcome: impl Fn(usize, usize) -> Outcome) -> usize {
    let winners = (1..outcomes.len()).filter(|i| outcomes[*i] == Outcome::Second);
    winners.reduce(|champion, other| if outcome(champion, other) == Outcome::Second { other } else { champion }).unwrap_or(0)
}

/// Whether depth and matrices are as declared; and the encoding that clearly fits instead, if there
/// is one.
pub(super) fn geometry_finding<'t, 'a>(declared: &Trial<'a>, alternatives: &'t [Trial<'a>]) -> (Finding, Option<&'t Trial<'a>>) {
    let outcomes: Vec<_> =
        std::iter::once(Outcome::Undecided).chain(alternatives.iter().map(|other| declared.against(other))).collect();
    let champion = champion(&outcomes, |a, b| alternatives[a - 1].against(&alternatives[b - 1]));
    if champion != 0 {
        let fitting = &alternatives[champion - 1];
        let votes = declared.votes(fitting).into_iter().filter(|(_, votes)| votes.voters() > 0);
        let evidence = votes.map(|(measure, votes)| {
            let (declared, fitting) = votes.medians();
            Evidence { measure, declared, fitting: Some(fitting), pixels: votes.voters() }
        });
        let remedy = fitting.geometry.remedy.clone();
        let factor = Some(fitting.geometry.depth_scale).filter(|scale| *scale != 1.0);
        let finding =
            Finding { remedy, factor, evidence: evidence.collect(), ..Finding::new(Verdict::Mistake, fitting.geometry.mistake) };
        return (finding, Some(fitting));
    }
    let mut finding = if declared.pair.camera_stands {
        declared.nothing_tells()
    } else if explained(DEPTH, &declared.depth).is_some_and(|part| part < 0.5) {
        Finding::new(Verdict::Unexplained, "the depth of the previous frame is not where depth and matrices of this one put it")
    } else if outcomes.contains(&Outcome::First) {
        let undecided = alternatives.iter().zip(&outcomes[1..]).filter(|(_, o)| **o == Outcome::Undecided);
        let mut untested: Vec<String> = undecided.map(|(t, _)| t.geometry.mistake.to_owned()).collect();
        // Units are many alternatives of one mistake.
        untested.dedup();
        Finding { untested, ..Finding::new(Verdict::Agrees, "") }
    } else {
        declared.nothing_tells()
    };
    if declared.surfaces() > 0 {
        finding.evidence.push(declared.agreement(Measure::Depth, &declared.depth));
    }
    (finding, None)
}

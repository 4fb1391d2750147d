//! The report of the test.

use atrous::config::Conventions;
use std::fmt;

/// The answer to one of the questions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Verdict {
    /// The guides are as declared.
    Agrees = 0,
    /// They clearly differ: [`Finding::mistake`] and [`Finding::remedy`].
    Mistake = 1,
    /// They are not as declared, and no known mistake explains them.
    Unexplained = 2,
    /// The two frames cannot tell; [`Finding::mistake`] says why.
    Inconclusive = 3,
    /// You give no such guide.
    Absent = 4,
}

/// A residual that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Distance of the depth of the previous frame from where depth and matrices of this frame put it, pixels.
    Depth,
    /// Difference between your motion and that of static geometry, by depth and matrices; pixels.
    Motion,
    /// Difference between z of your motion, read as the previous depth, and that of static
    /// geometry; percent.
    MotionDepth,
    /// Angle between your normals and those of the surface that the depth describes, degrees.
    Normals,
}

/// Medians of a residual over the pixels that tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// The residual.
    pub measure: Measure,
    /// Size of the residual with the declared conventions. Infinite: beyond the image or behind the camera.
    pub declared: f32,
    /// Size of the residual with the conventions that fit better.
    pub fitting: Option<f32>,
    /// Pixels that tell.
    pub pixels: usize,
}

/// The answer to one question.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The answer in one word.
    pub verdict: Verdict,
    /// The mistake, or the reason why there is no answer; empty if all is well.
    pub mistake: String,
    /// The remedy; empty where nothing is known.
    pub remedy: String,
    /// The answer in numbers.
    pub evidence: Vec<Evidence>,
    /// What the depth or the motion has to be multiplied by, where its unit is another one.
    pub factor: Option<f32>,
    /// Mistakes that these two frames would not show.
    pub untested: Vec<String>,
}

impl Finding {
    pub(super) fn new(verdict: Verdict, mistake: impl Into<String>) -> Self {
        Self { verdict, mistake: mistake.into(), remedy: String::new(), evidence: Vec::new(), factor: None, untested: Vec::new() }
    }
}

/// Findings of the test on two frames; [`fmt::Display`] has them in sentences.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Depth, handedness, matrices and jitter.
    pub geometry: Finding,
    /// Motion, x and y.
    pub motion: Finding,
    /// z of the motion, where `Conventions::motion_depth` says that it has a meaning.
    pub motion_depth: Finding,
    /// Normals.
    pub normals: Finding,
    /// The declared conventions with every remedy that a field of theirs can express.
    pub conventions: Conventions,
}

impl Report {
    /// The findings with their names.
    pub fn findings(&self) -> [(&'static str, &Finding); 4] {
        [
            ("depth and matrices", &self.geometry),
            ("motion", &self.motion),
            ("z of motion", &self.motion_depth),
            ("normals", &self.normals),
        ]
    }

    /// Whether anything is wrong: a mistake, or guides that nothing explains.
    pub fn complains(&self) -> bool {
        self.findings().iter().any(|(_, finding)| matches!(finding.verdict, Verdict::Mistake | Verdict::Unexplained))
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, finding) in self.findings() {
            if finding.verdict == Verdict::Absent {
                continue;
            }
            let verdict = match finding.verdict {
                Verdict::Agrees => "as declared",
                Verdict::Mistake => "MISTAKE: ",
                Verdict::Unexplained => "UNEXPLAINED: ",
                Verdict::Inconclusive => "cannot be told: ",
                Verdict::Absent => "",
            };
            writeln!(f, "{name}: {verdict}{}", finding.mistake)?;
            for evidence in &finding.evidence {
                writeln!(f, "    {evidence}")?;
            }
            if !finding.remedy.is_empty() {
                writeln!(f, "    change: {}", finding.remedy)?;
            }
            if !finding.untested.is_empty() {
                writeln!(f, "    these frames would not show: {}", finding.untested.join("; "))?;
            }
        }
        Ok(())
    }
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, unit) = match self.measure {
            Measure::Depth => ("depth, reprojected into the previous frame, is off by", "pixels"),
            Measure::Motion => ("motion differs from that by depth and matrices by", "pixels"),
            Measure::MotionDepth => ("the previous depth by the motion differs from that by the matrices by", "percent"),
            Measure::Normals => ("normals differ from those of the depth by", "degrees"),
        };
        let number = |v: f32| if v.is_finite() { format!("{v:.2} {unit}") } else { "more than the image".to_owned() };
        write!(f, "{what} {}", number(self.declared))?;
        if let Some(fitting) = self.fitting {
            write!(f, ", and by {} otherwise", number(fitting))?;
        }
        write!(f, " (median of {} pixels)", self.pixels)
    }
}

//! `--check`: do depth, motion, normals and matrices agree with the conventions?

use crate::conventions::{self, Scales};
use crate::error::{Result, ToolError};
use crate::frame;
use crate::frame_files::FrameFiles;
use crate::roles::Role;
use crate::setup::Setup;
use atrous::config::{Conventions, MotionDepth};
use atrous::reference::Image;
use atrous_conventions::{check, Finding, OwnedGuides, Report, Verdict};

/// Pairs of frames that are looked at, spread over the sequence: not every pair moves.
const PAIRS: usize = 4;

/// The number of a frame, and its guides.
fn load(files: &FrameFiles, setup: &Setup) -> Result<(u64, OwnedGuides)> {
    let mut inputs = frame::load(files, setup)?;
    let extent = setup.config.allocated_extent;
    // What the files do not have, the tool fills in: that proves nothing.
    let mut image = |name: &str, role: Role| match inputs.images.remove(name).filter(|_| setup.mapping.has(role)) {
        Some(texels) => Image::from_texels(extent, texels).map(Some),
        None => Ok(None),
    };
    let (normal, motion) = (image("normal", Role::Normal)?, image("motion", Role::Motion)?);
    let depth = Image::from_texels(extent, inputs.images.remove("depth").unwrap_or_default())?;
    let surface_id = inputs.surface_id.take().map(|ids| Image::from_texels(extent, ids)).transpose()?;
    Ok((inputs.number, OwnedGuides { params: inputs.params, depth, normal, motion, surface_id }))
}

/// The reports of some pairs, with the numbers of their frames.
pub fn run(frames: &[FrameFiles], setup: &Setup) -> Result<Vec<(u64, u64, Report)>> {
    if setup.sequence.is_none() || !(setup.mapping.has(Role::Depth) || setup.mapping.has(Role::Position)) {
        return Err(ToolError::Usage(
            "--check needs depth and the matrices of every frame: a sequence.json, see docs/denoise.md".into(),
        ));
    }
    if frames.len() < 2 {
        return Err(ToolError::Usage("--check needs two consecutive frames".into()));
    }
    let mut reports = Vec::new();
    for i in 0..PAIRS.min(frames.len() - 1) {
        let first = i * (frames.len() - 1) / PAIRS.min(frames.len() - 1);
        let pair = [&frames[first], &frames[first + 1]].map(|files| load(files, setup));
        let [previous, current] = pair;
        let ((previous_number, previous), (number, current)) = (previous?, current?);
        if current.params.reset.is_some() {
            continue;
        }
        let report = check(&declared(setup).0, &previous.borrow(), &current.borrow())?;
        reports.push((previous_number, number, report));
    }
    Ok(reports)
}

/// Conventions and units of the files.
pub type Declared = (Conventions, Scales);

/// The conventions of the files.
pub fn declared(setup: &Setup) -> Declared {
    let mut declared = setup.config.conventions;
    if setup.carries_depth {
        declared.motion_depth = MotionDepth::None;
    }
    (declared, setup.scales)
}

/// Prints the reports.
///
/// # Errors
/// Where any of them complains.
pub fn print(reports: &[(u64, u64, Report)], declared: &Declared) -> Result<()> {
    for (previous, current, report) in reports {
        println!("frames {previous} and {current}");
        print!("{}", told(report, declared));
    }
    let complaints = reports.iter().filter(|(.., report)| report.complains()).count();
    match complaints {
        0 => Ok(()),
        _ => Err(ToolError::Usage(format!(
            "guides and conventions do not agree in {complaints} of {} pairs of frames; try the options of the lines `change`",
            reports.len()
        ))),
    }
}

/// A report in lines, with remedies as this tool takes them.
pub fn told(report: &Report, declared: &Declared) -> String {
    let mut text = String::new();
    for (name, finding) in report.findings() {
        let verdict = match finding.verdict {
            Verdict::Absent => continue,
            Verdict::Agrees => "as declared",
            Verdict::Mistake => "MISTAKE: ",
            Verdict::Unexplained => "UNEXPLAINED: ",
            Verdict::Inconclusive => "cannot be told: ",
        };
        text += &format!("{name}: {verdict}{}\n", finding.mistake);
        for evidence in &finding.evidence {
            text += &format!("    {evidence}\n");
        }
        let (options, rest) = remedies(name, finding, report, declared);
        for option in options {
            text += &format!("    change: {option}\n");
        }
        for remedy in rest {
            text += &format!("    mend: {remedy}\n");
        }
        if !finding.untested.is_empty() {
            text += &format!("    these frames would not show: {}\n", finding.untested.join("; "));
        }
    }
    text
}

/// Every mistake in a line, with its remedy.
pub fn mistakes(report: &Report, declared: &Declared) -> Vec<String> {
    let of = |(name, finding): (&str, &Finding)| {
        let (options, rest) = remedies(name, finding, report, declared);
        let remedy: Vec<String> = options.into_iter().chain(rest).collect();
        format!("{name}: {} (--check has the figures). Remedy: {}", finding.mistake, remedy.join("; "))
    };
    report.findings().into_iter().filter(|(_, f)| f.verdict == Verdict::Mistake).map(of).collect()
}

/// Options that mend a finding, and what no option can.
fn remedies(name: &str, finding: &Finding, report: &Report, (declared, scales): &Declared) -> (Vec<String>, Vec<String>) {
    if finding.verdict != Verdict::Mistake {
        return (Vec::new(), Vec::new());
    }
    let keys: &[&str] = match name {
        "motion" => &["motion_unit", "motion_direction", "motion_y", "motion_jittered"],
        "z of motion" => &["motion_depth"],
        "normals" => &["normal", "normal_space"],
        _ => &["depth", "view_forward"],
    };
    let options = conventions::changes(declared, &report.conventions).into_iter();
    let options: Vec<String> =
        options.filter(|(key, _)| keys.contains(&key.as_str())).map(|(key, value)| format!("--convention {key}={value}")).collect();
    let scale = match name {
        "motion" => Some(("motion_scale", declared.motion_scale)),
        "depth and matrices" => Some(("depth_scale", scales.depth)),
        _ => None,
    };
    let mut options = options;
    if let (Some((key, declared)), Some(factor)) = (scale, finding.factor) {
        options.push(format!("--convention {key}={}", declared * factor));
    }
    // The library names fields, and factors; those are the options above.
    let is_field = |piece: &str| {
        piece.split_once(": ").is_some_and(|(key, _)| !key.contains(' '))
            || (finding.factor.is_some() && piece.starts_with("multiply"))
    };
    let rest = finding.remedy.split("; ").filter(|piece| !piece.is_empty() && !is_field(piece)).map(str::to_owned);
    (options, rest.collect())
}

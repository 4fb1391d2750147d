//! `--check`: do depth, motion, normals and matrices agree with the conventions?

use crate::error::{Result, ToolError};
use crate::frame;
use crate::frame_files::FrameFiles;
use crate::roles::Role;
use crate::setup::Setup;
use atrous::reference::Image;
use atrous_conventions::{check, OwnedGuides, Report};

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
        let report = check(&setup.config.conventions, &previous.borrow(), &current.borrow())?;
        reports.push((previous_number, number, report));
    }
    Ok(reports)
}

/// Prints the reports.
///
/// # Errors
/// Where any of them complains.
pub fn print(reports: &[(u64, u64, Report)]) -> Result<()> {
    for (previous, current, report) in reports {
        println!("frames {previous} and {current}");
        print!("{report}");
    }
    let complaints = reports.iter().filter(|(.., report)| report.complains()).count();
    match complaints {
        0 => Ok(()),
        _ => Err(ToolError::Usage(format!(
            "guides and conventions do not agree in {complaints} of {} pairs of frames; try what the lines `change` say with --convention",
            reports.len()
        ))),
    }
}

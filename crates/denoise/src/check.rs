//! `--check`: do depth, motion, normals and matrices agree with the conventions?

use crate::error::{Result, ToolError};
use crate::frame::{self, FrameInputs};
use crate::frame_files::FrameFiles;
use crate::roles::Role;
use crate::setup::Setup;
use atrous::reference::Image;
use atrous_conventions::{check, Guides, Report};

/// Pairs of frames that are looked at, spread over the sequence: not every pair moves.
const PAIRS: usize = 4;

/// The images of a frame.
struct Frame {
    inputs: FrameInputs,
    depth: Image<[f32; 4]>,
    normal: Option<Image<[f32; 4]>>,
    motion: Option<Image<[f32; 4]>>,
    surface_id: Option<Image<u32>>,
}

impl Frame {
    fn load(files: &FrameFiles, setup: &Setup) -> Result<Self> {
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
        Ok(Self { inputs, depth, normal, motion, surface_id })
    }

    fn guides(&self) -> Guides<'_> {
        Guides {
            params: self.inputs.params,
            depth: &self.depth,
            normal: self.normal.as_ref(),
            motion: self.motion.as_ref(),
            surface_id: self.surface_id.as_ref(),
        }
    }
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
        let pair = [&frames[first], &frames[first + 1]].map(|files| Frame::load(files, setup));
        let [previous, current] = pair;
        let (previous, current) = (previous?, current?);
        if current.inputs.params.reset.is_some() {
            continue;
        }
        let report = check(&setup.config.conventions, &previous.guides(), &current.guides())?;
        reports.push((previous.inputs.number, current.inputs.number, report));
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

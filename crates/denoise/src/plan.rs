//! The plan of a run: frames that are filtered, written or only scored; resuming.

use crate::error::{Result, ToolError};
use crate::exr_read;
use crate::frame_files::FrameFiles;
use std::path::{Path, PathBuf};

/// The treatment of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Filtered and written.
    Write,
    /// Finished already; filtered again, since the history of later frames needs it, and not written.
    KeepHistory,
    /// Finished already; only scored.
    Score,
}

/// One frame of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Input.
    pub files: FrameFiles,
    /// Output.
    pub output: PathBuf,
    /// The treatment of the frame.
    pub action: Action,
}

/// The treatment of existing outputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Existing {
    /// Overwritten.
    pub force: bool,
    /// Existing outputs are kept; missing ones are made.
    pub resume: bool,
    /// Finished frames before the first missing one that are filtered again for the sake of the history.
    pub warm_up: usize,
    /// Finished frames are wanted for the score.
    pub score: bool,
}

/// The path of a frame's result: the name of its colour, in the output folder.
pub fn output_path(folder: &Path, files: &FrameFiles) -> PathBuf {
    folder.join(files.colour.file_name().unwrap_or(std::ffi::OsStr::new("frame.exr"))).with_extension("exr")
}

/// Plans a run.
pub fn plan(frames: Vec<FrameFiles>, folder: &Path, extent: [u32; 2], existing: Existing) -> Result<Vec<Step>> {
    let mut steps = Vec::new();
    for files in frames {
        let output = output_path(folder, &files);
        let inputs = || std::iter::once(&files.colour).chain(files.guides.iter().map(|g| &g.1));
        if inputs().any(|input| same_file(&output, input)) {
            return Err(ToolError::Usage(format!(
                "{} would be overwritten by its own result; choose another folder with -o",
                output.display()
            )));
        }
        let finished = output.symlink_metadata().is_ok();
        if finished && !existing.force && !existing.resume {
            return Err(ToolError::Exists { path: output });
        }
        // A file that cannot be read is not finished.
        let finished = finished && existing.resume && exr_read::read_header(&output).is_ok_and(|h| h.extent == extent);
        steps.push(Step { files, output, action: if finished { Action::Score } else { Action::Write } });
    }
    let Some(first) = steps.iter().position(|s| s.action == Action::Write) else {
        return Ok(if existing.score { steps } else { Vec::new() });
    };
    let Some(last) = steps.iter().rposition(|s| s.action == Action::Write) else { return Ok(steps) };
    let start = first.saturating_sub(existing.warm_up);
    for step in &mut steps[start..last] {
        if step.action == Action::Score {
            step.action = Action::KeepHistory;
        }
    }
    if !existing.score {
        steps.truncate(last + 1);
        steps.drain(..start);
    }
    Ok(steps)
}

fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

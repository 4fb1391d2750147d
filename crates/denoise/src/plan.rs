//! The plan of a run: frames that are filtered, written or only read; resuming.

use crate::error::{Result, ToolError};
use crate::frame_files::FrameFiles;
use crate::results::{self, Expected, Extras};
use std::path::{Path, PathBuf};

/// The treatment of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Filtered and written.
    Write,
    /// Finished already; filtered again, since the history of later frames needs it, and not written.
    KeepHistory,
    /// Finished already; only scored, or shown.
    Read,
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
    /// Files beside the frames.
    pub extras: Extras,
    /// Whether frames are scored: then every finished one is read again.
    pub scored: bool,
    /// Finished frames that are wanted for pictures.
    pub shown: [Option<u64>; 2],
}

/// Plans a run.
pub fn plan(frames: Vec<FrameFiles>, folder: &Path, expected: &Expected, existing: Existing) -> Result<Vec<Step>> {
    let mut steps = Vec::new();
    for files in frames {
        let output = results::frame(folder, &files);
        let inputs = || std::iter::once(&files.colour).chain(files.guides.iter().map(|g| &g.1));
        if inputs().any(|input| same_file(&output, input)) {
            return Err(ToolError::Usage(format!(
                "{} would be overwritten by its own result; choose another folder with -o",
                output.display()
            )));
        }
        if !existing.force && !existing.resume && output.symlink_metadata().is_ok() {
            return Err(ToolError::Exists { path: output });
        }
        let finished = existing.resume && expected.is_finished(&output)?;
        steps.push(Step { files, output, action: if finished { Action::Read } else { Action::Write } });
    }
    if !existing.force && !existing.resume {
        let frames: Vec<PathBuf> = steps.iter().map(|s| s.output.clone()).collect();
        if let Some(path) = existing.extras.existing(folder, &frames) {
            return Err(ToolError::Exists { path });
        }
    }
    let is_written = |s: &Step| s.action == Action::Write;
    if let (Some(first), Some(last)) = (steps.iter().position(is_written), steps.iter().rposition(is_written)) {
        let start = first.saturating_sub(existing.warm_up);
        let between = steps[start..last].iter_mut().filter(|s| s.action == Action::Read);
        between.for_each(|step| step.action = Action::KeepHistory);
    }
    steps.retain(|s| s.action != Action::Read || existing.scored || existing.shown.contains(&Some(s.files.number)));
    Ok(steps)
}

fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

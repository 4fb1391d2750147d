//! The files of a run in its folder: their names, whether they are there, and whether they are whole.

use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::exr_read;
use crate::exr_write::OutputChannels;
use crate::frame_files::FrameFiles;
use crate::record::Record;
use atrous::DebugView;
use exr::prelude::Vec2;
use std::path::{Path, PathBuf};

/// Files that a run writes beside the frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extras {
    /// A preview of every frame.
    pub png: bool,
    /// Debug views of every frame.
    pub views: bool,
    /// The strip of one frame.
    pub strip: bool,
    /// The report.
    pub report: bool,
    /// Table and plots.
    pub score: bool,
}

/// The path of a frame's result: the name of its colour, in the output folder.
pub fn frame(folder: &Path, files: &FrameFiles) -> PathBuf {
    folder.join(files.colour.file_name().unwrap_or(std::ffi::OsStr::new("frame.exr"))).with_extension("exr")
}

/// The preview of a frame.
pub fn preview(frame: &Path) -> PathBuf {
    frame.with_extension("png")
}

/// The longest name that a file can have, bytes.
const LONGEST_NAME: usize = 255;

/// A view of a frame: `views/STEM_history_length.png`, ... Of a stem too long for that, its end, which
/// has the number.
pub fn view(frame: &Path, view: DebugView) -> PathBuf {
    let stem = frame.file_stem().unwrap_or_default().to_string_lossy();
    let ending = format!("_{}.png", view.name());
    let mut start = (stem.len() + ending.len()).saturating_sub(LONGEST_NAME);
    while !stem.is_char_boundary(start) {
        start += 1;
    }
    frame.with_file_name("views").join(format!("{}{ending}", &stem[start..]))
}

/// Noisy, denoised and reference of a frame.
pub fn strip(folder: &Path) -> PathBuf {
    folder.join("strip.png")
}

/// Pictures of a frame and scores of all, to look at in a browser.
pub fn report(folder: &Path) -> PathBuf {
    folder.join("report.html")
}

/// Scores of all frames, and their plots.
pub fn scores(folder: &Path) -> [PathBuf; 2] {
    ["scores.json", "scores.png"].map(|name| folder.join(name))
}

impl Extras {
    /// The first of the files that is there already.
    pub fn existing(self, folder: &Path, frames: &[PathBuf]) -> Option<PathBuf> {
        let mut paths = Vec::new();
        paths.extend(self.strip.then(|| strip(folder)));
        paths.extend(self.report.then(|| report(folder)));
        paths.extend(self.score.then(|| scores(folder)).into_iter().flatten());
        for frame in frames {
            paths.extend(self.png.then(|| preview(frame)));
            let views = self.views.then_some(DebugView::ALL).into_iter().flatten();
            paths.extend(views.map(|v| view(frame, v)));
        }
        paths.into_iter().find(|path| path.symlink_metadata().is_ok())
    }
}

/// The frames that a run writes, to be compared with what an earlier one left.
#[derive(Clone, Debug)]
pub struct Expected {
    /// Width and height of the display window.
    pub display: Vec2<usize>,
    /// Channels.
    pub channels: OutputChannels,
    /// Options.
    pub record: Record,
}

impl Expected {
    /// Whether a file is there and whole. What cannot be decoded to its end is not finished.
    ///
    /// # Errors
    /// [`ToolError::OtherOptions`] for a file that another run made; [`ToolError::Read`] for what is no file.
    pub fn is_finished(&self, path: &Path) -> Result<bool> {
        if path.symlink_metadata().is_err() {
            return Ok(false);
        }
        atrous_files::check_regular(path).map_err(ToolError::read(path))?;
        let Ok(header) = exr_read::read_header(path) else { return Ok(false) };
        match self.record.objection(&header) {
            Some(problem) => Err(ToolError::OtherOptions { path: path.to_owned(), problem }),
            None => Ok(self.fits(&header) && exr_read::read(path, |_| true).is_ok()),
        }
    }

    fn fits(&self, header: &ExrHeader) -> bool {
        let part = Record::part(header);
        let has = |name: &String| header.channels.iter().any(|c| c.part == part && c.own_name == *name);
        header.shared.display_window.size == self.display && self.channels.colours.iter().flatten().all(has)
    }
}

//! The channels of a frame, whether they are in one file or in several.

use crate::error::{Result, ToolError};
use crate::exr_header::{Channel, ExrHeader};
use crate::exr_read::{self, Planes};
use crate::frame_files::FrameFiles;
use std::path::Path;

/// Name that a channel of a file of its own gets: `R` of an albedo is `albedo.R`.
fn prefixed(layer: &str, name: &str) -> String {
    if name.to_lowercase().starts_with(&format!("{layer}.")) {
        return name.to_owned();
    }
    format!("{layer}.{}", name.rsplit('.').next().unwrap_or(name))
}

fn check_extent(path: &Path, given: [u32; 2], expected: [u32; 2]) -> Result<()> {
    match given == expected {
        true => Ok(()),
        false => Err(ToolError::FrameSize { path: path.to_owned(), given, expected }),
    }
}

/// The header of the colour, with the channels of all files.
pub fn header(files: &FrameFiles) -> Result<ExrHeader> {
    let mut all = exr_read::read_header(&files.colour)?;
    for (layer, path) in &files.guides {
        let guide = exr_read::read_header(path)?;
        check_extent(path, guide.extent, all.extent)?;
        all.channels.extend(guide.channels.into_iter().map(|c| Channel { name: prefixed(layer, &c.name), ..c }));
    }
    Ok(all)
}

/// The wanted channels of all files, with the header of the colour.
pub fn read(files: &FrameFiles, expected: [u32; 2], wanted: impl Fn(&str) -> bool) -> Result<Planes> {
    // Before the pixels are read: a larger frame may be one that does not fit into memory.
    check_extent(&files.colour, exr_read::read_header(&files.colour)?.extent, expected)?;
    let mut all = exr_read::read(&files.colour, |c| wanted(&c.name))?;
    for (layer, path) in &files.guides {
        let guide = exr_read::read(path, |c| wanted(&prefixed(layer, &c.name)))?;
        check_extent(path, guide.header.extent, expected)?;
        all.samples.extend(guide.samples.into_iter().map(|(name, samples)| (prefixed(layer, &name), samples)));
        all.header.channels.extend(guide.header.channels.into_iter().map(|c| Channel { name: prefixed(layer, &c.name), ..c }));
    }
    Ok(all)
}

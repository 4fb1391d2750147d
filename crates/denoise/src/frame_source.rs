//! The channels of a frame, whether they are in one file or in several.

use crate::error::{Result, ToolError};
use crate::exr_header::{Channel, ExrHeader, ELSEWHERE};
use crate::exr_read::{self, Planes, Samples};
use crate::frame_files::FrameFiles;
use crate::output_size::OutputSize;
use std::path::Path;

/// Name that a channel of a file of its own gets: `R` of an albedo is `albedo.R`.
fn prefixed(layer: &str, name: &str) -> String {
    if name.to_lowercase().starts_with(&format!("{layer}.")) {
        return name.to_owned();
    }
    format!("{layer}.{}", name.rsplit('.').next().unwrap_or(name))
}

/// A channel of a file of its own, among those of the colour.
fn elsewhere(layer: &str, channel: Channel) -> Channel {
    Channel { name: prefixed(layer, &channel.name), part: ELSEWHERE, ..channel }
}

/// Facts of the first frame that hold for all others.
#[derive(Clone, Copy, Debug)]
pub struct First {
    /// Width and height.
    pub extent: [u32; 2],
    /// Those of the light, where it has a file of its own.
    pub light: Option<[u32; 2]>,
    /// Bytes that decoding a file of a frame may take.
    pub reading: u64,
}

fn mib(bytes: u64) -> String {
    format!("{} MiB of blocks of pixels", bytes >> 20)
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
        // One file is read after the other.
        all.reading = all.reading.max(guide.reading);
        all.channels.extend(guide.channels.into_iter().map(|c| elsewhere(layer, c)));
    }
    if let Some(path) = &files.light {
        let light = exr_read::read_header(path)?;
        all.reading = all.reading.max(light.reading);
        replace(&mut all.channels, light.channels);
    }
    Ok(all)
}

/// Puts the channels of the light into the place of those that the guides have under the same names.
fn replace(channels: &mut Vec<Channel>, of_light: Vec<Channel>) {
    channels.retain(|channel| of_light.iter().all(|other| other.name != channel.name));
    channels.extend(of_light.into_iter().map(|channel| Channel { part: ELSEWHERE, ..channel }));
}

/// Width and height of the light, where it has a file of its own.
pub fn light_extent(files: &FrameFiles) -> Result<Option<[u32; 2]>> {
    files.light.as_deref().map(|path| exr_read::read_header(path).map(|header| header.extent)).transpose()
}

/// The wanted channels of all files, with the header of the colour.
pub fn read(files: &FrameFiles, first: &First, wanted: impl Fn(&str) -> bool) -> Result<Planes> {
    // Before the pixels are read: a larger frame may be one that does not fit into memory.
    for path in std::iter::once(&files.colour).chain(files.guides.iter().map(|g| &g.1)) {
        let header = exr_read::read_header(path)?;
        if header.reading > first.reading {
            let (claim, limit) = (mib(header.reading), mib(first.reading));
            return Err(ToolError::TooLarge { path: path.clone(), claim, limit: format!("{limit}, by the first frame") });
        }
        check_extent(path, header.extent, first.extent)?;
    }
    let mut all = exr_read::read(&files.colour, |c| wanted(&c.name))?;
    for (layer, path) in &files.guides {
        let guide = exr_read::read(path, |c| wanted(&prefixed(layer, &c.name)))?;
        all.samples.extend(guide.samples.into_iter().map(|(name, samples)| (prefixed(layer, &name), samples)));
        all.header.channels.extend(guide.header.channels.into_iter().map(|c| elsewhere(layer, c)));
    }
    if let Some(path) = &files.light {
        let header = exr_read::read_header(path)?;
        let expected = first.light.unwrap_or(first.extent);
        check_extent(path, header.extent, expected)?;
        let light = exr_read::read(path, |c| wanted(&c.name))?;
        // Each pixel of the light stands in all pixels of its cell, of which the filter takes the traced one.
        let size = OutputSize::new(expected, first.extent);
        let enlarged = |samples: Samples| match samples {
            Samples::Float(plane) => Samples::Float(size.enlarged(&plane)),
            Samples::Uint(plane) => Samples::Uint(size.enlarged(&plane)),
        };
        replace(&mut all.header.channels, light.header.channels);
        all.samples.extend(light.samples.into_iter().map(|(name, samples)| (name, enlarged(samples))));
    }
    Ok(all)
}

//! Writes denoised frames with the channel names and the metadata of the input.

use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::exr_read::{self, Samples};
use crate::panics::caught;
use crate::record::Record;
use atrous_files::Existing;
use exr::compression::Compression;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::LineOrder;
use exr::prelude::{SmallVec, Text, Vec2, WritableImage};
use std::io::{Cursor, Write};
use std::path::Path;

/// Names of the channels of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputChannels {
    /// Each set of three gets the colour.
    pub colours: Vec<[String; 3]>,
    /// Alpha.
    pub alpha: Option<String>,
    /// Half, else float.
    pub half: bool,
}

/// Makes a file of the result of some bytes.
pub fn publish(path: &Path, existing: Existing, bytes: &[u8]) -> Result<()> {
    atrous_files::publish(path, existing, |file| file.write_all(bytes)).map_err(ToolError::publish(path))
}

/// A frame to be written.
pub struct Content<'a> {
    /// Header of the input, for its metadata.
    pub header: &'a ExrHeader,
    /// Channels.
    pub names: &'a OutputChannels,
    /// Options.
    pub record: &'a Record,
    /// Linear radiance.
    pub radiance: &'a [[f32; 3]],
    /// Alpha of the input.
    pub alpha: Option<&'a [f32]>,
}

/// Writes a frame.
pub fn write(path: &Path, existing: Existing, content: &Content<'_>) -> Result<()> {
    let &Content { header, names, record, radiance, alpha } = content;
    let problem = |problem: String| ToolError::Encode { path: path.to_owned(), problem };
    let mut list: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    for set in &names.colours {
        for (component, name) in set.iter().enumerate() {
            let values = radiance.iter().map(|p| p[component]);
            list.push(channel(name, names.half, values).ok_or_else(|| problem(format!("`{name}` is no name for a channel")))?);
        }
    }
    if let (Some(name), Some(alpha)) = (&names.alpha, alpha) {
        list.extend(channel(name, names.half, alpha.iter().copied()));
    }
    let mut attributes = header.parts.first().cloned().unwrap_or_default();
    attributes.other.extend(record.attribute());
    attributes.layer_position = header.shared.display_window.position;
    let encoding = Encoding {
        compression: compression(header.compressions.first().copied()),
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = Vec2(header.extent[0] as usize, header.extent[1] as usize);
    let image = Image::new(header.shared.clone(), Layer::new(size, attributes, encoding, AnyChannels::sort(list)));
    let mut bytes = Cursor::new(Vec::new());
    let written = caught(|| image.write().non_parallel().to_buffered(&mut bytes)).map_err(problem)?;
    written.map_err(|e| problem(e.to_string()))?;
    publish(path, existing, &bytes.into_inner())
}

fn channel(name: &str, half: bool, values: impl Iterator<Item = f32>) -> Option<AnyChannel<FlatSamples>> {
    // Half floats end at 65504; beyond it a bright light would become an infinite one.
    let to_half = |v: f32| half::f16::from_f32(v.clamp(-65504.0, 65504.0));
    let samples = if half { FlatSamples::F16(values.map(to_half).collect()) } else { FlatSamples::F32(values.collect()) };
    Some(AnyChannel::new(Text::new_or_none(name)?, samples))
}

/// The compression of the input, unless it loses precision or is one that cannot be written.
fn compression(input: Option<Compression>) -> Compression {
    match input {
        Some(c @ (Compression::Uncompressed | Compression::RLE | Compression::ZIP1 | Compression::ZIP16 | Compression::PIZ)) => c,
        _ => Compression::ZIP16,
    }
}

/// Reads back what [`write`] wrote.
pub fn read_back(path: &Path, names: &OutputChannels) -> Result<Vec<[f32; 3]>> {
    let Some(set) = names.colours.first() else { return Err(ToolError::exr(path, "it has no colour")) };
    let planes = exr_read::read(path, |c| set.contains(&c.name))?;
    let plane = |name: &String| match planes.samples.get(name) {
        Some(Samples::Float(values)) => Ok(values),
        _ => {
            Err(ToolError::NoChannel { path: path.to_owned(), channel: name.clone(), known: crate::mapping::list(&planes.header) })
        }
    };
    let [r, g, b] = [plane(&set[0])?, plane(&set[1])?, plane(&set[2])?];
    Ok(r.iter().zip(g).zip(b).map(|((r, g), b)| [*r, *g, *b]).collect())
}

/// Makes the folder for the output and proves that files can be made in it, before minutes are spent on frames.
pub fn prepare_folder(folder: &Path) -> Result<()> {
    std::fs::create_dir_all(folder).map_err(ToolError::write(folder))?;
    atrous_files::check_writable(folder).map_err(ToolError::write(folder))
}

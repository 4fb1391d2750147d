//! Files of a capture: nothing is overwritten, and no reader sees half a file.

use super::channels::Layer;
use crate::error::Error;
use atrous_files::{check_writable, publish, Existing};
use exr::compression::Compression;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image};
use exr::meta::attribute::LineOrder;
use exr::prelude::{ImageAttributes, IntegerBounds, LayerAttributes, SmallVec, Text, Vec2, WritableImage};
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};

fn problem(path: &Path, action: &str, error: impl std::fmt::Display) -> Error {
    Error::Capture { path: path.to_owned(), problem: format!("cannot be {action}: {error}. Choose a folder that can be written") }
}

/// A file of an earlier capture, if there is one.
fn existing(folder: &Path) -> std::io::Result<Option<PathBuf>> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        if name == "sequence.json" || (name.starts_with("frame_") && name.ends_with(".exr")) {
            return Ok(Some(path));
        }
    }
    Ok(None)
}

/// Makes the folder and proves that files can be made in it, before a frame is lost.
pub(crate) fn prepare(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(|e| problem(folder, "made", e))?;
    if let Some(path) = existing(folder).map_err(|e| problem(folder, "read", e))? {
        let problem =
            "exists already: the folder holds a sequence, which is not overwritten. Choose another folder, or remove it first";
        return Err(Error::Capture { path, problem: problem.to_owned() });
    }
    check_writable(folder).map_err(|e| problem(folder, "written", e))
}

/// Makes the file `path` of `bytes`, whole or not at all.
pub(crate) fn write_whole(path: &Path, existing: Existing, bytes: &[u8]) -> Result<(), Error> {
    publish(path, existing, |file| file.write_all(bytes)).map_err(|e| problem(path, "written", e))
}

/// Writes a frame: ZIP, which loses nothing.
pub(crate) fn write(path: &Path, extent: [u32; 2], layers: Vec<Layer>) -> Result<(), Error> {
    let size = Vec2(extent[0] as usize, extent[1] as usize);
    let mut list: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    for layer in layers {
        for (component, samples) in layer.planes {
            let name =
                Text::new_or_none(format!("{}.{component}", layer.name)).ok_or_else(|| problem(path, "named", &layer.name))?;
            list.push(AnyChannel::new(name, samples));
        }
    }
    let encoding = Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let software_name = Text::new_or_none(concat!("atrous ", env!("CARGO_PKG_VERSION")));
    let attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    let layer = exr::image::Layer::new(size, attributes, encoding, AnyChannels::sort(list));
    let image = Image::new(ImageAttributes::new(IntegerBounds::from_dimensions(size)), layer);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).map_err(|e| problem(path, "encoded", e))?;
    write_whole(path, Existing::Kept, &bytes.into_inner())
}

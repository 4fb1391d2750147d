//! The header of an EXR file: what is in it, checked before anything is allocated for its pixels.

use crate::error::{Result, ToolError};
use crate::panics::caught;
use exr::block::reader::Reader;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use exr::prelude::{ImageAttributes, LayerAttributes};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Largest side of a frame, that of the library.
pub const MAX_SIDE: u32 = atrous::Config::MAX_SIDE;
/// Largest memory that one frame may need, bytes. 16K frames do not fit; 8K frames with every guide do.
const MAX_FRAME_BYTES: u64 = 8 << 30;
/// Fewest bytes that a chunk takes in a file: its entry in the offset table.
const MIN_CHUNK_BYTES: u64 = 8;

/// One channel of a file. Channels of a named part of a multi-part file are prefixed with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// `layer.suffix`.
    pub name: String,
    /// Half, float or unsigned integer.
    pub sample_type: SampleType,
    /// Part of the file.
    pub part: usize,
    /// Index in the part.
    pub index: usize,
}

/// The header of a file.
#[derive(Clone, Debug)]
pub struct ExrHeader {
    /// Size of the display window: of the picture.
    pub extent: [u32; 2],
    /// Whether some part covers less or more than the display window.
    pub windows_differ: bool,
    /// Channels of all parts.
    pub channels: Vec<Channel>,
    /// Attributes that all parts share.
    pub shared: ImageAttributes,
    /// Attributes of each part.
    pub parts: Vec<LayerAttributes>,
    /// Size of the data window of each part.
    pub part_sizes: Vec<[usize; 2]>,
    /// Compression of each part.
    pub compressions: Vec<exr::compression::Compression>,
    /// Bytes that decoding takes at most, beside the planes that come out.
    pub reading: u64,
}

/// An open file whose header was read and checked.
pub struct OpenExr {
    /// The header.
    pub header: ExrHeader,
    /// The rest of the file.
    pub reader: Reader<BufReader<File>>,
}

/// Opens a file and reads its header.
pub fn open(path: &Path) -> Result<OpenExr> {
    let bytes = atrous_files::check_regular(path).map_err(ToolError::read(path))?;
    let file = File::open(path).map_err(ToolError::read(path))?;
    let reader = caught(|| exr::block::read(BufReader::new(file), false));
    let reader = reader.map_err(|panic| ToolError::exr(path, panic))?.map_err(|e| from_exr(path, e))?;
    let header = check(path, reader.headers(), bytes)?;
    Ok(OpenExr { header, reader })
}

/// Turns an error of the crate `exr` into ours.
pub fn from_exr(path: &Path, error: exr::error::Error) -> ToolError {
    match error {
        exr::error::Error::Io(source) if source.kind() != std::io::ErrorKind::UnexpectedEof => {
            ToolError::Read { path: path.to_owned(), source }
        }
        exr::error::Error::Io(_) => ToolError::exr(path, "it is truncated"),
        exr::error::Error::NotSupported(what) => ToolError::exr(path, format!("it uses what is not supported here: {what}")),
        exr::error::Error::Invalid(what) if what.contains("reference to missing bytes") => ToolError::exr(path, "it is truncated"),
        exr::error::Error::Invalid(what) => ToolError::exr(path, format!("it is corrupt or truncated: {what}")),
        exr::error::Error::Aborted => ToolError::exr(path, "reading was aborted"),
    }
}

fn check(path: &Path, headers: &[Header], file_bytes: u64) -> Result<ExrHeader> {
    let Some(first) = headers.first() else { return Err(ToolError::exr(path, "it has no parts")) };
    let too_large = |claim: String, limit: String| ToolError::TooLarge { path: path.to_owned(), claim, limit };
    let window = first.shared_attributes.display_window;
    let (mut bytes, mut chunks) = (0u64, 0u64);
    for header in headers {
        if header.deep {
            return Err(ToolError::exr(path, "it has deep pixels; flatten it first"));
        }
        for size in [window.size, header.layer_size] {
            if size.0 == 0 || size.1 == 0 {
                return Err(ToolError::exr(path, format!("it is empty: {}x{} pixels", size.0, size.1)));
            }
            if size.0.max(size.1) > MAX_SIDE as usize {
                return Err(too_large(format!("{}x{} pixels", size.0, size.1), format!("{MAX_SIDE} per side")));
            }
        }
        let area = (header.layer_size.area() as u64).max(window.size.area() as u64);
        bytes = bytes.saturating_add(area.saturating_mul(4).saturating_mul(header.channels.list.len() as u64));
        chunks = chunks.saturating_add(header.chunk_count as u64);
        if let Some(channel) = header.channels.list.iter().find(|c| c.sampling.0 != 1 || c.sampling.1 != 1) {
            return Err(ToolError::exr(path, format!("channel `{}` is subsampled, which is not supported", channel.name)));
        }
    }
    if bytes > MAX_FRAME_BYTES {
        return Err(too_large(format!("{} MiB of pixels", bytes >> 20), format!("{} MiB", MAX_FRAME_BYTES >> 20)));
    }
    if chunks.saturating_mul(MIN_CHUNK_BYTES) > file_bytes {
        return Err(ToolError::exr(
            path,
            format!("it is truncated: {file_bytes} bytes cannot hold the {chunks} blocks of its header"),
        ));
    }
    Ok(describe(headers, file_bytes))
}

/// The file, or all of its blocks where that is less, and those that are decoded on every core.
fn reading(headers: &[Header], file_bytes: u64) -> u64 {
    let sum: u64 = headers.iter().map(|h| h.max_pixel_file_bytes() as u64).fold(0, u64::saturating_add);
    let block = headers.iter().map(|h| h.max_block_byte_size() as u64).max().unwrap_or_default();
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    // Each thread has a block and what it is made of; as many wait.
    file_bytes.min(sum).saturating_add(block.saturating_mul(4 * threads))
}

fn describe(headers: &[Header], file_bytes: u64) -> ExrHeader {
    let shared = headers[0].shared_attributes.clone();
    let window = shared.display_window;
    let mut channels = Vec::new();
    for (part, header) in headers.iter().enumerate() {
        let part_name = header.own_attributes.layer_name.as_ref().map(|n| n.to_string()).unwrap_or_default();
        for (index, channel) in header.channels.list.iter().enumerate() {
            let name = channel.name.to_string();
            // A single part may be called anything ("Layer", "rgba"): its channel names say what they are.
            let prefixed = headers.len() == 1 || part_name.is_empty() || name.starts_with(&format!("{part_name}."));
            let name = if prefixed { name } else { format!("{part_name}.{name}") };
            channels.push(Channel { name, sample_type: channel.sample_type, part, index });
        }
    }
    let differs = |h: &Header| h.own_attributes.layer_position != window.position || h.layer_size != window.size;
    ExrHeader {
        extent: [window.size.0 as u32, window.size.1 as u32],
        windows_differ: headers.iter().any(differs),
        channels,
        shared,
        parts: headers.iter().map(|h| h.own_attributes.clone()).collect(),
        part_sizes: headers.iter().map(|h| [h.layer_size.0, h.layer_size.1]).collect(),
        compressions: headers.iter().map(|h| h.compression).collect(),
        reading: reading(headers, file_bytes),
    }
}

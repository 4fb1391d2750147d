//! The header of an EXR file: what is in it, checked before anything is allocated for its pixels.

use crate::error::{Result, ToolError};
use crate::exr_compression;
use crate::panics::caught;
use exr::block::reader::Reader;
use exr::meta::attribute::{IntegerBounds, SampleType};
use exr::meta::header::Header;
use exr::prelude::{ImageAttributes, LayerAttributes, Vec2};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Largest side of a frame, that of the library.
pub const MAX_SIDE: u32 = atrous::Config::MAX_SIDE;
/// Largest memory that one frame may need, bytes. 16K frames do not fit; 8K frames with every guide do.
const MAX_FRAME_BYTES: u64 = 8 << 30;
/// Fewest bytes that a chunk takes in a file: its entry in the offset table.
const MIN_CHUNK_BYTES: u64 = 8;

/// The part of channels that are in a file beside.
pub const ELSEWHERE: usize = usize::MAX;

/// One channel of a file. Channels of a named part of a multi-part file are prefixed with its name,
/// those of a second eye with that.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// `layer.suffix`.
    pub name: String,
    /// The name in its part.
    pub own_name: String,
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
    /// Size of the picture: of [`Self::window`].
    pub extent: [u32; 2],
    /// The display window, and what parts have around it (overscan).
    pub window: IntegerBounds,
    /// Whether some part covers less than the picture.
    pub has_gaps: bool,
    /// Views of the file but for the first one: a second eye.
    pub eyes: Vec<String>,
    /// Channels of all parts.
    pub channels: Vec<Channel>,
    /// Attributes that all parts share.
    pub shared: ImageAttributes,
    /// Attributes of each part.
    pub parts: Vec<LayerAttributes>,
    /// Data window of each part.
    pub part_windows: Vec<IntegerBounds>,
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
        exr::error::Error::NotSupported(what) if what.contains("compression method") => {
            ToolError::exr(path, exr_compression::unknown(path))
        }
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
    let picture = picture(window, headers);
    let (mut bytes, mut chunks) = (0u64, 0u64);
    for header in headers {
        if let Some(problem) = exr_compression::unread(header.compression) {
            return Err(ToolError::exr(path, problem));
        }
        if header.deep {
            return Err(ToolError::exr(path, "it has deep pixels; flatten it first"));
        }
        for size in [picture.size, header.layer_size] {
            if size.0.max(size.1) > MAX_SIDE as usize {
                return Err(too_large(format!("{}x{} pixels", size.0, size.1), format!("{MAX_SIDE} per side")));
            }
        }
        for size in [window.size, header.layer_size] {
            if size.0 == 0 || size.1 == 0 {
                return Err(ToolError::exr(path, format!("it is empty: {}x{} pixels", size.0, size.1)));
            }
        }
        let area = (header.layer_size.area() as u64).max(picture.size.area() as u64);
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

fn data_window(header: &Header) -> IntegerBounds {
    IntegerBounds::new(header.own_attributes.layer_position, header.layer_size)
}

/// Corners of a window, the second one outside of it.
fn corners(window: IntegerBounds) -> [[i64; 2]; 2] {
    let [x, y] = [i64::from(window.position.0), i64::from(window.position.1)];
    [[x, y], [x + window.size.0 as i64, y + window.size.1 as i64]]
}

/// The display window, with the parts that reach into it.
fn picture(display: IntegerBounds, headers: &[Header]) -> IntegerBounds {
    let [mut from, mut to] = corners(display);
    for [start, end] in headers.iter().map(|header| corners(data_window(header))) {
        let [least, most] = corners(display);
        if (0..2).all(|i| start[i] < most[i] && end[i] > least[i]) {
            from = std::array::from_fn(|i| from[i].min(start[i]));
            to = std::array::from_fn(|i| to[i].max(end[i]));
        }
    }
    // Corners of windows that the format can hold.
    let position = Vec2(from[0] as i32, from[1] as i32);
    IntegerBounds::new(position, Vec2((to[0] - from[0]) as usize, (to[1] - from[1]) as usize))
}

/// Views of all parts; the first one is that of the picture.
fn views(headers: &[Header]) -> Vec<String> {
    let of_file = headers.iter().find_map(|header| header.own_attributes.multi_view_names.as_ref());
    let mut views: Vec<String> = of_file.into_iter().flatten().map(ToString::to_string).collect();
    for view in headers.iter().filter_map(|header| header.own_attributes.view_name.as_ref()) {
        if !views.contains(&view.to_string()) {
            views.push(view.to_string());
        }
    }
    views
}

/// The name of a part without that of its view, `rgba.left` or `left`; that of another eye is put first.
fn part_name(header: &Header, views: &[String]) -> String {
    let name = header.own_attributes.layer_name.as_ref().map(|n| n.to_string()).unwrap_or_default();
    let Some(view) = header.own_attributes.view_name.as_ref().map(ToString::to_string) else { return name };
    let rest = name.strip_suffix(&view).or_else(|| name.strip_prefix(&view)).unwrap_or(&name);
    let rest = rest.trim_matches(|c: char| matches!(c, '.' | '_' | '-' | ' '));
    match views.first() == Some(&view) {
        true => rest.to_owned(),
        false if rest.is_empty() => view,
        false => format!("{view}.{rest}"),
    }
}

fn describe(headers: &[Header], file_bytes: u64) -> ExrHeader {
    let shared = headers[0].shared_attributes.clone();
    let window = picture(shared.display_window, headers);
    let views = views(headers);
    let mut channels = Vec::new();
    for (part, header) in headers.iter().enumerate() {
        let part_name = part_name(header, &views);
        for (index, channel) in header.channels.list.iter().enumerate() {
            let own_name = channel.name.to_string();
            // A single part may be called anything ("Layer", "rgba"): its channel names say what they are.
            let prefixed = headers.len() == 1 || part_name.is_empty() || own_name.starts_with(&format!("{part_name}."));
            let name = if prefixed { own_name.clone() } else { format!("{part_name}.{own_name}") };
            channels.push(Channel { name, own_name, sample_type: channel.sample_type, part, index });
        }
    }
    let differs = |h: &Header| data_window(h) != window;
    ExrHeader {
        extent: [window.size.0 as u32, window.size.1 as u32],
        window,
        has_gaps: headers.iter().any(differs),
        eyes: views.into_iter().skip(1).collect(),
        channels,
        shared,
        parts: headers.iter().map(|h| h.own_attributes.clone()).collect(),
        part_windows: headers.iter().map(data_window).collect(),
        compressions: headers.iter().map(|h| h.compression).collect(),
        reading: reading(headers, file_bytes),
    }
}

impl ExrHeader {
    /// The part of a channel; the first one where there is none of that name.
    pub fn part_of(&self, channel: Option<&str>) -> usize {
        self.channels.iter().find(|c| Some(c.name.as_str()) == channel).map_or(0, |c| c.part)
    }
}

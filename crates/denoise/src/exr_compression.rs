//! Compressions that the decoder does not know, by name; and blocks of DWA, whose decoder trusts their
//! counters: they are held against the block before it sees them.

use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock};
use exr::compression::Compression;
use exr::meta::header::Header;
use exr::prelude::Vec2;
use std::io::Read;
use std::path::Path;

/// Codes of the header's `compression`, by OpenEXR 3.5.
const NAMES: [(u8, &str); 4] = [(10, "HTJ2K256"), (11, "HTJ2K32"), (12, "LJ2K"), (13, "ZSTD")];
/// The attribute is looked for in so many bytes.
const HEADER: u64 = 1 << 16;
/// Counters at the start of a block of DWA, 64 bits each.
const COUNTERS: usize = 11;
/// Side of the blocks whose frequencies DWA stores.
const SIDE: usize = 8;

/// The problem of a file whose compression the decoder does not know.
pub fn unknown(path: &Path) -> String {
    let mut start = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(HEADER).read_to_end(&mut start));
    let code = read.ok().and_then(|_| code(&start));
    match (NAMES.iter().find(|(known, _)| Some(*known) == code), code) {
        (Some((_, name)), _) => not_read(&format!("it is compressed with {name}")),
        (None, Some(code)) => not_read(&format!("its compression has the number {code}")),
        (None, None) => not_read("its compression is unknown"),
    }
}

/// The problem of a compression that the decoder knows by name alone.
pub fn unread(compression: Compression) -> Option<String> {
    match compression {
        Compression::HTJ2K256 => Some(not_read("it is compressed with HTJ2K256")),
        Compression::HTJ2K32 => Some(not_read("it is compressed with HTJ2K32")),
        _ => None,
    }
}

fn not_read(what: &str) -> String {
    format!("{what}, which is not read here; write ZIP, ZIPS, PIZ or no compression, for example with `oiiotool IN.exr --compression zip -o OUT.exr`")
}

fn code(header: &[u8]) -> Option<u8> {
    const ATTRIBUTE: &[u8] = b"compression\0compression\0\x01\0\0\0";
    let at = header.windows(ATTRIBUTE.len()).position(|w| w == ATTRIBUTE)?;
    header.get(at + ATTRIBUTE.len()).copied()
}

/// Whether the counters of a block of DWA, as `headers` have it, are within what the block can hold.
pub fn check(chunk: &Chunk, headers: &[Header]) -> Result<(), String> {
    let Some(header) = headers.get(chunk.layer_index) else { return Ok(()) };
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let (CompressedBlock::ScanLine(CompressedScanLineBlock { compressed_pixels_le: bytes, .. })
    | CompressedBlock::Tile(CompressedTileBlock { compressed_pixels_le: bytes, .. })) = &chunk.compressed_block
    else {
        return Ok(());
    };
    let place = header.get_block_data_indices(&chunk.compressed_block);
    // The decoder names what is wrong with the place.
    let Ok(area) = place.and_then(|place| header.get_absolute_block_pixel_coordinates(place)) else { return Ok(()) };
    let Vec2(width, height) = area.size;
    let raw: usize = header.channels.list.iter().map(|c| c.sample_type.bytes_per_sample() * width * height).sum();
    // A block that compression would not have made smaller is stored as it is.
    if bytes.is_empty() || bytes.len() == raw {
        return Ok(());
    }
    let blocks = width.div_ceil(SIDE) * height.div_ceil(SIDE) * header.channels.list.len();
    within(bytes, raw as u64, blocks as u64)
}

/// The counters: version; sizes of what is not known, plain and packed; packed AC, DC and RLE; RLE
/// before and behind its runs; numbers of AC and DC values; how AC is packed.
fn within(bytes: &[u8], raw: u64, blocks: u64) -> Result<(), String> {
    let counter = |i: usize| {
        let bytes = bytes.get(8 * i..8 * i + 8)?;
        Some(u64::from_le_bytes(<[u8; 8]>::try_from(bytes).ok()?))
    };
    let read: Option<Vec<u64>> = (0..COUNTERS).map(counter).collect();
    let Some([_, plain, packed, ac, dc, rle, runs, unrolled, ac_values, dc_values, _]) =
        read.and_then(|counters| <[u64; COUNTERS]>::try_from(counters).ok())
    else {
        return Err("a block of DWA is cut off".to_owned());
    };
    let payload = (bytes.len() - 8 * COUNTERS) as u64;
    let sections = [packed, ac, dc, rle].into_iter().fold(0, u64::saturating_add);
    // Runs of one byte take two; every block has 64 frequencies at most, and one of them is its mean.
    let limits = [
        (plain, raw),
        (unrolled, raw),
        (runs, raw.saturating_mul(2)),
        (ac_values, blocks.saturating_mul(64)),
        (dc_values, blocks),
        (sections, payload),
    ];
    match limits.into_iter().find(|(value, limit)| value > limit) {
        Some((value, limit)) => Err(format!("a block of DWA claims {value} of what can be {limit} at most; the file is corrupt")),
        None => Ok(()),
    }
}

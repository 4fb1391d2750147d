//! Reads channels of an EXR file into planes that cover the picture: its display window and overscan.

use crate::error::{Result, ToolError};
use crate::exr_compression;
use crate::exr_header::{from_exr, open, Channel, ExrHeader};
use crate::panics::caught;
use exr::block::chunk::Chunk;
use exr::block::UncompressedBlock;
use exr::math::Vec2;
use exr::meta::attribute::SampleType;
use exr::meta::MetaData;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::mpsc::{sync_channel, SyncSender};
use std::sync::Mutex;

/// Files below this many compressed bytes are decoded on one thread: starting more takes longer.
const PARALLEL_BYTES: usize = 1 << 20;

/// Samples of one channel, row by row, top row first.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Half or float.
    Float(Vec<f32>),
    /// Unsigned integers.
    Uint(Vec<u32>),
}

/// The channels that were asked for, by name, and what the file says about itself.
#[derive(Debug)]
pub struct Planes {
    /// Header.
    pub header: ExrHeader,
    /// Samples by channel name. What lies outside the data window is 0.
    pub samples: BTreeMap<String, Samples>,
}

/// Reads the header alone.
pub fn read_header(path: &Path) -> Result<ExrHeader> {
    Ok(open(path)?.header)
}

/// Reads those channels of a file that `wanted` picks.
pub fn read(path: &Path, mut wanted: impl FnMut(&Channel) -> bool) -> Result<Planes> {
    let file = open(path)?;
    let header = file.header;
    let picked: Vec<Channel> = header.channels.iter().filter(|&c| wanted(c)).cloned().collect();
    if picked.is_empty() {
        return Ok(Planes { header, samples: BTreeMap::new() });
    }
    let mut target = Target::new(&header, &picked);
    let meta = file.reader.meta_data().clone();
    let reader = caught(|| file.reader.all_chunks(false)).map_err(|p| ToolError::exr(path, p))?.map_err(|e| from_exr(path, e))?;
    let mut chunks = Vec::new();
    for chunk in caught(|| reader.collect::<Vec<_>>()).map_err(|p| ToolError::exr(path, p))? {
        let chunk = chunk.map_err(|e| from_exr(path, e))?;
        if picked.iter().any(|c| c.part == chunk.layer_index) {
            chunks.push(chunk);
        }
    }
    decode(path, &meta, chunks, |block| target.insert(&meta, &block))?;
    target.complete(path)?;
    let names = picked.into_iter().map(|c| c.name);
    Ok(Planes { samples: names.zip(target.planes.into_iter().map(|p| p.samples)).collect(), header })
}

fn decode(path: &Path, meta: &MetaData, chunks: Vec<Chunk>, mut insert: impl FnMut(UncompressedBlock)) -> Result<()> {
    let one = |chunk: Chunk| match exr_compression::check(&chunk, &meta.headers)
        .and_then(|()| caught(|| UncompressedBlock::decompress_chunk(chunk, meta, false)))
    {
        Ok(block) => block.map_err(|e| from_exr(path, e)),
        Err(problem) => Err(ToolError::exr(path, problem)),
    };
    let bytes: usize = chunks.iter().map(chunk_bytes).sum();
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(chunks.len());
    if bytes < PARALLEL_BYTES || threads < 2 {
        for chunk in chunks {
            insert(one(chunk)?);
        }
        return Ok(());
    }
    let queue = Mutex::new(chunks.into_iter());
    std::thread::scope(|scope| {
        let (sender, receiver) = sync_channel(2 * threads);
        for _ in 0..threads {
            let sender: SyncSender<Result<UncompressedBlock>> = sender.clone();
            scope.spawn(|| work(&queue, one, sender));
        }
        drop(sender);
        // The receiver is dropped on the first error, which ends the workers.
        receiver.into_iter().try_for_each(|block| block.map(&mut insert))
    })
}

fn work(
    queue: &Mutex<std::vec::IntoIter<Chunk>>,
    one: impl Fn(Chunk) -> Result<UncompressedBlock>,
    sender: SyncSender<Result<UncompressedBlock>>,
) {
    let next = || queue.lock().ok().and_then(|mut q| q.next());
    while let Some(chunk) = next() {
        if sender.send(one(chunk)).is_err() {
            return;
        }
    }
}

fn chunk_bytes(chunk: &Chunk) -> usize {
    use exr::block::chunk::CompressedBlock::{ScanLine, Tile};
    match &chunk.compressed_block {
        ScanLine(b) => b.compressed_pixels_le.len(),
        Tile(b) => b.compressed_pixels_le.len(),
        _ => 0,
    }
}

struct Plane {
    samples: Samples,
    /// Lines of the data window that were filled; a file that lacks some is truncated.
    filled: usize,
    expected: usize,
}

/// The place of decoded lines.
struct Target {
    width: i64,
    height: i64,
    /// Picture relative to each part's data window.
    offsets: Vec<[i64; 2]>,
    /// (part, channel in the part) to plane.
    index: BTreeMap<(usize, usize), usize>,
    planes: Vec<Plane>,
    /// Blocks that came: a corrupt file may hold one twice in place of another.
    seen: BTreeSet<(usize, usize, usize)>,
}

impl Target {
    fn new(header: &ExrHeader, picked: &[Channel]) -> Self {
        let window = header.window.position;
        let area = header.extent[0] as usize * header.extent[1] as usize;
        let offset = |at: Vec2<i32>| [i64::from(at.0) - i64::from(window.0), i64::from(at.1) - i64::from(window.1)];
        let plane = |c: &Channel| Plane {
            samples: if c.sample_type == SampleType::U32 { Samples::Uint(vec![0; area]) } else { Samples::Float(vec![0.0; area]) },
            filled: 0,
            expected: header.part_windows[c.part].size.area(),
        };
        Self {
            width: i64::from(header.extent[0]),
            height: i64::from(header.extent[1]),
            offsets: header.parts.iter().map(|p| offset(p.layer_position)).collect(),
            index: picked.iter().enumerate().map(|(plane, c)| ((c.part, c.index), plane)).collect(),
            planes: picked.iter().map(plane).collect(),
            seen: BTreeSet::new(),
        }
    }

    fn insert(&mut self, meta: &MetaData, block: &UncompressedBlock) {
        let part = block.index.layer;
        // Coarser levels of a mip map are not needed.
        let at = block.index.pixel_position;
        if block.index.level != Vec2(0, 0) || !self.seen.insert((part, at.0, at.1)) {
            return;
        }
        let list = &meta.headers[part].channels;
        for line in block.lines(list) {
            let Some(&plane) = self.index.get(&(part, line.location.channel)) else { continue };
            let plane = &mut self.planes[plane];
            plane.filled += line.location.sample_count;
            let x0 = line.location.position.0 as i64 + self.offsets[part][0];
            let y = line.location.position.1 as i64 + self.offsets[part][1];
            // Only the part of the line that is inside the picture.
            let (from, to) = ((-x0).max(0), (self.width - x0).min(line.location.sample_count as i64));
            if !(0..self.height).contains(&y) || from >= to {
                continue;
            }
            let (from, to, start) = (from as usize, to as usize, (y * self.width + x0 + from) as usize);
            let into = start..start + (to - from);
            match (&mut plane.samples, list.list[line.location.channel].sample_type) {
                (Samples::Uint(out), _) => convert(&mut out[into], &line.value[from * 4..to * 4], u32::from_ne_bytes),
                (Samples::Float(out), SampleType::F16) => {
                    convert(&mut out[into], &line.value[from * 2..to * 2], |b| half::f16::from_ne_bytes(b).to_f32());
                }
                (Samples::Float(out), _) => convert(&mut out[into], &line.value[from * 4..to * 4], f32::from_ne_bytes),
            }
        }
    }

    fn complete(&self, path: &Path) -> Result<()> {
        match self.planes.iter().all(|p| p.filled >= p.expected) {
            true => Ok(()),
            false => Err(ToolError::exr(path, "it is truncated or corrupt: some blocks of pixels are missing")),
        }
    }
}

fn convert<const N: usize, T>(out: &mut [T], bytes: &[u8], from: impl Fn([u8; N]) -> T) {
    for (value, chunk) in out.iter_mut().zip(bytes.chunks_exact(N)) {
        let mut sample = [0; N];
        sample.copy_from_slice(chunk);
        *value = from(sample);
    }
}

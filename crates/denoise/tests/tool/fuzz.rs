//! Corrupt files end in an error or in pixels: never in a panic, and never in a huge allocation.

use crate::samples::{frame, noise, Sample, Type};
use atrous_denoise::mapping::Mapping;
use atrous_denoise::{exr_header, exr_read};
use exr::compression::Compression;

/// Splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut v = self.0;
        v = (v ^ (v >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        v = (v ^ (v >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        v ^ (v >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

fn seeds() -> Vec<Vec<u8>> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("seed.exr");
    let all = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    let mut seeds = Vec::new();
    for compression in all {
        for tile in [None, Some(8)] {
            let kind = if matches!(compression, Compression::B44 | Compression::B44A) { Type::Half } else { Type::Float };
            let sample = Sample::new(24, 20).channel("R", kind, |x, y| noise(x, y, 1)).flat("G B Z", Type::Half, 0.5);
            Sample { compression, tile, ..sample.flat("id", Type::Uint, 3.0) }.write(&path);
            seeds.push(std::fs::read(&path).expect("a seed"));
        }
    }
    frame(0).write(&path);
    seeds.push(std::fs::read(&path).expect("a seed"));
    let part = Sample::new(8, 6).flat("R G B", Type::Half, 0.25);
    Sample::write_parts([("a", &part), ("b", &part)], &path);
    seeds.push(std::fs::read(&path).expect("a seed"));
    seeds
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    // Most of what decides is in the header.
    for _ in 0..1 + random.below(4) {
        let end = if random.below(2) == 0 { 400.min(bytes.len()) } else { bytes.len() };
        let at = random.below(end);
        match random.below(6) {
            0 => bytes[at] = random.next() as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][random.below(5)],
            3 => {
                // A number as the format has them: 32 bits, little endian.
                let value = [0u32, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff, 1 << 20][random.below(6)].to_le_bytes();
                let end = (at + 4).min(bytes.len());
                bytes[at..end].copy_from_slice(&value[..end - at]);
            }
            4 => bytes.truncate(at.max(1)),
            _ => {
                let (from, count) = (random.below(bytes.len()), random.below(16));
                let copied: Vec<u8> = bytes[from..(from + count).min(bytes.len())].to_vec();
                let end = (at + copied.len()).min(bytes.len());
                bytes[at..end].copy_from_slice(&copied[..end - at]);
            }
        }
    }
}

/// `ATROUS_FUZZ=1000000` runs longer than the default.
#[test]
fn mutated_files_are_errors_or_pictures() {
    let count = std::env::var("ATROUS_FUZZ").ok().and_then(|v| v.parse().ok()).unwrap_or(4000u64);
    let seeds = seeds();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("mutated.exr");
    let (mut good, mut bad) = (0u64, 0u64);
    for round in 0..count {
        let mut random = Random(round);
        let mut bytes = seeds[random.below(seeds.len())].clone();
        mutate(&mut bytes, &mut random);
        // Some file systems flush a file that is written over.
        let _ = std::fs::remove_file(&path);
        std::fs::write(&path, &bytes).expect("a file");
        // Caught inside the tool; caught here so that the round is told.
        let result = std::panic::catch_unwind(|| {
            let header = exr_read::read_header(&path)?;
            // Mutations of the size stay legal up to a point that is only slow.
            if u64::from(header.extent[0]) * u64::from(header.extent[1]) > 1 << 22 {
                return Ok(());
            }
            let _ = Mapping::choose(&path, &header, &[], None);
            exr_read::read(&path, |_| true).map(|_| ())
        });
        match result {
            Ok(Ok(())) => good += 1,
            Ok(Err(error)) => {
                assert!(error.to_string().contains("mutated.exr"), "round {round}: no file name in: {error}");
                bad += 1;
            }
            Err(_) => panic!("round {round} panicked"),
        }
    }
    assert!(good > 0 && bad > 0, "{good} good, {bad} bad");
}

#[test]
fn mutated_names_do_not_break_the_mapping() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    frame(0).write(&path);
    let header = exr_read::read_header(&path).expect("readable");
    let pieces =
        ["R", "G", ".", "..", "noisy", "ViewLayer", "Combined", "é", "", "normal", "X", "\u{1F600}", "depth", "Z", "I", "a.b.c"];
    for round in 0..20_000 {
        let mut random = Random(round);
        let mut changed = header.clone();
        for channel in &mut changed.channels {
            if random.below(2) == 0 {
                channel.name = (0..random.below(5)).map(|_| pieces[random.below(pieces.len())]).collect();
            }
        }
        let keep = random.below(changed.channels.len() + 1);
        changed.channels.truncate(keep);
        let named = [(atrous_denoise::roles::Role::Normal, pieces[random.below(pieces.len())].to_owned())];
        let view = pieces[random.below(pieces.len())];
        let _ = Mapping::choose(&path, &changed, &named[..random.below(2)], (random.below(4) == 0).then_some(view));
    }
}

#[test]
fn limits_are_those_of_the_library() {
    assert_eq!(exr_header::MAX_SIDE, atrous::Config::MAX_SIDE);
}

//! DWA, whose decoder trusts its counters, and compressions that are not read.

use crate::samples::{noise, Sample, Type};
use atrous_denoise::exr_read::{read, Samples};
use exr::compression::Compression;
use std::path::Path;

const SIDE: usize = 40;

fn sample(compression: Compression) -> Sample {
    let sample = Sample::new(SIDE, SIDE)
        .channel("R", Type::Half, |x, y| noise(x, y, 1))
        .flat("G B A", Type::Half, 0.5)
        .channel("Z", Type::Float, |x, y| noise(x, y, 2))
        .flat("id.I", Type::Uint, 7.0);
    Sample { compression, ..sample }
}

fn u64_at(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().expect("eight bytes"))
}

/// Where the first block's counters are, of a file with two blocks: behind the table of offsets, which
/// begins with the place right behind it, and behind the line and the size of the block.
fn counters(bytes: &[u8]) -> usize {
    let at = (100..bytes.len() - 16).find(|at| u64_at(bytes, *at) == *at as u64 + 16).expect("a table of offsets");
    at + 16 + 8
}

#[test]
fn dwa_is_read_as_far_as_it_loses_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    for compression in [Compression::DWAA(None), Compression::DWAB(None)] {
        sample(compression).write(&path);
        let planes = read(&path, |_| true).expect("readable");
        assert_eq!(planes.samples["id.I"], Samples::Uint(vec![7; SIDE * SIDE]), "{compression:?}");
        let Samples::Float(depth) = &planes.samples["Z"] else { panic!("floats") };
        assert_eq!(depth[SIDE + 3], noise(3, 1, 2), "{compression:?}");
    }
}

/// The third counter from the end of the process: each of them once made the decoder ask for as much
/// memory as it says.
#[test]
fn counters_of_dwa_that_cannot_be_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    sample(Compression::DWAA(None)).write(&path);
    let bytes = std::fs::read(&path).expect("a file");
    let at = counters(&bytes);
    assert_eq!(u64_at(&bytes, at), 2, "the version");
    for counter in 1..10 {
        for value in [1 << 40, u64::MAX >> 1, u64_at(&bytes, at + 8 * counter) + 100_000] {
            let mut changed = bytes.clone();
            changed[at + 8 * counter..at + 8 * counter + 8].copy_from_slice(&value.to_le_bytes());
            std::fs::write(&path, changed).expect("a file");
            let message = read(&path, |_| true).expect_err("a counter that cannot be").to_string();
            assert!(message.contains("a.exr") && message.contains("DWA claims"), "{counter}: {message}");
        }
    }
}

#[test]
fn compressions_that_are_not_read_are_named_with_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    // In one block, whatever the compression.
    Sample::new(8, 8).flat("R G B", Type::Half, 0.5).write(&path);
    let bytes = std::fs::read(&path).expect("a file");
    let key = b"compression\0compression\0\x01\0\0\0";
    let at = bytes.windows(key.len()).position(|w| w == key).expect("the attribute") + key.len();
    let message = |code: u8, path: &Path| {
        let mut changed = bytes.clone();
        changed[at] = code;
        std::fs::write(path, changed).expect("a file");
        read(path, |_| true).expect_err("not read").to_string()
    };
    for (code, name) in [(10, "HTJ2K256"), (11, "HTJ2K32"), (12, "LJ2K"), (13, "ZSTD"), (77, "number 77")] {
        let message = message(code, &path);
        assert!(message.contains(name) && message.contains("--compression zip"), "{message}");
    }
}

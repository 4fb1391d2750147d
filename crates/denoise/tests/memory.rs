//! Memory that a run is said to take, held against what it allocates. A program of its own: nothing else allocates beside it.

use atrous_denoise::cli::Cli;
use atrous_denoise::error::Result;
use atrous_denoise::memory::{fitting_queue, Demands, Free, Need};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{frame, frame_files};
use clap::Parser;
use fastrand::Rng;
use peak_alloc::PeakAlloc;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Width and height of the frames that are filtered.
const SIDE: usize = 192;

/// Held by the test that runs: what another one allocates would count as its own.
static ALONE: Mutex<()> = Mutex::new(());

/// What `work` gives, and the bytes that it had allocated at its peak.
fn measured<T>(work: impl FnOnce() -> T) -> (T, u64) {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let result = work();
    (result, ALLOCATOR.peak_usage().saturating_sub(before) as u64)
}

/// Colour alone, or with albedo, normal, depth and a reference.
fn write(path: &Path, guides: bool, side: usize) {
    use exr::prelude::*;
    let noise = |x: usize, y: usize| ((x * 31 + y * 17) % 64) as f32 / 32.0;
    let samples = || FlatSamples::F32((0..side * side).map(|i| noise(i % side, i / side)).collect());
    let names =
        ["B", "G", "R", "Z", "albedo.B", "albedo.G", "albedo.R", "normal.X", "normal.Y", "normal.Z", "ref.B", "ref.G", "ref.R"];
    let channels = names.iter().take(if guides { names.len() } else { 3 }).map(|name| AnyChannel::new(*name, samples()));
    let image = Image::from_channels((side, side), AnyChannels::sort(channels.collect()));
    image.write().to_file(path).expect("a sample");
}

#[test]
fn a_run_takes_what_it_is_said_to_take() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    for (frames, guides, more) in [
        (1, false, &["--preset", "eaw", "--levels", "1"][..]),
        (1, true, &["--preset", "svgf", "--levels", "2", "--score", "--png", "--strip", "--report"]),
        (9, true, &["--preset", "fast", "--levels", "1", "--score"]),
        (2, false, &["--preset", "svgf", "--levels", "1", "--views"]),
    ] {
        let (input, output) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
        for number in 0..frames {
            write(&input.path().join(format!("frame_{number:04}.exr")), guides, SIDE);
        }
        let path = |folder: &tempfile::TempDir| folder.path().to_str().expect("UTF-8").to_owned();
        let fixed = ["atrous-denoise", "--quiet", "--device", "reference", &path(&input), "-o", &path(&output)].map(str::to_owned);
        let cli = Cli::parse_from(fixed.iter().map(String::as_str).chain(more.iter().copied()));
        let setup = Setup::new(&frame_files::find(&cli.frames).expect("frames"), &cli.options()).expect("a setup");
        let has = |option: &str| more.contains(&option);
        let demands = Demands {
            frames,
            queue: atrous_denoise::pipeline::QUEUE,
            filtered: true,
            reference: true,
            score: has("--score"),
            pictures: has("--png"),
            views: has("--views"),
        };
        let need = Need::new(&setup, &demands).expect("a need");
        let said = need.frames + need.reading + need.filter + need.writing;
        let (run, taken) = measured(|| atrous_denoise::tool::run(&cli));
        run.expect("a run");
        assert!(taken <= said, "{more:?}: {taken} bytes were taken, where {said} were said: {need:?}");
        assert!(4 * taken >= said, "{more:?}: {said} bytes were said, where {taken} were taken: {need:?}");
    }
}

/// Fewer frames wait where memory is short; where none may, the message has what would fit.
#[test]
fn frames_wait_where_there_is_memory_for_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("frame_0000.exr");
    write(&path, true, SIDE);
    let setup = Setup::new(&frame_files::find(&[folder.path().to_owned()]).expect("frames"), &Options::default()).expect("a setup");
    let demands = Demands { frames: 100, filtered: true, reference: true, score: true, ..Demands::default() };
    let total = |queue| Need::new(&setup, &Demands { queue, ..demands }).expect("a need").total();
    let fitting = |bytes| fitting_queue(&path, &setup, &demands, Some(Free { bytes, limit: "limit of a test" }));
    assert!(total(0) < total(1) && total(1) < total(2));
    for queue in 0..3 {
        assert_eq!(fitting(total(queue)).expect("fits"), queue);
    }
    assert_eq!(fitting(total(1) - 1).expect("fits"), 0);
    assert_eq!(fitting_queue(&path, &setup, &demands, None).expect("fits"), 2, "a system that does not tell");

    let message = fitting(total(0) - 1).expect_err("does not fit").to_string();
    let fit = format!("{} MiB, which fit", Need::new(&setup, &Demands { score: false, ..demands }).expect("a need").total() >> 20);
    for word in ["limit of a test", "Without --score", &fit, "191x191 pixels fit", "overlap by 30 pixels"] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

/// Most bytes of a run that is tried, and of one that is only looked at.
const TRIED: u64 = 32 << 20;
const LOOKED_AT: u64 = 8 << 20;

/// A file of a few pixels with numbers of its header changed: windows, tiles, whatever is there.
fn mutated(seed: &[u8], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    let keys: [&[u8]; 3] = [b"dataWindow\0box2i\0", b"displayWindow\0box2i\0", b"channels\0chlist\0"];
    for _ in 0..1 + rng.u8(..3) {
        let key = keys[rng.usize(..3)];
        let start = bytes.windows(key.len()).position(|w| w == key).map_or(0, |at| at + key.len() + 4);
        let at = start + 4 * rng.usize(..4);
        let value = rng.choice([0, 1, 7, 63, 255, 1023, 4095, 8191, 16383, 70_000, i32::MAX, -1, -100, i32::MIN]).unwrap_or(0);
        if let Some(place) = bytes.get_mut(at..at + 4) {
            place.copy_from_slice(&value.to_le_bytes());
        }
    }
    bytes
}

/// Sees whether what is said holds for a file, and reads it where it is little. Whether a frame came out.
fn read_within_limits(folder: &Path) -> Result<bool> {
    let files = frame_files::find(&[folder.to_owned()])?;
    let (setup, taken) = measured(|| Setup::new(&files, &Options::default()));
    assert!(taken < LOOKED_AT, "{taken} bytes were taken for a header");
    let setup = setup?;
    let need = Need::new(&setup, &Demands { frames: 1, ..Demands::default() })?;
    let said = need.frames + need.reading;
    if said > TRIED {
        return Ok(false);
    }
    let (frame, taken) = measured(|| frame::load(&files[0], &setup).map(|_| ()));
    assert!(taken <= said + (1 << 20), "{taken} bytes were taken, where {said} were said: {need:?}");
    frame.map(|()| true)
}

/// `ATROUS_FUZZ=1000000` runs longer than the default.
#[test]
fn mutated_headers_take_no_more_than_is_said() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let count = std::env::var("ATROUS_FUZZ").ok().and_then(|v| v.parse().ok()).unwrap_or(1500u64);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("frame_0000.exr");
    let seeds = [false, true].map(|guides| {
        write(&path, guides, 8);
        std::fs::read(&path).expect("a seed")
    });
    let (mut good, mut large, mut bad) = (0u64, 0u64, 0u64);
    for round in 0..count {
        let mut rng = Rng::with_seed(round);
        let bytes = mutated(&seeds[rng.usize(..2)], &mut rng);
        // Some file systems flush a file that is written over.
        let _ = std::fs::remove_file(&path);
        std::fs::write(&path, &bytes).expect("a file");
        match std::panic::catch_unwind(|| read_within_limits(folder.path())) {
            Ok(Ok(true)) => good += 1,
            Ok(Ok(false)) => large += 1,
            Ok(Err(error)) => {
                assert!(error.to_string().contains("frame_0000.exr"), "round {round}: no file name in: {error}");
                bad += 1;
            }
            Err(_) => panic!("round {round} panicked"),
        }
    }
    assert!(good > 0 && large > 0 && bad > 0, "{good} good, {large} large, {bad} bad");
}

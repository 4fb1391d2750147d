//! Memory that a run is said to take, held against what it allocates. A program of its own: nothing else allocates beside it.

use atrous_denoise::cli::Cli;
use atrous_denoise::frame_files;
use atrous_denoise::memory::{fitting_queue, Demands, Free, Need};
use atrous_denoise::setup::{Options, Setup};
use clap::Parser;
use peak_alloc::PeakAlloc;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Held by each test, since allocations of the others would count.
static ALONE: Mutex<()> = Mutex::new(());

/// Width and height of the frames that are filtered.
const SIDE: usize = 192;

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
            filtered: true,
            reference: true,
            score: has("--score"),
            pictures: has("--png"),
            views: has("--views"),
            kept: 0,
        };
        let need = Need::new(&setup, &demands, atrous_denoise::memory::QUEUE).expect("a need");
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
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("frame_0000.exr");
    write(&path, true, SIDE);
    let setup = Setup::new(&frame_files::find(&[folder.path().to_owned()]).expect("frames"), &Options::default()).expect("a setup");
    let demands = Demands { frames: 100, filtered: true, reference: true, score: true, ..Demands::default() };
    let total = |queue| Need::new(&setup, &demands, queue).expect("a need").total();
    let fitting = |bytes| fitting_queue(&path, &setup, &demands, Some(Free { bytes, limit: "limit of a test" }));
    assert!(total(0) < total(1) && total(1) < total(2));
    for queue in 0..3 {
        assert_eq!(fitting(total(queue)).expect("fits"), queue);
    }
    assert_eq!(fitting(total(1) - 1).expect("fits"), 0);
    assert_eq!(fitting_queue(&path, &setup, &demands, None).expect("fits"), 2, "a system that does not tell");

    let message = fitting(total(0) - 1).expect_err("does not fit").to_string();
    let fit =
        format!("{} MiB, which fit", Need::new(&setup, &Demands { score: false, ..demands }, 0).expect("a need").total() >> 20);
    for word in ["limit of a test", "Without --score", &fit, "191x191 pixels fit", "overlap by 62 pixels"] {
        assert!(message.contains(word), "{word}: {message}");
    }
}

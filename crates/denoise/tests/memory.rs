//! Memory that a run is said to take, held against what it allocates. A program of its own: nothing else allocates beside it.

use atrous_denoise::cli::Cli;
use atrous_denoise::frame_files;
use atrous_denoise::memory::{Demands, Need};
use atrous_denoise::setup::{Options, Setup};
use clap::Parser;
use peak_alloc::PeakAlloc;
use std::path::Path;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

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
        };
        let need = Need::new(&setup, &demands).expect("a need");
        let said = need.frames + need.reading + need.filter + need.writing;
        let (run, taken) = measured(|| atrous_denoise::tool::run(&cli));
        run.expect("a run");
        assert!(taken <= said, "{more:?}: {taken} bytes were taken, where {said} were said: {need:?}");
        assert!(4 * taken >= said, "{more:?}: {said} bytes were said, where {taken} were taken: {need:?}");
    }
}

//! Memory that a run is said to take, held against what it allocates. A program of its own: nothing else allocates beside it.

use atrous_denoise::cli::Cli;
use atrous_denoise::frame_files;
use atrous_denoise::memory::{Demands, Need};
use atrous_denoise::setup::Setup;
use clap::Parser;
use peak_alloc::PeakAlloc;
use std::path::Path;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

const SIDE: usize = 192;

/// Colour alone, or with albedo, normal, depth and a reference.
fn write(path: &Path, guides: bool) {
    use exr::prelude::*;
    let noise = |x: usize, y: usize| ((x * 31 + y * 17) % 64) as f32 / 32.0;
    let samples = || FlatSamples::F32((0..SIDE * SIDE).map(|i| noise(i % SIDE, i / SIDE)).collect());
    let names =
        ["B", "G", "R", "Z", "albedo.B", "albedo.G", "albedo.R", "normal.X", "normal.Y", "normal.Z", "ref.B", "ref.G", "ref.R"];
    let channels = names.iter().take(if guides { names.len() } else { 3 }).map(|name| AnyChannel::new(*name, samples()));
    let image = Image::from_channels((SIDE, SIDE), AnyChannels::sort(channels.collect()));
    image.write().to_file(path).expect("a sample");
}

#[test]
fn a_run_takes_what_it_is_said_to_take() {
    for (frames, guides, more) in [
        (1, false, &["--preset", "eaw", "--levels", "1"][..]),
        (1, true, &["--preset", "svgf", "--levels", "2", "--score", "--png", "--strip"]),
        (9, true, &["--preset", "fast", "--levels", "1", "--score"]),
        (2, false, &["--preset", "svgf", "--levels", "1", "--views"]),
    ] {
        let (input, output) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
        for number in 0..frames {
            write(&input.path().join(format!("frame_{number:04}.exr")), guides);
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
        let before = ALLOCATOR.current_usage();
        ALLOCATOR.reset_peak_usage();
        atrous_denoise::tool::run(&cli).expect("a run");
        let taken = (ALLOCATOR.peak_usage() - before) as u64;
        assert!(taken <= said, "{more:?}: {taken} bytes were taken, where {said} were said: {need:?}");
        assert!(4 * taken >= said, "{more:?}: {said} bytes were said, where {taken} were taken: {need:?}");
    }
}

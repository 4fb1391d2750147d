//! `sequence.json`: descriptions of sequences with odd values in odd places.

use crate::Outcome;
use atrous_denoise::memory::{Demands, Need};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{camera, frame, frame_files};
use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image, WritableImage};
use std::path::Path;

const NAME: &str = "sequence.json";

/// Writes a frame of a few pixels into a folder, beside which descriptions can stand.
pub fn prepare(folder: &Path) {
    const SIDE: usize = 8;
    let names = ["B", "G", "R", "Z", "albedo.B", "albedo.G", "albedo.R", "normal.X", "normal.Y", "normal.Z"];
    let samples = || FlatSamples::F32((0..SIDE * SIDE).map(|i| (i * 31 % 64) as f32 / 32.0).collect());
    let channels = names.iter().map(|name| AnyChannel::new(*name, samples())).collect();
    let image = Image::from_channels((SIDE, SIDE), AnyChannels::sort(channels));
    image.write().to_file(folder.join("frame_0000.exr")).expect("a frame");
}

/// Writes the bytes beside the frame of a folder that was prepared, and goes the whole way to that frame.
pub fn attack(folder: &Path, bytes: &[u8]) -> Outcome {
    let path = folder.join(NAME);
    replace(&path, bytes);
    let result = used(folder);
    if let Err(error) = &result {
        assert!(!error.to_string().is_empty());
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        if let Err(error) = camera::parse(&path, text) {
            assert!(error.to_string().contains(NAME), "no file name in: {error}");
        }
    }
    result.map_or(Outcome::Refused, |()| Outcome::Used)
}

fn used(folder: &Path) -> atrous_denoise::error::Result<()> {
    let files = frame_files::find(&[folder.to_owned()])?;
    let setup = Setup::new(&files, &Options::default())?;
    Need::new(&setup, &Demands { frames: 1, filtered: true, ..Demands::default() }, 0)?;
    frame::load(&files[0], &setup).map(drop)
}

/// Writes a file in place of another. Some file systems flush a file that is written over.
pub(crate) fn replace(path: &Path, bytes: &[u8]) {
    _ = std::fs::remove_file(path);
    std::fs::write(path, bytes).expect("a file");
}

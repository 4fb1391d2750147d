//! `--resume` gives what an uninterrupted run gives, or says why it cannot.

use crate::samples::{denoise, frame_path, sequence};
use ash::vk::Format;
use atrous::capture::{InputFrame, InputImage, SequenceWriter};
use atrous::config::Preset;
use atrous::{Config, Tuning};
use atrous_denoise::error::ToolError;
use atrous_denoise::exr_read::{read, Samples};
use atrous_synthetic::scene::Scene;
use std::path::Path;

fn output() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn frames_that_are_cut_off_are_made_again() {
    let (input, whole, resumed) = (sequence(3), output(), output());
    for folder in [&whole, &resumed] {
        denoise(input.path(), folder.path(), &[]).expect("a run");
    }
    let bytes = |folder: &tempfile::TempDir, number| std::fs::read(frame_path(folder.path(), number)).expect("a result");
    // Behind the header, and a byte short.
    let first = bytes(&resumed, 0);
    for (number, length) in [(0, first.len() - 200), (1, first.len() - 1)] {
        let path = frame_path(resumed.path(), number);
        std::fs::write(&path, &first[..length]).expect("a file");
        assert!(atrous_denoise::exr_read::read_header(&path).is_ok());
    }
    denoise(input.path(), resumed.path(), &["--resume"]).expect("resumed");
    for number in 0..3 {
        assert!(bytes(&whole, number) == bytes(&resumed, number), "frame {number}");
    }
}

#[test]
fn results_of_other_options_are_not_mixed() {
    let (input, out) = (sequence(2), output());
    denoise(input.path(), out.path(), &["--set", "alpha=0.3"]).expect("a run");
    std::fs::remove_file(frame_path(out.path(), 1)).expect("removed");
    let before = std::fs::read(frame_path(out.path(), 0)).expect("a result");
    let same = ["--resume", "--set", "alpha=0.3"];
    for (more, words) in [
        (&["--resume"][..], ["`set.alpha`", "null"]),
        (&["--resume", "--set", "alpha=0.4"], ["`set.alpha`", "0.4"]),
        (&[&same[..], &["--preset", "eaw"]].concat(), ["`config.preset`", "eaw"]),
        (&[&same[..], &["--levels", "2"]].concat(), ["`config.levels`", "2"]),
        (&[&same[..], &["--keep-samples", "checkerboard"]].concat(), ["`config.sampling`", "one_of_2x2"]),
        (&[&same[..], &["--signals", "together"]].concat(), ["`config.signals`", "together"]),
        (&[&same[..], &["--convention", "background_depth=7"]].concat(), ["`config.conventions.background_depth`", "7"]),
        (&[&same[..], &["--channel", "albedo=none"]].concat(), ["`channel.albedo`", "albedo.R"]),
        (&[&same[..], &["--float"]].concat(), ["`float`", "true"]),
        (&[&same[..], &["--png"]].concat(), ["`exposure`", "1"]),
    ] {
        let error = denoise(input.path(), out.path(), more).expect_err("other options");
        let message = error.to_string();
        assert!(matches!(&error, ToolError::OtherOptions { path, .. } if path.ends_with("frame_0000.exr")), "{message}");
        assert!(words.iter().all(|word| message.contains(word)) && message.contains("--force"), "{more:?}: {message}");
    }
    assert!(std::fs::read(frame_path(out.path(), 0)).expect("a result") == before && !frame_path(out.path(), 1).exists());
    // Pictures of finished frames are no other options.
    denoise(input.path(), out.path(), &[&same[..], &["--strip", "--score"]].concat()).expect("resumed");
    // A file that some other program made.
    crate::samples::frame(0).write(&frame_path(out.path(), 0));
    let message = denoise(input.path(), out.path(), &same).expect_err("no options").to_string();
    assert!(message.contains("does not say") && message.contains("frame_0000.exr"), "{message}");
}

#[test]
fn other_matrices_are_not_mixed() {
    let (input, out) = (tempfile::tempdir().expect("a folder"), output());
    capture(input.path(), 2, 0);
    denoise(input.path(), out.path(), &[]).expect("a run");
    let path = input.path().join("sequence.json");
    let text = std::fs::read_to_string(&path).expect("a file").replace("\"jitter\":[0.0,0.0]", "\"jitter\":[0.5,0.0]");
    std::fs::write(&path, text).expect("a file");
    let message = denoise(input.path(), out.path(), &["--resume"]).expect_err("other matrices").to_string();
    assert!(message.contains("sequence.json"), "{message}");
}

const EXTENT: [u32; 2] = [48, 27];

/// What an engine with A-SVGF was given from its frame `first` on, where it re-shades.
fn capture(folder: &Path, frames: u32, first: u64) {
    let config = Config { preset: Preset::Asvgf, surface_id: false, ..Config::new(EXTENT) };
    let mut writer = SequenceWriter::new(folder, &config.declare().expect("valid")).expect("a writer");
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    for number in 0..frames {
        let guides = scene.frame(number, number);
        let texels = [("depth", &guides.depth), ("normal", &guides.normal), ("noisy_radiance", &guides.noisy_radiance)];
        let image = |(name, texels)| {
            let texels: &Vec<[f32; 4]> = texels;
            InputImage { name, format: Format::R32G32B32A32_SFLOAT, texels: bytemuck::cast_slice(texels) }
        };
        let images = texels.map(image);
        let params = atrous::FrameParams { reshaded: true, ..scene.params(number) };
        let tuning = Tuning::for_preset(config.preset);
        let index = first + u64::from(number);
        let frame = InputFrame { index, params: &params, tuning: &tuning, images: &images, instance_transforms: None };
        writer.write_frame(&frame).expect("written");
    }
}

fn red(folder: &Path, number: u32) -> Vec<f32> {
    match read(&frame_path(folder, number), |c| c.name == "R").expect("a result").samples.remove("R") {
        Some(Samples::Float(values)) => values,
        other => panic!("{other:?}"),
    }
}

/// Root of the mean squared difference, over the mean.
fn difference(a: &[f32], b: &[f32]) -> f32 {
    let squares: f32 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (squares / a.len() as f32).sqrt() / (a.iter().sum::<f32>() / a.len() as f32)
}

/// Which pixels are re-shaded depends on the number of the frame.
#[test]
fn a_resumed_capture_takes_the_pixels_that_were_re_shaded() {
    const LAST: u32 = 13;
    let (input, shifted) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let (whole, other) = (output(), output());
    capture(input.path(), LAST + 1, 1000);
    denoise(input.path(), whole.path(), &["--float"]).expect("a run");
    let expected = red(whole.path(), LAST);
    std::fs::remove_file(frame_path(whole.path(), LAST)).expect("removed");
    denoise(input.path(), whole.path(), &["--float", "--resume", "--warm-up", "10"]).expect("resumed");
    let resumed = difference(&expected, &red(whole.path(), LAST));
    // The same pictures, captured when the engine counted otherwise.
    capture(shifted.path(), LAST + 1, 0);
    denoise(shifted.path(), other.path(), &["--float"]).expect("a run");
    let shifted = difference(&expected, &red(other.path(), LAST));
    assert!(resumed < 0.1 * shifted, "a resumed run differs by {resumed}, one of other pixels by {shifted}");
}

#[test]
fn what_a_killed_run_left_is_cleared_away() {
    let (input, out) = (sequence(2), output());
    denoise(input.path(), out.path(), &[]).expect("a run");
    std::fs::remove_file(frame_path(out.path(), 1)).expect("removed");
    std::fs::write(out.path().join(".atrous-killed.part"), "half").expect("a file");
    denoise(input.path(), out.path(), &["--resume"]).expect("resumed");
    let names = std::fs::read_dir(out.path()).expect("a folder").map(|e| e.expect("a file").file_name());
    assert!(names.into_iter().all(|name| !name.to_string_lossy().ends_with(".part")));
}

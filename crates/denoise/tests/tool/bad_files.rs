//! Bad input and bad output: an error that names the file, and what was finished stays.

use crate::samples::{self, denoise, frame_path, sequence, Sample, Type};
use atrous_denoise::error::ToolError;
use atrous_denoise::exr_read::{read, read_header};
use std::path::Path;

fn fails(path: &Path, part: &str) {
    let message = match read(path, |_| true) {
        Ok(_) => panic!("{part}: was read"),
        Err(error) => error.to_string(),
    };
    let name = path.file_name().and_then(|n| n.to_str()).expect("a name");
    assert!(message.contains(name) && message.contains(part), "{message}");
}

#[test]
fn truncated_at_every_length() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("cut.exr");
    samples::frame(0).write(&path);
    let bytes = std::fs::read(&path).expect("a file");
    for length in (0..bytes.len()).step_by(37).chain([bytes.len() - 1]) {
        std::fs::write(&path, &bytes[..length]).expect("a file");
        fails(&path, "EXR");
    }
}

#[test]
fn other_files_and_folders() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("text.exr");
    std::fs::write(&path, "this is no picture, it is a text of some length").expect("a file");
    fails(&path, "EXR");
    fails(&folder.path().join("absent.exr"), "cannot be read");
    let inner = folder.path().join("folder.exr");
    std::fs::create_dir(&inner).expect("a folder");
    fails(&inner, "");
}

/// Replaces the windows of a header, which are four 32-bit numbers after the name of the attribute and of its type.
fn with_window(bytes: &[u8], attribute: &str, window: [i32; 4]) -> Vec<u8> {
    let key = format!("{attribute}\0box2i\0");
    let at = bytes.windows(key.len()).position(|w| w == key.as_bytes()).expect("the attribute") + key.len() + 4;
    let mut changed = bytes.to_vec();
    for (i, value) in window.iter().enumerate() {
        changed[at + 4 * i..at + 4 * i + 4].copy_from_slice(&value.to_le_bytes());
    }
    changed
}

#[test]
fn absurd_sizes_fail_before_memory_is_taken() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("huge.exr");
    samples::frame(0).write(&path);
    let bytes = std::fs::read(&path).expect("a file");
    let huge = [0, 0, i32::MAX - 1, i32::MAX - 1];
    for attribute in ["dataWindow", "displayWindow"] {
        for window in [huge, [0, 0, 16383, 16383], [0, 0, 20000, 10], [-1_000_000_000, 0, 1_000_000_000, 0]] {
            std::fs::write(&path, with_window(&bytes, attribute, window)).expect("a file");
            let error = read(&path, |_| true).expect_err("absurd");
            assert!(error.to_string().contains("huge.exr"), "{attribute} {window:?}: {error}");
        }
    }
    std::fs::write(&path, with_window(&with_window(&bytes, "dataWindow", huge), "displayWindow", huge)).expect("a file");
    assert!(read_header(&path).is_err());
}

#[test]
fn frames_that_do_not_fit_the_first_end_the_run_and_keep_what_is_finished() {
    let other_size = Sample::new(16, 16);
    let mut other_type = samples::frame(2);
    other_type.channels.iter_mut().filter(|c| c.0 == "depth.Z").for_each(|c| c.1 = Type::Uint);
    let mut no_normal = samples::frame(2);
    no_normal.channels.retain(|c| !c.0.starts_with("normal"));
    for (bad, part) in [(other_size.flat("R", Type::Half, 1.0), "16x16"), (other_type, "depth.Z"), (no_normal, "normal.X")] {
        let (input, output) = (sequence(4), tempfile::tempdir().expect("a temporary folder"));
        bad.write(&frame_path(input.path(), 2));
        let message = denoise(input.path(), output.path(), &[]).expect_err(part).to_string();
        assert!(message.contains("frame_0002.exr") && message.contains(part), "{message}");
        let finished: Vec<bool> = (0..4).map(|n| frame_path(output.path(), n).exists()).collect();
        assert_eq!(finished, [true, true, false, false], "{part}");
    }
}

#[test]
fn a_truncated_frame_ends_the_run_and_can_be_resumed_from() {
    let (input, output) = (sequence(4), tempfile::tempdir().expect("a temporary folder"));
    let bad = frame_path(input.path(), 2);
    let bytes = std::fs::read(&bad).expect("a file");
    std::fs::write(&bad, &bytes[..bytes.len() / 2]).expect("a file");
    let message = denoise(input.path(), output.path(), &[]).expect_err("truncated").to_string();
    assert!(message.contains("frame_0002.exr") && message.contains("truncated"), "{message}");
    std::fs::write(&bad, &bytes).expect("a file");
    denoise(input.path(), output.path(), &["--resume"]).expect("resumed");
    assert!((0..4).all(|n| frame_path(output.path(), n).exists()));
}

#[test]
fn missing_frames_are_named() {
    let (input, output) = (sequence(4), tempfile::tempdir().expect("a temporary folder"));
    std::fs::remove_file(frame_path(input.path(), 1)).expect("removed");
    let error = denoise(input.path(), output.path(), &[]).expect_err("a hole");
    assert!(matches!(error, ToolError::MissingFrames { .. }) && error.to_string().contains("frame_0001.exr"), "{error}");
}

#[test]
fn bad_pixels_become_zero() {
    let (input, output) = (sequence(2), tempfile::tempdir().expect("a temporary folder"));
    let mut sample = samples::frame(1);
    for channel in &mut sample.channels {
        if ["noisy.R", "direct.R", "albedo.G", "normal.Z", "depth.Z", "mv.X", "emission.B", "ref.B"].contains(&channel.0.as_str()) {
            channel.2 = Box::new(|x, y| {
                if (x, y) == (4, 4) {
                    f32::NAN
                } else if (x, y) == (5, 5) {
                    f32::INFINITY
                } else {
                    0.5
                }
            });
        }
    }
    sample.write(&frame_path(input.path(), 1));
    denoise(input.path(), output.path(), &["--score", "--png", "--views", "--strip"]).expect("bad pixels are replaced");
    let planes = read(&frame_path(output.path(), 1), |_| true).expect("a result");
    for (name, samples) in planes.samples {
        let atrous_denoise::exr_read::Samples::Float(values) = samples else { panic!("{name} is no float") };
        assert!(values.iter().all(|v| v.is_finite()), "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written() {
    let input = sequence(1);
    let message = denoise(input.path(), Path::new("/proc/denoised"), &[]).expect_err("not writable").to_string();
    assert!(message.contains("/proc/denoised") && message.contains("cannot be written"), "{message}");
    let file = frame_path(input.path(), 0);
    let message = denoise(input.path(), &file, &[]).expect_err("a file is no folder").to_string();
    assert!(message.contains("frame_0000.exr"), "{message}");
}

/// Some hundred bytes whose display window has 67 million pixels are a legal file.
#[cfg(target_os = "linux")]
#[test]
fn a_small_file_of_a_huge_picture_is_refused_by_name() {
    let (input, output) = (tempfile::tempdir().expect("a temporary folder"), tempfile::tempdir().expect("a temporary folder"));
    let path = input.path().join("huge.exr");
    let side = samples::bounds(0, 0, 8192, 8192);
    Sample { display: side, ..Sample::new(1, 1) }.flat("R G B", Type::Float, 0.5).write(&path);
    assert!(path.metadata().expect("a file").len() < 1000);
    for more in [&["--quiet"][..], &["--quiet", "--device", "reference"]] {
        let program = samples::program(&path, output.path(), more);
        let run = samples::limited(&program, "ulimit -v 8388608").output().expect("a run");
        let message = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(1), "{message}");
        for word in ["huge.exr", "8192x8192", "MiB", "With --preset eaw it is", "pixels fit", "overlap by 254 pixels"] {
            assert!(message.contains(word), "{message}");
        }
    }
    // A smaller limit is met by a smaller picture, and it is said who set it.
    samples::frame(0).write(&path);
    let run = samples::limited(&samples::program(&path, output.path(), &["--quiet"]), "ulimit -v 204800").output().expect("a run");
    let message = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.code() == Some(1) && message.contains("ulimit -v") && message.contains("30x18"), "{message}");
}

/// What decoding a later frame takes cannot be told from the first, so that it has a limit.
#[test]
fn a_later_frame_of_much_larger_blocks_is_refused_by_name() {
    let input = sequence(2);
    let path = frame_path(input.path(), 1);
    let data = samples::bounds(0, 0, 16384, 1024);
    let header = Sample { data: samples::bounds(0, 0, 8, 8), tile: Some(8), ..samples::frame(1) };
    header.write(&path);
    let mut bytes =
        with_window(&std::fs::read(&path).expect("a file"), "dataWindow", [0, 0, data.size.0 as i32 - 1, data.size.1 as i32 - 1]);
    let key = b"tiles\0tiledesc\0";
    let at = bytes.windows(key.len()).position(|w| w == key).expect("the attribute") + key.len() + 4;
    for (i, side) in [16384u32, 1024].iter().enumerate() {
        bytes[at + 4 * i..at + 4 * i + 4].copy_from_slice(&side.to_le_bytes());
    }
    std::fs::write(&path, bytes).expect("a file");
    let output = tempfile::tempdir().expect("a temporary folder");
    let message = denoise(input.path(), output.path(), &[]).expect_err("large blocks").to_string();
    assert!(
        message.contains("frame_0001.exr") && message.contains("blocks of pixels") && message.contains("first frame"),
        "{message}"
    );
}

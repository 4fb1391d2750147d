//! Whole runs on the CPU.

use crate::samples::{denoise, frame_path, program, sequence, HEIGHT, WIDTH};
use atrous_denoise::error::ToolError;
use atrous_denoise::exr_read::{read, read_header, Samples};
use exr::meta::attribute::SampleType;
use std::path::Path;

fn red(path: &Path) -> Vec<f32> {
    match read(path, |c| c.name == "R").expect("a result").samples.remove("R") {
        Some(Samples::Float(values)) => values,
        other => panic!("{other:?}"),
    }
}

fn output() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn results_have_the_names_and_metadata_of_the_input() {
    let (input, out) = (sequence(3), output());
    denoise(input.path(), out.path(), &["--score", "--png", "--strip", "--views"]).expect("a run");
    let header = read_header(&frame_path(out.path(), 2)).expect("a result");
    let names: Vec<_> = header.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["B", "G", "R", "noisy.B", "noisy.G", "noisy.R"]);
    assert!(header.channels.iter().all(|c| c.sample_type == SampleType::F16));
    assert_eq!(header.parts[0].owner.as_ref().map(|o| o.to_string()).as_deref(), Some("the owner"));
    assert_eq!(header.extent, [WIDTH as u32, HEIGHT as u32]);
    // The mean radiance is 0.5, and the noise is gone for the most part.
    let values = red(&frame_path(out.path(), 2));
    let worst = values.iter().map(|v| (v - 0.5).abs()).fold(0.0, f32::max);
    assert!(worst < 0.2, "{worst}");
    for file in ["strip.png", "scores.json", "scores.png", "frame_0001.png", "views/frame_0001_deviation.png"] {
        assert!(out.path().join(file).exists(), "{file}");
    }
    let leftovers =
        std::fs::read_dir(out.path()).expect("a folder").flatten().filter(|e| e.file_name().to_string_lossy().starts_with('.'));
    assert_eq!(leftovers.count(), 0);
}

/// Lines on stderr of the program on the CPU.
fn said(frames: u32, more: &[&str]) -> Vec<String> {
    let (input, out) = (sequence(frames), output());
    let mut program = program(input.path(), out.path(), &["--device", "reference", "--levels", "1"]);
    let run = program.args(more).output().expect("a run");
    assert!(run.status.success());
    String::from_utf8_lossy(&run.stderr).lines().map(str::to_owned).collect()
}

#[test]
fn a_single_still_is_told_what_it_gets() {
    let notes = |frames, more: &[&str]| -> Vec<String> {
        said(frames, more).into_iter().filter(|line| line.contains("a single frame is filtered in space alone")).collect()
    };
    assert_eq!(notes(2, &["--preset", "eaw"]).len(), 0);
    let default = notes(1, &[]);
    assert!(default.len() == 1 && !default[0].contains("--preset"), "{default:?}");
    let other = notes(1, &["--preset", "eaw"]);
    assert!(other.len() == 1 && other[0].contains("--preset best"), "{other:?}");
    assert_eq!(notes(1, &["--quiet"]).len(), 0);
}

/// Another channel in the place of the depth in the previous frame: no surface is where it is looked for.
#[test]
fn history_that_is_lost_everywhere_is_warned_of_once() {
    let warnings = |more: &[&str]| -> Vec<String> {
        said(20, &[&["--preset", "svgf", "--quiet"], more].concat()).into_iter().filter(|line| line.contains("history")).collect()
    };
    let lost = warnings(&["--channel", "previous_depth=noisy.R"]);
    assert_eq!(lost.len(), 1, "{lost:?}");
    // The first frame has no history to lose.
    for word in ["frame_0008.exr", "100 % of the surfaces", "the depth is another", "--check"] {
        assert!(lost[0].contains(word), "{word}: {lost:?}");
    }
    assert_eq!(warnings(&[]), [] as [String; 0]);
}

#[test]
fn scores_are_written_as_json() {
    let (input, out) = (sequence(3), output());
    denoise(input.path(), out.path(), &["--score", "--float"]).expect("a run");
    let text = std::fs::read_to_string(out.path().join("scores.json")).expect("a file");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(json["frames"].as_array().map(Vec::len), Some(3));
    assert!(json["frames"][0]["denoised"]["temporal_error"].is_null());
    for metric in ["rmse", "flip"] {
        let mean = |path: &str| json[path][metric].as_f64().expect("a number");
        assert!(mean("mean") > 0.0 && mean("mean") < 0.5 * mean("noisy_mean"), "{metric}: {text}");
    }
    // The first frame by hand.
    let values = red(&frame_path(out.path(), 0));
    assert!(values.iter().any(|v| half::f16::from_f32(*v).to_f32() != *v) || values.iter().all(|v| v.is_finite()));
}

#[test]
fn existing_results_need_force_or_resume() {
    let (input, out) = (sequence(2), output());
    denoise(input.path(), out.path(), &[]).expect("a run");
    let error = denoise(input.path(), out.path(), &[]).expect_err("exists");
    assert!(matches!(&error, ToolError::Exists { path } if path.ends_with("frame_0000.exr")), "{error}");
    denoise(input.path(), out.path(), &["--force"]).expect("overwritten");
    let before = std::fs::read(frame_path(out.path(), 0)).expect("a result");
    denoise(input.path(), out.path(), &["--resume"]).expect("nothing to do");
    assert_eq!(std::fs::read(frame_path(out.path(), 0)).expect("a result"), before);
    let error = denoise(input.path(), input.path(), &["--force"]).expect_err("the input would be lost");
    assert!(error.to_string().contains("overwritten"), "{error}");
}

#[test]
fn a_resumed_run_gives_what_an_uninterrupted_one_gives() {
    let (input, whole, resumed) = (sequence(6), output(), output());
    denoise(input.path(), whole.path(), &["--float"]).expect("a run");
    denoise(input.path(), resumed.path(), &["--float"]).expect("a run");
    // The second file is half a file, as no run of this tool leaves one.
    for number in [3, 5] {
        std::fs::remove_file(frame_path(resumed.path(), number)).expect("removed");
    }
    std::fs::write(frame_path(resumed.path(), 4), b"half a file").expect("a file");
    denoise(input.path(), resumed.path(), &["--float", "--resume", "--score"]).expect("resumed");
    for number in 0..6 {
        let bytes = |folder: &Path| std::fs::read(frame_path(folder, number)).expect("a result");
        assert!(bytes(whole.path()) == bytes(resumed.path()), "frame {number}");
    }
    let text = std::fs::read_to_string(resumed.path().join("scores.json")).expect("a file");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(json["frames"].as_array().map(Vec::len), Some(6));
}

#[test]
fn a_short_warm_up_starts_with_less_history() {
    let (input, out) = (sequence(6), output());
    denoise(input.path(), out.path(), &["--float"]).expect("a run");
    let whole = red(&frame_path(out.path(), 5));
    std::fs::remove_file(frame_path(out.path(), 5)).expect("removed");
    denoise(input.path(), out.path(), &["--float", "--resume", "--warm-up", "0"]).expect("resumed");
    assert!(red(&frame_path(out.path(), 5)) != whole);
}

#[test]
fn signals_and_tunables_reach_the_filter() {
    let input = sequence(2);
    let run = |more: &[&str]| {
        let out = output();
        denoise(input.path(), out.path(), &[&["--float"], more].concat()).expect("a run");
        red(&frame_path(out.path(), 1))
    };
    let usual = run(&[]);
    assert!(usual != run(&["--signals", "together"]));
    assert!(usual != run(&["--set", "alpha=0.9"]));
    assert!(usual != run(&["--levels", "1"]));
    assert!(usual == run(&["--signals", "apart", "--levels", "5"]));
}

#[test]
fn scoring_needs_a_reference() {
    let (input, out) = (sequence(1), output());
    let error = denoise(input.path(), out.path(), &["--score", "--channel", "reference=none"]).expect_err("no reference");
    assert!(error.to_string().contains("reference"), "{error}");
}

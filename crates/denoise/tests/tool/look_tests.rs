//! What is found out about the first frames, and what is said of it.

use crate::samples::scene::{Frame, Scene};
use crate::samples::{self, denoise, frame_path, program, Sample, Type};
use atrous_denoise::error::ToolError;
use atrous_denoise::exr_read::{read, Samples};
use atrous_denoise::frame_files;
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{first_look, frame};
use std::path::Path;

pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// The setup after the first look, with its warnings.
pub fn looked_at(input: &Path) -> (Setup, Vec<String>) {
    let frames = frame_files::find(&[input.to_owned()]).expect("frames");
    let mut setup = Setup::new(&frames, &Options::default()).expect("a setup");
    let warnings = first_look::take(&frames, &mut setup).expect("a look");
    (setup, warnings)
}

pub fn setup_of(sample: &Sample, more: &[&str]) -> Result<Setup, ToolError> {
    use clap::Parser;
    let folder = folder();
    sample.write(&folder.path().join("f_0001.exr"));
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let fixed = ["atrous-denoise", "frames", "-o", "out"];
    let cli = atrous_denoise::cli::Cli::parse_from(fixed.iter().chain(more));
    Setup::new(&frames, &cli.options())
}

/// Frames of the scene, as `write` makes samples of them, with their cameras.
pub fn written(scene: Scene, frames: u32, sample: impl Fn(u32, &Frame) -> Sample) -> tempfile::TempDir {
    let folder = folder();
    for number in 0..frames {
        sample(number, &scene.frame(number)).write(&frame_path(folder.path(), number));
    }
    std::fs::write(folder.path().join("sequence.json"), scene.cameras(0..frames)).expect("cameras");
    folder
}

pub fn red(path: &Path) -> Vec<f32> {
    match read(path, |c| c.name == "R").expect("a result").samples.remove("R") {
        Some(Samples::Float(values)) => values,
        other => panic!("{other:?}"),
    }
}

#[test]
fn ordinary_frames_are_left_as_they_are() {
    let input = written(Scene::default(), 2, |_, frame| frame.plain());
    let (setup, warnings) = looked_at(input.path());
    assert_eq!(warnings, [] as [String; 0]);
    assert_eq!((setup.range.exponent, setup.stills, setup.carries_depth), (0, false, false));
    assert!(setup.smoothed.is_empty() && !setup.report.iter().any(|line| line.contains("note:")), "{:?}", setup.report);
}

#[test]
fn the_same_noise_is_found_and_said() {
    let still = Scene { animates: false, ..Scene::default() };
    for scene in [still, Scene { speed: 0.0, ..still }] {
        let input = written(scene, 2, |_, frame| frame.plain());
        let (setup, warnings) = looked_at(input.path());
        assert!(setup.stills && warnings.iter().any(|w| w.contains("noise of frames 0 and 1 is the same")), "{warnings:?}");
        for renderer in ["Blender", "Mitsuba", "LuxCore", "PBRT", "Arnold", "Karma"] {
            assert!(warnings[0].contains(renderer), "{renderer}");
        }
    }
    // A camera that stands, with other noise in every frame, is no such thing.
    let input = written(Scene { speed: 0.0, ..Scene::default() }, 2, |_, frame| frame.plain());
    assert!(!looked_at(input.path()).0.stills);
}

#[test]
fn without_depth_nothing_is_where_there_is_no_normal() {
    let input = folder();
    let sample = Sample::new(8, 2).flat("R G B", Type::Half, 0.5).flat("normal.X normal.Y", Type::Float, 0.0);
    sample.channel("normal.Z", Type::Float, |x, _| if x < 4 { 0.0 } else { 1.0 }).write(&frame_path(input.path(), 0));
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let depth = frame::load(&frames[0], &looked_at(input.path()).0).expect("a frame").images["depth"].clone();
    assert_eq!((depth[3][0], depth[4][0]), (0.0, 1.0));
}

/// Neither motion nor a camera is known, and the history would smear.
#[test]
fn pictures_that_move_in_unknown_ways_are_filtered_one_by_one() {
    // A print that moves so many pixels in two frames, in the last columns, or noise. It is in the albedo, or in light with noise.
    let stills = |step: i32, columns: i32, is_noise: bool, has_motion: bool, has_albedo: bool| {
        let input = folder();
        for number in 0..4 {
            let shift = move |x: i32| if x >= 64 - columns { step * number as i32 / 2 } else { 0 };
            let seed = if is_noise { 90 + number } else { 90 };
            let print = move |x: i32, y: i32| samples::noise((x + 100 - shift(x)) / 3, y / 3, seed);
            let light = move |x: i32, y: i32| samples::noise(x, y, number) + if has_albedo { 0.0 } else { 2.0 * print(x, y) };
            let mut sample = Sample::new(64, 48);
            for c in ["R", "G", "B"] {
                sample = sample.channel(c, Type::Half, light);
                if has_albedo {
                    sample = sample.channel(&format!("albedo.{c}"), Type::Half, print);
                }
            }
            if has_motion {
                sample = sample.flat("motion.X", Type::Float, -step as f32 / 2.0).flat("motion.Y", Type::Float, 0.0);
            }
            sample.write(&frame_path(input.path(), number));
        }
        let setup = looked_at(input.path()).0;
        assert_eq!(setup.stills, setup.report.iter().any(|line| line.contains("neither motion nor a camera says how")));
        setup.stills
    };
    for has_albedo in [true, false] {
        assert!(stills(4, 64, false, false, has_albedo));
        assert!(!stills(0, 64, false, false, has_albedo), "it stands still");
        assert!(!stills(4, 64, false, true, has_albedo), "its motion is known");
        assert!(!stills(4, 24, false, false, has_albedo), "a part of it moves");
        assert!(!stills(0, 64, true, false, has_albedo), "noise is found nowhere");
    }
    assert!(stills(1, 64, false, false, true), "slowly");
}

#[test]
fn parts_that_do_not_add_up_are_left_out() {
    let with = |share: f32| {
        move |_: u32, frame: &Frame| {
            let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", |s| s.noisy);
            let sample = frame.add(sample, "ViewLayer.Depth", "Z", |s| [s.depth]);
            frame.add(sample, "ViewLayer.Env", "RGB", move |s| if s.id == 0 { s.noisy.map(|v| share * v) } else { [0.0; 3] })
        }
    };
    let whole = looked_at(written(Scene::default(), 2, with(1.0)).path()).0;
    assert!(whole.mapping.has(Role::Environment));
    let wrong = looked_at(written(Scene::default(), 2, with(1.5)).path()).0;
    assert!(!wrong.mapping.has(Role::Environment));
    assert!(wrong.report.iter().any(|line| line.contains("environment does not add up")), "{:?}", wrong.report);
}

/// Parts that are more than the whole in a few pixels alone do not add light.
#[test]
fn a_part_is_never_more_than_the_whole() {
    let folder = folder();
    let part = |x: i32, y: i32| if (x, y) == (3, 3) { 9.0 } else { 0.25 };
    let sample = (0..3).fold(Sample::new(30, 18), |sample, c| {
        let c = ["R", "G", "B"][c];
        sample.channel(&format!("Combined.{c}"), Type::Half, |_, _| 0.5).channel(&format!("Emit.{c}"), Type::Half, part)
    });
    sample.flat("Depth.Z", Type::Float, 2.0).write(&frame_path(folder.path(), 0));
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&frames, &Options::default()).expect("a setup");
    let inputs = frame::load(&frames[0], &setup).expect("a frame");
    for (emission, light) in inputs.images["emission"].iter().zip(&inputs.images["noisy_radiance"]) {
        assert_eq!(emission[0] + light[0], 0.5);
    }
}

#[test]
fn a_wrong_convention_is_warned_of_in_every_run() {
    let input = written(Scene::default(), 2, |_, frame| {
        let sample = frame.plain();
        let channels = sample.channels.into_iter().filter(|c| !c.0.starts_with("motion.")).collect();
        frame.add(Sample { channels, ..Frame::sample() }, "motion", "XY", |s| s.motion.map(|m| -m))
    });
    let (_, warnings) = looked_at(input.path());
    let wanted = "--convention motion_direction=current_minus_previous";
    assert!(warnings.iter().any(|w| w.contains("opposite sign") && w.contains(wanted)), "{warnings:?}");
}

#[test]
fn a_byte_order_mark_is_no_text() {
    let input = written(Scene::default(), 2, |_, frame| frame.plain());
    let path = input.path().join("sequence.json");
    let text = std::fs::read_to_string(&path).expect("cameras");
    std::fs::write(&path, format!("\u{feff}{text}")).expect("cameras");
    assert!(looked_at(input.path()).0.sequence.is_some());
}

#[test]
fn without_a_driver_the_other_way_is_named_once() {
    let input = samples::sequence(1);
    let mut program = program(input.path(), folder().path(), &[]);
    let run = program.env("VK_ICD_FILENAMES", "/absent").env("VK_DRIVER_FILES", "/absent").output().expect("a run");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(!run.status.success() && said.matches("--device reference").count() == 1, "{said}");
}

#[test]
fn names_give_the_terminal_no_orders() {
    let input = folder();
    samples::frame(0).write(&input.path().join("a\u{1b}[31m_0.exr"));
    let run = program(input.path(), folder().path(), &["--device", "reference"]).output().expect("a run");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && !said.contains('\u{1b}') && said.contains("\\u{1b}[31m"), "{said}");
}

#[test]
fn long_names_are_no_obstacle() {
    let (input, output) = (folder(), folder());
    let name = format!("{}_0001.exr", "n".repeat(244));
    samples::frame(0).write(&input.path().join(&name));
    denoise(input.path(), output.path(), &["--png", "--views", "--strip"]).expect("a run");
    assert!(output.path().join(&name).is_file());
}

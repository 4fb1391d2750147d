//! Advice can be followed: what a message proposes is fed back.

use super::look_tests::{folder, setup_of, written};
use crate::samples::scene::{Frame, Scene};
use crate::samples::{denoise, frame_path, program, Sample, Type};
use atrous_denoise::frame_files;
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};
use std::path::Path;

/// Runs `--check` and feeds every remedy back: then it has nothing to say.
fn follows_the_advice(input: &Path, wanted: &str) {
    let check = |options: &[String]| {
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let output = folder();
        let mut run = program(input, output.path(), &[&["--check", "--device", "reference"], &options[..]].concat());
        let run = run.stdout(std::process::Stdio::piped()).output().expect("a run");
        (run.status.success(), String::from_utf8_lossy(&run.stdout).into_owned())
    };
    let (is_right, told) = check(&[]);
    assert!(!is_right, "{told}");
    let changes: Vec<&str> = told.lines().filter_map(|line| line.trim().strip_prefix("change: ")).collect();
    assert!(changes.iter().any(|change| change.contains(wanted)), "{wanted}: {told}");
    let options: Vec<String> = changes.iter().flat_map(|change| change.split(' ')).map(str::to_owned).collect();
    let (is_right, told) = check(&options);
    assert!(is_right, "{options:?}: {told}");
}

#[test]
fn every_advice_can_be_typed() {
    let fast = Scene { speed: 0.15, ..Scene::default() };
    let wrong_motion = |change: fn([f32; 2]) -> [f32; 2]| {
        written(fast, 3, move |_, frame| {
            let sample = frame.plain();
            let channels = sample.channels.into_iter().filter(|c| !c.0.starts_with("motion.")).collect();
            frame.add(Sample { channels, ..Frame::sample() }, "motion", "XY", move |s| change(s.motion))
        })
    };
    follows_the_advice(wrong_motion(|[x, y]| [x, -y]).path(), "motion_y=up");
    follows_the_advice(wrong_motion(|[x, y]| [-x, -y]).path(), "motion_direction=current_minus_previous");
    follows_the_advice(wrong_motion(|[x, y]| [x / 60.0, y / 36.0]).path(), "motion_unit=uv");
    follows_the_advice(wrong_motion(|[x, y]| [0.2 * x, 0.2 * y]).path(), "motion_scale=5");
    let centimetres = written(fast, 3, |_, frame| {
        let sample = frame.plain();
        let channels = sample.channels.into_iter().filter(|c| c.0 != "depth.Z").collect();
        frame.add(Sample { channels, ..Frame::sample() }, "depth", "Z", |s| [100.0 * s.depth])
    });
    follows_the_advice(centimetres.path(), "depth_scale=0.01");
}

#[test]
fn several_colours_are_a_question() {
    let two = Sample::new(8, 6).flat("reflection.R reflection.G reflection.B reflection.A", Type::Half, 0.5);
    let two =
        two.flat("zz.R zz.G zz.B zz.A", Type::Half, 0.5).flat("crypto00.r crypto00.g crypto00.b crypto00.a", Type::Float, 0.5);
    let message = setup_of(&two, &[]).expect_err("a question").to_string();
    let options: Vec<&str> = message.split("--channel ").skip(1).filter_map(|rest| rest.split([' ', ',', ';']).next()).collect();
    assert_eq!(options, ["noisy=reflection", "noisy=zz"], "{message}");
    for option in options {
        let setup = setup_of(&two, &["--channel", option]).expect("an answer");
        assert_eq!(setup.mapping.roles[&Role::Noisy][0], format!("{}.R", &option[6..]));
    }
    let one = Sample::new(8, 6).flat("mine.R mine.G mine.B mine.A", Type::Half, 0.5);
    let one = one.flat("crypto00.R crypto00.G crypto00.B crypto00.A", Type::Float, 0.5);
    assert_eq!(setup_of(&one, &[]).expect("one").mapping.roles[&Role::Noisy][0], "mine.R");
}

#[test]
fn proposals_for_a_colour_can_be_typed() {
    for (sample, wanted) in [
        (Sample::new(8, 6).flat("Y", Type::Half, 0.5), "Y"),
        (Sample::new(8, 6).flat("mine.Y", Type::Half, 0.5), "mine.Y"),
        (Sample::new(8, 6).flat("a.b.R a.b.G a.b.B", Type::Half, 0.5), "a.b"),
    ] {
        let message = setup_of(&sample, &[]).expect_err("a question").to_string();
        let option = format!("noisy={wanted}");
        assert!(message.contains(&format!("--channel {option}")), "{message}");
        setup_of(&sample, &["--channel", &option]).expect("an answer");
    }
}

#[test]
fn a_second_eye_is_told_of() {
    let mut sample = Sample::new(8, 6).flat("R G B albedo.R albedo.G albedo.B", Type::Half, 0.5);
    sample = sample.flat("right.R right.G right.B right.albedo.R right.albedo.G right.albedo.B", Type::Half, 0.25);
    let folder = folder();
    let path = frame_path(folder.path(), 0);
    let mut layer = sample.layer(None);
    layer.attributes.multi_view_names = Some(["left", "right"].map(exr::prelude::Text::new_or_panic).to_vec());
    use exr::prelude::WritableImage;
    let image = exr::image::Image::new(exr::prelude::ImageAttributes::new(sample.display), layer);
    image.write().non_parallel().to_file(&path).expect("a file");
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let left = Setup::new(&frames, &Options::default()).expect("the left eye");
    assert!(left.report.iter().any(|line| line.contains("`right`") && line.contains("--channel noisy=right")), "{:?}", left.report);
    assert_eq!(left.mapping.roles[&Role::Albedo][0], "albedo.R");
    let options = Options { channels: vec![(Role::Noisy, "right".into())], ..Options::default() };
    let right = Setup::new(&frames, &options).expect("the right eye");
    assert_eq!(right.mapping.roles[&Role::Albedo][0], "right.albedo.R");
    denoise(folder.path(), tempfile::tempdir().expect("a folder").path(), &["--channel", "noisy=right"]).expect("a run");
}

#[test]
fn one_name_makes_no_layout() {
    use atrous_denoise::layouts::Layout;
    let plain = || Sample::new(8, 6).flat("R G B A", Type::Half, 0.5);
    // Arnold: a position in the world, and not in front of the camera as PBRT has it.
    let arnold = plain().flat("P.X P.Y P.Z N.X N.Y N.Z Z", Type::Float, 0.5);
    assert_eq!(setup_of(&arnold, &[]).expect("a setup").mapping.layout, Layout::Plain);
    for name in ["Ns.X Ns.Y Ns.Z", "nn.X nn.Y nn.Z", "u"] {
        assert_eq!(setup_of(&plain().flat(name, Type::Float, 0.5), &[]).expect("a setup").mapping.layout, Layout::Plain, "{name}");
    }
    let noisy = Sample::new(8, 6).flat("noisy.R noisy.G noisy.B", Type::Half, 0.5);
    assert_eq!(setup_of(&noisy, &[]).expect("a setup").mapping.layout, Layout::Plain);
}

#[test]
fn what_is_not_used_is_listed() {
    let sample = Sample::new(8, 6).flat("R G B", Type::Half, 0.5).flat("N_main.X N_main.Y N_main.Z depth_main.Z", Type::Float, 0.5);
    let report = setup_of(&sample, &[]).expect("a setup").report;
    assert!(report.contains(&"  not used: N_main.X/Y/Z, depth_main.Z".to_owned()), "{report:?}");
}

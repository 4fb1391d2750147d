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

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// The setup after the first look, with its warnings.
fn looked_at(input: &Path) -> (Setup, Vec<String>) {
    let frames = frame_files::find(&[input.to_owned()]).expect("frames");
    let mut setup = Setup::new(&frames, &Options::default()).expect("a setup");
    let warnings = first_look::take(&frames, &mut setup).expect("a look");
    (setup, warnings)
}

fn setup_of(sample: &Sample, more: &[&str]) -> Result<Setup, ToolError> {
    use clap::Parser;
    let folder = folder();
    sample.write(&folder.path().join("f_0001.exr"));
    let frames = frame_files::find(&[folder.path().to_owned()]).expect("a frame");
    let fixed = ["atrous-denoise", "frames", "-o", "out"];
    let cli = atrous_denoise::cli::Cli::parse_from(fixed.iter().chain(more));
    Setup::new(&frames, &cli.options())
}

/// Frames of the scene, as `write` makes samples of them, with their cameras.
fn written(scene: Scene, frames: u32, sample: impl Fn(u32, &Frame) -> Sample) -> tempfile::TempDir {
    let folder = folder();
    for number in 0..frames {
        sample(number, &scene.frame(number)).write(&frame_path(folder.path(), number));
    }
    std::fs::write(folder.path().join("sequence.json"), scene.cameras(0..frames)).expect("cameras");
    folder
}

fn red(path: &Path) -> Vec<f32> {
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
    let sample = (0..3).fold(Sample::new(32, 18), |sample, c| {
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
fn nothing_is_added_where_alpha_and_colour_are_nothing() {
    let input = written(Scene::default(), 2, |_, frame| {
        let sample = frame.add(frame.plain(), "", "A", |s| [f32::from(s.id != 0)]);
        let sample = Sample { channels: sample.channels.into_iter().filter(|c| c.0.len() > 1 || c.0 == "A").collect(), ..sample };
        frame.add(sample, "", "RGB", |s| if s.id == 0 { [0.0; 3] } else { s.noisy })
    });
    let output = folder();
    denoise(input.path(), output.path(), &[]).expect("a run");
    let empty: Vec<usize> =
        Scene::default().frame(1).pixels.iter().enumerate().filter(|(_, s)| s.id == 0).map(|(i, _)| i).collect();
    let result = red(&frame_path(output.path(), 1));
    assert!(!empty.is_empty() && empty.iter().all(|i| result[*i] == 0.0));
}

#[test]
fn a_sky_beyond_half_floats_keeps_its_value() {
    let sky = |s: &samples::scene::Seen| if s.id == 0 { [300_000.0; 3] } else { s.noisy };
    let input = written(Scene::default(), 2, move |_, frame| frame.add(frame.guides(Frame::sample()), "", "RGB", sky));
    let output = folder();
    denoise(input.path(), output.path(), &["--float"]).expect("a run");
    let brightest = red(&frame_path(output.path(), 1)).into_iter().fold(0.0, f32::max);
    assert!((brightest / 300_000.0 - 1.0).abs() < 1e-3, "{brightest}");
}

#[test]
fn surfaces_of_large_scenes_are_no_background() {
    let frame = samples::frame(0);
    let far = Sample { channels: frame.channels.into_iter().filter(|c| c.0 != "depth.Z").collect(), ..Sample::new(32, 18) };
    let setup = setup_of(&far.flat("depth.Z", Type::Float, 50_000.0), &[]).expect("a setup");
    assert!(setup.config.conventions.background_depth > 50_000.0);
}

#[test]
fn negative_pixels_are_counted_in_words() {
    let input = written(Scene::default(), 2, |_, frame| {
        let sample = frame.guides(Frame::sample());
        frame.add(sample, "", "RGB", |s| s.noisy.map(|v| if v < 0.05 { -0.1 } else { v }))
    });
    let run = program(input.path(), folder().path(), &["--device", "reference"]).output().expect("a run");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && said.contains("pixels of light are negative"), "{said}");
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
    follows_the_advice(wrong_motion(|[x, y]| [x / 64.0, y / 36.0]).path(), "motion_unit=uv");
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

#[test]
fn depth_is_looked_up_for_what_the_camera_carries() {
    let scene = Scene { is_carried: true, ..Scene::default() };
    let input = written(scene, 3, |_, frame| frame.plain());
    let (setup, _) = looked_at(input.path());
    assert!(setup.carries_depth && setup.report.iter().any(|line| line.contains("it is looked up")), "{:?}", setup.report);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let mut loader = atrous_denoise::loader::Loader::new(&setup);
    let loaded: Vec<_> = frames.iter().map(|files| loader.load(files).expect("a frame")).collect();
    let pixels = scene.frame(2).pixels;
    let carried = |i: &usize| pixels[*i].id == 3;
    let differs = |i: &usize| (loaded[2].images["motion"][*i][2] / pixels[*i].depth - 1.0).abs() > 0.02;
    let ball = (0..pixels.len()).filter(carried).count();
    // At the rim, the ball was another pixel.
    assert!(ball > 30 && (0..pixels.len()).filter(carried).filter(differs).count() * 2 < ball, "of {ball}");
}

#[test]
fn guides_that_are_noise_are_not_trusted() {
    let input = folder();
    for number in 0..2 {
        let mut pixels = Scene::default().frame(number).pixels.to_vec();
        for (i, seen) in pixels.iter_mut().enumerate().filter(|(i, _)| samples::noise(*i as i32, 3, 50 + number) < 0.5) {
            (seen.albedo, seen.normal, seen.depth) = ([0.02; 3], [1.0, 0.0, 0.0], if i % 2 == 0 { 0.3 } else { 40.0 });
        }
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), number));
    }
    let (setup, _) = looked_at(input.path());
    assert!(setup.smoothed.contains("normal"), "{:?}", setup.report);
    assert!(!setup.mapping.has(Role::Albedo) && !setup.mapping.has(Role::Depth), "{:?}", setup.report);
    // What the user names is taken.
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let options = Options { channels: vec![(Role::Albedo, "albedo".into())], ..Options::default() };
    let mut named = Setup::new(&frames, &options).expect("a setup");
    first_look::take(&frames, &mut named).expect("a look");
    assert!(named.mapping.has(Role::Albedo));
}

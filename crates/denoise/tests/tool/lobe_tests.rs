//! Surfaces that have no albedo, and ids that hold for a frame alone.

use super::look_tests::{folder, looked_at, red, written};
use crate::samples::scene::{Frame, Scene, Seen, SIZE};
use crate::samples::{self, frame_path, Sample, Type};
use atrous::config::Signals;
use atrous_denoise::frame::{self, FrameInputs};
use atrous_denoise::frame_files;
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};
use clap::Parser;
use std::path::Path;

const BALL: u32 = 3;

fn loaded(input: &Path, setup: &Setup, number: usize) -> FrameInputs {
    let frames = frame_files::find(&[input.to_owned()]).expect("frames");
    frame::load(&frames[number], setup).expect("a frame")
}

/// The scene with another albedo of its ball.
fn with_ball(frames: u32, has_ids: bool, change: impl Fn(&mut Seen)) -> tempfile::TempDir {
    written(Scene::default(), frames, |number, _| {
        let mut pixels = Scene::default().frame(number).pixels.to_vec();
        pixels.iter_mut().filter(|seen| seen.id == BALL).for_each(&change);
        let mut sample = Frame { pixels: std::rc::Rc::new(pixels) }.plain();
        sample.channels.retain(|(name, ..)| has_ids || name != "id.I");
        sample
    })
}

fn lobe(seen: &mut Seen) {
    seen.albedo = [10.0 * seen.normal[2].powi(8); 3];
}

#[test]
fn light_without_an_albedo_is_filtered_apart() {
    let changes: [fn(&mut Seen); 2] = [|seen| seen.albedo = [0.0; 3], lobe];
    for (change, has_ids) in [(changes[0], true), (changes[0], false), (changes[1], true), (changes[1], false)] {
        let input = with_ball(2, has_ids, change);
        let setup = looked_at(input.path()).0;
        assert!(setup.has_lobes && setup.config.signals == Signals::Specular, "{:?}", setup.report);
        assert!(setup.report.iter().any(|line| line.contains("has no albedo of its own")), "{:?}", setup.report);
        let frame = loaded(input.path(), &setup, 1);
        let seen = Scene::default().frame(1).pixels;
        let [diffuse, specular, albedo, coat] =
            ["noisy_diffuse", "noisy_specular", "albedo", "specular_albedo"].map(|name| &frame.images[name]);
        let ids = frame.surface_id.as_ref().expect("ids");
        let mut parted = 0;
        for (i, seen) in seen.iter().enumerate() {
            assert_eq!(diffuse[i][0] + specular[i][0], seen.noisy[0], "no light is lost");
            let is_apart = coat[i] == [1.0; 4];
            assert!(is_apart || (specular[i] == [0.0; 4] && coat[i] == [0.0; 4]));
            assert!(!is_apart || (diffuse[i] == [0.0; 4] && albedo[i] == [0.0; 4]));
            assert!(is_apart || albedo[i][..3] == seen.albedo);
            parted += usize::from(is_apart);
            // What is connected may end before the rim of the ball, whose normals turn fast.
            assert!(!is_apart || seen.id == BALL);
        }
        let ball = seen.iter().filter(|seen| seen.id == BALL).count();
        assert!(parted == ball || (!has_ids && parted * 10 > ball * 9), "{parted} of {ball}");
        let of = |id: u32| (0..seen.len()).filter(|i| seen[*i].id == id).map(|i| ids[i]).max();
        let (floor, ball) = (of(1), of(BALL));
        assert_eq!((floor, ball), if has_ids { (Some(2 * 2 + 1), Some(2 * 4 + 2)) } else { (Some(1), Some(2)) });
    }
}

/// In fog and out of focus an albedo is noise.
#[test]
fn all_light_is_specular_where_the_albedo_is_left_out() {
    let input = with_ball(2, true, |seen| seen.albedo = [0.0; 3]);
    for number in 0..2 {
        let mut pixels = Scene::default().frame(number).pixels.to_vec();
        for (i, seen) in pixels.iter_mut().enumerate() {
            seen.albedo = if seen.id == BALL { [0.0; 3] } else { [samples::noise(i as i32, 5, 80 + number); 3] };
        }
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), number));
    }
    let setup = looked_at(input.path()).0;
    assert!(!setup.mapping.has(Role::Albedo), "{:?}", setup.report);
    assert!(!setup.has_lobes && setup.config.signals == Signals::Specular);
    let frame = loaded(input.path(), &setup, 1);
    let seen = Scene::default().frame(1).pixels;
    let is_whole =
        |i: usize| frame.images["noisy_specular"][i][..3] == seen[i].noisy && frame.images["noisy_diffuse"][i] == [0.0; 4];
    assert!((0..seen.len()).all(is_whole));
}

/// A highlight in a mirror moves in other ways than the mirror.
#[test]
fn all_light_is_specular_where_there_is_no_albedo() {
    let signals = |dropped: &[&str], more: &[&str]| {
        let input = written(Scene::default(), 2, |_, frame| {
            let mut sample = frame.plain();
            sample.channels.retain(|(name, ..)| !dropped.iter().any(|part| name.starts_with(part)));
            sample
        });
        let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
        let arguments = ["atrous-denoise", "frames", "-o", "out"].iter().chain(more);
        let setup = Setup::new(&frames, &atrous_denoise::cli::Cli::parse_from(arguments).options()).expect("a setup");
        let is_told = setup.report.iter().any(|line| line.contains("together, as specular light"));
        assert_eq!(is_told, setup.config.signals == Signals::Specular);
        setup.config.signals
    };
    assert_eq!(signals(&["albedo"], &[]), Signals::Specular);
    assert_eq!(signals(&[], &[]), Signals::Together);
    for kept in [&["albedo", "normal"][..], &["albedo", "motion", "depth"]] {
        assert_eq!(signals(kept, &[]), Signals::Together, "without {kept:?}");
    }
    for option in [["--signals", "together"], ["--preset", "eaw"]] {
        assert_eq!(signals(&["albedo"], &option), Signals::Together, "{option:?}");
    }
}

/// A highlight that moves over a mirror as the mirror does not.
#[test]
fn a_highlight_leaves_no_glow() {
    let light = |number: u32, x: i32, y: i32| if (x - 8 - 3 * number as i32).abs() < 2 && (y - 12).abs() < 2 { 60.0 } else { 0.4 };
    let input = folder();
    for number in 0..8 {
        let noisy = move |x: i32, y: i32| light(number, x, y) * (0.95 + 0.1 * samples::noise(x, y, 30 + number));
        let mut sample = Sample::new(48, 24).flat("normal.X normal.Y motion.X motion.Y", Type::Float, 0.0);
        sample = sample.flat("normal.Z", Type::Float, 1.0).flat("depth.Z", Type::Float, 2.0);
        sample = ["R", "G", "B"].iter().fold(sample, |sample, c| sample.channel(c, Type::Float, noisy));
        sample.write(&frame_path(input.path(), number));
    }
    let error = |more: &[&str]| {
        let output = folder();
        samples::denoise(input.path(), output.path(), more).expect("a run");
        let result = red(&frame_path(output.path(), 7));
        let dark = (0..48 * 24).filter(|i| light(7, i % 48, i / 48) < 1.0).map(|i| (result[i as usize] - 0.4).powi(2));
        dark.clone().sum::<f32>() / dark.count() as f32
    };
    let (specular, together) = (error(&[]), error(&["--signals", "together"]));
    assert!(specular < 0.7 * together, "{specular} {together}");
}

/// Transforms are found by the ids of the file.
#[test]
fn ids_with_transforms_stay_as_they_are() {
    let input = with_ball(2, true, lobe);
    let setup = looked_at(input.path()).0;
    std::fs::write(input.path().join("frame_0001_instance_transforms.f32"), [0; 48]).expect("transforms");
    let ids = [0, 1].map(|number| loaded(input.path(), &setup, number).surface_id.expect("ids").into_iter().max());
    assert_eq!(ids, [Some(2 * 4 + 2), Some(4)]);
}

#[test]
fn a_lobe_is_left_out_where_light_stays_together() {
    let input = with_ball(2, true, lobe);
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    let together = ["atrous-denoise", "frames", "-o", "out", "--signals", "together"];
    let mut setup = Setup::new(&frames, &atrous_denoise::cli::Cli::parse_from(together).options()).expect("a setup");
    atrous_denoise::first_look::take(&frames, &mut setup).expect("a look");
    let note = setup.report.iter().find(|line| line.contains("albedo is above 1"));
    assert!(!setup.has_lobes && !setup.mapping.has(Role::Albedo));
    assert!(note.is_some_and(|line| line.ends_with("left out")), "{:?}", setup.report);
}

/// A ball of rough metal costs the floor nothing.
#[test]
fn other_surfaces_keep_their_albedo() {
    let input = with_ball(8, true, lobe);
    let seen = Scene::default().frame(7).pixels;
    let error = |more: &[&str]| {
        let output = folder();
        samples::denoise(input.path(), output.path(), more).expect("a run");
        let result = red(&frame_path(output.path(), 7));
        let squares = (0..seen.len()).filter(|i| seen[*i].id == 1).map(|i| (result[i] - seen[i].reference[0]).powi(2));
        squares.clone().sum::<f32>() / squares.count() as f32
    };
    let (apart, together) = (error(&[]), error(&["--signals", "together"]));
    assert!(apart < 0.6 * together, "{apart} {together}");
}

/// Blender's albedo for denoisers has the colour of what is seen in mirrors and through glass.
#[test]
fn black_of_an_albedo_for_denoisers_is_black() {
    let has_lobes = |name: &str| {
        let layer = |of: &str| format!("ViewLayer.{of}");
        let input = written(Scene::default(), 1, |_, frame| {
            let sample = frame.add(Frame::sample(), &layer("Combined"), "RGB", |s| s.noisy);
            let sample = frame.add(sample, &layer("Depth"), "Z", |s| [s.depth]);
            let sample = frame.add(sample, &layer("Normal"), "XYZ", |s| s.normal);
            frame.add(sample, &layer(name), "RGB", |s| if s.id == BALL { [0.0; 3] } else { s.albedo })
        });
        looked_at(input.path()).0.has_lobes
    };
    assert!(has_lobes("DiffCol") && !has_lobes("Denoising Albedo"));
}

/// Mitsuba numbers shapes anew whenever it loads a scene.
#[test]
fn ids_that_change_tell_surfaces_apart_within_a_frame() {
    let of_input = |shift: u32| {
        written(Scene::default(), 2, |number, frame| {
            let mut sample = frame.plain();
            sample.channels.retain(|(name, ..)| name != "id.I");
            let pixels = frame.pixels.clone();
            sample.channel("id.I", Type::Uint, move |x, y| {
                let id = pixels[y as usize * SIZE[0] + x as usize].id;
                (if id == 0 { 0 } else { id + shift * number }) as f32
            })
        })
    };
    // Columns of two pixels that move by as much.
    let moving = written(Scene::default(), 2, |number, frame| {
        let sample = frame.add(Frame::sample(), "", "RGB", |s| s.noisy);
        let sample = frame.add(sample, "depth", "Z", |_| [2.0]);
        let id = move |x: i32, _: i32| (100 + (x - 2 * number as i32).div_euclid(2)) as f32;
        frame.add(sample, "motion", "XY", |_| [-2.0, 0.0]).channel("id.I", Type::Uint, id)
    });
    assert!(looked_at(moving.path()).0.mapping.has(Role::Id));
    let (changing, still) = (of_input(5), of_input(0));
    let setup = looked_at(changing.path()).0;
    assert!(setup.mapping.has(Role::Shape) && !setup.mapping.has(Role::Id) && !setup.config.surface_id);
    assert!(setup.report.iter().any(|line| line.contains("within a frame alone")), "{:?}", setup.report);
    assert!(looked_at(still.path()).0.mapping.has(Role::Id));
    // What the user names is taken.
    let frames = frame_files::find(&[changing.path().to_owned()]).expect("frames");
    let options = Options { channels: vec![(Role::Id, "id".into())], ..Options::default() };
    let mut named = Setup::new(&frames, &options).expect("a setup");
    atrous_denoise::first_look::take(&frames, &mut named).expect("a look");
    assert!(named.mapping.has(Role::Id));
}

#[test]
fn an_id_between_two_is_that_of_the_nearer() {
    let number = |x: i32, _: i32| [2.0, 2.0, 3.5, 9.0, 9.0, 7.75, 3.0, 3.0][x as usize];
    let input = folder();
    let sample = Sample::new(8, 2).flat("R G B", Type::Half, 0.5).flat("depth.Z", Type::Float, 2.0).channel(
        "shape_index.I",
        Type::Float,
        number,
    );
    sample.write(&frame_path(input.path(), 0));
    let setup = looked_at(input.path()).0;
    let ids = loaded(input.path(), &setup, 0).surface_id.expect("ids");
    assert_eq!(ids[..8], [3, 3, 3, 10, 10, 10, 4, 4]);
}

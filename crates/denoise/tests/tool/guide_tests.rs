//! Guides and parts of the light that are noise, or that lack something.

use super::look_tests::{folder, looked_at, written};
use crate::samples::scene::{Frame, Scene};
use crate::samples::{self, frame_path};
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{first_look, frame, frame_files};

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
    let frames = frame_files::find(&[input.path().to_owned()]).expect("frames");
    // Half of the pixels had one that points to the side: now none is as it was.
    let normals = frame::load(&frames[0], &setup).expect("a frame").images["normal"].clone();
    assert!(normals.iter().all(|normal| normal[0] < 0.9));
    // What the user names is taken.
    let options = Options { channels: vec![(Role::Albedo, "albedo".into())], ..Options::default() };
    let mut named = Setup::new(&frames, &options).expect("a setup");
    first_look::take(&frames, &mut named).expect("a look");
    assert!(named.mapping.has(Role::Albedo));
}

/// The sky is a small part of the picture: it is noise all the same where fog is before it.
#[test]
fn parts_of_the_light_behind_fog_are_not_trusted() {
    let passes = |_: u32, frame: &Frame| {
        let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", |s| s.noisy);
        let sample = frame.add(sample, "ViewLayer.Depth", "Z", |s| [if s.id == 0 { 1e10 } else { s.depth }]);
        frame.add(sample, "ViewLayer.Env", "RGB", |s| s.environment)
    };
    let is_taken = |fog: f32| {
        let scene = Scene { samples: 8, fog, ..Scene::default() };
        looked_at(written(scene, 2, passes).path()).0.mapping.has(Role::Environment)
    };
    assert!(is_taken(0.0) && !is_taken(0.12));
}

#[test]
fn noise_in_alpha_is_told_of() {
    let told = |is_noisy: bool| {
        let input = written(Scene::default(), 2, move |number, frame| {
            let alpha = move |x: i32, y: i32| if is_noisy { samples::noise(x, y, 70 + number) } else { 0.5 };
            frame.plain().channel("A", samples::Type::Half, alpha)
        });
        looked_at(input.path()).0.report.iter().any(|line| line.contains("alpha is noisy"))
    };
    assert!(told(true) && !told(false));
}

/// Without depth and motion nobody knows where a texture was: that it changes proves little.
#[test]
fn a_texture_that_moves_is_no_noise() {
    let scene = Scene { speed: 0.15, ..Scene::default() };
    let input = written(scene, 2, |_, frame| {
        let sample = frame.add(Frame::sample(), "", "RGB", |s| s.noisy);
        frame.add(sample, "albedo", "RGB", |s| s.albedo)
    });
    assert!(looked_at(input.path()).0.mapping.has(Role::Albedo));
}

/// Rough metal of Mitsuba: its lobe by the angle to the eye.
#[test]
fn a_lobe_is_no_albedo() {
    let with = |most: f32, power: i32| {
        let mut pixels = Scene::default().frame(0).pixels.to_vec();
        pixels.iter_mut().filter(|seen| seen.id == 3).for_each(|seen| seen.albedo = [most * seen.normal[2].powi(power); 3]);
        let input = folder();
        Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&frame_path(input.path(), 0));
        looked_at(input.path()).0
    };
    let lobe = with(10.0, 8);
    let note = lobe.report.iter().find(|line| line.contains("albedo is above 1"));
    assert!(!lobe.mapping.has(Role::Albedo) && note.is_some_and(|line| line.ends_with("left out")), "{:?}", lobe.report);
    // One is within range, and the other a wrong number that is the same all over the ball.
    assert!(with(1.0, 8).mapping.has(Role::Albedo) && with(2.0, 0).mapping.has(Role::Albedo));
}

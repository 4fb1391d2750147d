//! Light of any size and sign: what is filtered, what is said, and how it is scored.

use super::look_tests::{folder, red, setup_of, written};
use crate::samples::scene::{Frame, Scene};
use crate::samples::{self, denoise, frame_path, program, Sample, Type};

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
    // The scale brings the first within their range, and no scale the second.
    for value in [300_000.0_f32, 1e12] {
        let sky = move |s: &samples::scene::Seen| if s.id == 0 { [value; 3] } else { s.noisy };
        let input = written(Scene::default(), 2, move |_, frame| frame.add(frame.guides(Frame::sample()), "", "RGB", sky));
        let output = folder();
        denoise(input.path(), output.path(), &["--float"]).expect("a run");
        let brightest = red(&frame_path(output.path(), 1)).into_iter().fold(0.0, f32::max);
        assert!((brightest / value - 1.0).abs() < 1e-3, "{brightest}");
    }
}

#[test]
fn surfaces_of_large_scenes_are_no_background() {
    let frame = samples::frame(0);
    let far = Sample { channels: frame.channels.into_iter().filter(|c| c.0 != "depth.Z").collect(), ..Sample::new(30, 18) };
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

/// The unit of the light is no matter of quality.
#[test]
fn scores_do_not_depend_on_the_unit() {
    let scores = |unit: f32| {
        let input = written(Scene::default(), 2, move |_, frame| {
            let sample = frame.add(Frame::sample(), "", "RGB", move |s| s.noisy.map(|v| v * unit));
            frame.add(sample, "ref", "RGB", move |s| s.reference.map(|v| v * unit))
        });
        let output = folder();
        denoise(input.path(), output.path(), &["--float", "--score"]).expect("a run");
        let text = std::fs::read(output.path().join("scores.json")).expect("scores");
        serde_json::from_slice::<serde_json::Value>(&text).expect("JSON")["mean"].clone()
    };
    let (usual, physical) = (scores(1.0), scores(131_072.0));
    // Light near 1 is scored as it is, and other light at about 1: so they differ a little.
    for (metric, tolerance) in [("ssim", 0.05), ("flip", 0.005)] {
        let [a, b] = [&usual, &physical].map(|scores| scores[metric].as_f64().expect("a number"));
        assert!((a - b).abs() < tolerance, "{metric}: {a} and {b}");
    }
}

#[test]
fn light_that_does_not_fit_is_counted_in_words() {
    let input = written(Scene::default(), 2, |_, frame| {
        let sample = frame.guides(Frame::sample());
        frame.add(sample, "", "RGB", |s| if s.id == 3 { [1e12; 3] } else { s.noisy })
    });
    let ball = |number| Scene::default().frame(number).pixels.iter().filter(|s| s.id == 3).count();
    let run = program(input.path(), folder().path(), &["--device", "reference"]).output().expect("a run");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success() && said.contains(&format!("warning: {} pixels are brighter", ball(0) + ball(1))), "{said}");
}

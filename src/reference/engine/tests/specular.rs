//! Specular light beside diffuse light: what of the one the other learns.

use super::*;
use crate::config::{Preset, Signals};
use crate::graph::{Feedback, Graph};
use crate::nodes::{Accumulation, Demodulate, Gradients, Import, Modulate, Variance};
use crate::{presets, Declaration, Error};

const EXTENT: [u32; 2] = [24, 24];

/// Both lights, each with gradients of its own from the same samples.
fn apart(source: Option<Gradients>) -> Result<Declaration, Error> {
    let config = Config { preset: Preset::Asvgf, signals: Signals::Specular, surface_id: false, ..Config::new(EXTENT) };
    let mut g = Graph::of_config(&config);
    let guides = g.import(Import { surface_id: false, ..Import::default() });
    let samples = presets::gradient_samples(&mut g, &guides, &config).expect("forward-projected");
    let noisy = g.radiance("noisy_diffuse");
    let change = presets::change_of_light(&mut g, &guides, &noisy, Some(samples));
    let irradiance = g.demodulate(&guides, &noisy, Demodulate { gradient: change.gradient, ..Demodulate::default() });
    let history = g.history(&irradiance, Feedback::Accumulated);
    let accumulation = Accumulation { confidence: Some(change.confidence), ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, accumulation);
    let diffuse = g.variance(&guides, &accumulated, &history, Variance::default());
    let parameters = presets::Specular { gradients: Some(source.unwrap_or(samples)), ..presets::Specular::default() };
    let (specular, _) = presets::specular(&mut g, &guides, &config, parameters);
    let both = g.pair(&diffuse.into(), &specular);
    let denoised = g.modulate(&guides, &both, Modulate { specular: true, ..Modulate::default() });
    g.output("denoised_radiance", &denoised);
    g.finish()
}

/// Confidence of specular light where it is its own.
const SPECULAR: &str = "history_confidence_specular";

/// The least confidence in the history of diffuse light and in that of specular light, the image of this name, in a frame in which
/// their light is so many times brighter; and the radiance of both in the middle.
fn after(declaration: Declaration, reshaded: bool, of_specular: &str, [diffuse, specular]: [f32; 2]) -> ([f32; 2], f32) {
    let mut engine = Engine::new(declaration).expect("twins").keep_transients();
    for i in 0..5 {
        let light = |scale| Image::new(EXTENT, if i == 4 { [scale, scale, scale, 0.0] } else { [1.0, 1.0, 1.0, 0.0] });
        for (name, image) in [
            ("depth", Image::new(EXTENT, [4.0; 4])),
            ("normal", Image::new(EXTENT, [0.0, 0.0, 1.0, 0.0])),
            ("noisy_diffuse", light(diffuse)),
            ("noisy_specular", light(specular)),
        ] {
            engine.upload(name, image.texels()).expect(name);
        }
        engine.run(&FrameParams { reshaded, ..FrameParams::new(EXTENT) }, &Tuning::default()).expect("frame");
    }
    let confidence = |name| match engine.texels(name, UseFrame::Current).expect(name) {
        Texels::Scalar(image) => image.texels().iter().copied().fold(f32::INFINITY, f32::min),
        other => panic!("{name} is {}", other.kind()),
    };
    let Ok(Texels::Colour(denoised)) = engine.texels("denoised_radiance", UseFrame::Current) else { panic!("a picture") };
    (["history_confidence", of_specular].map(confidence), denoised.at(glam::IVec2::splat(12))[0])
}

#[test]
fn light_that_changes_in_reflections_alone_leaves_diffuse_light_its_history() {
    // Where a history counts for nothing, the light of the frame is all there is: the sum of both.
    for (light, confidence, radiance) in
        [([1.0, 1.0], [1.0, 1.0], 2.0), ([1.0, 4.0], [1.0, 0.0], 5.0), ([4.0, 1.0], [0.0, 1.0], 5.0)]
    {
        let (given, sum) = after(apart(None).expect("valid"), true, SPECULAR, light);
        assert_eq!(given, confidence, "{light:?}");
        assert!((sum - radiance).abs() < 0.01, "{light:?}: {sum}");
    }
}

#[test]
fn gradients_of_all_light_are_none_of_specular_light() {
    let message = apart(Some(Gradients::Sparse { stratum_size: 3 })).expect_err("of all light").to_string();
    assert!(message.contains("gradients") && message.contains("forward-projected samples"), "{message}");
}

fn of_preset(preset: Preset) -> Declaration {
    Config { preset, signals: Signals::Specular, surface_id: false, ..Config::new(EXTENT) }.declare().expect("valid")
}

#[test]
fn light_that_rises_as_a_whole_rises_in_reflections_too() {
    // Diffuse history follows the ratio of the light. That of specular light does not, and may not be trusted for its sake.
    let (confidence, sum) = after(of_preset(Preset::Best), true, "unscaled_confidence", [4.0, 4.0]);
    assert_eq!(confidence, [1.0, 0.0]);
    assert!((sum - 8.0).abs() < 0.05, "{sum}");
}

#[test]
fn the_change_test_sees_light_that_changes_in_reflections_alone() {
    for preset in [Preset::Percentile, Preset::Fast] {
        for (light, expected) in [([1.0, 1.0], [1.0, 1.0]), ([1.0, 4.0], [1.0, 0.0]), ([4.0, 1.0], [0.0, 0.0])] {
            let (confidence, _) = after(of_preset(preset), false, SPECULAR, light);
            assert_eq!(confidence, expected, "{preset}: {light:?}");
        }
    }
}

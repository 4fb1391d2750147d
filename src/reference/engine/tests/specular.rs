//! Specular light beside diffuse light: what of the one the other learns.

use super::*;
use crate::config::{Preset, Signals};
use crate::graph::{Graph, Radiance};
use crate::nodes::{Albedo, Demodulate, Import, Modulate};
use crate::reference::both_confidences::{change_by, specular_confidence};
use crate::reference::luminance_history::unpack_luminance_history;
use crate::Declaration;

const EXTENT: [u32; 2] = [24, 24];

/// Confidence of specular light where it has an image of its own, and beside that of diffuse light.
const SPECULAR: &str = "history_confidence_specular";
const BOTH: &str = "history_confidence";

/// The least confidence in the history of diffuse light and in that of specular light, in the image of this name, in a frame in which
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
    let least = |name, of: fn(f32) -> f32| match engine.texels(name, UseFrame::Current).expect(name) {
        Texels::Scalar(image) => image.texels().iter().map(|c| of(*c)).fold(f32::INFINITY, f32::min),
        other => panic!("{name} is {}", other.kind()),
    };
    let confidence = match of_specular {
        BOTH => [least(BOTH, |c| 1.0 - change_by(c)), least(BOTH, specular_confidence)],
        _ => [BOTH, of_specular].map(|name| least(name, |c| c)),
    };
    let Ok(Texels::Colour(denoised)) = engine.texels("denoised_radiance", UseFrame::Current) else { panic!("a picture") };
    (confidence, denoised.at(glam::IVec2::splat(12))[0])
}

fn of_preset(preset: Preset) -> Declaration {
    Config { preset, signals: Signals::Specular, surface_id: false, ..Config::new(EXTENT) }.declare().expect("valid")
}

#[test]
fn light_that_rises_as_a_whole_rises_in_reflections_too() {
    // Diffuse history follows the ratio of the light. That of specular light does not, and may not be trusted for its sake.
    let (confidence, sum) = after(of_preset(Preset::Best), true, BOTH, [4.0, 4.0]);
    assert_eq!(confidence, [1.0, 0.0]);
    assert!((sum - 8.0).abs() < 0.05, "{sum}");
}

#[test]
fn the_history_of_mixed_light_follows_the_light_that_is_no_image() {
    let config = Config { preset: Preset::Best, signals: Signals::Mixed, surface_id: false, ..Config::new(EXTENT) };
    // Confidence in what is scaled and in images, the frames that a history of five holds, and the light, after it has risen from 1.
    let after = |light: f32, base: f32, coat: f32, roughness: f32| {
        let mut engine = Engine::new(config.declare().expect("valid")).expect("twins").keep_transients();
        for i in 0..5 {
            for (name, texel) in [
                ("depth", [4.0; 4]),
                ("normal", [0.0, 0.0, 1.0, 0.0]),
                ("albedo", [base; 4]),
                ("specular_albedo", [coat; 4]),
                ("roughness", [roughness; 4]),
                ("specular_hit_distance", [4.0; 4]),
                ("noisy_radiance", if i == 4 { [light; 4] } else { [1.0; 4] }),
            ] {
                engine.upload(name, Image::new(EXTENT, texel).texels()).expect(name);
            }
            engine.run(&FrameParams { reshaded: true, ..FrameParams::new(EXTENT) }, &Tuning::default()).expect("frame");
        }
        let middle = glam::IVec2::splat(12);
        let Ok(Texels::Uint(history)) = engine.texels("luminance_history", UseFrame::Current) else { panic!("a history") };
        let Ok(Texels::Colour(denoised)) = engine.texels("denoised_radiance", UseFrame::Current) else { panic!("a picture") };
        let Ok(Texels::Scalar(both)) = engine.texels(BOTH, UseFrame::Current) else { panic!("a confidence") };
        let confidence = [1.0 - change_by(both.at(middle)), specular_confidence(both.at(middle))];
        let frames = unpack_luminance_history(history.at(middle)).history_length.round();
        (confidence, frames, (denoised.at(middle)[0] * 10.0).round())
    };
    assert_eq!(after(4.0, 0.5, 0.04, 1.0), ([1.0, 0.0], 5.0, 40.0), "plaster");
    assert_eq!(after(4.0, 0.0, 0.9, 0.0), ([1.0, 0.0], 1.0, 40.0), "a mirror");
    assert_eq!(after(1.0, 0.0, 0.9, 0.0), ([1.0, 1.0], 5.0, 10.0), "a mirror in the light that it had");
}

#[test]
fn the_change_test_sees_light_that_changes_in_reflections_alone() {
    // Reflections of light that changes are not trusted by two presets; the third asks the reflections alone.
    let presets = [(Preset::Percentile, SPECULAR, 0.0), (Preset::Fast, SPECULAR, 0.0), (Preset::Best, BOTH, 1.0)];
    for (preset, of_specular, of_diffuse) in presets {
        for (light, expected) in [([1.0, 1.0], [1.0, 1.0]), ([1.0, 4.0], [1.0, 0.0]), ([4.0, 1.0], [0.0, of_diffuse])] {
            let (confidence, _) = after(of_preset(preset), false, of_specular, light);
            assert_eq!(confidence, expected, "{preset}: {light:?}");
        }
    }
}

#[test]
fn light_that_is_divided_apart_or_as_one_of_two_comes_back() {
    let divided = |apart: bool| {
        let mut g = Graph::new(EXTENT);
        let guides = g.import(Import { surface_id: false, ..Import::default() });
        let (diffuse, specular) = (g.radiance("noisy_diffuse"), g.radiance("noisy_specular"));
        let demodulate = |g: &mut Graph, light: &Radiance, albedo| {
            g.scope(&format!("{albedo:?}"), |g| g.demodulate(&guides, light, Demodulate { albedo, ..Demodulate::default() }))
        };
        let irradiance = match apart {
            true => {
                let diffuse = demodulate(&mut g, &diffuse, Albedo::Diffuse);
                let specular = demodulate(&mut g, &specular, Albedo::Specular);
                g.pair(&diffuse, &specular)
            }
            false => {
                let both = g.pair(&diffuse, &specular);
                demodulate(&mut g, &both, Albedo::Each)
            }
        };
        let radiance = g.modulate(&guides, &irradiance, Modulate { specular: true, emission: false, ..Modulate::default() });
        g.output("sum", &radiance);
        let mut engine = Engine::new(g.finish().expect("valid")).expect("twins");
        for (name, texel) in [
            ("depth", [4.0; 4]),
            ("normal", [0.0, 0.0, 1.0, 0.0]),
            ("albedo", [0.02; 4]),
            ("specular_albedo", [0.01; 4]),
            ("noisy_diffuse", [0.25; 4]),
            ("noisy_specular", [0.5; 4]),
        ] {
            engine.upload(name, Image::new(EXTENT, texel).texels()).expect(name);
        }
        engine.run(&FrameParams::new(EXTENT), &Tuning::default()).expect("frame");
        let Ok(Texels::Colour(sum)) = engine.texels("sum", UseFrame::Current) else { panic!("a picture") };
        sum.at(glam::IVec2::splat(12))[0]
    };
    assert_eq!([true, false].map(|apart| (divided(apart) * 1000.0).round()), [750.0; 2]);
}

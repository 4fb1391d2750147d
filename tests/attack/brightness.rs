//! Light in any unit: nits, moonlight, a scene that was exported a thousand times too dark.

use super::presets;
use crate::support::scene::{rmse, Scene};
use crate::support::{assert_valid, session, upload};
use atrous::config::Preset;
use atrous::executor::Session;
use atrous::{Config, Counter, FrameParams, Tuning};

const EXTENT: [u32; 2] = [66, 36];
const FRAMES: u32 = 8;

/// A few frames of a scene whose light is multiplied by `gain`, and the last of them as a converged renderer has it.
fn run(config: &Config, gain: f32) -> (Session, Vec<[f32; 4]>) {
    let scene = Scene { speed: 0.05, light: gain, ..Scene::new(EXTENT) };
    let mut session = session(config);
    let mut clean = Vec::new();
    for i in 0..FRAMES {
        let guides = scene.frame(i, i);
        upload(&mut session, &guides);
        let params = FrameParams { frame_slot: i % 2, ..scene.params(i) };
        session.run(&params, &Tuning::for_preset(config.preset)).expect("frame");
        clean = guides.clean;
    }
    (session, clean)
}

fn scaled(texels: &[[f32; 4]], factor: f32) -> Vec<[f32; 4]> {
    texels.iter().map(|texel| texel.map(|c| c * factor)).collect()
}

/// The error in the light of the scene without a gain, and how many values did not fit.
fn error(config: &Config, gain: f32) -> (f64, u32) {
    let (mut session, clean) = run(config, gain);
    let denoised = session.download("denoised_radiance").expect("an output");
    let saturated = session.statistics().expect("counters")[Counter::Saturated];
    (rmse(&scaled(&denoised, 1.0 / gain), &scaled(&clean, 1.0 / gain)), saturated)
}

/// Outputs of floats hold light of any unit, those of halves some of it: it is filtered alike. Of brighter light it is said that it does
/// not fit.
pub fn any_unit_of_light_is_filtered_alike() {
    let of_surfaces = |config: &Config| !matches!(config.preset, Preset::Volume | Preset::Stabilize | Preset::Eaw);
    for config in presets(EXTENT).into_iter().filter(of_surfaces) {
        let what = format!("{} {}", config.preset, config.signals);
        let (at_one, saturated) = error(&config, 1.0);
        assert_eq!(saturated, 0, "{what}");
        for (float_output, gain) in [(false, 1e-4), (false, 1e4), (true, 1e-6), (true, 1e-2), (true, 1e7)] {
            let (error, saturated) = error(&Config { float_output, ..config }, gain);
            println!("{what}, floats {float_output}: RMSE {at_one:.5}, {error:.5} at {gain:e}, {saturated} saturated");
            assert!(error < 1.05 * at_one && saturated == 0, "{what}: {error} at {gain:e}, {at_one} at 1, {saturated} saturated");
        }
        assert!(error(&config, 1e6).1 > 0, "{what}: nothing is said of light that does not fit");
    }
    assert_valid();
}

/// What the filter itself holds is the same in units in which an output of half floats is black or white.
pub fn the_filter_holds_light_of_any_unit() {
    for preset in [Preset::Best, Preset::Svgf] {
        let history = |gain: f32| {
            let (mut session, _) = run(&Config { preset, ..Config::new(EXTENT) }, gain);
            let exponent = session.download("filter_exposure").expect("an exponent")[0][0] - 128.0;
            scaled(&session.download("irradiance_history").expect("a history"), (-exponent).exp2() / gain)
        };
        let at_one = history(1.0);
        let light = rmse(&at_one, &vec![[0.0; 4]; at_one.len()]);
        for gain in [1e-6, 1e-4, 1e5, 1e7] {
            let difference = rmse(&history(gain), &at_one);
            println!("{preset}: {difference:.2e} of {light:.2e} at {gain:e}");
            assert!(difference < 0.01 * light, "{preset}: {difference} of {light} at {gain:e}");
        }
    }
    assert_valid();
}

/// The light of a volume, and the light whose visibility is filtered, go out in 32 bits as well.
pub fn whatever_goes_out_holds_light_of_any_unit() {
    let outputs = |gain: f32| {
        let config = Config { volume: true, visibility: 1, float_output: true, ..Config::new(EXTENT) };
        let (mut session, _) = run(&config, gain);
        ["denoised_radiance", "denoised_volume"].map(|name| {
            let texels = session.download(name).expect(name);
            // Alpha is no light of the picture.
            texels.into_iter().map(|[r, g, b, _]| [r / gain, g / gain, b / gain, 0.0]).collect::<Vec<_>>()
        })
    };
    let at_one = outputs(1.0);
    for gain in [1e-6, 1e7] {
        for (one, other) in at_one.iter().zip(outputs(gain)) {
            let (light, difference) = (rmse(one, &vec![[0.0; 4]; one.len()]), rmse(&other, one));
            println!("{difference:.2e} of {light:.2e} at {gain:e}");
            assert!(light > 0.0 && difference < 0.02 * light, "{difference} of {light} at {gain:e}");
        }
    }
    assert_valid();
}

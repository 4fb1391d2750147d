//! The firefly filter in every preset: it takes outliers, and next to nothing else.

use super::support::{assert_valid, pixels, random, rmse, scene::Guides, scene::Scene, session, upload};
use atrous::config::{GradientSource, Preset};
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("energy_stays_in_svgf", || energy_stays(Preset::Svgf)),
    ("energy_stays_in_asvgf", || energy_stays(Preset::Asvgf)),
    ("energy_stays_in_best", || energy_stays(Preset::Best)),
    ("energy_stays_in_stabilize", || energy_stays(Preset::Stabilize)),
    ("energy_stays_in_percentile", || energy_stays(Preset::Percentile)),
    ("energy_stays_in_eaw", || energy_stays(Preset::Eaw)),
    ("energy_stays_in_volume", || energy_stays(Preset::Volume)),
    ("outliers_go_in_every_preset", outliers_go_in_every_preset),
];

const EXTENT: [u32; 2] = [96, 54];

fn output(preset: Preset) -> &'static str {
    if preset == Preset::Volume {
        "denoised_volume"
    } else {
        "denoised_radiance"
    }
}

/// Denoises some frames of a scene at rest with the filter on or off.
fn denoised(preset: Preset, filter: bool, frames: impl Iterator<Item = Guides>) -> Vec<[f32; 4]> {
    let config = Config { preset, firefly_filter: filter, gradient_source: GradientSource::Confidence, ..Config::new(EXTENT) };
    let mut s = session(&config);
    // The presets `percentile` and `best` always filter: where they shall not, every luminance is usual.
    let firefly_bias = if filter { 0.0 } else { 65504.0 };
    let tuning = Tuning { firefly_bias, ..Tuning::for_preset(preset) };
    for guides in frames {
        upload(&mut s, &guides);
        if preset == Preset::Stabilize {
            s.upload("other_denoised_radiance", &guides.noisy_radiance).expect("other_denoised_radiance");
        }
        if preset.has_gradients() {
            s.upload("confidence", &[[1.0; 4]; (EXTENT[0] * EXTENT[1]) as usize]).expect("confidence");
        }
        s.run(&Scene::new(EXTENT).params(0), &tuning).expect("frame");
    }
    assert_valid();
    s.download(output(preset)).expect("output")
}

fn mean(image: &[[f32; 4]]) -> f64 {
    image.iter().map(|t| f64::from(t[0] + t[1] + t[2])).sum::<f64>() / image.len() as f64
}

/// Exponential noise, as heavy a tail as diffuse light has at one sample a pixel, and no outlier.
fn exponential(i: u32) -> Guides {
    let mut g = Scene::new(EXTENT).frame(0, i);
    for (p, (x, y)) in pixels(EXTENT).enumerate() {
        let noise = -(1.0 - random(x, y, 500 + i)).max(1e-7).ln();
        g.noisy_radiance[p] = g.clean[p].map(|v| v * noise);
        g.noisy_volume[p] = g.clean_volume[p].map(|v| v * noise);
    }
    g
}

fn energy_stays(preset: Preset) {
    let frames = || (0..6).map(exponential);
    let change = mean(&denoised(preset, true, frames())) / mean(&denoised(preset, false, frames())) - 1.0;
    println!("{preset:?}: the mean changes by {:.4} %", 100.0 * change);
    assert!(change.abs() < 0.005, "{preset:?}: {change}");
}

/// Two pixels of a thousand are far too bright.
fn with_outliers(i: u32) -> Guides {
    let mut g = Scene::new(EXTENT).frame(0, i);
    for (x, y) in pixels(EXTENT).filter(|&(x, y)| random(x, y, 900 + i) < 0.002) {
        let p = (y * EXTENT[0] + x) as usize;
        // The sky is not filtered; fog before it is.
        let factor = if g.surface_id[p] == 0 { 1.0 } else { 300.0 };
        g.noisy_radiance[p] = g.noisy_radiance[p].map(|v| factor * v);
        g.noisy_volume[p] = g.clean_volume[p].map(|v| 300.0 * v);
    }
    g
}

/// Most of the error that outliers add.
fn outliers_go_in_every_preset() {
    let scene = Scene::new(EXTENT).frame(0, 0);
    for preset in Preset::ALL {
        let clean = if preset == Preset::Volume { &scene.clean_volume } else { &scene.clean };
        let least = rmse(&denoised(preset, false, (0..6).map(|i| Scene::new(EXTENT).frame(0, i))), clean);
        let added = |filter| rmse(&denoised(preset, filter, (0..6).map(with_outliers)), clean) - least;
        let (with, without) = (added(true), added(false));
        println!("{preset:?}: to an error of {least:.4} outliers add {with:.4} instead of {without:.4}");
        assert!(with < 0.25 * without, "{preset:?}: {with} {without}");
    }
}

//! The stages of a volume: `volume_motion`, equal to the bit, `volume_points`, and the variants of the filters.

use super::compare::{halves, texels, Tolerance, HALF};
use super::{run, Captured};
use crate::support::{assert_valid, scene::Scene, session_with, upload};
use atrous::config::Preset;
use atrous::executor::SessionOptions;
use atrous::reference::{
    unpack_moments, unpack_volume_motion, volume_accumulation, volume_atrous, volume_motion_claim, volume_motion_resolve,
    volume_points, volume_variance, Image, PreviousFrame, SignalHistory, VolumeAccumulationInputs, VolumePointsInputs,
    VolumeVarianceInputs,
};
use atrous::{Config, FrameParams, Tuning, UseFrame};

pub fn check_claims(c: &Captured) {
    let (guide, points) = (c.packed("guide", UseFrame::Current), c.packed("volume_points", UseFrame::Previous));
    let mut twin = Image::new(c.config.allocated_extent, 0);
    volume_motion_claim(&c.frame.constants, &guide, &points, &mut twin);
    let claims = c.written_uints("volume_claims");
    assert_eq!(claims, twin);
    assert!(c.frame.reset.is_none() || claims.texels().iter().all(|key| *key == 0), "a point of before the reset");
}

pub fn check_motion(c: &Captured) {
    let (surface_motion, points) = (c.packed("surface_motion", UseFrame::Current), c.packed("volume_points", UseFrame::Previous));
    let claims = c.uints("volume_claims", UseFrame::Current);
    let twin = volume_motion_resolve(&c.frame.constants, &points, &surface_motion, &claims);
    let exact = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };
    texels("volume_motion", c, &c.written_uints("volume_motion"), &twin, exact, unpack_volume_motion);
}

pub fn check_points(c: &Captured) {
    let (noisy, depth) = (c.host("noisy_volume"), c.optional_host("scattering_depth"));
    let inputs = VolumePointsInputs { noisy_volume: &noisy, scattering_depth: depth.as_ref() };
    let twin = volume_points(&c.frame.constants, &inputs);
    halves("filter_ping_volume", c, &c.written_halves("filter_ping_volume"), &twin.radiance, HALF);
    let exact = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };
    texels("volume_points", c, &c.written_packed("volume_points"), &twin.volume_points, exact, |t| t.map(f32::from));
}

pub fn check_accumulation(c: &Captured) {
    let (guide, previous_guide) = (c.packed("guide", UseFrame::Current), c.packed("guide", UseFrame::Previous));
    let history = c.halves("irradiance_history_volume", UseFrame::Previous);
    let moments = c.packed("moments_volume", UseFrame::Previous);
    let signals = [SignalHistory { irradiance: &history, moments: &moments }];
    let inputs = VolumeAccumulationInputs {
        guide: &guide,
        volume_motion: &c.uints("volume_motion", UseFrame::Current),
        radiance: &c.halves("filter_ping_volume", UseFrame::Current),
        previous: Some(PreviousFrame { guide: &previous_guide, signals: &signals }),
    };
    let (radiance, moments) = volume_accumulation(&c.frame.constants, c.tuning, &inputs);
    let tested = Tolerance { outliers: 2e-3, ..HALF };
    halves("filter_ping_volume", c, &c.written_halves("filter_ping_volume"), &radiance, tested);
    // A deviation near 0 is the root of a difference that rounding decides.
    let tolerance = Tolerance { absolute: 2e-3, ..tested };
    texels("moments_volume", c, &c.written_packed("moments_volume"), &moments, tolerance, |t| {
        let m = unpack_moments(t);
        [m.mean, m.deviation, m.history_length, f32::from(m.reason)]
    });
}

pub fn check_variance(c: &Captured) {
    let inputs = VolumeVarianceInputs {
        guide: &c.packed("guide", UseFrame::Current),
        radiance: &c.halves("filter_ping_volume", UseFrame::Current),
        moments: &c.packed("moments_volume", UseFrame::Current),
    };
    let twin = volume_variance(&c.frame.constants, c.tuning, &inputs);
    let tolerance = Tolerance { relative: 3e-3, absolute: 2e-3, ..HALF };
    halves("filter_pong_volume", c, &c.written_halves("filter_pong_volume"), &twin, tolerance);
}

pub fn check_atrous(c: &Captured, level: u32) {
    let last = c.config.levels.max(2) - 1;
    let from = match level {
        0 => "filter_pong_volume",
        1 => "irradiance_history_volume",
        l if l % 2 == 0 => "filter_ping_volume",
        _ => "filter_pong_volume",
    };
    let to = match level {
        0 => "irradiance_history_volume",
        l if l == last => "denoised_volume",
        l if l % 2 == 1 => "filter_ping_volume",
        _ => "filter_pong_volume",
    };
    let guide = c.packed("guide", UseFrame::Current);
    let twin = volume_atrous(&c.frame.constants, c.tuning, level, &guide, &c.halves(from, UseFrame::Current));
    let tolerance = Tolerance { relative: 3e-3, absolute: 5e-4, ..HALF };
    halves(&format!("{to} of level {level}"), c, &c.written_halves(to), &twin, tolerance);
}

/// The pixels of the previous frame are carried, be they more or fewer than those of this one.
pub fn other_resolutions() {
    let allocated = [64, 40];
    let config = Config { preset: Preset::Volume, levels: 2, ..Config::new(allocated) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for (i, extent) in (0..).zip([[64, 40], [33, 19], [50, 40], [1, 1], [64, 40]]) {
        let scene = Scene { speed: 0.1, allocated, ..Scene::new(extent) };
        upload(&mut s, &scene.frame(i, i));
        let params = FrameParams { jitter: [0.25, -0.4], ..scene.params(i) };
        run(&mut s, &config, &params, &Tuning::default());
    }
    assert_valid();
}

/// Nothing bound: a volume moves as the surfaces behind it.
pub fn without_depths() {
    let config = Config { preset: Preset::Volume, levels: 2, ..Config::new([40, 23]) };
    let scene = Scene { speed: 0.1, ..Scene::new(config.allocated_extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..3 {
        upload(&mut s, &scene.frame(i, i));
        s.unbind("scattering_depth").expect("known");
        run(&mut s, &config, &scene.params(i), &Tuning::default());
        let motion = s.download_bytes("volume_motion", UseFrame::Current).expect("kept");
        let surfaces = s.download_bytes("surface_motion", UseFrame::Current).expect("kept");
        assert!(motion.chunks(4).eq(surfaces.chunks(8).map(|texel| &texel[..4])));
    }
    assert_valid();
}

//! A volume at other resolutions, and without scattering depths.

use super::run;
use crate::support::{assert_valid, scene::Scene, session_with, upload};
use atrous::config::Preset;
use atrous::executor::SessionOptions;
use atrous::{Config, FrameParams, Tuning, UseFrame};

/// The pixels of the previous frame are carried, be they more or fewer than those of this one.
pub fn other_resolutions() {
    let allocated = [66, 40];
    let config = Config { preset: Preset::Volume, levels: Some(2), ..Config::new(allocated) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for (i, extent) in (0..).zip([[66, 40], [33, 19], [50, 40], [1, 1], [66, 40]]) {
        let scene = Scene { speed: 0.1, allocated, ..Scene::new(extent) };
        upload(&mut s, &scene.frame(i, i));
        let params = FrameParams { jitter: [0.25, -0.4], ..scene.params(i) };
        run(&mut s, &params, &Tuning::default());
    }
    assert_valid();
}

/// Nothing bound: a volume moves as the surfaces behind it.
pub fn without_depths() {
    let config = Config { preset: Preset::Volume, levels: Some(2), ..Config::new([40, 23]) };
    let scene = Scene { speed: 0.1, ..Scene::new(config.allocated_extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..3 {
        upload(&mut s, &scene.frame(i, i));
        s.unbind("scattering_depth").expect("known");
        run(&mut s, &scene.params(i), &Tuning::default());
        let motion = s.download_bytes("volume_motion", UseFrame::Current).expect("kept");
        let surfaces = s.download_bytes("surface_motion", UseFrame::Current).expect("kept");
        assert!(motion.chunks(4).eq(surfaces.chunks(8).map(|texel| &texel[..4])));
    }
    assert_valid();
}

//! `tone_map` with every curve.

use super::run;
use crate::support::{assert_valid, scene::Scene, session_with, svgf, svgf_tuning, upload};
use atrous::config::PostProcess;
use atrous::executor::SessionOptions;
use atrous::{Config, ToneCurve, Tuning};

/// Every curve, from black to far beyond white.
pub fn curves() {
    let scene = Scene { noise: 0.0, ..Scene::new([60, 5]) };
    for tone_curve in [ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Linear] {
        let config = Config { post_process: PostProcess::ToneMap, levels: Some(1), ..svgf(scene.extent) };
        let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        let mut g = scene.frame(0, 0);
        let ramp = |i: usize| 2f32.powf((i % 64) as f32 / 3.0 - 8.0) * if i.is_multiple_of(64) { 0.0 } else { 1.0 };
        g.noisy_radiance.iter_mut().enumerate().for_each(|(i, t)| *t = [ramp(i), 0.5 * ramp(i), 2.0 * ramp(i), 1.0]);
        upload(&mut s, &g);
        run(&mut s, &scene.params(0), &Tuning { tone_curve, exposure: 1.7, ..svgf_tuning() });
    }
    assert_valid();
}

//! `debug_view`: every view of every preset.

use super::run;
use crate::support::{assert_valid, scene::Scene, session_with, svgf, upload};
use atrous::config::{Preset, Signals};
use atrous::executor::{Session, SessionOptions};
use atrous::{Config, DebugView, FrameParams, Tuning};

/// Every view of every preset, with values that are not finite and a change of light to show.
pub fn every_view() {
    let base = Config { debug_view: true, ..svgf([40, 23]) };
    for config in [
        base,
        Config { preset: Preset::Percentile, signals: Signals::Apart, ..base },
        Config { preset: Preset::Best, signals: Signals::Specular, ..base },
        Config { preset: Preset::Asvgf, firefly_filter: true, ..base },
        Config { preset: Preset::Stabilize, ..base },
        Config { preset: Preset::Eaw, ..base },
    ] {
        let scene = Scene { speed: 0.12, ..Scene::new(config.allocated_extent) };
        let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        for (i, view) in (0..).zip(DebugView::ALL) {
            let mut guides = scene.frame(i, i);
            let brightness = if i % 5 == 3 { 4.0 } else { 1.0 };
            for texels in [&mut guides.noisy_radiance, &mut guides.noisy_direct] {
                texels.iter_mut().for_each(|t| *t = t.map(|c| c * brightness));
                texels[70] = [f32::NAN; 4];
                texels[205] = [900.0; 4];
            }
            upload(&mut s, &guides);
            if config.preset == Preset::Stabilize {
                s.upload("other_denoised_radiance", &guides.noisy_radiance).expect("other_denoised_radiance");
            }
            let params = FrameParams { debug_view: Some(view), reshaded: true, ..scene.params(i) };
            run(&mut s, &params, &Tuning::for_preset(config.preset));
            shows_something(&mut s, view);
        }
    }
    assert_valid();
}

/// What the preset has nothing for is a chequer, and nothing else is.
fn shows_something(s: &mut Session, view: DebugView) {
    let has = s.executor().denoiser().declaration().debug_views().contains(&view);
    let shown = s.download("debug_view").expect("debug_view");
    let chequer = shown.iter().all(|t| [0.02, 0.05].iter().any(|grey| t[..3].iter().all(|c| (c - grey).abs() < 1e-3)));
    assert_eq!(!chequer, has, "{view:?}");
}

//! `debug_view`.

use super::compare::{halves, Tolerance, HALF};
use super::{each, run, Captured};
use crate::support::{assert_valid, scene::Scene, session_with, upload};
use atrous::config::{Preset, Signals};
use atrous::executor::{Session, SessionOptions};
use atrous::reference::{debug_view, DebugViewInputs, Image, Statistics};
use atrous::{Config, DebugView, FrameParams, Tuning, UseFrame};

/// Every view of every preset, with values that are not finite and a change of light to show.
pub fn every_view() {
    let base = Config { debug_view: true, ..Config::new([40, 23]) };
    for config in [
        base,
        Config { preset: Preset::Percentile, signals: Signals::Apart, ..base },
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
            run(&mut s, &config, &params, &Tuning::for_preset(config.preset));
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

pub fn check(c: &Captured) {
    let present = |name: &str| c.suffixes().iter().all(|s| c.has(&format!("{name}{s}")));
    let moments = if present("moments") { c.packed_signals("moments", UseFrame::Current) } else { Vec::new() };
    let history = if present("irradiance_history") { c.signals("irradiance_history", UseFrame::Current) } else { Vec::new() };
    let percentiles: Vec<Image<u32>> = match present("block_percentiles") {
        true => c.suffixes().iter().map(|s| c.block_uints(&format!("block_percentiles{s}"))).collect(),
        false => Vec::new(),
    };
    let noisy: Vec<_> = c.filtered().iter().map(|name| c.host(name)).collect();
    let confidence = c.has("history_confidence").then(|| c.floats("history_confidence"));
    let albedo = c.optional_host("albedo");
    let gradient = ["gradient_ping", "gradient_pong"].into_iter().find(|name| c.has(name));
    let gradient = gradient.map(|name| c.halves_of(name, UseFrame::Current, c.strata()));
    let mut statistics = Statistics::default();
    statistics
        .copy_from_slice(&bytemuck::allocation::pod_collect_to_vec::<u8, u32>(c.optional_buffer("statistics").expect("read")));
    let inputs = DebugViewInputs {
        guide: &c.packed("guide", UseFrame::Current),
        surface_motion: &c.packed("surface_motion", UseFrame::Current),
        statistics: &statistics,
        moments: &each(&moments),
        irradiance_history: &each(&history),
        history_confidence: confidence.as_ref(),
        gradient: gradient.as_ref(),
        stratum_size: c.config.stratum_size,
        block_percentiles: &each(&percentiles),
        noisy: &each(&noisy),
        albedo: albedo.as_ref(),
    };
    let view = c.frame.debug_view.unwrap_or_default();
    let twin = debug_view(&c.frame.constants, c.tuning, &inputs, view);
    let what = format!("debug_view {view:?} of {:?}", c.config.preset);
    // Colours go through a power, which devices round each in its own way.
    halves(&what, c, &c.written_halves("debug_view"), &twin, Tolerance { relative: 4e-3, absolute: 2e-4, ..HALF });
}

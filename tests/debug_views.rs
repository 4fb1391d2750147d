//! Views behind a frame, on the GPU and by the CPU's chain of stages: both have to show the same images of each preset.

use super::support::rig::Rig;
use super::support::{assert_valid, gpu, scene::Scene, session, session_with, svgf, svgf_tuning, upload, upload_to_engine};
use ash::vk;
use atrous::config::{Preset, Signals};
use atrous::executor::SessionOptions;
use atrous::reference::Engine;
use atrous::{Config, DebugView, Error, FrameParams, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("are_those_of_the_cpu", are_those_of_the_cpu),
    ("do_not_depend_on_what_was_shown_before", do_not_depend_on_what_was_shown_before),
    ("are_left_out_where_none_is_asked_for", are_left_out_where_none_is_asked_for),
    ("nothing_is_recorded_once_more_without_a_view", nothing_is_recorded_once_more_without_a_view),
];

const EXTENT: [u32; 2] = [61, 35];
const FRAMES: u32 = 4;

fn configurations() -> [Config; 7] {
    let base = Config { debug_view: true, firefly_filter: true, ..svgf(EXTENT) };
    [
        Config { signals: Signals::Apart, ..base },
        Config { preset: Preset::Asvgf, ..base },
        Config { preset: Preset::Percentile, signals: Signals::Apart, ..base },
        Config { preset: Preset::Stabilize, ..base },
        Config { preset: Preset::Eaw, ..base },
        Config { preset: Preset::Volume, ..base },
        Config { preset: Preset::Best, signals: Signals::Specular, visibility: 1, ..base },
    ]
}

/// The light comes on with the last frame, and the camera moves.
fn scene_of(frame: u32) -> Scene {
    Scene { speed: 0.12, light: if frame + 1 == FRAMES { 4.0 } else { 1.0 }, ..Scene::new(EXTENT) }
}

/// Where `best` drops all history, its deviations are roots of next to nothing, which the rounding of a half decides: its light changes by less.
fn light_of(preset: Preset, light: f32) -> f32 {
    if preset == Preset::Best {
        light.min(1.75)
    } else {
        light
    }
}

fn are_those_of_the_cpu() {
    for config in configurations() {
        let mut s = session(&config);
        let mut engine = Engine::new(config.declare().expect("valid")).expect("twins").keep_transients();
        let wanted = s.executor().denoiser().declaration().debug_views();
        for i in 0..FRAMES {
            let scene = scene_of(i);
            let scene = Scene { light: light_of(config.preset, scene.light), ..scene };
            let mut g = scene.frame(i, i);
            for texels in [&mut g.noisy_radiance, &mut g.noisy_direct, &mut g.noisy_volume] {
                texels[205] = [900.0; 4];
                texels[70] = [f32::NAN; 4];
            }
            upload(&mut s, &g);
            if config.preset == Preset::Stabilize {
                s.upload("other_denoised_radiance", &g.noisy_radiance).expect("other_denoised_radiance");
            }
            let params = FrameParams { reshaded: true, ..scene.params(i) };
            s.run(&params, &Tuning::for_preset(config.preset)).expect("frame");
            upload_to_engine(&mut engine, &g);
            if config.preset == Preset::Stabilize {
                engine.upload("other_denoised_radiance", &g.noisy_radiance).expect("other_denoised_radiance");
            }
            engine.run(&params, &Tuning::for_preset(config.preset)).expect("frame");
            for view in &wanted {
                let twin = engine.debug_view(*view).expect("debug_view");
                let shown = s.debug_view(*view).expect("debug_view");
                let what = format!("{view:?} of {:?}, frame {i}", config.preset);
                assert_alike(&shown, &twin, &what);
                let is_uniform = shown.iter().all(|t| t[..3] == shown[0][..3]);
                assert!(i + 1 < FRAMES || !is_uniform, "{what}: nothing is shown");
            }
        }
    }
    assert_valid();
}

fn nothing_is_recorded_once_more_without_a_view() {
    for (debug_view, view) in [(true, None), (false, Some(DebugView::Alpha))] {
        let mut rig = Rig::new(gpu(), &Config { debug_view, ..Config::new(EXTENT) }, 1);
        let params = FrameParams { debug_view: view, ..FrameParams::new(EXTENT) };
        let frame = rig.executor.begin_frame(&params, &Tuning::default()).expect("a frame");
        // SAFETY: nothing is recorded, so that the null command buffer is never used.
        let recorded = unsafe { rig.executor.record_debug_view(vk::CommandBuffer::null(), &frame) };
        assert_eq!(recorded, Ok(()), "a pass: {debug_view}, a view: {view:?}");
    }
}

/// Differences of one stage grow in the next and in the next frame, so a few pixels may differ.
fn assert_alike(gpu: &[[f32; 4]], cpu: &[[f32; 4]], what: &str) {
    let differs = |(a, b): &(&[f32; 4], &[f32; 4])| {
        let number = (a[3] - b[3]).abs() > 0.02 + 0.02 * b[3].abs();
        number || (0..3).any(|c| (a[c] - b[c]).abs() > 0.02)
    };
    let different = gpu.iter().zip(cpu).filter(differs).count();
    assert!(100 * different <= gpu.len(), "{what}: {different} of {} pixels differ", gpu.len());
}

fn do_not_depend_on_what_was_shown_before() {
    let config = Config { debug_view: true, preset: Preset::Asvgf, ..Config::new(EXTENT) };
    let mut s = session(&config);
    let views = s.executor().denoiser().declaration().debug_views();
    let mut first = None;
    for i in 0..2 {
        let scene = scene_of(i);
        upload(&mut s, &scene.frame(i, i));
        let params = FrameParams { debug_view: Some(DebugView::Alpha), reshaded: true, ..scene.params(i) };
        s.run(&params, &Tuning::for_preset(config.preset)).expect("frame");
        first = Some(s.download("debug_view").expect("debug_view"));
    }
    for view in views {
        s.debug_view(view).expect("debug_view");
    }
    assert!(Some(s.debug_view(DebugView::Alpha).expect("debug_view")) == first);
    assert_valid();
}

fn are_left_out_where_none_is_asked_for() {
    let scene = scene_of(0);
    let run = |config: &Config| {
        let options = SessionOptions { timestamps: gpu().has_timestamps(), ..SessionOptions::default() };
        let mut s = session_with(config, options);
        upload(&mut s, &scene.frame(0, 0));
        // Times are those of the frame before.
        for _ in 0..2 {
            s.run(&scene.params(0), &svgf_tuning()).expect("frame");
        }
        s
    };
    let s = run(&Config { debug_view: true, ..svgf(EXTENT) });
    let (times, passes) = (s.times(), s.executor().denoiser().declaration().passes().len());
    assert_eq!(times.len(), if gpu().has_timestamps() { passes } else { 0 });
    assert!(times.iter().all(|time| time.milliseconds >= 0.0), "{times:?}");

    let mut s = run(&svgf(EXTENT));
    let error = s.debug_view(DebugView::Alpha).expect_err("there is no such output");
    assert!(matches!(&error, Error::UnknownResource { given, .. } if given == "debug_view"), "{error}");
    assert_valid();
}

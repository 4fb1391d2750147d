//! Volumes: alone, and beside the presets for surfaces.

use super::support::{assert_finite, assert_valid, frame, rmse, scene::Guides, scene::Scene, session, session_with, upload};
use atrous::config::{PostProcess, Preset, Signals};
use atrous::executor::{Session, SessionOptions};
use atrous::Counter;
use atrous::{Config, FrameParams, ResetReason, ToneCurve, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_constant_volume_is_a_fixed_point", a_constant_volume_is_a_fixed_point),
    ("a_reset_frame_equals_a_first_frame", a_reset_frame_equals_a_first_frame),
    ("two_runs_are_bit_identical", two_runs_are_bit_identical),
    ("its_own_motion_is_better_than_that_of_surfaces", its_own_motion_is_better_than_that_of_surfaces),
    ("bad_values_stop_and_are_counted", bad_values_stop_and_are_counted),
    ("what_is_no_depth_is_no_point", what_is_no_depth_is_no_point),
    ("surfaces_and_volume_do_not_touch_each_other", surfaces_and_volume_do_not_touch_each_other),
    ("the_picture_is_the_sum", the_picture_is_the_sum),
    ("fog_before_the_sky_is_filtered", fog_before_the_sky_is_filtered),
    ("a_render_rect_gives_the_bits_of_a_tight_image", a_render_rect_gives_the_bits_of_a_tight_image),
];

const EXTENT: [u32; 2] = [96, 54];

fn alone(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Volume, ..Config::new(extent) }
}

fn volume_of(s: &mut Session, g: &Guides, params: &FrameParams) -> Vec<[f32; 4]> {
    upload(s, g);
    let context = s.run(params, &Tuning::default()).expect("frame");
    let image = s.download("denoised_volume").expect("denoised_volume");
    assert_finite(&image, context.render_extent, s.executor().denoiser().declaration().allocated_extent());
    assert_valid();
    image
}

fn a_constant_volume_is_a_fixed_point() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let mut s = session(&alone(EXTENT));
    for i in 0..5 {
        let mut g = scene.frame(i, i);
        g.noisy_volume.fill([0.5, 0.25, 2.0, 1.0]);
        for texel in volume_of(&mut s, &g, &scene.params(i)) {
            let close = (0..3).all(|c| (texel[c] / [0.5, 0.25, 2.0][c] - 1.0).abs() < 2e-3);
            assert!(close, "frame {i}: {texel:?}");
        }
    }
}

fn a_reset_frame_equals_a_first_frame() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let (mut used, mut fresh) = (session(&alone(EXTENT)), session(&alone(EXTENT)));
    for i in 0..4 {
        volume_of(&mut used, &scene.frame(i, i), &scene.params(i));
    }
    let cut = FrameParams { reset: Some(ResetReason::CameraCut), ..scene.params(9) };
    let g = scene.frame(9, 9);
    assert_eq!(volume_of(&mut used, &g, &cut), volume_of(&mut fresh, &g, &scene.params(9)));
}

fn two_runs_are_bit_identical() {
    let scene = Scene { speed: 0.13, ..Scene::new(EXTENT) };
    let run = || -> Vec<Vec<[f32; 4]>> {
        let mut s = session_with(&alone(EXTENT), SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        let mut images = Vec::new();
        for i in 0..5 {
            images.push(volume_of(&mut s, &scene.frame(i, i), &scene.params(i)));
            images.push(s.download("volume_motion").expect("kept"));
        }
        images
    };
    assert_eq!(run(), run());
}

/// A sheet of fog at a third of the wall's distance, seen by a camera that moves along.
fn its_own_motion_is_better_than_that_of_surfaces() {
    let scene = Scene { speed: 0.06, ..Scene::new(EXTENT) };
    let error = |with_depths: bool| {
        let mut s = session(&alone(EXTENT));
        let mut error = 0.0;
        for i in 0..16 {
            let mut g = scene.frame(i, i);
            if !with_depths {
                g.scattering_depth.fill([0.0; 4]);
            }
            let image = volume_of(&mut s, &g, &scene.params(i));
            error = rmse(&image, &g.clean_volume) / rmse(&g.noisy_volume, &g.clean_volume);
        }
        error
    };
    let (own, surfaces) = (error(true), error(false));
    println!("error as a share of the noisy one: {own:.4} with motion of its own, {surfaces:.4} with that of surfaces");
    assert!(own < 0.25 && own < 0.75 * surfaces, "{own} {surfaces}");
}

fn bad_values_stop_and_are_counted() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let mut s = session(&alone(EXTENT));
    for i in 0..3 {
        let mut g = scene.frame(i, i);
        g.scattering_depth.fill([2.0; 4]);
        for (p, bad) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
            g.noisy_volume[1000 + p][p] = bad;
            g.scattering_depth[2000 + p] = [bad; 4];
        }
        volume_of(&mut s, &g, &scene.params(i));
        let counts = s.download("statistics").expect("statistics");
        let count = |i: Counter| counts[i as usize][0];
        // Infinity is a ray that nothing scattered.
        assert_eq!((count(Counter::Radiance), count(Counter::ScatteringDepth)), (3.0, 1.0));
    }
}

fn what_is_no_depth_is_no_point() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let run = |depths: &[f32]| {
        let mut s = session(&alone(EXTENT));
        let images = (0..4).map(|i| {
            let mut g = scene.frame(i, i);
            g.scattering_depth.iter_mut().enumerate().for_each(|(p, t)| *t = [depths[p % depths.len()]; 4]);
            volume_of(&mut s, &g, &scene.params(i))
        });
        images.collect::<Vec<_>>()
    };
    let none = run(&[0.0]);
    assert_eq!(none, run(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0]));
    assert_ne!(none, run(&[2.0]));
}

fn surfaces_and_volume_do_not_touch_each_other() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    for (preset, signals) in
        [(Preset::Svgf, Signals::Apart), (Preset::Percentile, Signals::Together), (Preset::Eaw, Signals::Together)]
    {
        let config = Config { preset, signals, ..Config::new(EXTENT) };
        let (mut surfaces, mut volume) = (session(&config), session(&alone(EXTENT)));
        let mut both = session(&Config { volume: true, ..config });
        for i in 0..4 {
            let (g, params) = (scene.frame(i, i), scene.params(i));
            let (_, expected) = frame(&mut surfaces, &g, &params, &Tuning::default());
            let (_, image) = frame(&mut both, &g, &params, &Tuning::default());
            assert_eq!(image, expected, "{preset:?}, surfaces of frame {i}");
            let image = both.download("denoised_volume").expect("output");
            assert_eq!(image, volume_of(&mut volume, &g, &params), "{preset:?}, volume of frame {i}");
        }
    }
}

fn the_picture_is_the_sum() {
    let scene = Scene { light: 0.2, ..Scene::new(EXTENT) };
    let mut s = session(&Config { volume: true, post_process: PostProcess::ToneMap, ..Config::new(EXTENT) });
    upload(&mut s, &scene.frame(0, 0));
    s.run(&scene.params(0), &Tuning { tone_curve: ToneCurve::Linear, ..Tuning::default() }).expect("frame");
    let [display, surfaces, volume] =
        ["display", "denoised_radiance", "denoised_volume"].map(|name| s.download(name).expect("output"));
    for ((d, a), b) in display.iter().zip(&surfaces).zip(&volume) {
        assert!((0..3).all(|c| (d[c] - (a[c] + b[c]).min(1.0)).abs() < 2e-3), "{d:?} {a:?} {b:?}");
    }
}

fn fog_before_the_sky_is_filtered() {
    let scene = Scene::new(EXTENT);
    let mut s = session(&alone(EXTENT));
    let mut last = Vec::new();
    for i in 0..8 {
        last = volume_of(&mut s, &scene.frame(0, i), &scene.params(0));
    }
    let g = scene.frame(0, 7);
    let of_sky = |image: &[[f32; 4]]| -> Vec<[f32; 4]> {
        image.iter().zip(&g.surface_id).filter(|(_, &id)| id == 0).map(|(t, _)| *t).collect()
    };
    let (filtered, noisy) =
        (rmse(&of_sky(&last), &of_sky(&g.clean_volume)), rmse(&of_sky(&g.noisy_volume), &of_sky(&g.clean_volume)));
    assert!(of_sky(&last).len() > 100 && filtered < 0.25 * noisy, "{filtered} {noisy}");
}

fn a_render_rect_gives_the_bits_of_a_tight_image() {
    let tight = Scene { speed: 0.15, ..Scene::new([37, 21]) };
    let loose = Scene { allocated: [66, 40], ..tight };
    let (mut a, mut b) = (session(&alone(tight.allocated)), session(&alone(loose.allocated)));
    for i in 0..4 {
        let x = volume_of(&mut a, &tight.frame(i, i), &tight.params(i));
        let y = volume_of(&mut b, &loose.frame(i, i), &loose.params(i));
        for (row, expected) in x.chunks(37).enumerate() {
            assert_eq!(&y[row * 66..row * 66 + 37], expected, "frame {i}, row {row}");
        }
    }
}

//! SVGF over many frames: how much noise goes, how soon it settles, what happens where nothing was seen before.

use super::support::{frame, luminance_history, rmse, scene::Scene, session, svgf, svgf_tuning};
use atrous::config::Signals;
use atrous::Config;
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("the_temporal_error_settles_ten_times_below_the_input", the_temporal_error_settles_ten_times_below_the_input),
    ("noise_goes_under_a_moving_camera", noise_goes_under_a_moving_camera),
    ("disoccluded_pixels_say_why", disoccluded_pixels_say_why),
    ("a_light_that_changes_leaves_no_trace", a_light_that_changes_leaves_no_trace),
];

const EXTENT: [u32; 2] = [96, 54];

/// Mean absolute change of luminance from one frame to the next.
fn change(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    let luminance = |t: &[f32; 4]| 0.2126 * f64::from(t[0]) + 0.7152 * f64::from(t[1]) + 0.0722 * f64::from(t[2]);
    a.iter().zip(b).map(|(a, b)| (luminance(a) - luminance(b)).abs()).sum::<f64>() / a.len() as f64
}

/// [SVGF] Fig. 10.
fn the_temporal_error_settles_ten_times_below_the_input() {
    let scene = Scene::new(EXTENT);
    let mut s = session(&svgf(EXTENT));
    let (mut errors, mut noisy_errors) = (Vec::new(), Vec::new());
    let mut previous: Option<[Vec<[f32; 4]>; 2]> = None;
    for i in 0..60 {
        let g = scene.frame(0, i);
        let (_, image) = frame(&mut s, &g, &scene.params(0), &svgf_tuning());
        if let Some([before, noisy_before]) = &previous {
            errors.push(change(&image, before));
            noisy_errors.push(change(&g.noisy_radiance, noisy_before));
        }
        previous = Some([image, g.noisy_radiance]);
    }
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (soon, late, noisy) = (mean(&errors[15..20]), mean(&errors[40..]), mean(&noisy_errors));
    println!("temporal error: noisy {noisy:.5}, frames 16 to 20 {soon:.5}, frames 41 to 59 {late:.5}");
    assert!(late <= noisy / 10.0, "{late} against {noisy}");
    assert!((soon / late - 1.0).abs() < 0.15, "not settled after 20 frames: {soon} against {late}");
}

fn noise_goes_under_a_moving_camera() {
    for signals in [Signals::Together, Signals::Apart] {
        let scene = Scene { speed: 0.04, ..Scene::new(EXTENT) };
        let mut s = session(&Config { signals, ..svgf(EXTENT) });
        for i in 0..12 {
            let g = scene.frame(i, i);
            let (_, image) = frame(&mut s, &g, &scene.params(i), &svgf_tuning());
            let (denoised, noisy) = (rmse(&image, &g.clean), rmse(&g.noisy_radiance, &g.clean));
            if i >= 6 {
                assert!(denoised < noisy / 4.0, "{signals:?}, frame {i}: {denoised} of {noisy}");
            }
        }
    }
}

fn reasons(s: &mut atrous::executor::Session) -> [usize; 6] {
    let mut counts = [0; 6];
    for m in luminance_history(s, "luminance_history") {
        counts[m.reason as usize] += 1;
    }
    counts
}

fn disoccluded_pixels_say_why() {
    let scene = Scene { speed: 0.8, ..Scene::new(EXTENT) };
    let mut s = session(&svgf(EXTENT));
    let first = scene.frame(0, 0);
    let surface = first.surface_id.iter().filter(|&&id| id != 0).count();
    frame(&mut s, &first, &scene.params(0), &svgf_tuning());
    let [_, off_screen, id, depth, normal, reset] = reasons(&mut s);
    assert_eq!((off_screen, id, depth, normal), (0, 0, 0, 0));
    assert_eq!(reset, surface);
    frame(&mut s, &scene.frame(1, 1), &scene.params(1), &svgf_tuning());
    let [kept, off_screen, id, _, _, reset] = reasons(&mut s);
    assert_eq!(reset, 0);
    assert!(off_screen > 25, "a sliding camera uncovers a border: {off_screen}");
    assert!(id > 5, "the ball uncovers the wall behind it: {id}");
    assert!(kept * 10 > surface * 8, "{kept} of {surface}");
}

fn a_light_that_changes_leaves_no_trace() {
    let scene = Scene::new(EXTENT);
    let dark = Scene { light: 0.1, ..scene };
    let mut s = session(&svgf(EXTENT));
    for i in 0..10 {
        frame(&mut s, &scene.frame(0, i), &scene.params(0), &svgf_tuning());
    }
    let mut error = f64::NAN;
    for i in 10..40 {
        let g = dark.frame(0, i);
        let (_, image) = frame(&mut s, &g, &dark.params(0), &svgf_tuning());
        error = rmse(&image, &g.clean);
    }
    assert!(error < 0.01, "{error} thirty frames after the light was dimmed");
}

//! Input with pixels that have no sample, for every preset that filters light: checkerboards, one of 2×2 and of 4×4, half the rate for
//! one signal alone.

use super::support::{assert_valid, frame, luminance_history, pixels, rmse, scene::Scene, session};
use atrous::config::{Preset, Sampling, Signals};
use atrous::executor::Session;
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("every_preset_takes_holes", every_preset_takes_holes),
    ("one_signal_may_have_holes_alone", one_signal_may_have_holes_alone),
    ("holes_that_nothing_fills_are_counted", holes_that_nothing_fills_are_counted),
];

const EXTENT: [u32; 2] = [112, 66];
const FRAMES: u32 = 16;

/// Whether a pixel has a sample in a frame: each pixel in its turn.
pub fn is_sampled(side: u32, index: u32, x: u32, y: u32) -> bool {
    x % side == index % side && y % side == (index / side + index) % side
}

type Pattern = fn(u32, u32, u32) -> bool;

/// Name, what the filter is told, which pixels have a sample, one of how many.
const PATTERNS: [(&str, Sampling, Pattern, f64); 3] = [
    ("checkerboard", Sampling::OneOf2x2, |index, x, y| (x + y + index).is_multiple_of(2), 2.0),
    ("one of 2x2", Sampling::OneOf2x2, |index, x, y| is_sampled(2, index, x, y), 4.0),
    ("one of 4x4", Sampling::OneOf4x4, |index, x, y| is_sampled(4, index, x, y), 16.0),
];

fn punch(noisy: &mut [[f32; 4]], index: u32, pattern: Pattern, hole: f32) {
    for (x, y) in pixels(EXTENT).filter(|(x, y)| !pattern(index, *x, *y)) {
        noisy[(y * EXTENT[0] + x) as usize] = [hole; 4];
    }
}

/// The mean error of the last frames of a camera that slides; with it how many bad radiances were counted, and what ran.
fn error(config: &Config, change: impl Fn(u32, &mut super::support::scene::Guides)) -> (f64, f32, Session) {
    let scene = Scene { speed: 0.03, ..Scene::new(EXTENT) };
    let mut s = session(config);
    let (mut sum, mut counted) = (0.0, 0.0);
    for i in 0..FRAMES {
        let mut guides = scene.frame(i, i);
        change(i, &mut guides);
        let (_, image) = frame(&mut s, &guides, &scene.params(i), &Tuning::for_preset(config.preset));
        counted += s.download("statistics").expect("statistics")[3][0];
        if i >= FRAMES / 2 {
            sum += rmse(&image, &guides.clean) / f64::from(FRAMES / 2);
        }
    }
    assert_valid();
    (sum, counted, s)
}

/// The mean history length of each of two signals, frames.
fn history_lengths(mut s: Session) -> [f32; 2] {
    ["luminance_history_direct", "luminance_history_indirect"].map(|name| {
        let texels = luminance_history(&mut s, name);
        texels.iter().map(|m| m.history_length).sum::<f32>() / texels.len() as f32
    })
}

fn every_preset_takes_holes() {
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Best] {
        let config = Config { preset, ..Config::new(EXTENT) };
        let (of_all, ..) = error(&config, |_, _| {});
        for (name, sampling, pattern, one_of) in PATTERNS {
            let (with_holes, counted, _) =
                error(&Config { sampling, ..config }, |i, g| punch(&mut g.noisy_radiance, i, pattern, f32::NAN));
            let (black, ..) = error(&config, |i, g| punch(&mut g.noisy_radiance, i, pattern, 0.0));
            println!("{preset}, {name}: error {with_holes:.4}, of all samples {of_all:.4}, holes as black {black:.4}");
            assert_eq!(counted, 0.0, "{preset}, {name}: holes are no bad values");
            // With so few samples the noise is this many times as large.
            assert!(with_holes < one_of.sqrt() * of_all && with_holes < 0.1 * black, "{preset}, {name}");
        }
    }
}

fn one_signal_may_have_holes_alone() {
    let config = Config { signals: Signals::Apart, sampling: Sampling::OneOf4x4, ..Config::new(EXTENT) };
    let (of_all, ..) = error(&config, |_, _| {});
    let pattern = PATTERNS[2].2;
    let (indirect, counted, _) = error(&config, |i, g| punch(&mut g.noisy_indirect, i, pattern, f32::NAN));
    let (both, ..) = error(&config, |i, g| {
        punch(&mut g.noisy_direct, i, pattern, f32::NAN);
        punch(&mut g.noisy_indirect, i, pattern, f32::NAN);
    });
    println!("all samples {of_all:.4}, one of 4x4 of the indirect light {indirect:.4}, of both {both:.4}");
    assert_eq!(counted, 0.0);
    // Direct light, three quarters of it, has all of its samples and as long a history as ever.
    assert!(indirect - of_all < 0.5 * (both - of_all), "{of_all} {indirect} {both}");
    // Without a test of change, which would cut both histories.
    let config = Config { preset: Preset::Svgf, ..config };
    let (_, _, of_indirect) = error(&config, |i, g| punch(&mut g.noisy_indirect, i, pattern, f32::NAN));
    let (_, _, of_direct) = error(&config, |i, g| punch(&mut g.noisy_direct, i, pattern, f32::NAN));
    let [[direct, holed_indirect], [holed_direct, indirect]] = [of_indirect, of_direct].map(history_lengths);
    println!("frames: {direct:.1} of direct light, {holed_direct:.1} with holes; {indirect:.1} of indirect, {holed_indirect:.1} with holes");
    assert!(holed_indirect < 0.75 * direct && holed_direct < 0.75 * indirect, "each signal counts its own samples");
}

fn holes_that_nothing_fills_are_counted() {
    let config = Config { sampling: Sampling::OneOf2x2, ..Config::new(EXTENT) };
    // A block of 8×6 pixels without a sample: the 6×4 in its middle see none.
    let (_, counted, _) = error(&config, |_, g| {
        for (x, y) in pixels([8, 6]) {
            g.noisy_radiance[((y + 40) * EXTENT[0] + x + 20) as usize] = [f32::NAN; 4];
        }
    });
    assert_eq!(counted, (6 * 4 * FRAMES) as f32);
}

//! The deviation of means against noise that is known, and against structure that is none.

use super::*;
use crate::nodes::variance::twin::Estimate;
use crate::reference::test_scene::*;
use crate::reference::Surface;

const EXTENT: [u32; 2] = [48, 48];

/// Deviation of the uniform noise of the test scenes.
const UNIFORM: f32 = 0.288_675;

fn deviations(guides: &Guides, luminance_history: &Image<LuminanceHistory>) -> Vec<f32> {
    let tuning = Tuning::default();
    let frame = frame(luminance_history.extent());
    let geometry = Geometry::new(&frame, &tuning, &guides.guide);
    let inner = (4..EXTENT[1] as i32 - 4).flat_map(|y| (4..EXTENT[0] as i32 - 4).map(move |x| IVec2::new(x, y)));
    inner.map(|p| deviation_of_mean(&frame, &tuning, &geometry, luminance_history, p).deviation).collect()
}

fn flat() -> Guides {
    guides(EXTENT, |_, _| surface(4.0))
}

fn of(mean: f32, deviation: f32, history_length: f32) -> LuminanceHistory {
    LuminanceHistory { mean, deviation, history_length, reason: 0, outside: None }
}

/// Of a pixel of the row 24.
fn at(deviations: &[f32], x: usize) -> f32 {
    deviations[(24 - 4) * 40 + x - 4]
}

fn root_mean_square(values: &[f32]) -> f32 {
    (values.iter().map(|value| value * value).sum::<f32>() / values.len() as f32).sqrt()
}

#[test]
fn white_noise_has_the_standard_error_of_its_mean() {
    for length in [1.0_f32, 4.0, 9.0] {
        let error = UNIFORM / length.sqrt();
        let within = UNIFORM * (1.0 - 1.0 / length).sqrt();
        let luminance_history = noise(EXTENT, 5).map(|t| of(0.5 + (t[0] - 0.5) / length.sqrt(), within, length));
        let seen = root_mean_square(&deviations(&flat(), &luminance_history)) / error;
        // A variance from so few pixels is widened by its doubt, and what neighbours show counts 1.75 times.
        assert!((1.0..1.75).contains(&seen), "{length} frames: {seen} of the standard error");
    }
}

#[test]
fn what_is_smooth_is_no_noise() {
    let slope = paint(EXTENT, |x, y| of(0.25 * x as f32 + 0.125 * y as f32, 0.0, 8.0));
    assert!(deviations(&flat(), &slope).iter().all(|deviation| *deviation < 1e-4));
    let rough = paint(EXTENT, |x, y| of(((x * 7 + y * 3) % 5) as f32, 0.0, 8.0));
    assert!(deviations(&flat(), &rough).iter().all(|deviation| *deviation > 0.5));
}

#[test]
fn the_shading_of_a_small_ball_is_no_noise() {
    let normal_at = |x: i32, y: i32| {
        let side = IVec2::new(x - 24, y - 24).as_vec2() / 9.0;
        (side.length_squared() < 1.0).then(|| side.extend((1.0 - side.length_squared()).sqrt()))
    };
    let ball = guides(EXTENT, |x, y| match normal_at(x, y) {
        Some(normal) => Surface { normal: normal.into(), ..surface(4.0) },
        None => Surface::default(),
    });
    let shaded = paint(EXTENT, |x, y| of(normal_at(x, y).map_or(0.0, |n| 1.0 + n.x), 0.0, 1.0));
    let widest = deviations(&ball, &shaded).into_iter().fold(0.0, f32::max);
    assert!(widest < 0.05, "{widest}");
}

#[test]
fn a_mean_is_no_surer_than_its_neighbours_agree() {
    // Noise that came again in every frame: to itself each pixel is certain.
    let repeated = noise(EXTENT, 7).map(|t| of(t[0], 0.0, 10.0));
    let seen = root_mean_square(&deviations(&flat(), &repeated)) / UNIFORM;
    assert!((1.0..1.5).contains(&seen), "{seen} of the deviation of neighbours");
}

#[test]
fn a_picture_in_a_mirror_is_no_noise() {
    // Squares of 6×6 pixels that no guide knows, sure to themselves after ten frames.
    let seen = paint(EXTENT, |x, y| of(if (x / 6 + y / 6) % 2 == 0 { 1.0 } else { 2.0 }, 0.01, 10.0));
    let widest = deviations(&flat(), &seen).into_iter().fold(0.0, f32::max);
    assert!(widest < 0.1, "{widest}");
}

#[test]
fn an_edge_that_no_guide_knows_is_little_noise_in_the_first_frame() {
    // A shadow of half of the light is no clear picture: its edge bends by a quarter of what noise of its spread does.
    let step = 0.5;
    let shadow = paint(EXTENT, |x, _| of(if x < 24 { 1.0 } else { 1.0 - step }, 0.0, 1.0));
    let beside = at(&deviations(&flat(), &shadow), 24);
    assert!(beside < 0.12 * step, "{beside}");
    // Nor is what it left in the pasts of its pixels.
    let moved = shadow.map(|m| LuminanceHistory { deviation: step, ..*m });
    assert!(at(&deviations(&flat(), &moved), 24) < 0.5 * step, "{}", at(&deviations(&flat(), &moved), 24));
    // Noise of the same spread counts in full.
    let grain = noise(EXTENT, 5).map(|t| of(0.75 + step * (t[0] - 0.5), 0.0, 1.0));
    assert!(root_mean_square(&deviations(&flat(), &grain)) > 0.9 * UNIFORM * step);
}

#[test]
fn a_sample_within_its_past_is_little_noise() {
    let grain = |outside| noise(EXTENT, 5).map(|t| LuminanceHistory { outside, ..of(0.5 + t[0], 0.0, 1.0) });
    let seen = |outside| root_mean_square(&deviations(&flat(), &grain(outside)));
    // A picture that no guide knows, of which each pixel was as bright before, there or beside it.
    assert!(seen(Some(0.0)) < 1e-3 * UNIFORM, "{}", seen(Some(0.0)));
    let part = 0.1 * UNIFORM;
    assert!((1.0..2.0).contains(&(seen(Some(part)) / part)), "{}", seen(Some(part)) / part);
    // Noise lies as far outside of its past as it varies.
    assert_eq!(seen(Some(UNIFORM)), root_mean_square(&deviations(&flat(), &noise(EXTENT, 5).map(|t| of(0.5 + t[0], 0.0, 1.0)))));
}

/// The mean share of what bends that is told to be no noise; `None` where no pixel tells it.
fn detail(luminance_history: &Image<LuminanceHistory>) -> Option<f32> {
    let told: Vec<f32> = with_sample_frames(luminance_history, 1.0).iter().filter_map(|estimate| estimate.detail).collect();
    (!told.is_empty()).then(|| told.iter().sum::<f32>() / told.len() as f32)
}

#[test]
fn what_bends_beyond_its_past_is_detail() {
    let grain = |outside, length| noise(EXTENT, 5).map(|t| LuminanceHistory { outside, ..of(0.5 + t[0], 0.0, length) });
    let told = |outside| detail(&grain(Some(outside), 1.0)).expect("a history of one frame");
    assert!(told(0.1 * UNIFORM) > 0.95, "{}", told(0.1 * UNIFORM));
    assert!((0.6..0.8).contains(&told(0.5 * UNIFORM)), "{}", told(0.5 * UNIFORM));
    assert!(told(UNIFORM) < 0.1, "{}", told(UNIFORM));
    assert!(told(1.2 * UNIFORM) < -0.2, "{}", told(1.2 * UNIFORM));
    // Where the past is longer, or where there is none, nothing is told.
    assert_eq!([detail(&grain(None, 1.0)), detail(&grain(None, 12.0))], [None; 2]);
}

/// A highlight of a few pixels, 200 times as bright as the surface.
fn highlight(x: i32, y: i32) -> f32 {
    let (dx, dy) = (x as f32 - 20.0, y as f32 - 24.0);
    0.5 + 100.0 * (-0.5 * (dx * dx + dy * dy)).exp()
}

#[test]
fn a_highlight_is_no_noise_for_the_surface_beside_it() {
    let beside = |value: fn(i32, i32) -> f32, deviation| {
        let seen = paint(EXTENT, |x, y| of(value(x, y), deviation, 1.0));
        at(&deviations(&flat(), &seen), 17).max(at(&deviations(&flat(), &seen), 23))
    };
    assert!(beside(highlight, 0.0) < 0.5, "{}", beside(highlight, 0.0));
    // What the highlight left in the pasts of its neighbours is none either.
    assert!(beside(highlight, 20.0) < 0.5, "{}", beside(highlight, 20.0));
    // The same light in one pixel of nine is.
    let rare = |x: i32, y: i32| if x % 3 == 0 && y % 3 == 0 { 9.0 } else { 0.01 };
    assert!(beside(rare, 0.0) > 2.0, "{}", beside(rare, 0.0));
}

#[test]
fn a_variance_that_few_pixels_tell_is_in_doubt() {
    // The same variance in all pixels, and in one of sixteen.
    let even = paint(EXTENT, |x, y| of(if (x + y) % 2 == 0 { 1.0 } else { -1.0 }, 0.0, 1.0));
    let rare = paint(EXTENT, |x, y| of(if x % 4 == 0 && y % 4 == 0 { 4.13 } else { 0.0 }, 0.0, 1.0));
    let (even, rare) = (deviations(&flat(), &even), deviations(&flat(), &rare));
    let widened = root_mean_square(&rare) / root_mean_square(&even);
    assert!((1.1..2.2).contains(&widened), "{widened}");
    let longer = paint(EXTENT, |x, y| of(if x % 4 == 0 && y % 4 == 0 { 4.13 } else { 0.0 }, 0.0, 64.0));
    assert!(root_mean_square(&deviations(&flat(), &longer)) < 0.75 * root_mean_square(&rare));
}

#[test]
fn a_window_with_a_single_lit_pixel_says_next_to_nothing() {
    let of_lit = |dark: f32| {
        let lit = paint(EXTENT, |x, y| of(if x % 5 == 0 && y % 5 == 0 { dark + 5.0 } else { dark }, 0.0, 1.0));
        root_mean_square(&deviations(&flat(), &lit))
    };
    // The same outlier above light that is there anyway is no rare light.
    let (rare, faint) = (of_lit(0.0), of_lit(50.0));
    assert!(rare > 2.0 * faint, "{rare}, {faint}");
}

#[test]
fn rare_light_is_told_from_noise_of_all_pixels() {
    let share = |luminance_history: &Image<LuminanceHistory>| {
        let estimates = with_sample_frames(luminance_history, 1.0);
        estimates.iter().filter(|estimate| estimate.rare).count() as f32 / estimates.len() as f32
    };
    assert_eq!(share(&paint(EXTENT, |x, y| of(if x % 5 == 0 && y % 5 == 0 { 4.0 } else { 0.0 }, 0.0, 1.0))), 1.0);
    assert_eq!(share(&noise(EXTENT, 5).map(|t| of(t[0], 0.0, 1.0))), 0.0);
}

#[test]
fn another_surface_says_nothing() {
    let edge = guides(EXTENT, |x, _| surface(if x < 24 { 4.0 } else { 9.0 }));
    let luminance_history = paint(EXTENT, |x, y| of(if x >= 24 && (x + y) % 2 == 0 { 100.0 } else { 0.0 }, 0.0, 1.0));
    assert!(at(&deviations(&edge, &luminance_history), 23) < 1e-3);
    assert!(at(&deviations(&flat(), &luminance_history), 23) > 10.0);
}

#[test]
fn what_was_filled_in_may_be_noise_though_it_is_smooth() {
    let slope = paint(EXTENT, |x, _| of(0.25 * x as f32, 0.0, 1.0));
    let (tuning, frame, guides) = (Tuning::default(), frame(EXTENT), flat());
    let geometry = Geometry::new(&frame, &tuning, &guides.guide);
    let at = |estimate: Estimate| estimate(&frame, &tuning, &geometry, &slope, IVec2::splat(20)).deviation;
    assert!(at(deviation_of_mean) < 1e-4 && at(deviation_of_filled_mean) > 0.25);
}

/// Estimates with samples that live for so many frames.
fn with_sample_frames(luminance_history: &Image<LuminanceHistory>, sample_frames: f32) -> Vec<Estimated> {
    let (tuning, frame, guides) = (Tuning { sample_frames, ..Tuning::default() }, frame(EXTENT), flat());
    let geometry = Geometry::new(&frame, &tuning, &guides.guide);
    let inner = (4..EXTENT[1] as i32 - 4).map(|y| IVec2::new(20, y));
    inner.map(|p| deviation_of_mean(&frame, &tuning, &geometry, luminance_history, p)).collect()
}

#[test]
fn noise_that_repeats_is_counted_and_noise_that_does_not_is_not() {
    let counted = |luminance_history: &Image<LuminanceHistory>, sample_frames: f32| {
        let estimates = with_sample_frames(luminance_history, sample_frames);
        estimates.iter().filter(|estimate| estimate.is_repeated).count() as f32 / estimates.len() as f32
    };
    // As a running mean leaves it, which is worth 19 frames.
    let averaged = noise(EXTENT, 5).map(|t| of(0.5 + (t[0] - 0.5) / 19f32.sqrt(), UNIFORM, 64.0));
    assert_eq!(counted(&averaged, 1.0), 0.0);
    // Of samples that live for eight frames, which a host may know.
    let lasting = noise(EXTENT, 5).map(|t| of(0.5 + (t[0] - 0.5) / (19f32 / 8.0).sqrt(), UNIFORM, 64.0));
    assert!(counted(&lasting, 1.0) > 0.4, "{}", counted(&lasting, 1.0));
    assert_eq!(counted(&lasting, 8.0), 0.0);
    let same = noise(EXTENT, 7).map(|t| of(t[0], 0.0, 64.0));
    assert!(counted(&same, 1.0) > 0.9, "{}", counted(&same, 1.0));
    assert_eq!(counted(&same.map(|m| LuminanceHistory { history_length: 7.0, ..*m }), 1.0), 0.0, "too few frames");
}

#[test]
fn frames_that_share_a_sample_are_worth_one() {
    // Means without noise of their own: the past alone tells.
    let even = |history_length: f32| paint(EXTENT, move |_, _| of(1.0, 0.25, history_length));
    let deviation = |history_length, sample_frames| with_sample_frames(&even(history_length), sample_frames)[8].deviation;
    for (length, sample_frames) in [(8.0, 2.0), (16.0, 4.0), (6.0, 1.5)] {
        let (many, few) = (deviation(length, sample_frames), deviation(length / sample_frames, 1.0));
        assert!((many - few).abs() < 1e-4, "{length} frames of {sample_frames}: {many}, {few}");
    }
    assert!((deviation(64.0, 64.0) - deviation(1.0, 1.0)).abs() < 1e-4, "no surer than one sample");
}

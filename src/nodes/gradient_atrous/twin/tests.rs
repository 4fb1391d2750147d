//! Gradients spread over their surface and no other.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_guide, Surface};

const STRATA: [u32; 2] = [24, 20];
const EXTENT: [u32; 2] = [72, 60];

/// Runs all iterations on strata whose guides are `surfaces`, at their first pixels.
fn reconstructed(gradient: &Image<[f32; 4]>, surfaces: impl Fn(i32, i32) -> Surface) -> Image<[f32; 4]> {
    let gradient_guide = paint(STRATA, surfaces).map(pack_guide).map(|t| [t[0], t[1], t[2], t[3] & !0xf0]);
    let guide = Image::new(EXTENT, pack_guide(&surface(4.0)));
    (0..GRADIENT_ITERATIONS).fold(gradient.clone(), |gradient, level| {
        let inputs =
            GradientAtrousInputs { guide: &guide, gradient_guide: &gradient_guide, gradient: &gradient, light: None, last: false };
        gradient_atrous(&frame(EXTENT), &svgf_tuning(), 3, level, &inputs).gradient
    })
}

#[test]
fn a_constant_is_kept_and_nothing_stays_nothing() {
    for texel in [[0.25, 0.5, 2.0, 0.125], [-0.25, 0.5, 0.0, 0.0], [0.0; 4]] {
        let output = reconstructed(&Image::new(STRATA, texel), |_, _| surface(4.0));
        for t in output.texels() {
            assert!((0..3).all(|i| (t[i] - texel[i]).abs() <= 1e-3 * texel[i].abs()), "{t:?}");
            assert!(t[3] >= 0.0 && t[3] <= texel[3]);
        }
    }
}

#[test]
fn a_sample_fills_the_surface_around_it_and_no_other() {
    let sample = paint(STRATA, |x, y| [0.0, 0.0, 1.0, 0.1].map(|v: f32| if (x, y) == (6, 10) && v == 0.0 { 1.0 } else { v }));
    let output = reconstructed(&sample, |x, _| surface(if x < 12 { 4.0 } else { 8.0 }));
    for y in 0..20 {
        for x in 0..24 {
            let [change, brightest, ..] = output.at(IVec2::new(x, y));
            if x < 12 {
                assert!(brightest > 0.0 && (change / brightest - 1.0).abs() < 0.01, "{x},{y}: {change} of {brightest}");
            } else {
                assert!(change.abs() < 1e-6, "{x},{y}: {change}");
            }
        }
    }
}

/// One plane, and light that changes on its right half alone.
#[test]
fn a_place_whose_samples_all_say_that_nothing_changed_keeps_to_that() {
    let output = reconstructed(&paint(STRATA, |x, _| [if x < 12 { 0.0 } else { 0.5 }, 1.0, 1.0, 0.1]), |_, _| surface(4.0));
    let changes: Vec<f32> = (0..24).map(|x| output.at(IVec2::new(x, 10))[0]).collect();
    assert!(changes[..9].iter().all(|change| *change == 0.0), "{changes:?}");
    assert!(changes[9..].iter().all(|change| *change > 0.0), "{changes:?}");
    // Without any light a sample says nothing, and asks its surroundings.
    let output =
        reconstructed(&paint(STRATA, |x, _| if x < 12 { [0.0, 0.0, 1.0, 0.1] } else { [0.5, 1.0, 1.0, 0.1] }), |_, _| surface(4.0));
    assert!((0..24).all(|x| output.at(IVec2::new(x, 10))[0] > 0.0));
}

#[test]
fn a_background_stratum_is_left_alone() {
    let input = paint(STRATA, |x, y| [x as f32, y as f32, 1.0, 0.0]);
    assert_eq!(reconstructed(&input, |_, _| surface(0.0)), input);
}

/// The light of a place whose samples are `times` those given: before and now.
fn light_of(samples: &[([f32; 3], [f32; 3])], times: usize) -> [[f32; 4]; 2] {
    let share = 1.0 / samples.len() as f32;
    let (mut before, mut now) = ([0.0; 4], [0.0; 4]);
    for (sample_before, sample_now) in samples {
        for i in 0..3 {
            before[i] += share * sample_before[i];
            before[3] += share * (sample_before[i] * sample_now[i]).sqrt();
            now[i] += share * sample_now[i];
        }
        now[3] += sample_before.iter().sum::<f32>().max(sample_now.iter().sum()).powi(2);
    }
    now[3] = share * (now[3] / times as f32).sqrt();
    [before, now]
}

fn assert_ratio(ratio: [f32; 4], expected: [f32; 3]) {
    assert!((0..3).all(|i| (ratio[i] - expected[i]).abs() < 2e-3), "{ratio:?} for {expected:?}");
}

#[test]
fn samples_that_agree_give_the_ratio_and_few_others_none() {
    // Light of every component changes by its own factor, the same for samples of a bright and a dark place.
    let [before, now] = light_of(&[([1.0, 2.0, 4.0], [0.5, 2.0, 1.0]), ([0.1, 0.2, 0.4], [0.05, 0.2, 0.1])], 1000);
    let ratio = light_ratio(before, now);
    assert_eq!(ratio[3], 1.0);
    assert_ratio(ratio, [0.5, 1.0, 0.25]);
    // One of two lamps went out: half of the samples are as they were.
    let [before, now] = light_of(&[([1.0; 3], [1.0; 3]), ([1.0; 3], [0.0; 3])], 1);
    assert_eq!(light_ratio(before, now), [1.0, 1.0, 1.0, 0.0]);
    // Nothing changed; nothing is lit; light came on where there was none.
    let [before, now] = light_of(&[([0.3, 0.0, 7.0], [0.3, 0.0, 7.0])], 4);
    assert_eq!(light_ratio(before, now), [1.0; 4]);
    assert_eq!(light_ratio([0.0; 4], [0.0; 4]), [1.0, 1.0, 1.0, 0.0]);
    assert_eq!(light_ratio([0.0; 4], [5.0, 5.0, 5.0, 15.0]), [1.0, 1.0, 1.0, 0.0]);
}

/// Beside an outline, or where a highlight arrives on a face of one pixel.
#[test]
fn a_sample_that_nothing_confirms_scales_no_history() {
    let brighter = |times: usize| {
        let [before, now] = light_of(&[([0.1; 3], [10.0; 3])], times);
        light_ratio(before, now)
    };
    assert_eq!(brighter(1), [1.0, 1.0, 1.0, 0.0]);
    assert!(brighter(2)[0] > 1.0 && brighter(2)[0] < brighter(4)[0], "{:?} {:?}", brighter(2), brighter(4));
    assert_eq!(brighter(4)[3], 1.0);
}

#[test]
fn many_samples_that_differ_give_the_ratio_of_their_means_without_coherence() {
    let one_of_two_lamps_out = [([1.0; 3], [1.0; 3]), ([1.0; 3], [0.0; 3])];
    let [before, now] = light_of(&one_of_two_lamps_out, 1000);
    let ratio = light_ratio(before, now);
    assert_ratio(ratio, [0.5; 3]);
    assert_eq!(ratio[3], 0.0);
    // From few to many it is applied more and more, and one that falls and rises again leaves nothing behind.
    let mut last = 1.0;
    for times in [100, 200, 300, 400, 1000] {
        let [before, now] = light_of(&one_of_two_lamps_out, times);
        let fallen = light_ratio(before, now);
        assert!(fallen[0] <= last, "{times}: {fallen:?} after {last}");
        let risen = light_ratio([now[0], now[1], now[2], before[3]], [before[0], before[1], before[2], now[3]]);
        assert!((fallen[0] * risen[0] - 1.0).abs() < 2e-3, "{times}: {fallen:?} {risen:?}");
        last = fallen[0];
    }
    assert!(last < 0.51);
}

/// A small change of brightness of noisy samples says nothing about colours; a large one does.
#[test]
fn components_have_ratios_of_their_own_where_the_change_is_above_the_noise() {
    let colours_of = |samples: &[([f32; 3], [f32; 3])]| {
        let [before, now] = light_of(samples, 60);
        let ratio = light_ratio(before, now);
        (ratio[1] / ratio[0], now[1] / now[0] * before[0] / before[1])
    };
    let (told_apart, true_colours) = colours_of(&[([1.0, 1.0, 1.0], [1.0, 0.98, 1.0])]);
    assert!((told_apart - 1.0).abs() < 1e-3, "{told_apart} of {true_colours}");
    let (told_apart, true_colours) = colours_of(&[([1.0, 1.0, 1.0], [0.5, 0.4, 0.5])]);
    assert!((told_apart / true_colours - 1.0).abs() < 2e-3, "{told_apart} of {true_colours}");
}

/// Light on the right half of one plane doubles; samples agree, `times` of them in each stratum.
#[test]
fn a_ratio_that_is_known_is_not_blurred() {
    let filtered = |times: usize| {
        let light = |x: i32| light_of(&[([1.0; 3], [if x < 12 { 1.0 } else { 2.0 }; 3])], times);
        let gradient = Image::new(STRATA, [0.5, 1.0, 1.0, 0.1]);
        let gradient_guide = paint(STRATA, |_, _| surface(4.0)).map(pack_guide).map(|t| [t[0] & !0xf, t[1], t[2], t[3]]);
        let guide = Image::new(EXTENT, pack_guide(&surface(4.0)));
        let mut images = [0, 1].map(|which| paint(STRATA, |x, _| light(x)[which]));
        for level in 0..GRADIENT_ITERATIONS {
            let inputs = GradientAtrousInputs {
                guide: &guide,
                gradient_guide: &gradient_guide,
                gradient: &gradient,
                light: Some(Light { before: &images[0], now: &images[1] }),
                last: level + 1 == GRADIENT_ITERATIONS,
            };
            images = gradient_atrous(&frame(EXTENT), &svgf_tuning(), 3, level, &inputs).light.expect("light went in");
        }
        [11, 12].map(|x| images[0].at(IVec2::new(x, 10))[0])
    };
    let [left, right] = filtered(1000);
    assert!((left - 1.0).abs() < 1e-3 && (right - 2.0).abs() < 2e-3, "{left}, {right}");
    let [left, right] = filtered(1);
    assert!(left > 1.1 && right < 1.9, "{left}, {right}");
}

//! Gradients spread over their surface and no other.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_guide, Surface};

const STRATA: [u32; 2] = [24, 20];
const EXTENT: [u32; 2] = [72, 60];

/// Runs all iterations on strata whose guides are `surfaces`, at their first pixels.
fn reconstructed(gradient: &Image<[f32; 4]>, surfaces: impl Fn(i32, i32) -> Surface) -> Image<[f32; 4]> {
    let gradient_guide = paint(STRATA, surfaces).map(pack_guide).map(|t| [t[0], t[1], t[2], t[3] & !0xf0]);
    let depth_gradient = Image::new(EXTENT, 0);
    (0..GRADIENT_ITERATIONS).fold(gradient.clone(), |gradient, level| {
        let inputs = GradientAtrousInputs {
            gradient_guide: &gradient_guide,
            depth_gradient: &depth_gradient,
            gradient: &gradient,
            light: None,
            smooth_deviation: false,
            last: false,
        };
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

/// One stratum whose pixels happen to be alike, among noisy ones with another mean.
#[test]
fn a_smooth_deviation_lets_strata_that_know_of_none_take_part() {
    let gradient = paint(STRATA, |x, y| if (x, y) == (12, 10) { [0.0, 0.0, 0.2, 0.0] } else { [0.5, 1.0, 1.0, 0.5] });
    let at_the_stratum = |smooth_deviation| {
        let inputs = GradientAtrousInputs {
            gradient_guide: &paint(STRATA, |_, _| surface(4.0)).map(pack_guide).map(|t| [t[0] & !0xf, t[1], t[2], t[3]]),
            depth_gradient: &Image::new(EXTENT, 0),
            gradient: &gradient,
            light: None,
            smooth_deviation,
            last: false,
        };
        gradient_atrous(&frame(EXTENT), &Tuning::default(), 3, 0, &inputs).gradient.at(IVec2::new(12, 10))
    };
    assert_eq!(at_the_stratum(false)[..2], [0.0, 0.0]);
    let [change, brightest, ..] = at_the_stratum(true);
    assert!(change > 0.1 && (change / brightest - 0.5).abs() < 1e-3, "{change} of {brightest}");
}

#[test]
fn samples_that_agree_give_the_ratio_and_others_none() {
    // Light of every component changes by its own factor, the same for two samples of a bright and a dark place.
    let mean = |samples: &[([f32; 3], [f32; 3])]| {
        let share = 1.0 / samples.len() as f32;
        let mut sums = ([0.0; 4], [0.0; 4]);
        for (before, now) in samples {
            for i in 0..3 {
                sums.0[i] += share * before[i];
                sums.0[3] += share * (before[i] * now[i]).sqrt();
                sums.1[i] += share * now[i];
            }
        }
        sums
    };
    let (before, now) = mean(&[([1.0, 2.0, 4.0], [0.5, 2.0, 1.0]), ([0.1, 0.2, 0.4], [0.05, 0.2, 0.1])]);
    let [r, g, b, coherence] = light_ratio(before, now);
    assert_eq!(coherence, 1.0);
    for (ratio, expected) in [(r, 0.5), (g, 1.0), (b, 0.25)] {
        assert!((ratio - expected).abs() < 2e-3, "{ratio} for {expected}");
    }
    // One of two lamps went out: half of the samples are as they were.
    let (before, now) = mean(&[([1.0; 3], [1.0; 3]), ([1.0; 3], [0.0; 3])]);
    assert_eq!(light_ratio(before, now), [1.0, 1.0, 1.0, 0.0]);
    // Nothing changed; nothing is lit; light came on where there was none.
    let (before, now) = mean(&[([0.3, 0.0, 7.0], [0.3, 0.0, 7.0])]);
    assert_eq!(light_ratio(before, now), [1.0; 4]);
    assert_eq!(light_ratio([0.0; 4], [0.0; 4]), [1.0, 1.0, 1.0, 0.0]);
    let came_on = light_ratio([0.0; 4], [5.0; 4]);
    assert_eq!(came_on, [1.0, 1.0, 1.0, 0.0]);
}

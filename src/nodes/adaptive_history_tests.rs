//! `percentile_rule` and `change_test`: which changes each sees, on blocks of one luminance distribution before and another one
//! now.

use super::block_difference::twin::*;
use super::block_percentiles::twin::*;
use super::change_test::twin::*;
use super::percentile_rule::twin::*;
use crate::reference::test_scene::*;
use crate::reference::*;
use crate::Tuning;

const EXTENT: [u32; 2] = [44, 35];

/// Samples of diffuse light at one sample per pixel: most are 0, few are bright; mean 1.
fn one_sample(seed: u32) -> Image<[f32; 4]> {
    noise(EXTENT, seed).map(|t| if t[0] < 0.7 { [0.0; 4] } else { [(t[0] - 0.7) / 0.045; 4] })
}

/// A block whose brighter side is 1, of samples with a deviation of 1.
fn of_mean(mean: f32, count: f32, past_noise: f32) -> Difference {
    let [now, before] = [1.0 + mean.min(0.0), 1.0 - mean.max(0.0)].map(|light| [light; 3]);
    Difference { now, before, deviation: 1.0, count, noise: 0.2, past_noise }
}

/// What the test says of light on a wall that stands still.
fn tested(irradiance: &Image<[f32; 4]>, history: &Image<[f32; 4]>, past: LuminanceHistory) -> Image<f32> {
    let (frame, tuning, guides) = (frame(EXTENT), svgf_tuning(), guides(EXTENT, |_, _| surface(2.0)));
    let guides = HistoryGuides { guide: &guides.guide, surface_motion: &guides.surface_motion, previous_guide: &guides.guide };
    let history = SignalHistory { irradiance: history, luminance_history: &Image::new(EXTENT, past) };
    let difference = block_difference(&frame, &tuning, &BlockDifferenceInputs { guides, irradiance, history });
    change_test(&frame, &tuning, EXTENT, &[&difference], true).history_confidence
}

/// Mean confidence of both rules (published, test) where the light goes from `before` to `now`.
fn confidence(before: f32, now: f32) -> (f32, f32) {
    let (frame, tuning, guides) = (frame(EXTENT), svgf_tuning(), guides(EXTENT, |_, _| surface(2.0)));
    let irradiance = one_sample(4).map(|t| t.map(|v| v * now));
    let history = Image::new(EXTENT, [before; 4]);
    let past = LuminanceHistory { mean: before, deviation: before, history_length: 8.0, ..LuminanceHistory::default() };
    let guides = HistoryGuides { guide: &guides.guide, surface_motion: &guides.surface_motion, previous_guide: &guides.guide };
    let percentiles =
        block_percentiles(&frame, &tuning, &BlockPercentilesInputs { guide: Some(guides.guide), irradiance: &irradiance });
    let published = percentile_rule(&frame, &tuning, &PercentileRuleInputs { guides, signals: &[(&percentiles, &history)] });
    let test = tested(&irradiance, &history, past);
    let mean = |image: &Image<f32>| image.texels().iter().sum::<f32>() / image.texels().len() as f32;
    (mean(&published), mean(&test))
}

#[test]
fn light_that_stays_keeps_its_history() {
    let (published, test) = confidence(1.0, 1.0);
    assert!(published > 0.99 && test > 0.95, "{published} {test}");
}

#[test]
fn both_rules_see_a_light_that_goes_out() {
    let (published, test) = confidence(1.0, 0.05);
    assert!(published < 0.05 && test < 0.05, "{published} {test}");
}

/// The published rule's low percentile is 0 at one sample per pixel: no history falls below it.
#[test]
fn only_the_test_sees_a_light_that_comes_on() {
    let (published, test) = confidence(0.05, 1.0);
    assert!(published > 0.99, "{published}");
    assert!(test < 0.05, "{test}");
}

#[test]
fn a_change_that_is_certain_but_small_is_not_worth_the_history() {
    let past = LuminanceHistory { mean: 1.0, history_length: 8.0, ..LuminanceHistory::default() };
    let confidence = |now: f32| tested(&Image::new(EXTENT, [now; 4]), &Image::new(EXTENT, [1.0; 4]), past).texels()[700];
    assert_eq!(confidence(1.02), 1.0);
    assert!(confidence(1.1) < 0.01);
}

#[test]
fn without_adaptivity_every_history_is_kept() {
    let (frame, tuning) = (frame(EXTENT), Tuning { adaptivity: 0.0, ..svgf_tuning() });
    let difference = Image::new(
        [6, 5],
        pack_difference(&Difference { now: [9.0; 3], before: [0.0; 3], deviation: 0.1, count: 64.0, noise: 0.0, past_noise: 0.0 }),
    );
    assert!(change_test(&frame, &tuning, EXTENT, &[&difference], true).history_confidence.texels().iter().all(|c| *c == 1.0));
    let percentiles = Percentiles { low: 0.0, up: 0.1, is_clumped: false };
    assert_eq!(weight_of_history(&tuning, &percentiles, 9.0), 1.0);
}

#[test]
fn blocks_are_steady_where_neither_their_mean_nor_one_of_them_departs() {
    let frame = frame([40, 40]);
    let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
    // A standard error of 0.125 in a block of 64 pixels.
    let steadiness = |mean_of: &dyn Fn(i32, i32) -> f32, count: f32| {
        let of_block = |x, y| of_mean(mean_of(x, y), count, 0.2);
        let difference = paint([5, 5], |x, y| pack_difference(&of_block(x, y)));
        change_test(&frame, &tuning, [40, 40], &[&difference], true).steadiness.at(glam::IVec2::splat(2))
    };
    assert_eq!(steadiness(&|_, _| 0.0, 64.0), 1.0);
    assert!(steadiness(&|_, _| 0.2, 64.0) < 0.01, "4.8 standard errors of the mean, 1.6 of each block");
    assert_eq!(steadiness(&|_, _| 0.3, 64.0), -1.0, "twice the threshold and more");
    // What a shadow that wanders takes from one block it gives to the next: 4.8 standard errors of each, none of the mean.
    assert!(steadiness(&|x, _| [0.0, 0.6, 0.0, -0.6, 0.0][x as usize], 64.0) < 0.01);
    let partly = steadiness(&|x, y| if (x, y) == (2, 2) { 0.375 } else { 0.0 }, 64.0);
    assert!(partly > 0.4 && partly < 0.9, "3 standard errors of one block: {partly}");
    assert_eq!(steadiness(&|_, _| 0.0, 0.0), 0.0, "nothing is known of the background");
}

/// A shadow that moves by two pixels a frame takes from one side of its block what it gives to the other.
#[test]
fn light_without_noise_loses_the_history_of_what_changed() {
    let shadow = |at: i32, noise: f32| {
        let random = one_sample(7 + at as u32);
        paint(EXTENT, |x, y| {
            let light = if (at..at + 6).contains(&x) { 0.2 } else { 1.0 };
            [light * (1.0 + noise * (random.at(glam::IVec2::new(x, y))[0].min(4.0) - 1.0)); 4]
        })
    };
    let confidence = |noise: f32, past_noise: f32| {
        let past = LuminanceHistory { mean: 1.0, deviation: past_noise, history_length: 8.0, ..LuminanceHistory::default() };
        let all = tested(&shadow(18, noise), &shadow(16, 0.0), past);
        [all.at(glam::IVec2::new(20, 20)), all.at(glam::IVec2::new(42, 20))]
    };
    assert_eq!(confidence(0.0, 0.0), [0.0, 1.0]);
    assert_eq!(confidence(1.0, 0.0), [1.0, 1.0], "noise explains it");
    assert_eq!(confidence(0.0, 0.3), [0.0, 1.0], "a shadow that moved spread the samples of its past by as much");
    assert_eq!(confidence(0.0, 2.0), [1.0, 1.0], "rare light explains it, which this frame has none of");
}

/// Neighbours that share a sample share its noise, which the deviations of single pixels do not show.
#[test]
fn noise_that_blocks_have_in_common_is_no_change() {
    let frame = frame([40, 40]);
    let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
    let confidence = |mean_of: &dyn Fn(i32, i32) -> f32| {
        let difference = paint([5, 5], |x, y| {
            let (mean, count) = (mean_of(x, y), 64.0);
            pack_difference(&of_mean(mean, count, 0.2))
        });
        change_test(&frame, &tuning, [40, 40], &[&difference], true).history_confidence.at(glam::IVec2::splat(20))
    };
    assert_eq!(confidence(&|_, _| 0.5), 0.0, "12 standard errors, of all blocks alike");
    assert_eq!(confidence(&|x, _| if x % 3 == 0 { 1.5 } else { 0.0 }), 0.0, "the same mean, of an edge");
    let shared = confidence(&|x, y| 0.5 + 0.5 * ((7 * x + 3 * y).rem_euclid(5) - 2) as f32);
    assert_eq!(shared, 1.0, "the same mean, of blocks that differ by more");
}

/// What the test says of the middle of blocks that are all alike.
fn of_blocks(difference: Difference, is_alone: bool) -> (f32, [f32; 4]) {
    let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
    let blocks = Image::new([5, 5], pack_difference(&difference));
    let outputs = change_test(&frame([40, 40]), &tuning, [40, 40], &[&blocks], is_alone);
    (outputs.history_confidence.at(glam::IVec2::splat(20)), outputs.light_ratio.at(glam::IVec2::splat(2)))
}

#[test]
fn light_that_changes_its_colour_alone_loses_its_history() {
    // From red to blue, of the same luminance.
    let [now, before] = [[0.5, 1.0, 2.0], [1.009_407, 1.0, 0.5]];
    let difference = Difference { now, before, deviation: 1.0, count: 64.0, noise: 0.2, past_noise: 0.2 };
    assert!(difference.mean().abs() < 1e-3, "{}", difference.mean());
    assert_eq!(of_blocks(difference, true).0, 0.0);
    assert_eq!(of_blocks(difference, false).0, 1.0, "beside gradients the luminance alone counts");
    let noisy = Difference { deviation: 20.0, ..difference };
    assert_eq!(of_blocks(noisy, true).0, 1.0, "noise has part in the components");
}

#[test]
fn history_of_light_that_changed_is_scaled_where_the_change_is_known() {
    let known = Difference { now: [0.5, 1.0, 3.0], before: [1.0; 3], deviation: 0.1, count: 64.0, noise: 0.2, past_noise: 0.2 };
    let ratio = |difference| of_blocks(difference, true).1;
    let near = |[r, g, b, _]: [f32; 4]| [r - 0.5, g - 1.0, b - 3.0].iter().all(|d| d.abs() < 0.02);
    assert!(near(ratio(known)), "{:?}", ratio(known));
    assert_eq!(ratio(Difference { now: [1.0; 3], ..known }), [1.0; 4], "nothing changed");
    assert_eq!(ratio(Difference { deviation: 8.0, ..known }), [1.0; 4], "of noise as large as the light");
    assert_eq!(ratio(Difference { count: 7.0, ..known }), [1.0; 4], "of seven pixels");
    assert_eq!(ratio(Difference { count: 0.0, ..known })[3], -1.0, "without a history");
    assert!(ratio(Difference { now: [500.0; 3], ..known })[0] <= 64.0);
    assert_eq!(ratio(Difference { now: [-1.0; 3], ..known }), [1.0; 4], "of less than no light");
}

#[test]
fn a_change_is_told_sooner_where_noise_is_usual() {
    // 4 % brighter, by 2 standard errors.
    let confidence = |past_noise: f32, exchanged: f32| {
        let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
        let blocks = paint([5, 5], |x, y| {
            let more = if x == 1 { [0.0, 0.0, exchanged, -exchanged, 0.0][y as usize] } else { 0.0 };
            let [now, before] = [24.96 + more, 24.0].map(|light| [light; 3]);
            pack_difference(&Difference { now, before, deviation: 9.6, count: 64.0, noise: 0.2, past_noise })
        });
        change_test(&frame([40, 40]), &tuning, [40, 40], &[&blocks], true).history_confidence.at(glam::IVec2::splat(20))
    };
    let [usual, new_light] = [0.0, 16.0].map(|exchanged| confidence(0.5, exchanged));
    assert!((0.8..0.9).contains(&usual), "{usual}");
    assert!(new_light > 0.98, "brighter than all that was there before: {new_light}");
    assert_eq!(confidence(RARE, 0.0), 1.0, "samples of the past were rare");
}

/// The glow of a lamp in a mirror that moves on: what one block loses the next one gains.
#[test]
fn a_block_that_departs_alone_loses_its_history_sooner_where_it_became_darker() {
    let frame = frame([40, 40]);
    let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
    // A standard error of 0.125: thresholds of 1.5 and 2 times 0.3125, from which confidence falls to 0 at twice as much.
    let confidence = |darker: f32, brighter: f32, count: f32| {
        let difference = paint([5, 5], |x, y| {
            let mean = [0.0, 0.0, brighter, -darker, 0.0][x as usize] * f32::from(y == 2);
            pack_difference(&of_mean(mean, count, RARE))
        });
        let all = change_test(&frame, &tuning, [40, 40], &[&difference], true).history_confidence;
        // The middle of a block lies between four pixels.
        [20, 28].map(|x| all.at(glam::IVec2::new(x, 20)))
    };
    assert_eq!(confidence(0.45, 0.45, 64.0), [1.0, 1.0]);
    let [brighter, darker] = confidence(0.6, 0.6, 64.0);
    assert!(brighter > 0.95 && darker < 0.8, "4.8 standard errors: {brighter}, {darker}");
    let [brighter, darker] = confidence(1.3, 1.3, 64.0);
    assert!(brighter < 0.25 && darker < 0.25, "10.4 standard errors: {brighter}, {darker}");
    assert_eq!(confidence(3.0, 3.0, 4.0), [1.0, 1.0], "four pixels tell nothing of their noise");
}

/// Edges bend as noise does, and a look-up of the nearest pixel is half a pixel off.
#[test]
fn edges_that_were_looked_up_beside_their_place_are_no_noise() {
    let leaves = |shift: i32, noise: f32| {
        let random = one_sample(11 + shift as u32);
        paint(EXTENT, |x, y| {
            let light = if ((x + shift + 2) / 4 + (y + 2) / 4) % 2 == 0 { 0.2 } else { 1.0 };
            [light * (1.0 + noise * (random.at(glam::IVec2::new(x, y))[0].min(4.0) - 1.0)); 4]
        })
    };
    let past = LuminanceHistory { mean: 0.6, history_length: 1.0, ..LuminanceHistory::default() };
    let confidence = |noise: f32| tested(&leaves(1, noise), &leaves(0, noise), past).at(glam::IVec2::new(20, 20));
    assert_eq!(confidence(0.0), 0.0);
    assert_eq!(confidence(1.0), 1.0, "noise explains it");
}

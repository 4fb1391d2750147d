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

/// What the test says of light on a wall that stands still.
fn tested(irradiance: &Image<[f32; 4]>, history: &Image<[f32; 4]>, past: LuminanceHistory) -> Image<f32> {
    let (frame, tuning, guides) = (frame(EXTENT), svgf_tuning(), guides(EXTENT, |_, _| surface(2.0)));
    let guides = HistoryGuides { guide: &guides.guide, surface_motion: &guides.surface_motion, previous_guide: &guides.guide };
    let history = SignalHistory { irradiance: history, luminance_history: &Image::new(EXTENT, past) };
    let difference = block_difference(&frame, &tuning, &BlockDifferenceInputs { guides, irradiance, history });
    change_test(&frame, &tuning, EXTENT, &[&difference]).history_confidence
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
        pack_difference(&Difference { mean: 9.0, deviation: 0.1, count: 64.0, brighter: 9.0, noise: 0.0, past_noise: 0.0 }),
    );
    assert!(change_test(&frame, &tuning, EXTENT, &[&difference]).history_confidence.texels().iter().all(|c| *c == 1.0));
    let percentiles = Percentiles { low: 0.0, up: 0.1, is_clumped: false };
    assert_eq!(weight_of_history(&tuning, &percentiles, 9.0), 1.0);
}

#[test]
fn blocks_are_steady_where_neither_their_mean_nor_one_of_them_departs() {
    let frame = frame([40, 40]);
    let tuning = Tuning { change_threshold: 2.5, ..svgf_tuning() };
    // A standard error of 0.125 in a block of 64 pixels.
    let steadiness = |mean_of: &dyn Fn(i32, i32) -> f32, count: f32| {
        let of_block = |x, y| Difference { mean: mean_of(x, y), deviation: 1.0, count, brighter: 1.0, noise: 0.2, past_noise: 0.2 };
        let difference = paint([5, 5], |x, y| pack_difference(&of_block(x, y)));
        change_test(&frame, &tuning, [40, 40], &[&difference]).steadiness.at(glam::IVec2::splat(2))
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
            pack_difference(&Difference { mean, deviation: 1.0, count, brighter: 1.0, noise: 0.2, past_noise: 0.2 })
        });
        change_test(&frame, &tuning, [40, 40], &[&difference]).history_confidence.at(glam::IVec2::splat(20))
    };
    assert_eq!(confidence(&|_, _| 0.5), 0.0, "12 standard errors, of all blocks alike");
    assert_eq!(confidence(&|x, _| if x % 3 == 0 { 1.5 } else { 0.0 }), 0.0, "the same mean, of an edge");
    let shared = confidence(&|x, y| 0.5 + 0.5 * ((7 * x + 3 * y).rem_euclid(5) - 2) as f32);
    assert_eq!(shared, 1.0, "the same mean, of blocks that differ by more");
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
            pack_difference(&Difference { mean, deviation: 1.0, count, brighter: 1.0, noise: 0.2, past_noise: 0.2 })
        });
        let all = change_test(&frame, &tuning, [40, 40], &[&difference]).history_confidence;
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

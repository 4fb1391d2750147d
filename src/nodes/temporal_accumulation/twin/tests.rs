//! The blend: running mean, moments, cap, exposure, reset.

use super::*;
use crate::reference::holes::{EMPTY_HOLE, HOLE};
use crate::reference::test_scene::*;

const EXTENT: [u32; 2] = [6, 5];

/// One frame on `guides` with an optional previous frame on the same guides.
fn step(
    frame: &FrameConstants,
    guides: &Guides,
    c: &Image<[f32; 4]>,
    previous: Option<&TemporalAccumulationOutputs>,
) -> TemporalAccumulationOutputs {
    tuned(frame, &svgf_tuning(), guides, c, previous)
}

fn tuned(
    frame: &FrameConstants,
    tuning: &Tuning,
    guides: &Guides,
    c: &Image<[f32; 4]>,
    previous: Option<&TemporalAccumulationOutputs>,
) -> TemporalAccumulationOutputs {
    let signals = previous.map(|p| [SignalHistory { irradiance: &p.irradiance[0], luminance_history: &p.luminance_history[0] }]);
    let previous = signals.as_ref().map(|signals| PreviousFrame { guide: &guides.guide, signals });
    temporal_accumulation(frame, tuning, &TemporalAccumulationInputs { previous, ..inputs(guides, &[c]) })
}

/// Nothing but guides and irradiance.
pub(super) fn inputs<'a>(guides: &'a Guides, irradiance: &'a [&'a Image<[f32; 4]>]) -> TemporalAccumulationInputs<'a> {
    TemporalAccumulationInputs {
        guide: &guides.guide,
        surface_motion: &guides.surface_motion,
        irradiance,
        object_normals: None,
        material_class: None,
        history_confidence: None,
        repair: false,
        sharp: false,
        light_ratio: None,
        previous: None,
    }
}

fn flat(extent: [u32; 2]) -> Guides {
    guides(extent, |_, _| surface(4.0))
}

fn grey(extent: [u32; 2], l: f32) -> Image<[f32; 4]> {
    Image::new(extent, [l, l, l, 0.0])
}

#[test]
fn alpha_zero_is_the_running_mean_and_the_sample_variance() {
    let (frame, tuning) = (frame(EXTENT), Tuning { alpha: 0.0, alpha_moments: 0.0, ..svgf_tuning() });
    let guides = flat(EXTENT);
    let samples: Vec<_> = (0..20).map(|i| noise(EXTENT, i)).collect();
    let mut previous = None;
    for (i, sample) in samples.iter().enumerate() {
        let output = tuned(&frame, &tuning, &guides, sample, previous.as_ref());
        let n = (i + 1) as f32;
        for (j, texel) in output.irradiance[0].texels().iter().enumerate() {
            let so_far = || samples[..=i].iter().map(|s| s.texels()[j][0]);
            let mean = so_far().sum::<f32>() / n;
            let variance = so_far().map(|l| (l - mean) * (l - mean)).sum::<f32>() / n;
            let luminance_history = output.luminance_history[0].texels()[j];
            assert!((texel[0] - mean).abs() < 1e-3, "frame {i}: {} for {mean}", texel[0]);
            assert!((luminance_history.mean - mean).abs() < 1e-3);
            assert!(
                luminance_history.deviation >= 0.0 && (luminance_history.deviation - variance.sqrt()).abs() < 1e-3,
                "{luminance_history:?} for {variance}"
            );
            assert_eq!(luminance_history.history_length, n);
            assert_eq!(luminance_history.reason, if i == 0 { Reason::Reset as u16 } else { 0 });
            assert_eq!(texel[3], 0.0);
        }
        previous = Some(output);
    }
}

#[test]
fn alpha_bounds_the_weight_of_a_new_sample() {
    let guides = flat(EXTENT);
    let luminance_history = LuminanceHistory { mean: 1.0, deviation: 0.5, history_length: 100.0, reason: 0, outside: None };
    let previous = TemporalAccumulationOutputs {
        irradiance: vec![grey(EXTENT, 1.0)],
        luminance_history: vec![Image::new(EXTENT, luminance_history)],
        statistics: Statistics::default(),
    };
    let (frame, tuning) = (frame(EXTENT), Tuning { alpha: 0.25, alpha_moments: 0.5, ..svgf_tuning() });
    let output = tuned(&frame, &tuning, &guides, &grey(EXTENT, 3.0), Some(&previous));
    assert_eq!(output.irradiance[0].texels()[7][0], 1.5);
    let luminance_history = output.luminance_history[0].texels()[7];
    assert!((luminance_history.mean - 2.0).abs() < 1e-3);
    assert!((luminance_history.deviation - (0.5_f32 * (0.25 + 0.5 * 4.0)).sqrt()).abs() < 1e-3, "{luminance_history:?}");
    assert_eq!(luminance_history.history_length, 101.0);

    let capped = Tuning { alpha: 0.0, alpha_moments: 0.0, max_history_length: 4.0, ..tuning };
    let output = tuned(&frame, &capped, &guides, &grey(EXTENT, 3.0), Some(&previous));
    assert_eq!(output.irradiance[0].texels()[7][0], 1.5);
    assert_eq!(output.luminance_history[0].texels()[7].history_length, 4.0);
}

#[test]
fn a_history_of_one_frame_tells_how_far_its_sample_lies_outside_of_its_past() {
    let guides = flat(EXTENT);
    let luminance_history = LuminanceHistory { mean: 1.0, deviation: 0.5, history_length: 8.0, ..LuminanceHistory::default() };
    let previous = TemporalAccumulationOutputs {
        irradiance: vec![grey(EXTENT, 1.0)],
        luminance_history: vec![Image::new(EXTENT, luminance_history)],
        statistics: Statistics::default(),
    };
    let of = |max_history_length: f32, now: f32, previous: Option<&TemporalAccumulationOutputs>| {
        let tuning = Tuning { max_history_length, ..svgf_tuning() };
        tuned(&frame(EXTENT), &tuning, &guides, &grey(EXTENT, now), previous).luminance_history[0].texels()[7]
    };
    let outside = of(1.0, 3.0, Some(&previous)).outside.expect("one frame");
    // Of even noise, 2 beside four samples are what a deviation of 2/0.535 gives.
    assert!((outside - 2.0 / 0.535).abs() < 5e-3, "{outside}");
    assert_eq!(of(1.0, 3.0, Some(&previous)).deviation, 0.0);
    assert_eq!(of(1.0, 1.0, Some(&previous)).outside, Some(0.0));
    assert_eq!(of(2.0, 3.0, Some(&previous)).outside, None, "two frames have a deviation");
    assert_eq!(of(1.0, 3.0, None).outside, None, "without a past");
}

#[test]
fn a_constant_image_is_a_fixed_point() {
    let (guides, constant) = (flat(EXTENT), Image::new(EXTENT, [0.3, 7.0, 900.0, 0.0].map(crate::reference::round_to_half)));
    let mut output = step(&frame(EXTENT), &guides, &constant, None);
    for _ in 0..8 {
        output = step(&frame(EXTENT), &guides, &constant, Some(&output));
        assert_eq!(output.irradiance[0], constant);
        assert!(output.luminance_history[0].texels().iter().all(|m| m.deviation < 0.1), "half a step of the mean, 70");
    }
}

#[test]
fn exposure_scales_the_history() {
    let (guides, bright) = (flat(EXTENT), grey(EXTENT, 2.0));
    let first = step(&frame(EXTENT), &guides, &noise(EXTENT, 3), None);
    let first = step(&frame(EXTENT), &guides, &noise(EXTENT, 4), Some(&first));
    let scaled = FrameConstants { exposure_ratio: 2.0, ..frame(EXTENT) };
    let next = step(&scaled, &guides, &bright, Some(&first));
    let doubled = TemporalAccumulationOutputs {
        irradiance: vec![first.irradiance[0].map(|t| t.map(|x| 2.0 * x))],
        luminance_history: vec![first.luminance_history[0].map(|m| LuminanceHistory {
            mean: 2.0 * m.mean,
            deviation: 2.0 * m.deviation,
            ..*m
        })],
        statistics: Statistics::default(),
    };
    let expected = step(&frame(EXTENT), &guides, &bright, Some(&doubled));
    assert_eq!(next, expected);
    assert_ne!(next, step(&frame(EXTENT), &guides, &bright, Some(&first)));
    let absurd = FrameConstants { exposure_ratio: f32::MAX, ..frame(EXTENT) };
    assert!(all_finite(&step(&absurd, &guides, &bright, Some(&first)).irradiance[0]));
}

#[test]
fn a_reset_frame_is_a_first_frame_and_reads_nothing() {
    let guides = guides(EXTENT, |x, _| surface(if x == 0 { 0.0 } else { 4.0 }));
    let c = noise(EXTENT, 5);
    let poison = TemporalAccumulationOutputs {
        irradiance: vec![Image::new(EXTENT, [f32::NAN; 4])],
        luminance_history: vec![Image::new(
            EXTENT,
            LuminanceHistory { mean: f32::NAN, deviation: f32::NAN, history_length: f32::NAN, reason: 0, outside: None },
        )],
        statistics: Statistics::default(),
    };
    let first = step(&frame(EXTENT), &guides, &c, None);
    assert_eq!(step(&reset(frame(EXTENT)), &guides, &c, Some(&poison)), first);
    let luminance_history = &first.luminance_history[0];
    assert_eq!(
        (luminance_history.texels()[0].reason, luminance_history.texels()[1].reason),
        (Reason::None as u16, Reason::Reset as u16)
    );
    assert!(luminance_history.texels().iter().all(|m| m.history_length == 1.0 && m.deviation == 0.0));
}

#[test]
fn the_background_passes_with_its_luminance() {
    let guides = guides(EXTENT, |_, _| surface(0.0));
    let sky = Image::new(EXTENT, [1.0, 2.0, 3.0, 0.0]);
    let first = step(&frame(EXTENT), &guides, &noise(EXTENT, 1), None);
    let output = step(&frame(EXTENT), &guides, &sky, Some(&first));
    assert_eq!(output.irradiance[0], sky);
    let luminance_history = output.luminance_history[0].texels()[3];
    assert!((luminance_history.mean - 1.8596).abs() < 1e-3);
    assert_eq!((luminance_history.deviation, luminance_history.history_length, luminance_history.reason), (0.0, 1.0, 0));
}

#[test]
fn neither_parity_nor_the_allocation_changes_a_bit() {
    let large = [17, 13];
    let (tight, loose) = (flat(EXTENT), guides(large, |x, y| surface(if x < 6 && y < 5 { 4.0 } else { 4.05 })));
    let poison = |image: &Image<[f32; 4]>| embed(image, large, [f32::NAN; 4]);
    let in_large =
        |frame_index| FrameConstants { render_extent: EXTENT, previous_render_extent: EXTENT, frame_index, ..frame(large) };
    let (mut tight_output, mut loose_output) =
        (step(&frame(EXTENT), &tight, &noise(EXTENT, 0), None), step(&in_large(0), &loose, &poison(&noise(EXTENT, 0)), None));
    for i in 1..5 {
        let c = noise(EXTENT, i);
        tight_output = step(&FrameConstants { frame_index: 7, ..frame(EXTENT) }, &tight, &c, Some(&tight_output));
        loose_output.irradiance[0] = poison(&crop(&loose_output.irradiance[0], EXTENT));
        loose_output = step(&in_large(i), &loose, &poison(&c), Some(&loose_output));
        assert_eq!(crop(&loose_output.irradiance[0], EXTENT), tight_output.irradiance[0]);
        assert_eq!(crop(&loose_output.luminance_history[0], EXTENT), tight_output.luminance_history[0]);
    }
    assert!(tight_output.luminance_history[0].texels()[0].history_length == 5.0);
}

#[test]
fn a_hole_keeps_its_history_and_a_filled_one_counts_for_less() {
    let guides = flat(EXTENT);
    let luminance_history = LuminanceHistory { mean: 1.0, deviation: 0.5, history_length: 4.0, reason: 0, outside: None };
    let signal = (grey(EXTENT, 1.0), Image::new(EXTENT, luminance_history));
    let signals = [SignalHistory { irradiance: &signal.0, luminance_history: &signal.1 }; 2];
    let [sample, filled] = [0.0, HOLE].map(|alpha| Image::new(EXTENT, [3.0, 3.0, 3.0, alpha]));
    let tuning = Tuning { alpha: 0.0, alpha_moments: 0.0, ..Tuning::default() };
    let step = |change: f32, previous: Option<PreviousFrame>| {
        let confidence = Image::new(EXTENT, 1.0 - change);
        let inputs = TemporalAccumulationInputs {
            irradiance: &[&sample, &filled],
            history_confidence: Some(&confidence),
            previous,
            ..inputs(&guides, &[])
        };
        let output = temporal_accumulation(&frame(EXTENT), &tuning, &inputs);
        let of = |i: usize| (output.irradiance[i].texels()[7][0], output.luminance_history[i].texels()[7].history_length);
        [of(0), of(1)]
    };
    let previous = Some(PreviousFrame { guide: &guides.guide, signals: &signals });
    let [(mean, frames), (kept, frames_kept)] = step(0.0, previous);
    assert_eq!((frames, frames_kept), (5.0, 4.5), "a length for each signal");
    assert!((mean - (1.0 + 2.0 / 5.0)).abs() < 1e-3 && (kept - (1.0 + 2.0 * 0.5 / 4.5)).abs() < 1e-3, "{mean} {kept}");
    // What is filled in takes the place of light that is no longer true, and of a history that is lost.
    assert_eq!(step(1.0, previous).map(|of| of.0), [3.0, 3.0]);
    assert_eq!(step(0.0, None), [(3.0, 1.0), (3.0, 1.0)]);
}

#[test]
fn a_hole_that_nothing_fills_keeps_its_history_and_is_none() {
    let guides = flat(EXTENT);
    let luminance_history = LuminanceHistory { mean: 1.0, deviation: 0.5, history_length: 4.0, reason: 0, outside: None };
    let signal = (grey(EXTENT, 1.0), Image::new(EXTENT, luminance_history));
    let signals = [SignalHistory { irradiance: &signal.0, luminance_history: &signal.1 }];
    let (empty, sample) = (Image::new(EXTENT, [0.0, 0.0, 0.0, EMPTY_HOLE]), grey(EXTENT, 3.0));
    let changed = Image::new(EXTENT, 0.0);
    let step = |irradiance: &Image<[f32; 4]>, confidence: Option<&Image<f32>>, signals: Option<&[SignalHistory]>| {
        let previous = signals.map(|signals| PreviousFrame { guide: &guides.guide, signals });
        let inputs = TemporalAccumulationInputs {
            irradiance: &[irradiance],
            history_confidence: confidence,
            previous,
            ..inputs(&guides, &[])
        };
        let mut output = temporal_accumulation(&frame(EXTENT), &Tuning::default(), &inputs);
        (output.irradiance.remove(0), output.luminance_history.remove(0))
    };
    // Also where the light is known to have changed: to what is not known.
    for confidence in [None, Some(&changed)] {
        let (kept, after) = step(&empty, confidence, Some(&signals));
        assert_eq!(kept.texels()[7][0], 1.0);
        let after = after.texels()[7];
        assert_eq!((after.mean, after.deviation), (1.0, 0.5));
    }
    // Without a history there is none for the next frame either.
    let (irradiance, luminance_history) = step(&empty, None, None);
    assert_eq!(luminance_history.texels()[7].history_length, 0.0);
    let (healed, luminance_history) =
        step(&sample, None, Some(&[SignalHistory { irradiance: &irradiance, luminance_history: &luminance_history }]));
    assert_eq!((healed.texels()[7][0], luminance_history.texels()[7].history_length), (3.0, 1.0));
}

//! Sources of the deviation, and pixels that the neighbourhood may see.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::Surface;

const EXTENT: [u32; 2] = [15, 13];

fn deviations(frame: &FrameConstants, guides: &Guides, luminance_history: &Image<LuminanceHistory>) -> Image<f32> {
    let c = noise(luminance_history.extent(), 9);
    let inputs = VarianceInputs { guide: &guides.guide, irradiance: &[&c], luminance_history: &[luminance_history] };
    let output = variance(frame, &svgf_tuning(), &inputs).remove(0);
    let kept = |a: &[f32; 4], b: &[f32; 4]| (0..3).all(|i| a[i] == crate::reference::round_to_half(b[i]));
    assert!(output.texels().iter().zip(c.texels()).all(|(a, b)| kept(a, b)), "irradiance passes");
    output.map(|t| t[3])
}

fn of(mean: f32, deviation: f32, history_length: f32) -> LuminanceHistory {
    LuminanceHistory { mean, deviation, history_length, reason: 0, outside: None }
}

fn centre(image: &Image<f32>) -> f32 {
    *image.get(7, 6).expect("inside")
}

#[test]
fn a_long_history_speaks_for_itself() {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    let luminance_history = paint(EXTENT, |x, y| of((x * y) as f32, 0.125 * x as f32, 4.0));
    let output = deviations(&frame(EXTENT), &guides, &luminance_history);
    assert_eq!(output, luminance_history.map(|m| m.deviation));
}

#[test]
fn a_short_history_asks_its_neighbourhood() {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    let samples = noise(EXTENT, 1);
    let window: Vec<f32> =
        (3..10).flat_map(|y| (4..11).map(move |x| (x, y))).map(|(x, y)| samples.at(IVec2::new(x, y))[0]).collect();
    let mean = window.iter().sum::<f32>() / 49.0;
    let spread = window.iter().map(|l| (l - mean) * (l - mean)).sum::<f32>() / 49.0;
    for length in [1.0, 2.0, 3.0] {
        let luminance_history = samples.map(|t| of(t[0], 0.25, length));
        let expected = ((spread + 0.0625) * 4.0 / length).sqrt();
        let given = centre(&deviations(&frame(EXTENT), &guides, &luminance_history));
        assert!((given - expected).abs() < 1e-3, "{length}: {given} for {expected}");
    }
}

#[test]
fn a_constant_neighbourhood_has_no_variance() {
    let guides = guides(EXTENT, |x, _| surface(4.0 + x as f32));
    for l in [0.0, 0.1, 300.0, 65504.0] {
        let output = deviations(&frame(EXTENT), &guides, &Image::new(EXTENT, of(l, 0.0, 1.0)));
        assert!(output.texels().iter().all(|d| *d <= 1e-5 * l), "{l}: {:?}", output.texels()[0]);
    }
}

#[test]
fn the_neighbourhood_ends_at_edges_and_at_the_background() {
    let other_side = |change: fn(&mut Surface)| {
        guides(EXTENT, |x, _| {
            let mut s = surface(4.0);
            if x > 7 {
                change(&mut s);
            }
            s
        })
    };
    let luminance_history = paint(EXTENT, |x, _| of(if x > 7 { 100.0 } else { 1.0 }, 0.0, 1.0));
    let seen = centre(&deviations(&frame(EXTENT), &other_side(|_| ()), &luminance_history));
    assert!(seen > 50.0, "without an edge the step is variance: {seen}");
    let edges: [fn(&mut Surface); 3] = [|s| s.linear_depth = 4.5, |s| s.normal = [1.0, 0.0, 0.0], |s| s.linear_depth = 0.0];
    for change in edges {
        let guides = other_side(change);
        let output = deviations(&frame(EXTENT), &guides, &luminance_history);
        assert!(centre(&output) < 1e-3, "{}", centre(&output));
        assert!(!guides.guide.texels().contains(&[0; 4]) || *output.get(12, 6).expect("inside") == BACKGROUND_DEVIATION);
    }
}

#[test]
fn two_signals_and_a_larger_allocation_change_nothing() {
    let large = [40, 20];
    let (tight, loose) = (guides(EXTENT, |_, _| surface(4.0)), guides(large, |_, _| surface(4.0)));
    let luminance_history = noise(EXTENT, 2).map(|t| of(t[0], 0.1, 2.0));
    let (a, b) = (noise(EXTENT, 3), noise(EXTENT, 4));
    let run = |frame: &FrameConstants,
               guides: &Guides,
               irradiance: &[&Image<[f32; 4]>],
               luminance_history: &[&Image<LuminanceHistory>]| {
        let inputs = VarianceInputs { guide: &guides.guide, irradiance, luminance_history };
        variance(frame, &svgf_tuning(), &inputs)
    };
    let one = run(&frame(EXTENT), &tight, &[&b], &[&luminance_history]).remove(0);
    let flat = Image::new(EXTENT, of(1.0, 0.0, 1.0));
    assert_eq!(run(&frame(EXTENT), &tight, &[&a, &b], &[&flat, &luminance_history])[1], one);
    let in_large = FrameConstants { render_extent: EXTENT, frame_index: 5, ..frame(large) };
    let (b, luminance_history) =
        (embed(&b, large, [f32::NAN; 4]), embed(&luminance_history, large, of(f32::NAN, f32::NAN, f32::NAN)));
    assert_eq!(crop(&run(&in_large, &loose, &[&b], &[&luminance_history])[0], EXTENT), one);
}

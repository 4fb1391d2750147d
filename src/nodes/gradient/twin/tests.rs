//! Differences by hand.

use super::*;
use crate::nodes::demodulate::twin::noisy_luminance;
use crate::reference::binary16::half_bits;
use crate::reference::surface_motion::pack_surface_motion;
use crate::reference::test_scene::*;
use crate::reference::{pack_gradient_sample, GradientSample};
use crate::Flags;

const EXTENT: [u32; 2] = [6, 3];

fn grey(l: f32) -> Image<[f32; 4]> {
    Image::new(EXTENT, [l, l, l, 0.0])
}

fn reshaded_frame() -> FrameConstants {
    let frame = frame(EXTENT);
    FrameConstants { flags: frame.flags | Flags::RESHADED, ..frame }
}

/// The left stratum repeats a sample of the right one, which has none.
fn samples() -> Image<[u16; 4]> {
    let sample = GradientSample { pixel: [1, 2], previous_pixel: [4, 0] };
    paint([2, 1], |x, _| pack_gradient_sample(3, (x == 0).then_some(sample)))
}

/// `noisy_luminance` of a frame with grey radiance and albedo; of strata as of pixels.
fn luminance_of(l: f32, albedo: f32) -> Image<u32> {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    noisy_luminance(&frame(EXTENT), &guides.guide, &[&grey(l)], Some(&grey(albedo)))
}

fn left(frame: &FrameConstants, now: f32, albedo: f32, previous: &Image<u32>) -> [f32; 4] {
    let (guides, albedo) = (guides(EXTENT, |_, _| surface(4.0)), grey(albedo));
    let inputs = GradientInputs {
        guide: &guides.guide,
        noisy: &[&grey(now)],
        albedo: Some(&albedo),
        previous_luminance: Some(previous),
        previous_red_blue: None,
        source: GradientInput::ForwardProjected { gradient_samples: &samples() },
    };
    let outputs = gradient(frame, &svgf_tuning(), 3, &inputs);
    let [_, without] = outputs.gradient.texels() else { panic!("two strata") };
    assert_eq!(without[..2], [0.0, 0.0], "a stratum without a sample");
    // The sample stands for the left stratum, the middle pixel for the right one.
    let places: Vec<u16> = outputs.gradient_guide.texels().iter().map(|t| t[0] & 0xf).collect();
    assert_eq!(places[1], 4);
    assert_eq!(places[0], if is_reshaded(frame) && !is_reset(frame) { 7 } else { 4 });
    outputs.gradient.texels()[0]
}

#[test]
fn the_change_is_taken_against_the_previous_albedo() {
    let near = |a: [f32; 4], b: [f32; 2]| assert!((a[0] - b[0]).abs() < 2e-3 && (a[1] - b[1]).abs() < 2e-3, "{a:?} for {b:?}");
    near(left(&reshaded_frame(), 0.5, 0.9, &luminance_of(0.25, 0.5)), [0.5, 1.0]);
    near(left(&reshaded_frame(), 0.25, 0.9, &luminance_of(0.5, 0.5)), [-0.5, 1.0]);
    near(left(&reshaded_frame(), 0.5, 0.9, &luminance_of(0.0, 0.5)), [1.0, 1.0]);
    near(left(&reshaded_frame(), 0.0, 0.9, &luminance_of(0.5, 0.5)), [-1.0, 1.0]);
    let brighter = FrameConstants { exposure_ratio: 2.0, ..reshaded_frame() };
    near(left(&brighter, 0.5, 0.9, &luminance_of(0.25, 0.5)), [0.0, 1.0]);
}

#[test]
fn the_same_radiance_differs_by_nothing() {
    for l in [0.0, 1e-7, 0.1, 0.333, 7.77, 1e5, f32::NAN] {
        let [change, ..] = left(&reshaded_frame(), l, 0.9, &luminance_of(l, 0.123));
        assert_eq!(change, 0.0, "{l}");
    }
}

#[test]
fn a_pixel_without_a_sample_says_nothing_of_the_light() {
    // In this frame, in the one before, in both.
    for (now, before) in [(f32::NAN, 0.5), (0.5, f32::NAN), (f32::NAN, f32::NAN)] {
        let [change, brightest, mean, deviation] = left(&reshaded_frame(), now, 0.5, &luminance_of(before, 0.5));
        assert_eq!([change, brightest, deviation], [0.0; 3], "{now}, {before}");
        assert_eq!(mean == 0.0, now.is_nan());
    }
}

#[test]
fn without_reshading_and_in_a_reset_there_is_no_gradient() {
    let dark = luminance_of(0.0, 0.5);
    assert_eq!(left(&frame(EXTENT), 1.0, 0.5, &dark)[..2], [0.0, 0.0]);
    assert_eq!(left(&reset(reshaded_frame()), 1.0, 0.5, &dark)[..2], [0.0, 0.0]);
}

/// Of light that was 2 and is, where paths of the previous frame now see other radiances.
fn of_paths_again(
    again: &Image<[f32; 4]>,
    guide: &Image<[u16; 4]>,
    previous_guide: &Image<[u16; 4]>,
    surface_motion: &Image<[u16; 4]>,
) -> GradientOutputs {
    let inputs = GradientInputs {
        guide,
        noisy: &[&grey(1.0)],
        albedo: Some(&grey(0.5)),
        previous_luminance: Some(&luminance_of(1.0, 0.5)),
        previous_red_blue: Some(&Image::new(EXTENT, u32::from(half_bits(1.0)) * 0x1_0001)),
        source: GradientInput::Reshaded { reshaded_radiance: Some(again), previous_guide: Some(previous_guide), surface_motion },
    };
    gradient(&frame(EXTENT), &svgf_tuning(), 3, &inputs)
}

#[test]
fn a_dense_image_counts_where_the_surface_was() {
    // The right column of the left stratum has no sample, and half of the others changed.
    let again = paint(EXTENT, |x, _| [[1.0, 3.0, f32::NAN, 1.0, 1.0, 1.0][x as usize]; 4]);
    let guides = guides(EXTENT, |x, _| surface(if x == 5 { 0.0 } else { 4.0 }));
    let outputs = of_paths_again(&again, &guides.guide, &guides.guide, &guides.surface_motion);
    let [left, right] = outputs.gradient.texels() else { panic!("two strata") };
    assert!((left[0] - 2.0).abs() < 5e-3 && (left[1] - 4.0).abs() < 5e-3, "{left:?}");
    assert_eq!((right[0], (right[1] - 2.0).abs() < 5e-3), (0.0, true), "{right:?}");
    // Three samples shone 2 and shine 2, three shine 6, each in three components.
    let [light, _] = outputs.light_now.texels() else { panic!("two strata") };
    let expected = [4.0, 4.0, 4.0, (3.0_f32 * 6.0 * 6.0 + 3.0 * 18.0 * 18.0).sqrt() / 6.0];
    assert!((0..4).all(|i| (light[i] - expected[i]).abs() < 2e-2), "{light:?} for {expected:?}");
    let hidden = Image::new(EXTENT, pack(9.0));
    let outputs = of_paths_again(&again, &guides.guide, &hidden, &guides.surface_motion);
    assert!(outputs.gradient.texels().iter().all(|g| g[..2] == [0.0, 0.0]), "another surface was there");
}

/// A bar moved to the right before a bright wall, which the paths of the previous frame now see in its place.
#[test]
fn a_thing_that_moved_by_itself_has_no_paths_of_the_previous_frame() {
    let again = paint(EXTENT, |x, _| if x < 3 { [9.0; 4] } else { [1.0; 4] });
    let guide = guides(EXTENT, |_, _| surface(4.0)).guide;
    let changes = |moved: f32| {
        let surface_motion = paint(EXTENT, |_, _| pack_surface_motion([-moved, 0.0], Some((0.0, [0.0, 0.0, 1.0]))));
        let outputs = of_paths_again(&again, &guide, &guide, &surface_motion);
        outputs.gradient.texels().iter().map(|g| g[1]).collect::<Vec<_>>()
    };
    assert_eq!(changes(3.0), [0.0; 2]);
    assert!(changes(0.25).iter().all(|brightest| *brightest > 1.0), "what hardly moved keeps its paths");
}

fn pack(depth: f32) -> [u16; 4] {
    crate::reference::pack_guide(&surface(depth))
}

#[test]
fn a_host_s_own_differences_are_bounded() {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    let host = paint([2, 1], |x, _| if x == 0 { [-0.5, 1.0, 0.0, 0.0] } else { [f32::NAN, 1.0, 0.0, 0.0] });
    let inputs = GradientInputs {
        guide: &guides.guide,
        noisy: &[&grey(1.0)],
        albedo: None,
        previous_luminance: None,
        previous_red_blue: None,
        source: GradientInput::Sparse(Some(&host)),
    };
    let outputs = gradient(&frame(EXTENT), &svgf_tuning(), 3, &inputs);
    let changes: Vec<_> = outputs.gradient.texels().iter().map(|g| [g[0], g[1]]).collect();
    assert_eq!(changes, [[-0.5, 1.0], [0.0, 0.0]]);
}

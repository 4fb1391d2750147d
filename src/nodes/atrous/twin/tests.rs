//! Fixed points, the kernel, and the variance against Monte Carlo.

use super::*;
use crate::reference::test_scene::*;

const EXTENT: [u32; 2] = [21, 17];

/// One axis of the B3 spline \[EAW\].
const SPLINE: [f32; 5] = [1.0 / 16.0, 1.0 / 4.0, 3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

fn run(frame: &FrameConstants, level: u32, guides: &Guides, image: &Image<[f32; 4]>) -> Image<[f32; 4]> {
    tuned(frame, &svgf_tuning(), level, guides, image)
}

fn tuned(frame: &FrameConstants, tuning: &Tuning, level: u32, guides: &Guides, image: &Image<[f32; 4]>) -> Image<[f32; 4]> {
    let inputs = AtrousInputs { guide: &guides.guide, reflection: None, irradiance: &[image] };
    atrous(frame, tuning, AtrousLevel::new(level), &inputs).remove(0)
}

fn flat(extent: [u32; 2]) -> Guides {
    guides(extent, |_, _| surface(4.0))
}

fn with_deviation(image: &Image<[f32; 4]>, deviation: f32) -> Image<[f32; 4]> {
    image.map(|[r, g, b, _]| [*r, *g, *b, deviation])
}

#[test]
fn a_constant_image_is_a_fixed_point() {
    let constant = Image::new(EXTENT, [0.3, 7.0, 65504.0, 0.5].map(crate::reference::round_to_half));
    for (level, output) in (0..10).flat_map(|level| {
        let published = run(&frame(EXTENT), level, &flat(EXTENT), &constant);
        [(level, published), (level, of_means(level, &constant))]
    }) {
        for (given, kept) in output.texels().iter().zip(constant.texels()) {
            assert_eq!(given[..3], kept[..3], "level {level}");
            assert!(given[3] <= kept[3]);
        }
    }
}

fn of_means(level: u32, image: &Image<[f32; 4]>) -> Image<[f32; 4]> {
    let scene = flat(image.extent());
    let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[image] };
    let level = AtrousLevel { luminance_weight: LuminanceWeight::OfMeans, ..AtrousLevel::new(level) };
    atrous(&frame(image.extent()), &svgf_tuning(), level, &inputs).remove(0)
}

fn light(image: &Image<[f32; 4]>) -> f32 {
    image.texels().iter().map(|texel| texel[0]).sum()
}

#[test]
fn rare_light_keeps_more_of_its_mean_by_deviations_of_means() {
    // Neighbours that it never hit know nothing of it.
    let rare = paint(EXTENT, |x, y| if (x, y) == (10, 8) { [9.0, 9.0, 9.0, 3.0] } else { [0.0; 4] });
    let published = run(&frame(EXTENT), 0, &flat(EXTENT), &rare);
    let ours = of_means(0, &rare);
    assert!(light(&ours) > 1.25 * light(&published), "{} of 9 for {}", light(&ours), light(&published));
    // A pixel that was not hit takes some.
    assert!(ours.get(11, 8).expect("inside")[0] > 0.05);
}

#[test]
fn what_luminance_refuses_stays_in_part_on_the_centre() {
    // So far off that no tap takes from it: half of the 55/64 that are refused are kept beside the centre's own 9/64.
    let far = paint(EXTENT, |x, y| if (x, y) == (10, 8) { [900.0, 900.0, 900.0, 1.0] } else { [0.0, 0.0, 0.0, 1.0] });
    let [l, .., deviation] = *of_means(0, &far).get(10, 8).expect("inside");
    assert!((l - 900.0).abs() < 0.5, "{l}");
    // All of it is the noise of the centre.
    assert!((deviation - 1.0).abs() < 1e-2, "{deviation}");
}

#[test]
fn small_differences_are_filtered_and_large_ones_kept_by_deviations_of_means() {
    let step = |height: f32| paint(EXTENT, move |x, _| if x < 10 { [0.0, 0.0, 0.0, 0.1] } else { [height, height, height, 0.1] });
    let beside = |height: f32| of_means(0, &step(height)).get(9, 8).expect("inside")[0] / height;
    // Half of a standard deviation is noise; twenty are an edge.
    assert!(beside(0.05) > 0.25, "{}", beside(0.05));
    assert!(beside(2.0) < 1e-3, "{}", beside(2.0));
}

#[test]
fn wider_levels_tolerate_by_the_deviations_of_their_own_taps() {
    // Certain beside itself, uncertain where its taps are.
    let image = |away: f32| {
        paint(EXTENT, move |x, y| {
            let near = (x - 10).abs() <= 1 && (y - 8).abs() <= 1;
            let l = if (x, y) == (10, 8) { 1.0 } else { 0.0 };
            [l, l, l, if near { 0.0 } else { away }]
        })
    };
    let taken = |away: f32| 1.0 - of_means(2, &image(away)).get(10, 8).expect("inside")[0];
    assert!(taken(0.0) < 1e-3, "{}", taken(0.0));
    assert!(taken(1.0) > 0.4, "{}", taken(1.0));
}

#[test]
fn one_bright_pixel_becomes_the_kernel() {
    let (frame, tuning) = (frame(EXTENT), Tuning { sigma_l: 128.0, ..svgf_tuning() });
    for level in 0..3 {
        let step = 1 << level;
        let impulse = paint(EXTENT, |x, y| {
            let l = if (x, y) == (10, 8) { 1.0 } else { 0.0 };
            [l, l, l, 1000.0]
        });
        let output = tuned(&frame, &tuning, level, &flat(EXTENT), &impulse);
        for (j, ky) in SPLINE.iter().enumerate() {
            for (i, kx) in SPLINE.iter().enumerate() {
                let (x, y) = (10 + (i as i32 - 2) * step, 8 + (j as i32 - 2) * step);
                let c = output.get(x, y).expect("inside")[0];
                // The window of a pixel near the border is cut off: its weights sum to less.
                let sum = |at: i32, side: i32| {
                    (0..5).filter(|k| (0..side).contains(&(at + (k - 2) * step))).map(|k| SPLINE[k as usize]).sum::<f32>()
                };
                let expected = kx * ky / (sum(x, 21) * sum(y, 17));
                assert!((c - expected).abs() < 1e-4, "level {level}, {x} {y}: {c} for {expected}");
            }
        }
        assert_eq!(output.get(10 + 3 * step, 8).map_or(0.0, |t| t[0]), 0.0);
    }
}

#[test]
fn the_variance_is_that_of_filtered_white_noise() {
    let extent = [96, 96];
    // The deviation of uniform noise. Weights must not depend on the noise: then eq. 1 is linear and the prediction is exact.
    let deviation = 1.0 / 12.0_f32.sqrt();
    let (frame, tuning) = (frame(extent), Tuning { sigma_l: 128.0, ..svgf_tuning() });
    let guides = flat(extent);
    let mut squares = 0.0;
    let mut number = 0.0;
    let mut predicted = 0.0;
    for seed in 0..4 {
        // Far enough from luminance edge stopping: a large deviation in the alpha would widen it, so the image is scaled down.
        let image = with_deviation(&noise(extent, seed), deviation);
        let output = tuned(&frame, &tuning, 0, &guides, &image);
        for y in 8..88 {
            for x in 8..88 {
                let [l, .., sigma] = *output.get(x, y).expect("inside");
                squares += (l - 0.5) * (l - 0.5);
                predicted += sigma * sigma;
                number += 1.0;
            }
        }
    }
    let (measured, predicted) = (squares / number, predicted / number);
    assert!((measured / predicted - 1.0).abs() < 0.06, "{measured} measured, {predicted} predicted");
    // Σh² of the kernel: (35/128)².
    let ideal = deviation * deviation * (35.0_f32 / 128.0).powi(2);
    assert!((predicted / ideal - 1.0).abs() < 0.03, "{predicted} for {ideal}");
}

#[test]
fn the_second_level_predicts_as_well() {
    // Level 1 reads every other pixel, and those are correlated after level 0: the prediction is that of independent taps,
    // so white noise is given to level 1 itself.
    let extent = [96, 96];
    let (frame, tuning) = (frame(extent), Tuning { sigma_l: 128.0, ..svgf_tuning() });
    let deviation = 1.0 / 12.0_f32.sqrt();
    let output = tuned(&frame, &tuning, 1, &flat(extent), &with_deviation(&noise(extent, 77), deviation));
    let inner = || (8..88).flat_map(|y| (8..88).map(move |x| (x, y))).map(|(x, y)| *output.get(x, y).expect("inside"));
    let measured = inner().map(|t| (t[0] - 0.5) * (t[0] - 0.5)).sum::<f32>() / 6400.0;
    let predicted = inner().map(|t| t[3] * t[3]).sum::<f32>() / 6400.0;
    assert!((measured / predicted - 1.0).abs() < 0.1, "{measured} measured, {predicted} predicted");
}

#[test]
fn signals_share_nothing_but_geometry() {
    let (a, b, c) =
        (with_deviation(&noise(EXTENT, 1), 0.2), with_deviation(&noise(EXTENT, 2), 0.4), with_deviation(&noise(EXTENT, 3), 0.1));
    let guides = guides(EXTENT, |x, y| surface(4.0 + 0.01 * (x * y) as f32));
    let inputs = AtrousInputs { guide: &guides.guide, reflection: None, irradiance: &[&a, &b, &c] };
    let together = atrous(&frame(EXTENT), &svgf_tuning(), AtrousLevel::new(1), &inputs);
    assert_eq!(together.len(), 3);
    for (output, image) in together.iter().zip([&a, &b, &c]) {
        assert_eq!(*output, run(&frame(EXTENT), 1, &guides, image));
    }
}

#[test]
fn a_render_rect_gives_the_bits_of_a_tight_image() {
    let large = [37, 33];
    let image = with_deviation(&noise(EXTENT, 1), 0.2);
    let (tight, loose) = (flat(EXTENT), flat(large));
    let in_large = FrameConstants { render_extent: EXTENT, frame_index: 3, ..frame(large) };
    for level in [0, 2, 4] {
        let expected = run(&frame(EXTENT), level, &tight, &image);
        let output = run(&in_large, level, &loose, &embed(&image, large, [f32::NAN; 4]));
        assert_eq!(output, embed(&expected, large, [0.0; 4]));
    }
}

#[test]
fn one_pixel_stays() {
    let image = Image::new([1, 1], [1.0, 2.0, 4.0, 0.5]);
    for level in [0, 9] {
        assert_eq!(run(&frame([1, 1]), level, &flat([1, 1]), &image), image);
    }
}

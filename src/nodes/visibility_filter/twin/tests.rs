//! How wide the filter is, and where it is not.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::VisibilityHistory;

const EXTENT: [u32; 2] = [32, 32];

/// All levels of a picture of visibility whose penumbrae have a radius of so many pixels.
fn filtered(radius: f32, deviation: f32, estimate: impl Fn(i32, i32) -> f32) -> Image<[f32; 2]> {
    let g = guides(EXTENT, |_, _| surface(1.0));
    // Pixels are 2/32 scene units long.
    let history = VisibilityHistory { mean: [0.5; 3], deviation: 0.5, history_length: 4.0, occluder_distance: radius };
    let history = Image::new(EXTENT, history);
    let tuning = Tuning { light_radius: 2.0 / 32.0, penumbra_blur: 0.5, ..svgf_tuning() };
    let filtered = (0..4).fold(paint(EXTENT, |x, y| ([estimate(x, y); 3], deviation)), |estimate, level| {
        let inputs = VisibilityFilterInputs {
            guide: &g.guide,
            light_radius: tuning.light_radius,
            visibility_history: &history,
            estimate: &estimate,
        };
        visibility_filter(&frame(EXTENT), &tuning, level, &inputs)
    });
    filtered.map(|(v, sigma)| [v[0], *sigma])
}

fn half(x: i32, _: i32) -> f32 {
    f32::from(u8::from(x >= 16))
}

#[test]
fn a_penumbra_below_a_pixel_is_left_as_it_is() {
    for radius in [0.0, 0.1, 0.25] {
        let image = filtered(radius, 0.5, half);
        // Along the edge alone, from which the nearest tap on the other side is a pixel away.
        let tolerated = if radius == 0.0 { 0.0 } else { 0.03 };
        assert!(image.texels().iter().zip(paint(EXTENT, half).texels()).all(|(a, b)| (a[0] - b).abs() <= tolerated), "{radius}");
    }
}

#[test]
fn the_kernel_has_the_width_that_the_penumbra_allows() {
    for radius in [2.0, 4.0, 8.0] {
        let image = filtered(radius, 1e3, half);
        // The edge's profile is the sum of the kernel: its variance is that of the slope.
        let row: Vec<f32> = (0..32).map(|x| image.at(IVec2::new(x, 8))[0]).collect();
        let slope = |x: usize| row[x] - row[x - 1];
        let variance: f32 = (1..32).map(|x| slope(x) * (x as f32 - 16.0).powi(2)).sum::<f32>() / (1..32).map(slope).sum::<f32>();
        let expected = 0.5 * radius;
        assert!(variance.sqrt() < 1.05 * expected && variance.sqrt() > 0.6 * expected, "{radius}: {}", variance.sqrt());
    }
}

#[test]
fn what_is_certain_is_not_blurred_and_noise_is_averaged() {
    let sharp = filtered(6.0, 0.0, half);
    assert!((sharp.at(IVec2::new(16, 8))[0] - 1.0).abs() < 1e-3 && sharp.at(IVec2::new(15, 8))[0] < 1e-3);
    let random = noise(EXTENT, 3);
    let image = filtered(6.0, 0.5, |x, y| f32::from(random.at(IVec2::new(x, y))[0] < 0.5));
    let spread = |image: &Image<[f32; 2]>| {
        image.texels().iter().map(|t| (t[0] - 0.5) * (t[0] - 0.5)).sum::<f32>() / image.texels().len() as f32
    };
    assert!(spread(&image) < 0.02, "{}", spread(&image));
    assert!(image.texels().iter().all(|t| t[1] < 0.2 && (0.0..=1.0).contains(&t[0])));
}

//! Literal expectations come from flip-evaluator 1.7, the published implementation, which evaluated the same generated
//! images (the hash and the products below are exact in `f32`, so both languages see the same bits).

use super::*;
use crate::scores::tests::hash;

/// Largest difference from the published numbers. Both sides add and round `f32` in another order, which leaves about 1e-7
/// in the planes, and powers below 1 enlarge that where the images hardly differ: 2e-6 was measured.
const TOLERANCE: f64 = 5e-6;
/// The same for images of one colour: they have no features, so that the square root of nothing but rounding remains.
const FLAT_TOLERANCE: f64 = 1e-4;

#[derive(Clone)]
struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Image {
    /// Ramps with jumps, a checkerboard in two tints, a highlight of up to 126, and a part in shadow.
    fn scene(width: u32, height: u32) -> Self {
        let pixel = |i: u32| {
            let (x, y) = (i % width, i / width);
            let ramps = [((x * 3 + 1) % 64, 32), ((y * 5 + 2) % 32, 32), ((x + y) * 2 % 48 + 1, 64)];
            let tint = if (x / 7 + y / 5) % 2 == 0 { [1.0, 0.25, 0.5] } else { [1.0; 3] };
            let highlight = if x >= 28 && (12..18).contains(&y) { 64.0 } else { 1.0 };
            let shadow = if y >= 24 { 1.0 / 256.0 } else { 1.0 };
            [0, 1, 2].map(|c| ramps[c].0 as f32 / ramps[c].1 as f32 * tint[c] * highlight * shadow)
        };
        Self { width, height, pixels: (0..width * height).map(pixel).collect() }
    }

    fn noisy(mut self) -> Self {
        for (i, value) in self.pixels.as_flattened_mut().iter_mut().enumerate() {
            *value *= 0.5 + hash(i as u32);
        }
        self
    }

    /// Scales all rows but the first eight.
    fn dimmed(mut self, factor: f32) -> Self {
        self.pixels[8 * self.width as usize..].as_flattened_mut().iter_mut().for_each(|v| *v *= factor);
        self
    }

    fn map(mut self, value: impl Fn(f32) -> f32) -> Self {
        self.pixels.as_flattened_mut().iter_mut().for_each(|v| *v = value(*v));
        self
    }

    fn rgb(&self) -> Rgb<'_> {
        Rgb::new(self.width, self.height, &self.pixels).unwrap()
    }
}

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

fn mean_of(map: &[f32]) -> f64 {
    map.iter().map(|&v| f64::from(v)).sum::<f64>() / map.len() as f64
}

/// Checks the mean and some pixels `(x, y, error)`.
#[track_caller]
fn check(map: &[f32], width: u32, mean: f64, pixels: &[(u32, u32, f64)]) {
    for &(x, y, expected) in pixels {
        close(f64::from(map[(y * width + x) as usize]), expected, TOLERANCE);
    }
    close(mean_of(map), mean, TOLERANCE);
}

#[track_caller]
fn check_hdr(reference: Image, mean: f64, pixels: &[(u32, u32, f64)]) {
    let image = reference.clone().noisy();
    check(&flip_map(image.rgb(), reference.rgb()).unwrap(), reference.width, mean, pixels);
    close(flip(image.rgb(), reference.rgb()).unwrap(), mean, TOLERANCE);
}

#[track_caller]
fn check_ldr(reference: Image, mean: f64, pixels: &[(u32, u32, f64)]) {
    let to_display = |image: Image| image.map(|v| v.min(1.0));
    let (image, reference) = (to_display(reference.clone().noisy()), to_display(reference));
    check(&ldr_flip(&image.pixels, &reference.pixels, reference.width as usize), reference.width, mean, pixels);
    check(&ldr_flip(&reference.pixels, &image.pixels, reference.width as usize), reference.width, mean, pixels);
}

#[test]
fn ldr_flip_agrees_with_the_published_numbers_either_way_round() {
    let pixels = [
        (0, 0, 0.096_493_06),
        (21, 5, 0.157_473_55),
        (29, 14, 0.085_450_10),
        (47, 31, 0.014_558_89),
        (27, 12, 0.130_894_88),
        (40, 25, 0.170_210_69),
        (13, 20, 0.162_126_03),
    ];
    check_ldr(Image::scene(48, 32), 0.124_766_665, &pixels);
}

#[test]
fn hdr_flip_agrees_with_the_published_numbers() {
    let pixels = [
        (0, 0, 0.192_349_46),
        (21, 5, 0.126_208_63),
        (29, 14, 0.100_561_59),
        (47, 31, 0.018_497_36),
        (27, 12, 0.106_166_31),
        (40, 25, 0.149_933_26),
        (13, 20, 0.236_373_02),
    ];
    check_hdr(Image::scene(48, 32), 0.132_224_647, &pixels);
}

#[test]
fn the_exposures_come_from_the_reference() {
    let (scene, noisy) = (Image::scene(48, 32), Image::scene(48, 32).noisy());
    check(&flip_map(scene.rgb(), noisy.rgb()).unwrap(), 48, 0.132_845_205, &[]);
    for (image, start, stop, count) in [(&scene, -5.029_782_3, 2.872_861_4, 8), (&noisy, -5.378_554_3, 2.926_431_4, 9)] {
        let exposures = exposure::exposures(&image.pixels);
        assert_eq!(exposures.len(), count);
        close(exposures[0], start, 1e-5);
        close(exposures[count - 1], stop, 1e-5);
    }
}

#[test]
fn there_are_as_many_exposures_as_stops_and_at_least_two() {
    let mut pixels = [[0.25; 3]; 9];
    pixels[4] = [4.0; 3];
    let exposures = exposure::exposures(&pixels);
    assert_eq!(exposures.len(), 4);
    close(exposures[0], -0.916_702_8, 1e-5);
    close(exposures[3], 3.083_297_3, 1e-5);
    let exposures = exposure::exposures(&[[1.0; 3]; 9]);
    assert_eq!(exposures.len(), 2);
    close(exposures[0], 1.083_297_3, 1e-5);
    close(exposures[1], 1.083_297_3, 1e-5);
}

/// Where the reference is black, its image is too: only its light part differs.
#[test]
fn a_reference_whose_median_is_dark_or_black_agrees_with_the_published_numbers() {
    let pixels = [(0, 0, 0.202_855_23), (21, 5, 0.107_790_22), (29, 14, 0.099_063_39)];
    check_hdr(Image::scene(48, 32).dimmed(1.0 / 4096.0), 0.129_153_879, &pixels);
    let pixels = [(0, 0, 0.202_827_13), (21, 5, 0.107_813_07), (29, 14, 0.005_027_63)];
    check_hdr(Image::scene(48, 32).dimmed(0.0), 0.047_799_168, &pixels);
}

#[test]
fn images_smaller_than_the_filters_agree_with_the_published_numbers() {
    check_hdr(Image::scene(3, 2), 0.258_976_745, &[(2, 1, 0.266_940_27)]);
    check_hdr(Image::scene(7, 3), 0.286_077_673, &[(6, 2, 0.304_906_67)]);
    check_hdr(Image::scene(1, 40), 0.199_343_660, &[(0, 39, 0.082_362_15)]);
    check_ldr(Image::scene(3, 2), 0.124_549_026, &[(2, 1, 0.157_917_93)]);
    check_ldr(Image::scene(7, 3), 0.201_196_814, &[(6, 2, 0.278_714_84)]);
    check_ldr(Image::scene(1, 40), 0.187_132_494, &[(0, 39, 0.006_694_83)]);
}

#[test]
fn identical_images_have_no_flip() {
    for image in [Image::scene(48, 32), Image::scene(7, 3), Image::scene(7, 3).map(|_| 0.0)] {
        assert_eq!(flip(image.rgb(), image.rgb()).unwrap(), 0.0);
        assert!(flip_map(image.rgb(), image.rgb()).unwrap().iter().all(|&error| error == 0.0));
    }
}

#[test]
fn a_black_image_agrees_with_the_published_number() {
    let scene = Image::scene(48, 32);
    let map = flip_map(scene.clone().map(|_| 0.0).rgb(), scene.rgb()).unwrap();
    check(&map, 48, 0.857_886_631, &[(0, 0, 0.979_019_70)]);
}

#[test]
fn light_where_the_reference_is_black_everywhere_is_an_error() {
    let black = Image::scene(7, 3).map(|_| 0.0);
    let error = |light: f32| flip(black.clone().map(|_| light).rgb(), black.rgb()).unwrap();
    assert!(error(1.0) > 0.9 && error(1.0) <= 1.0);
    assert_eq!(error(f32::MAX), error(1.0));
    assert!(error(f32::MIN_POSITIVE) < 1e-3);
}

#[test]
fn negative_radiance_counts_as_black() {
    let scene = Image::scene(7, 3);
    let below = scene.clone().map(|v| v - 0.25);
    let clipped = below.clone().map(|v| v.max(0.0));
    assert_eq!(flip_map(below.rgb(), scene.rgb()).unwrap(), flip_map(clipped.rgb(), scene.rgb()).unwrap());
    assert_eq!(flip_map(scene.rgb(), below.rgb()).unwrap(), flip_map(scene.rgb(), clipped.rgb()).unwrap());
}

#[test]
fn a_unit_of_radiance_changes_nothing() {
    let (scene, noisy) = (Image::scene(48, 32), Image::scene(48, 32).noisy());
    let error = flip(noisy.rgb(), scene.rgb()).unwrap();
    for unit in [2.0_f32.powi(120), 2.0_f32.powi(-8)] {
        let in_unit = |image: &Image| image.clone().map(|v| v * unit);
        close(flip(in_unit(&noisy).rgb(), in_unit(&scene).rgb()).unwrap(), error, TOLERANCE);
    }
}

#[test]
fn brighter_than_white_is_white() {
    let scene = Image::scene(48, 32);
    for bright in [1e6, f32::MAX] {
        let image = scene.clone().map(|v| if v > 32.0 { bright } else { v });
        check(&flip_map(image.rgb(), scene.rgb()).unwrap(), 48, 0.046_339_419, &[(30, 14, 0.335_627_59)]);
    }
}

#[test]
fn images_of_one_colour_agree_with_the_published_numbers() {
    let pixel = Image::scene(1, 1);
    close(flip(pixel.clone().noisy().rgb(), pixel.rgb()).unwrap(), 0.188_972_279, FLAT_TOLERANCE);
    let ldr = |image: [f32; 3], reference: [f32; 3]| mean_of(&ldr_flip(&[image; 9], &[reference; 9], 3));
    close(ldr([0.0; 3], [1.0; 3]), 0.967_388_332, FLAT_TOLERANCE);
    close(ldr([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]), 1.0, FLAT_TOLERANCE);
}

#[test]
fn sizes_must_fit() {
    let (wide, tall) = (Image::scene(7, 3), Image::scene(3, 7));
    let mismatch = QualityError::ExtentMismatch { left: [7, 3], right: [3, 7] };
    assert_eq!(flip(wide.rgb(), tall.rgb()).unwrap_err(), mismatch);
    assert_eq!(flip_map(wide.rgb(), tall.rgb()).unwrap_err(), mismatch);
}

//! Literal expectations come from scikit-image 0.26.0 and NumPy 2.4.6, which evaluated the same formulas on the same
//! generated images (the hash and the products below are exact in `f32`, so both languages see the same bits).

use super::*;

const RMSE: f64 = 0.457_062_278_3;
const REL_MSE: f64 = 0.077_469_290_4;
const PSNR: f64 = 26.653_743_3;
/// `structural_similarity` of 37x29 and 7x7 pixels, then of 20x6 pixels with `win_size=5` and 3x20 with `win_size=3`.
const SSIM_37: f64 = 0.972_865_678_6;
const SSIM_7: f64 = 0.976_006_032_7;
const SSIM_WIN5: f64 = 0.973_832_149_4;
const SSIM_WIN3: f64 = 0.948_818_353_2;
/// 579 of the 1073 pixels count.
const TEMPORAL: f64 = 0.051_536_485_8;
const STATIC_TEMPORAL: f64 = 0.627_932_620_2;

pub(crate) fn hash(i: u32) -> f32 {
    let state = i.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (((word >> 22) ^ word) >> 8) as f32 / 16_777_216.0
}

/// A pattern that moves by one pixel to the left in each frame.
fn reference(width: u32, height: u32, frame: u32) -> Vec<[f32; 3]> {
    let value = |i: u32, c: u32| {
        let (x, y) = (i % width + frame, i / width);
        ((x * 3 + y * 5 + c * 7 + (x / 9) * (y / 6) * 11) % 23) as f32 / 8.0
    };
    (0..width * height).map(|i| [value(i, 0), value(i, 1), value(i, 2)]).collect()
}

fn noisy(width: u32, height: u32, frame: u32) -> Vec<[f32; 3]> {
    let mut pixels = reference(width, height, frame);
    for (i, value) in pixels.as_flattened_mut().iter_mut().enumerate() {
        *value *= 0.5 + hash(i as u32 + frame * 1_000_003);
    }
    pixels
}

#[track_caller]
fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 1e-6 * expected.abs(), "{value} instead of {expected}");
}

struct Pair {
    image: Vec<[f32; 3]>,
    reference: Vec<[f32; 3]>,
    size: [u32; 2],
}

impl Pair {
    fn new(width: u32, height: u32, frame: u32) -> Self {
        Self { image: noisy(width, height, frame), reference: reference(width, height, frame), size: [width, height] }
    }

    fn image(&self) -> Rgb<'_> {
        Rgb::new(self.size[0], self.size[1], &self.image).unwrap()
    }

    fn reference(&self) -> Rgb<'_> {
        Rgb::new(self.size[0], self.size[1], &self.reference).unwrap()
    }
}

/// Planes of [`TemporalGuides`] for the moving pattern, with wrong depths, ids and motion strewn in.
struct Guides {
    motion_px: Vec<[f32; 2]>,
    expected_previous_depth: Vec<f32>,
    previous_depth: Vec<f32>,
    surface_id: Vec<u32>,
    previous_surface_id: Vec<u32>,
}

impl Guides {
    fn new(width: u32, height: u32) -> Self {
        let pixels = 0..width * height;
        Self {
            motion_px: pixels.clone().map(|i| [1.0 - hash(i) * 0.75, (i % 5) as f32 * 0.25 - 0.5]).collect(),
            expected_previous_depth: pixels.clone().map(|i| 4.0 + (i % 3) as f32 * 0.0625).collect(),
            previous_depth: pixels.clone().map(|i| 4.0 + (i % 4) as f32 * 0.0625).collect(),
            surface_id: pixels.clone().map(|i| 1 + i / 200).collect(),
            previous_surface_id: pixels.map(|i| 1 + i / 190).collect(),
        }
    }

    fn borrow(&self) -> TemporalGuides<'_> {
        TemporalGuides {
            motion_px: &self.motion_px,
            expected_previous_depth: &self.expected_previous_depth,
            previous_depth: &self.previous_depth,
            surface_id: &self.surface_id,
            previous_surface_id: &self.previous_surface_id,
        }
    }
}

#[test]
fn errors_agree_with_numpy() {
    let pair = Pair::new(37, 29, 0);
    close(rmse(pair.image(), pair.reference()).unwrap(), RMSE);
    close(rel_mse(pair.image(), pair.reference()).unwrap(), REL_MSE);
    close(psnr(pair.image(), pair.reference()).unwrap(), PSNR);
}

#[test]
fn ssim_agrees_with_scikit_image() {
    for (width, height, expected) in [(37, 29, SSIM_37), (7, 7, SSIM_7), (20, 6, SSIM_WIN5), (3, 20, SSIM_WIN3)] {
        let pair = Pair::new(width, height, 0);
        close(ssim(pair.image(), pair.reference()).unwrap(), expected);
    }
}

#[test]
fn temporal_errors_agree_with_numpy() {
    let (now, before, guides) = (Pair::new(37, 29, 1), Pair::new(37, 29, 0), Guides::new(37, 29));
    let error = temporal_error(now.image(), before.image(), now.reference(), before.reference(), &guides.borrow());
    close(error.unwrap(), TEMPORAL);
    close(static_temporal_error(now.image(), before.image()).unwrap(), STATIC_TEMPORAL);
}

#[test]
fn identical_images_have_no_error() {
    let (pair, guides) = (Pair::new(19, 11, 3), Guides::new(19, 11));
    let r = pair.reference();
    assert_eq!(rmse(r, r).unwrap(), 0.0);
    assert_eq!(rel_mse(r, r).unwrap(), 0.0);
    assert_eq!(psnr(r, r).unwrap(), f64::INFINITY);
    assert!((ssim(r, r).unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(static_temporal_error(r, r).unwrap(), 0.0);
    assert_eq!(temporal_error(r, r, r, r, &guides.borrow()).unwrap(), 0.0);
}

#[test]
fn more_noise_is_a_larger_error() {
    let pair = Pair::new(32, 24, 0);
    let blend = |t: f32| -> Vec<[f32; 3]> {
        let mix = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|c| b[c] + t * (a[c] - b[c]));
        pair.image.iter().zip(&pair.reference).map(mix).collect()
    };
    let scores: Vec<[f64; 4]> = [0.1, 0.3, 0.6, 1.0]
        .map(|t| {
            let pixels = blend(t);
            let (x, r) = (Rgb::new(32, 24, &pixels).unwrap(), pair.reference());
            [rmse(x, r).unwrap(), rel_mse(x, r).unwrap(), -psnr(x, r).unwrap(), -ssim(x, r).unwrap()]
        })
        .to_vec();
    for (less, more) in scores.iter().zip(&scores[1..]) {
        assert!(less.iter().zip(more).all(|(l, m)| l < m), "{less:?} then {more:?}");
    }
}

#[test]
fn a_single_pixel_has_an_ssim() {
    let (black, white) = ([[0.0; 3]], [[1.0; 3]]);
    let value = ssim(Rgb::new(1, 1, &black).unwrap(), Rgb::new(1, 1, &white).unwrap()).unwrap();
    assert!((0.0..0.1).contains(&value), "{value}");
}

#[test]
fn values_that_are_not_finite_are_counted() {
    let mut pixels = reference(8, 4, 0);
    pixels[8 * 2 + 5] = [0.0, f32::NAN, f32::INFINITY];
    pixels[8 * 3] = [f32::NEG_INFINITY, 0.0, 0.0];
    let error = Rgb::new(8, 4, &pixels).unwrap_err();
    assert_eq!(error, QualityError::NonFinite { plane: "the image", count: 3, x: 5, y: 2 });
    assert!(error.to_string().contains("3 values that are not finite, the first at pixel (5, 2)"));

    let (pair, mut guides) = (Pair::new(8, 4, 0), Guides::new(8, 4));
    guides.motion_px[9] = [0.0, f32::NAN];
    let r = pair.reference();
    let error = temporal_error(r, r, r, r, &guides.borrow()).unwrap_err();
    assert_eq!(error, QualityError::NonFinite { plane: "motion_px", count: 1, x: 1, y: 1 });
}

#[test]
fn sizes_must_fit() {
    let pixels = reference(8, 4, 0);
    assert_eq!(Rgb::new(0, 4, &[]).unwrap_err(), QualityError::Empty { width: 0, height: 4 });
    let needed = QualityError::Length { plane: "the image", width: 8, height: 5, given: 32, needed: 40 };
    assert_eq!(Rgb::new(8, 5, &pixels).unwrap_err(), needed);
    assert!(Rgb::new(u32::MAX, u32::MAX, &pixels).is_err());
    let (wide, tall) = (Rgb::new(8, 4, &pixels).unwrap(), Rgb::new(4, 8, &pixels).unwrap());
    let mismatch = QualityError::ExtentMismatch { left: [8, 4], right: [4, 8] };
    assert_eq!(rmse(wide, tall).unwrap_err(), mismatch);
    assert_eq!(ssim(wide, tall).unwrap_err(), mismatch);
    let guides = Guides::new(7, 4);
    let error = temporal_error(wide, wide, wide, wide, &guides.borrow()).unwrap_err();
    assert!(matches!(error, QualityError::Length { plane: "motion_px", given: 28, .. }));
}

#[test]
fn a_camera_cut_has_no_temporal_error() {
    let (pair, mut guides) = (Pair::new(8, 4, 0), Guides::new(8, 4));
    guides.previous_surface_id.fill(1000);
    let r = pair.reference();
    assert_eq!(temporal_error(r, r, r, r, &guides.borrow()).unwrap_err(), QualityError::NoCommonSurface);
}

/// A picture plus noise that differs from seed to seed, with mean 0.
fn with_noise(pixels: &[[f32; 3]], deviation: f32, seed: u32) -> Vec<[f32; 3]> {
    let mut pixels = pixels.to_vec();
    for (i, value) in pixels.as_flattened_mut().iter_mut().enumerate() {
        *value += deviation * 12.0_f32.sqrt() * (hash(i as u32 ^ seed.wrapping_mul(0x9e37_79b9)) - 0.5);
    }
    pixels
}

#[test]
fn noise_of_references_is_no_error() {
    let (size, sure) = ([192, 128], Guides::new(192, 128));
    let view = |pixels| Rgb::new(size[0], size[1], pixels).unwrap();
    let converged = reference(size[0], size[1], 0).into_iter().map(|pixel| pixel.map(|value| 0.5 + value)).collect::<Vec<_>>();
    let image = with_noise(&converged, 0.03, 1);
    let before = with_noise(&converged, 0.03, 2);
    let halves: Vec<_> = (3..7).map(|seed| with_noise(&converged, 0.06, seed)).collect();
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| view(&halves[i]));
    let (image, before, truth) = (view(&image), view(&before), view(&converged));
    let guides = TemporalGuides { motion_px: &vec![[0.0; 2]; converged.len()], ..sure.borrow() };
    let near = |value: f64, expected: f64| assert!((value - expected).abs() < 0.15 * expected, "{value} instead of {expected}");
    near(unbiased_rmse(image, [a, b]).unwrap(), rmse(image, truth).unwrap());
    near(unbiased_rel_mse(image, [a, b]).unwrap(), rel_mse(image, truth).unwrap());
    let temporal = |references, previous| unbiased_temporal_rmse(image, before, references, previous, &guides).unwrap();
    near(temporal([a, b], [c, d]), temporal([truth; 2], [truth; 2]));
    let [plain, without, wanted] =
        [ssim(image, a), unbiased_ssim(image, [a, b]), ssim(image, truth)].map(|value| 1.0 - value.unwrap());
    assert!((without - wanted).abs() < 0.1 * (plain - wanted), "{without} instead of {wanted}, with noise {plain}");
    // As it is without: half of the error and more is noise of the references.
    assert!(rmse(image, a).unwrap() > 2.0 * rmse(image, truth).unwrap());
    assert!(temporal([a; 2], [c; 2]) > 2.0 * temporal([truth; 2], [truth; 2]));
}

#[test]
fn two_references_that_are_one_give_the_plain_errors() {
    let (pair, other) = (Pair::new(37, 29, 0), Pair::new(36, 29, 0));
    let r = pair.reference();
    close(unbiased_rmse(pair.image(), [r, r]).unwrap(), RMSE);
    close(unbiased_rel_mse(pair.image(), [r, r]).unwrap(), REL_MSE);
    close(unbiased_ssim(pair.image(), [r, r]).unwrap(), SSIM_37);
    let mismatch = QualityError::ExtentMismatch { left: [37, 29], right: [36, 29] };
    assert_eq!(unbiased_ssim(pair.image(), [r, other.reference()]).unwrap_err(), mismatch);
    assert_eq!(unbiased_rmse(pair.image(), [r, other.reference()]).unwrap_err(), mismatch);
    assert_eq!(unbiased_rel_mse(pair.image(), [other.reference(), r]).unwrap_err(), mismatch);
}

#[test]
fn a_picture_nearer_than_the_noise_can_tell_has_no_error() {
    let (converged, size) = (reference(96, 64, 0), [96, 64]);
    let view = |pixels| Rgb::new(size[0], size[1], pixels).unwrap();
    let apart = |sign: f32| converged.iter().map(|pixel| pixel.map(|value| value + sign * 0.1)).collect::<Vec<_>>();
    assert_eq!(unbiased_rmse(view(&converged), [view(&apart(1.0)), view(&apart(-1.0))]).unwrap(), 0.0);
}

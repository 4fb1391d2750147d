//! Peak signal-to-noise ratio.

use super::{tone_map, QualityError, Rgb};

/// Peak signal-to-noise ratio in dB of the images after [`tone_map`]: `-10 log10(mean squared error)`, the peak being 1.
///
/// Radiance has no peak, so the ratio is taken where one exists: on the tone-mapped values in [0, 1].
/// Infinite for images that are identical after the tone map.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn psnr(image: Rgb<'_>, reference: Rgb<'_>) -> Result<f64, QualityError> {
    image.same_extent(reference)?;
    let (left, right) = (image.pixels().as_flattened(), reference.pixels().as_flattened());
    let square = |(&x, &r): (&f32, &f32)| (f64::from(tone_map(x)) - f64::from(tone_map(r))).powi(2);
    let sum: f64 = left.iter().zip(right).map(square).sum();
    Ok(-10.0 * (sum / image.value_count()).log10())
}

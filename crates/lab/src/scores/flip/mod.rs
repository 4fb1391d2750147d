//! FLIP: the difference that a viewer sees who flips between two images.
//!
//! Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images" (LDR-FLIP), and Andersson et al. 2021,
//! "Visualizing Errors in Rendered High Dynamic Range Images" (HDR-FLIP), with all defaults of the published
//! implementation: 67 pixels per degree, the ACES tone curve, exposures chosen from the reference.

mod colour;
mod contrast;
mod convolution;
mod exposure;
mod features;
#[cfg(test)]
mod tests;

use super::{QualityError, Rgb};
use colour::Planes;

/// Pixels of the display in one degree of the visual field: a display 0.7 m and 3840 pixels wide, seen from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// Mean HDR-FLIP over all pixels, in [0, 1]; 0 for identical images. It is the mean of [`flip_map`].
///
/// It depends on which image is the reference: the exposures come from there.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn flip(image: Rgb<'_>, reference: Rgb<'_>) -> Result<f64, QualityError> {
    let map = flip_map(image, reference)?;
    Ok(map.iter().map(|&error| f64::from(error)).sum::<f64>() / map.len() as f64)
}

/// HDR-FLIP of each pixel, in [0, 1], row by row from the top left: the largest LDR-FLIP among tone-mapped exposures.
///
/// The exposures range from the one that makes the brightest pixel of the reference almost white to the one that does
/// so to its median pixel, in steps of one to two stops: a wider range takes longer. Negative radiance counts as 0.
///
/// To choose exposures, luminances below 2^-23 count as 2^-23, so that a reference whose median is black has finite ones.
/// A reference that is black everywhere, which the published implementation refuses, is exposed for a luminance of 2^-23:
/// any visible light in the image is then a large error, and a black image has none.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn flip_map(image: Rgb<'_>, reference: Rgb<'_>) -> Result<Vec<f32>, QualityError> {
    image.same_extent(reference)?;
    let mut largest = vec![0.0_f32; image.pixels().len()];
    for stops in exposure::exposures(reference.pixels()) {
        let display = |pixels: &[[f32; 3]]| exposure::tone_mapped(pixels, stops);
        let errors = ldr_flip(&display(image.pixels()), &display(reference.pixels()), image.width() as usize);
        largest.iter_mut().zip(errors).for_each(|(largest, error)| *largest = largest.max(error));
    }
    Ok(largest)
}

/// LDR-FLIP of each pixel, in [0, 1]. The images are linear RGB in [0, 1]; either may be the reference.
fn ldr_flip(image: &[[f32; 3]], reference: &[[f32; 3]], width: usize) -> Vec<f32> {
    let (image, reference) = (Planes::of(image), Planes::of(reference));
    let colours = contrast::colour_differences(&image, &reference, width);
    let features = features::differences(&image.luminance(), &reference.luminance(), width);
    // Where an edge or a point appears or vanishes, the same difference in colour is seen more. Rounding must not carry the
    // exponent below 0.
    colours.iter().zip(features).map(|(&colour, feature)| colour.powf((1.0 - feature).max(0.0)).min(1.0)).collect()
}

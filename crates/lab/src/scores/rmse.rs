//! Errors of linear radiance.

use super::{QualityError, Rgb};

/// Term added to the squared reference in [`rel_mse`], so that black pixels do not divide by zero.
const REL_MSE_EPSILON: f64 = 1e-2;

/// Root mean square error over all pixels and channels, in the unit of the images. 0 for identical images.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn rmse(image: Rgb<'_>, reference: Rgb<'_>) -> Result<f64, QualityError> {
    image.same_extent(reference)?;
    let sum: f64 = image.value_pairs(reference).map(|(x, r)| (x - r).powi(2)).sum();
    Ok((sum / image.value_count()).sqrt())
}

/// Relative mean square error: the mean of `(x - r)^2 / (r^2 + 0.01)` over all pixels and channels, without unit.
///
/// Unlike [`rmse`] it weighs dark regions as much as bright ones, and it depends on which image is the reference.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn rel_mse(image: Rgb<'_>, reference: Rgb<'_>) -> Result<f64, QualityError> {
    image.same_extent(reference)?;
    let sum: f64 = image.value_pairs(reference).map(|(x, r)| relative((x - r).powi(2), r)).sum();
    Ok(sum / image.value_count())
}

/// A squared error relative to the reference.
pub(super) fn relative(squared: f64, reference: f64) -> f64 {
    squared / (reference * reference + REL_MSE_EPSILON)
}

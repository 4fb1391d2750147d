//! Errors against a reference that has noise of its own, without that noise.
//!
//! The reference is rendered twice, with independent random numbers. Both have the converged picture r as their mean, so the
//! mean of `(x - a) (x - b)` is that of `(x - r)^2`, however few paths they have: their noises are multiplied with each other
//! and cancel, where the square of one would add to the error. What is left of noise makes the sum of a perfect picture as
//! often negative as positive; then these functions return 0.

use super::rmse::relative;
use super::temporal::change;
use super::{QualityError, Rgb, TemporalGuides};

/// [`rmse`](super::rmse) against the picture that two references converge to.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn unbiased_rmse(image: Rgb<'_>, references: [Rgb<'_>; 2]) -> Result<f64, QualityError> {
    Ok(mean_of_products(image, references, |product, _| product)?.max(0.0).sqrt())
}

/// [`rel_mse`](super::rel_mse) against the picture that two references converge to; the mean of both is what the error is
/// relative to.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn unbiased_rel_mse(image: Rgb<'_>, references: [Rgb<'_>; 2]) -> Result<f64, QualityError> {
    Ok(mean_of_products(image, references, relative)?.max(0.0))
}

/// Mean of `of(product of both errors, reference)` over all values.
fn mean_of_products(image: Rgb<'_>, [a, b]: [Rgb<'_>; 2], of: impl Fn(f64, f64) -> f64) -> Result<f64, QualityError> {
    image.same_extent(a)?;
    image.same_extent(b)?;
    let values = image.value_pairs(a).zip(image.value_pairs(b));
    let sum: f64 = values.map(|((x, a), (_, b))| of((x - a) * (x - b), 0.5 * (a + b))).sum();
    Ok(sum / image.value_count())
}

/// Root mean square of the change that [`temporal_error`](super::temporal_error) takes the mean absolute value of, against the
/// sequence that two references converge to: of an absolute value noise cannot be taken away. The tone map bends the noise of
/// the references a little, so that this holds as far as they are nearly converged.
///
/// # Errors
/// As [`temporal_error`](super::temporal_error).
pub fn unbiased_temporal_rmse(
    image: Rgb<'_>,
    previous: Rgb<'_>,
    references: [Rgb<'_>; 2],
    previous_references: [Rgb<'_>; 2],
    guides: &TemporalGuides<'_>,
) -> Result<f64, QualityError> {
    for other in [previous].into_iter().chain(references).chain(previous_references) {
        image.same_extent(other)?;
    }
    let mean = guides.mean(image.extent(), |now, before| {
        let change_in = |image: Rgb<'_>, previous: Rgb<'_>| change(image.pixels()[now], previous.pixels()[before]);
        let image_change = change_in(image, previous);
        let [a, b] = [0, 1].map(|i| change_in(references[i], previous_references[i]));
        (0..3).map(|c| f64::from(image_change[c] - a[c]) * f64::from(image_change[c] - b[c])).sum()
    })?;
    Ok(mean.max(0.0).sqrt())
}

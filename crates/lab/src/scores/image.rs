//! The borrowed image that all metrics take.

use super::QualityError;

/// A borrowed image of finite linear RGB values, row by row from the top left.
#[derive(Debug, Clone, Copy)]
pub struct Rgb<'a> {
    width: u32,
    height: u32,
    pixels: &'a [[f32; 3]],
}

impl<'a> Rgb<'a> {
    /// Borrows `width * height` pixels: linear Rec. 709 radiance, any range, row-major, top row first.
    ///
    /// # Errors
    /// [`QualityError::Empty`] if a side is 0, [`QualityError::Length`] if the slice has another length, and
    /// [`QualityError::NonFinite`] if a value is NaN or infinite.
    pub fn new(width: u32, height: u32, pixels: &'a [[f32; 3]]) -> Result<Self, QualityError> {
        if width == 0 || height == 0 {
            return Err(QualityError::Empty { width, height });
        }
        check_length("the image", [width, height], pixels.len())?;
        check_finite("the image", width, pixels)?;
        Ok(Self { width, height, pixels })
    }

    /// Width in pixels, at least 1.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Height in pixels, at least 1.
    pub fn height(self) -> u32 {
        self.height
    }

    /// The `width * height` pixels, row by row from the top left.
    pub fn pixels(self) -> &'a [[f32; 3]] {
        self.pixels
    }

    pub(super) fn extent(self) -> [u32; 2] {
        [self.width, self.height]
    }

    pub(super) fn same_extent(self, other: Rgb<'_>) -> Result<(), QualityError> {
        if self.extent() == other.extent() {
            return Ok(());
        }
        Err(QualityError::ExtentMismatch { left: self.extent(), right: other.extent() })
    }

    /// Pairs of values, channel by channel, of two images of the same size, in `f64`: squares of any finite `f32` fit.
    pub(super) fn value_pairs(self, other: Rgb<'a>) -> impl Iterator<Item = (f64, f64)> + 'a {
        let (left, right) = (self.pixels.as_flattened(), other.pixels.as_flattened());
        left.iter().zip(right).map(|(&l, &r)| (f64::from(l), f64::from(r)))
    }

    pub(super) fn value_count(self) -> f64 {
        (self.pixels.len() * 3) as f64
    }
}

pub(super) fn check_length(plane: &'static str, extent: [u32; 2], given: usize) -> Result<(), QualityError> {
    let [width, height] = extent;
    let needed = u64::from(width) * u64::from(height);
    if given as u64 == needed {
        return Ok(());
    }
    Err(QualityError::Length { plane, width, height, given, needed })
}

/// `texels` has at least one row of `width`.
pub(super) fn check_finite<const N: usize>(plane: &'static str, width: u32, texels: &[[f32; N]]) -> Result<(), QualityError> {
    let bad = |texel: &[f32; N]| texel.iter().filter(|v| !v.is_finite()).count();
    let Some(first) = texels.iter().position(|t| bad(t) > 0) else {
        return Ok(());
    };
    let count = texels[first..].iter().map(bad).sum();
    let (x, y) = (first % width as usize, first / width as usize);
    Err(QualityError::NonFinite { plane, count, x: x as u32, y: y as u32 })
}

//! A value per pixel, as colours.

use crate::pages::PageError;
use crate::pictures::{Picture, PictureError, NOT_FINITE};
use colorous::{Color, MAGMA};
use std::ops::RangeInclusive;

/// A value per pixel, drawn with a colour map in which equal steps look equal: black for the lowest, then purple and orange, and
/// light yellow for the highest. A colour bar in the page says which values these are.
#[derive(Debug, Clone)]
pub struct HeatMap {
    pub(crate) picture: Picture,
    pub(crate) range: [f32; 2],
}

impl HeatMap {
    /// FLIP that heat maps end at: what is above is a plain fault, and below it differences stay visible.
    pub const LARGEST_FLIP: f32 = 0.5;

    /// A heat map of `width * height` values, row by row from the top left. What is beyond `range` has the colour of its end;
    /// a value that is not finite is magenta, as in pictures.
    ///
    /// # Errors
    /// [`PageError::Range`] if the range is empty or not finite; [`PageError::Picture`] if there is not one value for each pixel.
    pub fn new(width: u32, height: u32, values: &[f32], range: RangeInclusive<f32>) -> Result<Self, PageError> {
        let (low, high) = (*range.start(), *range.end());
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(PageError::Range { low, high });
        }
        let needed = u64::from(width) * u64::from(height);
        if values.len() as u64 != needed {
            return Err(PictureError::Length { width, height, given: values.len(), needed }.into());
        }
        // In f64, where the difference of two f32 never overflows.
        let place = |v: f32| (f64::from(v) - f64::from(low)) / (f64::from(high) - f64::from(low));
        let colour = |v: &f32| if v.is_finite() { rgb(place(*v).clamp(0.0, 1.0)) } else { NOT_FINITE };
        let picture = Picture::from_pixels(width, height, values.iter().map(colour).collect())?;
        Ok(Self { picture, range: [low, high] })
    }

    /// A heat map of FLIP: with the same colours everywhere, from 0 to [`Self::LARGEST_FLIP`].
    ///
    /// # Errors
    /// [`PageError::Picture`] if there is not one value for each pixel.
    pub fn of_flip(width: u32, height: u32, errors: &[f32]) -> Result<Self, PageError> {
        Self::new(width, height, errors, 0.0..=Self::LARGEST_FLIP)
    }

    /// The colours.
    pub fn picture(&self) -> &Picture {
        &self.picture
    }
}

/// The colour bar as a CSS image.
pub fn css_gradient() -> String {
    const STEPS: u32 = 16;
    let colours = (0..=STEPS).map(|i| rgb(f64::from(i) / f64::from(STEPS))).map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"));
    format!("linear-gradient(to right,{})", colours.collect::<Vec<_>>().join(","))
}

fn rgb(place: f64) -> [u8; 3] {
    let Color { r, g, b } = MAGMA.eval_continuous(place);
    [r, g, b]
}

#[cfg(test)]
mod tests {
    use super::{css_gradient, HeatMap};
    use crate::pages::PageError;
    use crate::pictures::NOT_FINITE;

    #[test]
    fn values_become_colours() {
        let map = HeatMap::new(6, 1, &[0.0, 0.25, 0.5, 7.0, -1.0, f32::NAN], 0.0..=0.5).unwrap();
        let pixels = map.picture.pixels();
        let light = |p: [u8; 3]| p.iter().map(|&c| u32::from(c)).sum::<u32>();
        assert!(light(pixels[0]) < 10 && light(pixels[2]) > 600, "{pixels:?}");
        assert!(light(pixels[0]) < light(pixels[1]) && light(pixels[1]) < light(pixels[2]), "{pixels:?}");
        assert_eq!([pixels[3], pixels[4], pixels[5]], [pixels[2], pixels[0], NOT_FINITE]);
        let [r, g, b] = pixels[2];
        assert!(css_gradient().ends_with(&format!(",#{r:02x}{g:02x}{b:02x})")));
    }

    #[test]
    fn a_wrong_range_or_count_is_refused() {
        for range in [0.0..=0.0, 1.0..=0.0, 0.0..=f32::INFINITY, f32::NAN..=1.0] {
            assert!(matches!(HeatMap::new(1, 1, &[0.0], range), Err(PageError::Range { .. })));
        }
        assert!(HeatMap::new(1, 1, &[1.0], f32::MIN..=f32::MAX).is_ok());
        let message = HeatMap::new(4, 3, &[0.0; 11], 0.0..=1.0).unwrap_err().to_string();
        assert!(message.contains("11") && message.contains("4x3") && message.contains("12"), "{message}");
    }
}

//! Radiance, and colours for a display, to 8-bit colours.

use crate::pictures::picture::check_length;
use crate::pictures::{Picture, PictureError};

/// The colour of a pixel with NaN or an infinity in it: magenta, which neither the tone map of a usual scene nor a
/// debug view gives, so that such pixels are seen.
pub const NOT_FINITE: [u8; 3] = [255, 0, 255];

impl Picture {
    /// Tone-maps linear Rec. 709 radiance: times `exposure`, then `x / (1 + x)`, then the sRGB curve.
    ///
    /// Negative values become black; a pixel with a value that is not finite becomes [`NOT_FINITE`].
    ///
    /// # Errors
    /// [`PictureError::Exposure`] if the exposure is no finite number above 0; [`PictureError::Empty`],
    /// [`PictureError::TooLarge`] or [`PictureError::Length`] if the sizes are wrong.
    pub fn from_linear(width: u32, height: u32, radiance: &[[f32; 3]], exposure: f32) -> Result<Self, PictureError> {
        if !(exposure.is_finite() && exposure > 0.0) {
            return Err(PictureError::Exposure(exposure));
        }
        check_length(width, height, radiance.len())?;
        let to_srgb = |rgb: &[f32; 3]| {
            if rgb.iter().all(|v| v.is_finite()) {
                rgb.map(|v| srgb_8bit(tone_map(v * exposure)))
            } else {
                NOT_FINITE
            }
        };
        Self::from_pixels(width, height, radiance.iter().map(to_srgb).collect())
    }

    /// Colours that are linear and ready for a display, 0 to 1, such as those of debug views: the sRGB curve and nothing else.
    ///
    /// What is beyond is clamped; a pixel with a value that is not finite becomes [`NOT_FINITE`].
    ///
    /// # Errors
    /// [`PictureError::Empty`], [`PictureError::TooLarge`] or [`PictureError::Length`] if the sizes are wrong.
    pub fn from_display(width: u32, height: u32, colours: &[[f32; 3]]) -> Result<Self, PictureError> {
        check_length(width, height, colours.len())?;
        let encode = |rgb: &[f32; 3]| match rgb.iter().all(|v| v.is_finite()) {
            true => rgb.map(srgb_8bit),
            false => NOT_FINITE,
        };
        Self::from_pixels(width, height, colours.iter().map(encode).collect())
    }
}

/// `x / (1 + x)`, written so that a value which overflowed under the exposure gives 1 and not NaN.
fn tone_map(x: f32) -> f32 {
    1.0 - 1.0 / (1.0 + x.max(0.0))
}

/// A linear value, 0 to 1, as it is encoded; what is beyond has the end's.
pub fn srgb_8bit(x: f32) -> u8 {
    let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

/// The linear value of an encoded one.
pub fn from_srgb_8bit(code: u8) -> f32 {
    let x = f32::from(code) / 255.0;
    if x <= 0.040_45 {
        x / 12.92
    } else {
        ((x + 0.055) / 1.055).powf(2.4)
    }
}

//! What a denoiser can show of a frame besides pictures: one number for each pixel, and how to paint it.

use atrous_picture::{Picture, PictureError};

/// One number for each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Frames accumulated.
    HistoryLength,
    /// Standard deviation of luminance after the first level of the filter.
    Deviation,
    /// Reconstructed temporal gradient over the larger of the two luminances, −1 (light went out) to 1 (light came on).
    Gradient,
    /// λ: how much of the history the change of light costs, 0 to 1; the largest of 3×3 pixels.
    Lambda,
    /// Weight of the new frame in the accumulation.
    Alpha,
}

impl View {
    /// In the order of a strip.
    pub const ALL: [Self; 5] = [Self::HistoryLength, Self::Deviation, Self::Gradient, Self::Lambda, Self::Alpha];

    /// What to write above it.
    pub fn label(self) -> &'static str {
        match self {
            Self::HistoryLength => "history length, frames",
            Self::Deviation => "variance, as standard deviation",
            Self::Gradient => "gradient, relative",
            Self::Lambda => "lambda, change of light",
            Self::Alpha => "alpha, weight of the new frame",
        }
    }

    /// From the darkest to the brightest colour. The deviation has no scale of its own: 99 % of its values are within.
    pub fn range(self, values: &[f32]) -> [f32; 2] {
        match self {
            Self::HistoryLength => [0.0, 32.0],
            Self::Deviation => [0.0, high(values)],
            Self::Gradient => [-1.0, 1.0],
            Self::Lambda | Self::Alpha => [0.0, 1.0],
        }
    }

    /// In false colours, with its label and range.
    ///
    /// # Errors
    /// Another number of values than pixels.
    pub fn paint(self, [width, height]: [u32; 2], values: &[f32]) -> Result<(String, Picture), PictureError> {
        let range = self.range(values);
        let decimals = if self == Self::Deviation { 3 } else { 0 };
        let label = format!("{}\n{:.decimals$} to {:.decimals$}", self.label(), range[0], range[1]);
        Ok((label, Picture::false_colour(width, height, values, range)?))
    }
}

/// The value below which 99 % of the values lie.
fn high(values: &[f32]) -> f32 {
    let mut sorted: Vec<f32> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1.0).max(1e-3)
}

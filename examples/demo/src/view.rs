//! What a denoiser can show of a frame besides pictures: one number for each pixel, and how to paint it.

use atrous_picture::{Picture, PictureError};

use crate::{FrameDenoiser, Result};

/// Where the last of the five passes of `gradient_atrous` leaves the reconstructed gradient.
pub(crate) const GRADIENT: &str = "gradient_pong";

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
    pub fn paint(self, [width, height]: [u32; 2], values: &[f32]) -> std::result::Result<(String, Picture), PictureError> {
        let range = self.range(values);
        let decimals = if self == Self::Deviation { 3 } else { 0 };
        let label = format!("{}\n{:.decimals$} to {:.decimals$}", self.label(), range[0], range[1]);
        Ok((label, Picture::false_colour(width, height, values, range)?))
    }
}

impl FrameDenoiser {
    /// What [`Self::view`] can show: the preset says.
    pub fn views(&self) -> impl Iterator<Item = View> + '_ {
        View::ALL.into_iter().filter(|view| {
            let needed: &[&str] = match view {
                View::HistoryLength => &[self.name_of("moments")],
                View::Deviation => &[self.name_of("moments"), self.name_of("irradiance_history")],
                View::Gradient => &[GRADIENT],
                View::Lambda => &["history_confidence"],
                View::Alpha => &["history_confidence", self.name_of("moments")],
            };
            needed.iter().all(|name| self.has(name))
        })
    }

    /// One number for each pixel of the last frame; nothing before the first.
    ///
    /// # Errors
    /// A view that is not among [`Self::views`], or no memory.
    pub fn view(&mut self, view: View) -> Result<Vec<f32>> {
        match view {
            View::HistoryLength => self.history_length(),
            View::Deviation => Ok(self.read(self.name_of("irradiance_history"))?.iter().map(|t| t[3]).collect()),
            View::Gradient => self.gradient(),
            View::Lambda => self.lambda(),
            View::Alpha => self.alpha(),
        }
    }

    fn history_length(&mut self) -> Result<Vec<f32>> {
        let moments = self.read(self.name_of("moments"))?;
        Ok(moments.iter().map(|m| half::f16::from_bits(m[2] as u16).to_f32()).collect())
    }

    fn lambda(&mut self) -> Result<Vec<f32>> {
        Ok(self.read("history_confidence")?.iter().map(|c| 1.0 - c[0]).collect())
    }

    /// As the stage `temporal_accumulation` has it.
    fn alpha(&mut self) -> Result<Vec<f32>> {
        let least = self.tuning().alpha;
        let (lambda, length) = (self.lambda()?, self.history_length()?);
        Ok(lambda.iter().zip(length).map(|(l, n)| (least + l * (1.0 - least)).max(1.0 / n)).collect())
    }

    /// Every pixel gets the gradient of its stratum.
    fn gradient(&mut self) -> Result<Vec<f32>> {
        let strata = self.read(GRADIENT)?;
        let [width, height] = self.executor().denoiser().declaration().allocated_extent();
        let size = self.executor().denoiser().config().stratum_size;
        let across = width.div_ceil(size);
        let at = |i: u32| strata.get((i / width / size * across + i % width / size) as usize);
        let relative = |&[change, brightest, ..]: &[f32; 4]| if brightest > 0.0 { change / brightest } else { 0.0 };
        Ok((0..width * height).map_while(at).map(relative).collect())
    }

    fn has(&self, name: &str) -> bool {
        self.executor().denoiser().declaration().find(name).is_some()
    }

    /// The image of a signal, or that of its direct light where there are two.
    fn name_of(&self, image: &'static str) -> &'static str {
        match (self.has(image), image) {
            (false, "moments") => "moments_direct",
            (false, "irradiance_history") => "irradiance_history_direct",
            _ => image,
        }
    }
}

/// The value below which 99 % of the values lie.
fn high(values: &[f32]) -> f32 {
    let mut sorted: Vec<f32> = values.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f32::total_cmp);
    sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1.0).max(1e-3)
}

//! Scores frames against the converged image.

use crate::display_transform::DisplayTransform;
use crate::error::{Result, ToolError};
use crate::frame::FrameInputs;
use crate::motion::{self, SurfaceMotion};
use atrous::config::Conventions;
use atrous::FrameParams;
use atrous_files::Existing;
use atrous_lab::pictures::{Column, PictureError, TextTable};
use atrous_lab::scores::{flip, psnr, rel_mse, rmse, ssim, temporal_error, QualityError, Rgb, TemporalGuides};
use serde::Serialize;
use std::path::Path;

/// Metrics of one frame. `None`: not defined for it, as the temporal error is not for the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Metrics {
    /// Root of the mean squared error, linear radiance.
    pub rmse: f64,
    /// Mean squared error relative to the squared reference.
    pub rel_mse: f64,
    /// Peak signal-to-noise ratio of the tone-mapped images, dB; `None` where they are equal.
    pub psnr: Option<f64>,
    /// Structural similarity of the tone-mapped images.
    pub ssim: f64,
    /// Difference that an eye sees, HDR-FLIP.
    pub flip: f64,
    /// Motion-compensated temporal error.
    pub temporal_error: Option<f64>,
}

impl Metrics {
    /// Headings and decimals.
    pub const COLUMNS: [(&'static str, usize); 6] =
        [("RMSE", 4), ("relMSE", 4), ("PSNR", 2), ("SSIM", 4), ("FLIP", 4), ("temporal", 5)];

    /// The values in the order of [`Self::COLUMNS`]; NaN for what is not defined.
    pub fn values(&self) -> [f64; 6] {
        let or_nan = |v: Option<f64>| v.unwrap_or(f64::NAN);
        [self.rmse, self.rel_mse, or_nan(self.psnr), self.ssim, self.flip, or_nan(self.temporal_error)]
    }

    /// The mean of what is defined.
    pub fn mean(all: &[Self]) -> Self {
        let mean = |of: &dyn Fn(&Self) -> Option<f64>| {
            let values: Vec<f64> = all.iter().filter_map(of).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        Self {
            rmse: mean(&|m| Some(m.rmse)).unwrap_or_default(),
            rel_mse: mean(&|m| Some(m.rel_mse)).unwrap_or_default(),
            psnr: mean(&|m| m.psnr),
            ssim: mean(&|m| Some(m.ssim)).unwrap_or_default(),
            flip: mean(&|m| Some(m.flip)).unwrap_or_default(),
            temporal_error: mean(&|m| m.temporal_error),
        }
    }
}

/// Scores of a frame.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FrameScore {
    /// Number of the frame.
    pub frame: u64,
    /// Metrics of the result.
    pub denoised: Metrics,
    /// Metrics of the input, for comparison.
    pub noisy: Metrics,
}

/// Images of a frame that the temporal error of the next one needs.
struct Previous {
    number: u64,
    params: FrameParams,
    image: Vec<[f32; 3]>,
    noisy: Vec<[f32; 3]>,
    reference: Vec<[f32; 3]>,
    surface: SurfaceMotion,
}

/// Collects scores in the order of frames.
pub struct ScoreBook {
    conventions: Conventions,
    shown: DisplayTransform,
    step: u64,
    previous: Option<Previous>,
    /// Scores so far.
    pub frames: Vec<FrameScore>,
    /// Frames without a reference.
    pub without_reference: usize,
}

impl ScoreBook {
    /// An empty one. Frames are `step` apart; what an eye sees is measured as it is shown.
    pub fn new(conventions: Conventions, shown: DisplayTransform, step: u64) -> Self {
        Self { conventions, shown, step, previous: None, frames: Vec::new(), without_reference: 0 }
    }

    /// Scores the next frame. `None`: it has no reference.
    pub fn add(&mut self, frame: &FrameInputs, image: &[[f32; 3]]) -> Result<Option<FrameScore>> {
        let Some(reference) = &frame.reference else {
            self.without_reference += 1;
            self.previous = None;
            return Ok(None);
        };
        let previous = self.previous.take().filter(|p| p.number + self.step == frame.number);
        let before = previous.as_ref().map_or(frame.params, |p| p.params);
        let surface = motion::of_frame(frame, &before, &self.conventions);
        let metrics = |image: &[[f32; 3]], of: fn(&Previous) -> &Vec<[f32; 3]>| {
            let pair = previous.as_ref().map(|p| (p, of(p).as_slice()));
            measure(frame.params.render_extent, image, reference, pair, &surface, self.shown)
        };
        let problem = |e: QualityError| ToolError::Usage(format!("frame {} cannot be scored: {e}", frame.number));
        let denoised = metrics(image, |p| &p.image).map_err(problem)?;
        let noisy = metrics(&frame.noisy, |p| &p.noisy).map_err(problem)?;
        let score = FrameScore { frame: frame.number, denoised, noisy };
        self.frames.push(score);
        self.previous = Some(Previous {
            number: frame.number,
            params: frame.params,
            image: image.to_vec(),
            noisy: frame.noisy.clone(),
            reference: reference.clone(),
            surface,
        });
        Ok(Some(score))
    }

    /// Means of result and input.
    pub fn means(&self) -> (Metrics, Metrics) {
        let of = |pick: fn(&FrameScore) -> Metrics| Metrics::mean(&self.frames.iter().map(pick).collect::<Vec<_>>());
        (of(|f| f.denoised), of(|f| f.noisy))
    }

    /// A row per frame, and the means.
    pub fn table(&self) -> std::result::Result<TextTable, PictureError> {
        let mut table = TextTable::new("frame", Metrics::COLUMNS.map(|(name, decimals)| Column::new(name, decimals)));
        for score in &self.frames {
            table.row(score.frame.to_string(), &score.denoised.values())?;
        }
        let (denoised, noisy) = self.means();
        table.row("mean", &denoised.values())?;
        table.row("noisy, mean", &noisy.values())?;
        Ok(table)
    }

    /// All scores as JSON.
    pub fn json(&self, preset: &str, device: &str) -> serde_json::Value {
        let (mean, noisy_mean) = self.means();
        serde_json::json!({
            "preset": preset,
            "device": device,
            "mean": mean,
            "noisy_mean": noisy_mean,
            "frames": self.frames,
        })
    }
}

fn rgb(pixels: &[[f32; 3]], [width, height]: [u32; 2]) -> std::result::Result<Rgb<'_>, QualityError> {
    Rgb::new(width, height, pixels)
}

fn measure(
    extent: [u32; 2],
    image: &[[f32; 3]],
    reference: &[[f32; 3]],
    previous: Option<(&Previous, &[[f32; 3]])>,
    surface: &SurfaceMotion,
    shown: DisplayTransform,
) -> std::result::Result<Metrics, QualityError> {
    let (linear, truth) = (rgb(image, extent)?, rgb(reference, extent)?);
    let (image, reference) = (shown.apply(image), shown.apply(reference));
    let (now, reference) = (rgb(&image, extent)?, rgb(&reference, extent)?);
    let mut metrics = Metrics {
        rmse: rmse(linear, truth)?,
        rel_mse: rel_mse(linear, truth)?,
        psnr: Some(psnr(now, reference)?).filter(|p| p.is_finite()),
        ssim: ssim(now, reference)?,
        flip: flip(now, reference)?,
        temporal_error: None,
    };
    if let Some((previous, image)) = previous {
        let guides = TemporalGuides {
            motion_px: &surface.motion_px,
            expected_previous_depth: &surface.previous_depth,
            previous_depth: &previous.surface.depth,
            surface_id: &surface.id,
            previous_surface_id: &previous.surface.id,
        };
        let (before, truth_before) = (shown.apply(image), shown.apply(&previous.reference));
        metrics.temporal_error = match temporal_error(now, rgb(&before, extent)?, reference, rgb(&truth_before, extent)?, &guides) {
            Ok(error) => Some(error),
            Err(QualityError::NoCommonSurface) => None,
            Err(other) => return Err(other),
        };
    }
    Ok(metrics)
}

/// Writes `scores.json`.
pub fn write_json(path: &Path, existing: Existing, value: &serde_json::Value) -> Result<()> {
    let text =
        serde_json::to_string_pretty(value).map_err(|e| ToolError::Encode { path: path.to_owned(), problem: e.to_string() })?;
    crate::exr_write::publish(path, existing, text.as_bytes())
}

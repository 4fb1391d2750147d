//! Shadows that move: how wrong a visibility is around them, and how far it lags behind.

use std::sync::Arc;

use ash::vk::Extent2D;
use atrous::config::Preset;
use atrous_engine::{DenoiserOptions, FrameDenoiser, Gpu, PathTracer, Scene, SceneOptions, TracerOptions};

use crate::Result;

/// Pixels around a shadow that moved which count.
const BAND: i32 = 8;
/// Change of visibility over [`LAGS`] frames from which on a shadow moved.
const CHANGED: f32 = 0.1;
/// Frames back that a picture is compared with.
const LAGS: usize = 4;

/// What is measured.
#[derive(Clone, Copy, Debug)]
pub struct MovingShadows<'a> {
    /// Scene with a sun.
    pub scene: &'a str,
    /// Pixels.
    pub extent: Extent2D,
    /// Frames of the animation; the last is measured.
    pub frames: u32,
    /// Shadow rays a pixel of a reference.
    pub reference_rays: u32,
    /// The camera stands still.
    pub static_camera: bool,
}

/// Of the last frame, around shadows that moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowErrors {
    /// Root mean square error of the visibility.
    pub rmse: f64,
    /// Frames by which the visibility lags: where its correlation with the references of earlier frames is best.
    pub lag: f64,
}

impl MovingShadows<'_> {
    /// The errors of a filter that knows neither ids nor places, and of one that knows both.
    ///
    /// # Errors
    /// An unknown scene, or a lost device.
    pub fn measure(&self, gpu: &Gpu) -> Result<[ShadowErrors; 2]> {
        let options = SceneOptions { static_camera: self.static_camera, ..SceneOptions::default() };
        let scene = Arc::new(Scene::load(self.scene, &options)?);
        let mut tracer =
            PathTracer::new(gpu, &scene, self.extent, TracerOptions { lamps_apart: true, ..TracerOptions::default() })?;
        // The passes of a visibility are the same beside every preset.
        let filter = |knows: bool| {
            let options = DenoiserOptions { occluder_ids: knows, light_places: knows, ..DenoiserOptions::new(Preset::Eaw) };
            FrameDenoiser::new(gpu, &tracer, &options)
        };
        let mut filters = [filter(false)?, filter(true)?];
        let mut references = Vec::new();
        for frame in 0..self.frames {
            tracer.begin_frame(frame)?;
            gpu.submit(|cmd| {
                tracer.record_gbuffer(cmd);
                filters.iter_mut().try_for_each(|filter| filter.record(cmd, &mut tracer))
            })?;
            if frame + LAGS as u32 >= self.frames {
                let seen = tracer.lamp_reference(0, self.reference_rays)?;
                references.extend(seen.map(|seen| seen.iter().map(|v| v[0]).collect::<Vec<_>>()));
            }
        }
        references.reverse();
        let band = self.band(&references);
        let [first, second] = &mut filters;
        Ok([errors(&band, &visibility(first)?, &references), errors(&band, &visibility(second)?, &references)])
    }

    /// Pixels around those whose visibility changed.
    fn band(&self, references: &[Vec<f32>]) -> Vec<usize> {
        let (now, before) = (&references[0], &references[references.len() - 1]);
        let (w, h) = (self.extent.width as i32, self.extent.height as i32);
        let changed: Vec<bool> = now.iter().zip(before).map(|(a, b)| (a - b).abs() > CHANGED).collect();
        let is_near = |x: i32, y: i32| {
            let rows = (y - BAND).max(0)..=(y + BAND).min(h - 1);
            rows.into_iter().any(|v| ((x - BAND).max(0)..=(x + BAND).min(w - 1)).any(|u| changed[(v * w + u) as usize]))
        };
        (0..w * h).filter(|i| is_near(i % w, i / w)).map(|i| i as usize).collect()
    }
}

fn visibility(filter: &mut FrameDenoiser) -> Result<Vec<f32>> {
    Ok(filter.read("denoised_visibility")?.iter().map(|v| v[0]).collect())
}

/// `references`: of this frame, of the one before, and so on.
fn errors(band: &[usize], visibility: &[f32], references: &[Vec<f32>]) -> ShadowErrors {
    let square = |p: &usize| f64::from(visibility[*p] - references[0][*p]).powi(2);
    let rmse = (band.iter().map(square).sum::<f64>() / band.len().max(1) as f64).sqrt();
    let correlations: Vec<f64> = references.iter().map(|reference| correlation(band, visibility, reference)).collect();
    ShadowErrors { rmse, lag: peak(&correlations) }
}

fn correlation(band: &[usize], a: &[f32], b: &[f32]) -> f64 {
    let mean = |of: &[f32]| band.iter().map(|p| f64::from(of[*p])).sum::<f64>() / band.len().max(1) as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        band.iter().map(|p| of(f64::from(a[*p]) - mean_a, f64::from(b[*p]) - mean_b)).sum()
    };
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt().max(f64::MIN_POSITIVE)
}

/// The place of the largest value, by the parabola through its neighbours.
fn peak(values: &[f64]) -> f64 {
    let best = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    if best == 0 || best + 1 >= values.len() {
        return best as f64;
    }
    let [before, at, after] = [values[best - 1], values[best], values[best + 1]];
    best as f64 + 0.5 * (before - after) / (before - 2.0 * at + after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_frames_ago_lags_by_them() {
        let edge = |at: f32| (0..400).map(|i| ((i % 20) as f32 - at).clamp(0.0, 1.0)).collect::<Vec<f32>>();
        let references: Vec<_> = (0..=LAGS).map(|lag| edge(12.0 - 2.0 * lag as f32)).collect();
        let band: Vec<usize> = (0..400).collect();
        let now = errors(&band, &references[0], &references);
        assert_eq!((now.rmse, now.lag), (0.0, 0.0));
        let late = errors(&band, &edge(8.0), &references);
        assert!(late.rmse > 0.1 && (late.lag - 2.0).abs() < 0.1, "{late:?}");
    }
}

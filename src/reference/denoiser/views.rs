//! What is between the stages of a frame, and how the stage `debug_view` shows it.

use super::adaptation::Outliers;
use super::volume::FilteredVolume;
use super::*;
use crate::DebugView;

/// The images between the stages, one for every signal where they are in a `Vec`. Empty or `None` where the preset has no such stage.
/// Without surfaces, moments, percentiles and `irradiance_history` are those of the volume.
#[derive(Clone, Debug, PartialEq)]
pub struct DenoiserViews {
    /// See [`unpack_guide`].
    pub guide: Image<[u16; 4]>,
    /// See [`unpack_surface_motion`].
    pub surface_motion: Image<[u16; 4]>,
    /// See [`unpack_depth_gradient`].
    pub depth_gradient: Image<u32>,
    /// rgb: irradiance before any filter, outliers scaled down where the preset does so.
    pub demodulated: Vec<Image<[f32; 4]>>,
    /// See [`unpack_percentiles`], one texel a block: of the irradiance before outliers are scaled down.
    pub block_percentiles: Vec<Image<u32>>,
    /// The reconstructed gradient, one texel a stratum. x: δ, y: Δ.
    pub gradient: Option<Image<[f32; 4]>>,
    /// 1: keep the history, 0: drop it.
    pub history_confidence: Option<Image<f32>>,
    /// rgb: irradiance after temporal accumulation.
    pub accumulated: Vec<Image<[f32; 4]>>,
    /// See [`unpack_moments`].
    pub moments: Vec<Image<[u16; 4]>>,
    /// Standard deviation of luminance after the stage `variance`.
    pub standard_deviation: Vec<Image<f32>>,
    /// What the next frame accumulates onto, where it comes out of a filter. rgb: irradiance, alpha: standard deviation of luminance.
    pub irradiance_history: Vec<Image<[f32; 4]>>,
    /// `levels[level][signal]`: rgb irradiance, alpha standard deviation of luminance.
    pub levels: Vec<Vec<Image<[f32; 4]>>>,
}

pub(super) fn views(
    imported: &ImportOutputs,
    outliers: &Outliers,
    history_confidence: Option<Image<f32>>,
    gradient: Option<Image<[f32; 4]>>,
    filtered: &Filtered,
    volume: Option<&FilteredVolume>,
) -> DenoiserViews {
    let views = DenoiserViews {
        guide: imported.guide.clone(),
        surface_motion: imported.surface_motion.clone(),
        depth_gradient: imported.depth_gradient.clone(),
        demodulated: outliers.irradiance.clone(),
        block_percentiles: outliers.block_percentiles.clone(),
        gradient,
        history_confidence,
        accumulated: filtered.accumulated.clone(),
        moments: filtered.moments.clone(),
        standard_deviation: filtered.with_deviation.iter().map(|image| image.map(|t| t[3])).collect(),
        irradiance_history: if filtered.with_deviation.is_empty() { Vec::new() } else { filtered.history().to_vec() },
        levels: filtered.levels.clone(),
    };
    match volume {
        Some(volume) if filtered.result().is_empty() => DenoiserViews {
            block_percentiles: volume.block_percentiles.iter().cloned().collect(),
            moments: vec![volume.history.moments.clone()],
            irradiance_history: vec![volume.history.radiance.clone()],
            ..views
        },
        _ => views,
    }
}

impl Denoiser {
    /// The pass `debug_view` of a frame with this context, these inputs and outputs; `None` where [`Self::frame`] was not asked for views.
    pub fn debug_view(
        &self,
        frame: &FrameContext,
        inputs: &DenoiserInputs,
        outputs: &DenoiserOutputs,
        view: DebugView,
    ) -> Option<Image<[f32; 4]>> {
        let views = outputs.views.as_ref()?;
        let other = match self.config.preset {
            Preset::Stabilize => inputs.gradients.other_denoised_radiance,
            Preset::Volume => inputs.volume.map(|volume| volume.noisy_volume),
            _ => None,
        };
        let inputs = DebugViewInputs {
            guide: &views.guide,
            surface_motion: &views.surface_motion,
            statistics: &outputs.statistics,
            moments: &each(&views.moments),
            irradiance_history: &each(&views.irradiance_history),
            history_confidence: views.history_confidence.as_ref(),
            gradient: views.gradient.as_ref(),
            stratum_size: self.config.stratum_size,
            block_percentiles: &each(&views.block_percentiles),
            noisy: other.as_ref().map_or(inputs.noisy, std::slice::from_ref),
            // No albedo divides the light of a volume.
            albedo: inputs.albedo.filter(|_| self.config.preset != Preset::Volume),
        };
        Some(debug_view(&frame.constants, &tuning_of(&frame.constants), &inputs, view))
    }
}

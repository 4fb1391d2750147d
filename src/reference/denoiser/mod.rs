//! A preset over a sequence of frames: the stages chained as the passes are, with the history between them.

use super::*;
use crate::config::{PostProcess, Preset, Signals};
use crate::{Config, Error, FrameConstants, FrameContext, ToneCurve, Tuning};

mod adaptation;
mod check;
mod frame_data;
#[cfg(test)]
mod sequence_tests;
#[cfg(test)]
mod tests;
mod views;
mod volume;
#[cfg(test)]
mod volume_tests;

pub use frame_data::{DenoiserInputs, DenoiserOutputs, GradientSources};
pub use views::DenoiserViews;
use volume::VolumeHistory;
pub use volume::VolumeInputs;

/// What the next frame needs of this one.
#[derive(Clone, Debug)]
struct History {
    guide: Image<[u16; 4]>,
    object_normal_guide: Option<Image<u32>>,
    irradiance: Vec<Image<[f32; 4]>>,
    moments: Vec<Image<[u16; 4]>>,
    noisy_luminance: Option<Image<u32>>,
    gradient_candidates: Option<Image<[u16; 4]>>,
    volume: Option<VolumeHistory>,
    display: Option<Image<[f32; 4]>>,
}

/// A preset on the CPU.
#[derive(Clone, Debug)]
pub struct Denoiser {
    config: Config,
    history: Option<History>,
}

/// Irradiance on its way through a frame.
#[derive(Default)]
struct Filtered {
    accumulated: Vec<Image<[f32; 4]>>,
    moments: Vec<Image<[u16; 4]>>,
    with_deviation: Vec<Image<[f32; 4]>>,
    levels: Vec<Vec<Image<[f32; 4]>>>,
}

impl Filtered {
    /// What the next frame accumulates onto: the first level, as \[SVGF\] 4.1 has it.
    fn history(&self) -> &[Image<[f32; 4]>] {
        [self.levels.first(), Some(&self.with_deviation), Some(&self.accumulated)]
            .into_iter()
            .flatten()
            .find(|i| !i.is_empty())
            .map_or(&[], Vec::as_slice)
    }

    fn result(&self) -> &[Image<[f32; 4]>] {
        self.levels.last().map_or(self.history(), Vec::as_slice)
    }
}

impl Denoiser {
    /// A denoiser without history.
    ///
    /// # Errors
    /// As [`Config::validate`].
    pub fn new(config: Config) -> Result<Self, Error> {
        config.validate()?;
        Ok(Self { config, history: None })
    }

    /// Denoises one frame; `frame` comes from [`crate::FrameState::begin`] with the same configuration, in order.
    ///
    /// # Errors
    /// [`Error::Size`] for an image that has not the allocated extent, or a wrong number of signals; [`Error::RenderExtent`] for a frame of
    /// another configuration; [`Error::NotBound`] for an image that the configuration asks for. The history is unchanged then.
    pub fn frame(&mut self, frame: &FrameContext, inputs: &DenoiserInputs, with_views: bool) -> Result<DenoiserOutputs, Error> {
        check::check(&self.config, frame, inputs)?;
        let constants = &frame.constants;
        let tuning = &tuning_of(constants);
        let guides = if matches!(self.config.preset, Preset::Eaw | Preset::Volume) {
            // Object-space normals serve the history alone.
            ImportInputs { object_normal: None, ..inputs.guides }
        } else {
            inputs.guides
        };
        let imported = import(constants, &guides);
        let gradients = self.gradients(constants, tuning, &imported, inputs);
        let stabilized = inputs.gradients.other_denoised_radiance.filter(|_| self.config.preset == Preset::Stabilize);
        let noisy = stabilized.as_ref().map_or(inputs.noisy, std::slice::from_ref);
        let demodulated = demodulate(constants, &self.demodulation(&imported, noisy, inputs.albedo));
        let outliers = self.outliers(constants, tuning, &imported, demodulated.irradiance);
        let confidence = gradients.confidence.or_else(|| self.confidence(constants, tuning, &imported, &outliers));
        let filtered = self.filter(constants, tuning, &imported, &outliers.irradiance, confidence.as_ref());
        let irradiance = each(filtered.result());
        let modulated = modulate(
            constants,
            &ModulateInputs { guide: &imported.guide, irradiance: &irradiance, albedo: inputs.albedo, emission: inputs.emission },
        );
        let volume = self.volume(constants, tuning, &imported, inputs);
        let surfaces = Some(&modulated.denoised_radiance).filter(|_| self.config.preset != Preset::Volume);
        let radiances: Vec<_> = surfaces.into_iter().chain(volume.as_ref().map(|volume| &volume.denoised)).collect();
        let display = self.post_process(constants, tuning, &imported, &radiances);
        let of_volume = volume.as_ref().map_or(Statistics::default(), |volume| volume.statistics);
        let stages = [imported.statistics, gradients.statistics, demodulated.statistics, modulated.statistics, of_volume];
        let views =
            with_views.then(|| views::views(&imported, &outliers, confidence, gradients.gradient, &filtered, volume.as_ref()));
        let (denoised_volume, volume) = volume.map(|volume| (volume.denoised, volume.history)).unzip();
        self.history = Some(History {
            irradiance: filtered.history().to_vec(),
            guide: imported.guide,
            object_normal_guide: imported.object_normal_guide,
            moments: filtered.moments,
            noisy_luminance: gradients.noisy_luminance,
            gradient_candidates: gradients.candidates,
            volume,
            display: display.clone(),
        });
        Ok(DenoiserOutputs {
            denoised_radiance: modulated.denoised_radiance,
            denoised_volume,
            display,
            statistics: std::array::from_fn(|i| stages.iter().map(|s| s[i]).sum()),
            views,
        })
    }

    fn demodulation<'a>(
        &self,
        imported: &'a ImportOutputs,
        noisy: &'a [&'a Image<[f32; 4]>],
        albedo: Option<&'a Image<[f32; 4]>>,
    ) -> DemodulateInputs<'a> {
        let has_holes = self.config.preset == Preset::Eaw && self.config.sampling as u32 != 0;
        DemodulateInputs { guide: &imported.guide, noisy, albedo, has_holes }
    }

    fn filter(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        irradiance: &[Image<[f32; 4]>],
        confidence: Option<&Image<f32>>,
    ) -> Filtered {
        if self.config.preset == Preset::Volume {
            return Filtered::default();
        }
        if self.config.preset == Preset::Eaw {
            let (weights, painting_levels) = (self.config.eaw_weights, self.config.sampling as u32);
            let level = |level, irradiance: &[&_]| {
                eaw(frame, tuning, level, &EawInputs { guide: &imported.guide, irradiance, weights, painting_levels })
            };
            return Filtered { levels: self.levels(irradiance, level), ..Filtered::default() };
        }
        let accumulated = self.accumulate(frame, tuning, imported, irradiance, confidence);
        if self.config.preset == Preset::Stabilize {
            return Filtered { accumulated: accumulated.irradiance, moments: accumulated.moments, ..Filtered::default() };
        }
        let (guide, depth_gradient) = (&imported.guide, &imported.depth_gradient);
        let estimate = if self.config.preset == Preset::Percentile { fading_variance } else { variance };
        let (irradiance, moments) = (each(&accumulated.irradiance), each(&accumulated.moments));
        let inputs = VarianceInputs { guide, depth_gradient, irradiance: &irradiance, moments: &moments };
        let with_deviation = estimate(frame, tuning, &inputs);
        let kernel = if self.config.preset == Preset::Svgf { atrous } else { box_atrous };
        let level = |level, irradiance: &[&_]| kernel(frame, tuning, level, &AtrousInputs { guide, depth_gradient, irradiance });
        let levels = self.levels(&with_deviation, level);
        Filtered { accumulated: accumulated.irradiance, moments: accumulated.moments, with_deviation, levels }
    }

    fn levels(
        &self,
        input: &[Image<[f32; 4]>],
        filter: impl Fn(u32, &[&Image<[f32; 4]>]) -> Vec<Image<[f32; 4]>>,
    ) -> Vec<Vec<Image<[f32; 4]>>> {
        let mut levels: Vec<Vec<_>> = Vec::with_capacity(self.config.levels as usize);
        for level in 0..self.config.levels {
            let filtered = filter(level, &each(levels.last().map_or(input, Vec::as_slice)));
            levels.push(filtered);
        }
        levels
    }

    fn accumulate(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        irradiance: &[Image<[f32; 4]>],
        history_confidence: Option<&Image<f32>>,
    ) -> TemporalAccumulationOutputs {
        let signals: Vec<_> = self.history.iter().flat_map(|history| history.irradiance.iter().zip(&history.moments)).collect();
        let signals: Vec<_> = signals.into_iter().map(|(irradiance, moments)| SignalHistory { irradiance, moments }).collect();
        let inputs = TemporalAccumulationInputs {
            guide: &imported.guide,
            surface_motion: &imported.surface_motion,
            depth_gradient: &imported.depth_gradient,
            irradiance: &each(irradiance),
            history_confidence,
            repair: self.config.preset == Preset::Percentile,
            object_normals: imported
                .object_normal_guide
                .as_ref()
                .zip(self.history.as_ref().and_then(|history| history.object_normal_guide.as_ref()))
                .map(|(current, previous)| ObjectNormals { current, previous }),
            previous: self.history.as_ref().map(|history| PreviousFrame { guide: &history.guide, signals: &signals }),
        };
        temporal_accumulation(frame, tuning, &inputs)
    }

    fn post_process(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        radiances: &[&Image<[f32; 4]>],
    ) -> Option<Image<[f32; 4]>> {
        if self.config.post_process == PostProcess::None {
            return None;
        }
        let tone_mapped = tone_map(frame, tuning, radiances);
        if self.config.post_process == PostProcess::ToneMap {
            return Some(tone_mapped);
        }
        let inputs = TaaInputs {
            tone_mapped: &tone_mapped,
            guide: &imported.guide,
            surface_motion: &imported.surface_motion,
            previous: self.history.as_ref().and_then(|history| history.display.as_ref()),
        };
        Some(taa(frame, tuning, &inputs))
    }
}

/// The tunables that a frame's constants hold.
fn tuning_of(frame: &FrameConstants) -> Tuning {
    Tuning {
        alpha: frame.alpha,
        alpha_moments: frame.alpha_moments,
        max_history_length: frame.max_history_length,
        spatial_variance_frames: frame.spatial_variance_frames,
        sigma_l: frame.sigma_l,
        sigma_n: frame.sigma_n,
        sigma_z: frame.sigma_z,
        depth_tolerance: frame.depth_tolerance,
        normal_tolerance: frame.normal_tolerance,
        edge_falloff: frame.edge_falloff,
        percentile_low: frame.percentile_low,
        percentile_up: frame.percentile_up,
        percentile_range: frame.percentile_range,
        adaptivity: frame.adaptivity,
        change_threshold: frame.change_threshold,
        firefly_bias: frame.firefly_bias,
        sigma_rt: frame.sigma_rt,
        sigma_rt_n: frame.sigma_rt_n,
        sigma_rt_x: frame.sigma_rt_x,
        volume_alpha: frame.volume_alpha,
        volume_sigma_l: frame.volume_sigma_l,
        volume_sigma_z: frame.volume_sigma_z,
        volume_depth_tolerance: frame.volume_depth_tolerance,
        gradient_scale: frame.gradient_scale,
        exposure: frame.exposure,
        taa_alpha: frame.taa_alpha,
        taa_gamma: frame.taa_gamma,
        tone_curve: [ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Linear][frame.tone_curve.min(2) as usize],
    }
}

fn each<T>(images: &[Image<T>]) -> Vec<&Image<T>> {
    images.iter().collect()
}

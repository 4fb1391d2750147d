//! What says how far history is out of date: temporal gradients \[ASVGF\], or statistics of blocks \[PSVGF\].

use super::*;
use crate::config::{AdaptiveRule, GradientSource};

/// What the presets with gradients find before they accumulate.
#[derive(Default)]
pub(super) struct Gradients {
    /// As reconstructed: one texel a stratum.
    pub gradient: Option<Image<[f32; 4]>>,
    pub confidence: Option<Image<f32>>,
    pub noisy_luminance: Option<Image<u32>>,
    pub candidates: Option<Image<[u16; 4]>>,
    pub statistics: Statistics,
}

/// Irradiance whose outliers were scaled down, where the preset does so.
pub(super) struct Outliers {
    pub irradiance: Vec<Image<[f32; 4]>>,
    /// Of every signal, before.
    pub block_percentiles: Vec<Image<u32>>,
}

impl Denoiser {
    pub(super) fn gradients(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        inputs: &DenoiserInputs,
    ) -> Gradients {
        if !matches!(self.config.preset, Preset::Asvgf | Preset::Stabilize) {
            return Gradients::default();
        }
        let extent = self.config.allocated_extent;
        match self.config.gradient_source {
            GradientSource::ForwardProjected => {
                let (projected, statistics) = self.project(frame, tuning, imported, inputs);
                let source = GradientInput::ForwardProjected { gradient_samples: &projected.gradient_samples };
                let gradients = self.reconstructed(frame, tuning, imported, inputs, source);
                Gradients { candidates: Some(projected.gradient_candidates), statistics, ..gradients }
            }
            GradientSource::Reshaded => {
                let source = GradientInput::Reshaded {
                    reshaded_radiance: inputs.gradients.reshaded_radiance,
                    previous_guide: self.history.as_ref().map(|history| &history.guide),
                    surface_motion: &imported.surface_motion,
                    depth_gradient: &imported.depth_gradient,
                };
                self.reconstructed(frame, tuning, imported, inputs, source)
            }
            GradientSource::Sparse => {
                let gradients =
                    self.reconstructed(frame, tuning, imported, inputs, GradientInput::Sparse(inputs.gradients.sparse_gradient));
                Gradients { noisy_luminance: None, ..gradients }
            }
            GradientSource::Confidence => {
                let trusted = Image::new(extent, [1.0; 4]);
                let host = inputs.gradients.confidence.unwrap_or(&trusted);
                let confidence = adaptive_alpha(frame, tuning, extent, AdaptiveAlphaInput::Confidence(host));
                Gradients { confidence: Some(confidence), ..Gradients::default() }
            }
        }
    }

    fn project(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        inputs: &DenoiserInputs,
    ) -> (ForwardProjectOutputs, Statistics) {
        let surface_id = inputs.guides.surface_id;
        let stratum_size = self.config.stratum_size;
        let previous = self.history.as_ref().and_then(|history| {
            history.gradient_candidates.as_ref().map(|candidates| PreviousCandidates { guide: &history.guide, candidates })
        });
        let inputs = ForwardProjectInputs {
            guide: &imported.guide,
            depth_gradient: &imported.depth_gradient,
            previous,
            instance_transforms: inputs.guides.instance_transforms,
            forward_motion: inputs.gradients.forward_motion.filter(|_| self.config.forward_motion),
            stratum_size,
        };
        let mut claims = Image::new(self.config.allocated_extent.map(|side| side.div_ceil(stratum_size)), 0);
        let statistics = forward_project_claim(frame, tuning, &inputs, &mut claims);
        (forward_project_resolve(frame, tuning, &inputs, &claims, surface_id), statistics)
    }

    fn reconstructed(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        inputs: &DenoiserInputs,
        source: GradientInput,
    ) -> Gradients {
        let inputs = GradientInputs {
            guide: &imported.guide,
            noisy: inputs.noisy,
            albedo: inputs.albedo,
            previous_luminance: self.history.as_ref().and_then(|history| history.noisy_luminance.as_ref()),
            source,
        };
        let stratum_size = self.config.stratum_size;
        let measured = gradient(frame, tuning, stratum_size, &inputs);
        let iterations = (0..GRADIENT_ITERATIONS).fold(measured.gradient, |gradient, level| {
            let inputs = GradientAtrousInputs {
                gradient_guide: &measured.gradient_guide,
                depth_gradient: &imported.depth_gradient,
                gradient: &gradient,
            };
            gradient_atrous(frame, tuning, stratum_size, level, &inputs)
        });
        let input = AdaptiveAlphaInput::Gradient { gradient: &iterations, stratum_size };
        let confidence = adaptive_alpha(frame, tuning, self.config.allocated_extent, input);
        Gradients {
            gradient: Some(iterations),
            confidence: Some(confidence),
            noisy_luminance: Some(measured.noisy_luminance),
            ..Gradients::default()
        }
    }

    pub(super) fn outliers(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        irradiance: Vec<Image<[f32; 4]>>,
    ) -> Outliers {
        let is_filtered = match self.config.preset {
            Preset::Percentile => true,
            _ => self.config.firefly_filter,
        };
        if !is_filtered {
            return Outliers { irradiance, block_percentiles: Vec::new() };
        }
        let guide = Some(&imported.guide);
        let percentiles = |irradiance| block_percentiles(frame, tuning, &BlockPercentilesInputs { guide, irradiance });
        let block_percentiles: Vec<_> = irradiance.iter().map(percentiles).collect();
        let signals = irradiance.iter().zip(&block_percentiles);
        let scaled =
            |(irradiance, block_percentiles)| firefly(frame, tuning, &FireflyInputs { guide, block_percentiles, irradiance });
        Outliers { irradiance: signals.map(scaled).collect(), block_percentiles }
    }

    /// The confidence of the preset `Percentile`.
    pub(super) fn confidence(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        outliers: &Outliers,
    ) -> Option<Image<f32>> {
        if self.config.preset != Preset::Percentile {
            return None;
        }
        let extent = self.config.allocated_extent;
        let Some(history) = &self.history else { return Some(Image::new(extent, 1.0)) };
        let guides = HistoryGuides {
            guide: &imported.guide,
            surface_motion: &imported.surface_motion,
            depth_gradient: &imported.depth_gradient,
            previous_guide: &history.guide,
        };
        let confidence = match self.config.adaptive_rule {
            AdaptiveRule::Percentiles => {
                let signals: Vec<_> = outliers.block_percentiles.iter().zip(&history.irradiance).collect();
                percentile_rule(frame, tuning, &PercentileRuleInputs { guides, signals: &signals })
            }
            AdaptiveRule::ChangeTest => {
                let signals = outliers.irradiance.iter().zip(&history.irradiance).zip(&history.moments);
                let differences: Vec<_> = signals
                    .map(|((now, irradiance), moments)| {
                        let history = SignalHistory { irradiance, moments };
                        block_difference(frame, tuning, &BlockDifferenceInputs { guides, irradiance: now, history })
                    })
                    .collect();
                change_test(frame, tuning, extent, &each(&differences))
            }
        };
        Some(confidence)
    }
}

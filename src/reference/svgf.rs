//! SVGF over a sequence of frames: the stages chained, with the history between them.

use super::*;
use crate::config::{PostProcess, Signals};
use crate::{Config, Error, FrameContext};

#[cfg(test)]
mod sequence_tests;
#[cfg(test)]
mod tests;

/// What the host gives for one frame; every image has the allocated extent.
#[derive(Clone, Copy, Debug)]
pub struct SvgfInputs<'a> {
    /// Depth, normals, motion and ids.
    pub guides: ImportInputs<'a>,
    /// rgb: noisy radiance of every signal: one, or direct and indirect.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo at the primary hit.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: radiance that is not filtered.
    pub emission: Option<&'a Image<[f32; 4]>>,
}

/// What one frame gives back.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgfOutputs {
    /// rgb: linear radiance; alpha 1.
    pub denoised_radiance: Image<[f32; 4]>,
    /// rgb: 0..1, where the configuration has a post-process.
    pub display: Option<Image<[f32; 4]>>,
    /// Bad input, summed over the stages.
    pub statistics: Statistics,
    /// What is between the stages, where it was asked for.
    pub views: Option<SvgfViews>,
}

/// The images between the stages, one for every signal where they are in a `Vec`.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgfViews {
    /// See [`unpack_guide`].
    pub guide: Image<[u16; 4]>,
    /// See [`unpack_surface_motion`].
    pub surface_motion: Image<[u16; 4]>,
    /// See [`unpack_depth_gradient`].
    pub depth_gradient: Image<u32>,
    /// rgb: irradiance before any filter.
    pub demodulated: Vec<Image<[f32; 4]>>,
    /// rgb: irradiance after temporal accumulation.
    pub accumulated: Vec<Image<[f32; 4]>>,
    /// See [`unpack_moments`].
    pub moments: Vec<Image<[u16; 4]>>,
    /// Frames accumulated.
    pub history_length: Image<f32>,
    /// A [`Reason`] as a number.
    pub reasons: Image<u16>,
    /// Standard deviation of luminance after the stage `variance`.
    pub standard_deviation: Vec<Image<f32>>,
    /// `levels[level][signal]`: rgb irradiance, alpha standard deviation of luminance.
    pub levels: Vec<Vec<Image<[f32; 4]>>>,
}

/// What the next frame needs of this one.
#[derive(Clone, Debug)]
struct History {
    guide: Image<[u16; 4]>,
    object_normal_guide: Option<Image<u32>>,
    irradiance: Vec<Image<[f32; 4]>>,
    moments: Vec<Image<[u16; 4]>>,
    display: Option<Image<[f32; 4]>>,
}

/// Spatiotemporal variance-guided filtering \[SVGF\] of a sequence, on the CPU.
#[derive(Clone, Debug)]
pub struct Svgf {
    config: Config,
    history: Option<History>,
}

impl Svgf {
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
    /// another configuration. The history is unchanged then.
    pub fn frame(&mut self, frame: &FrameContext, inputs: &SvgfInputs, with_views: bool) -> Result<SvgfOutputs, Error> {
        self.check(frame, inputs)?;
        let constants = &frame.constants;
        let imported = import(constants, &inputs.guides);
        let demodulated =
            demodulate(constants, &DemodulateInputs { guide: &imported.guide, noisy: inputs.noisy, albedo: inputs.albedo });
        let accumulated = self.accumulate(frame, &imported, &demodulated.irradiance);
        let with_deviation = variance(
            constants,
            &VarianceInputs {
                guide: &imported.guide,
                depth_gradient: &imported.depth_gradient,
                irradiance: &each(&accumulated.irradiance),
                moments: &each(&accumulated.moments),
            },
        );
        let levels = self.filter(frame, &imported, &with_deviation);
        let (first, last) = (levels.first().unwrap_or(&with_deviation), levels.last().unwrap_or(&with_deviation));
        let modulated = modulate(
            constants,
            &ModulateInputs { guide: &imported.guide, irradiance: &each(last), albedo: inputs.albedo, emission: inputs.emission },
        );
        let display = self.post_process(frame, &imported, &modulated.denoised_radiance);
        let stages = [imported.statistics, demodulated.statistics, modulated.statistics];
        self.history = Some(History {
            guide: imported.guide.clone(),
            object_normal_guide: imported.object_normal_guide.clone(),
            irradiance: first.clone(),
            moments: accumulated.moments.clone(),
            display: display.clone(),
        });
        Ok(SvgfOutputs {
            denoised_radiance: modulated.denoised_radiance,
            display,
            statistics: std::array::from_fn(|i| stages.iter().map(|s| s[i]).sum()),
            views: with_views.then(|| views(imported, demodulated.irradiance, accumulated, &with_deviation, levels)),
        })
    }

    fn accumulate(
        &self,
        frame: &FrameContext,
        imported: &ImportOutputs,
        irradiance: &[Image<[f32; 4]>],
    ) -> TemporalAccumulationOutputs {
        let signals: Vec<_> = self.history.iter().flat_map(|history| history.irradiance.iter().zip(&history.moments)).collect();
        let signals: Vec<_> = signals.into_iter().map(|(irradiance, moments)| SignalHistory { irradiance, moments }).collect();
        let inputs = TemporalAccumulationInputs {
            guide: &imported.guide,
            surface_motion: &imported.surface_motion,
            depth_gradient: &imported.depth_gradient,
            irradiance: &each(irradiance),
            history_confidence: None,
            repair: false,
            object_normals: imported
                .object_normal_guide
                .as_ref()
                .zip(self.history.as_ref().and_then(|history| history.object_normal_guide.as_ref()))
                .map(|(current, previous)| ObjectNormals { current, previous }),
            previous: self.history.as_ref().map(|history| PreviousFrame { guide: &history.guide, signals: &signals }),
        };
        temporal_accumulation(&frame.constants, &inputs)
    }

    fn filter(&self, frame: &FrameContext, imported: &ImportOutputs, input: &[Image<[f32; 4]>]) -> Vec<Vec<Image<[f32; 4]>>> {
        let mut levels: Vec<Vec<_>> = Vec::with_capacity(self.config.levels as usize);
        for level in 0..self.config.levels {
            let irradiance = each(levels.last().map_or(input, |before| before.as_slice()));
            let inputs = AtrousInputs { guide: &imported.guide, depth_gradient: &imported.depth_gradient, irradiance: &irradiance };
            let filtered = atrous(&frame.constants, level, &inputs);
            levels.push(filtered);
        }
        levels
    }

    fn post_process(&self, frame: &FrameContext, imported: &ImportOutputs, radiance: &Image<[f32; 4]>) -> Option<Image<[f32; 4]>> {
        if self.config.post_process == PostProcess::None {
            return None;
        }
        let tone_mapped = tone_map(&frame.constants, &[radiance]);
        if self.config.post_process == PostProcess::ToneMap {
            return Some(tone_mapped);
        }
        let inputs = TaaInputs {
            tone_mapped: &tone_mapped,
            guide: &imported.guide,
            surface_motion: &imported.surface_motion,
            previous: self.history.as_ref().and_then(|history| history.display.as_ref()),
        };
        Some(taa(&frame.constants, &inputs))
    }

    fn check(&self, frame: &FrameContext, inputs: &SvgfInputs) -> Result<(), Error> {
        let allocated = self.config.allocated_extent;
        for render in [frame.constants.render_extent, frame.constants.previous_render_extent] {
            if (0..2).any(|i| render[i] > allocated[i]) {
                return Err(Error::RenderExtent { render, allocated });
            }
        }
        let signals = match self.config.signals {
            Signals::Together => 1,
            Signals::Apart => 2,
        };
        if inputs.noisy.len() != signals {
            let (given, needed) = (format!("{} images", inputs.noisy.len()), format!("{signals}, as Config::signals says"));
            return Err(Error::Size { resource: "noisy".into(), given, needed });
        }
        let guides = &inputs.guides;
        let mut extents = vec![("depth", guides.depth.extent()), ("normal", guides.normal.extent())];
        extents.extend(inputs.noisy.iter().map(|image| ("noisy", image.extent())));
        extents.extend(guides.surface_id.map(|image| ("surface_id", image.extent())));
        let optional =
            [("motion", guides.motion), ("roughness", guides.roughness), ("albedo", inputs.albedo), ("emission", inputs.emission)];
        extents.extend(optional.iter().filter_map(|(name, image)| Some((*name, image.as_ref()?.extent()))));
        match extents.into_iter().find(|(_, extent)| *extent != allocated) {
            Some((name, [w, h])) => Err(Error::Size {
                resource: name.into(),
                given: format!("{w} x {h} texels"),
                needed: format!("{} x {}, the allocated extent", allocated[0], allocated[1]),
            }),
            None => Ok(()),
        }
    }
}

fn each<T>(images: &[Image<T>]) -> Vec<&Image<T>> {
    images.iter().collect()
}

fn views(
    imported: ImportOutputs,
    demodulated: Vec<Image<[f32; 4]>>,
    accumulated: TemporalAccumulationOutputs,
    with_deviation: &[Image<[f32; 4]>],
    levels: Vec<Vec<Image<[f32; 4]>>>,
) -> SvgfViews {
    let first = &accumulated.moments[0];
    SvgfViews {
        guide: imported.guide,
        surface_motion: imported.surface_motion,
        depth_gradient: imported.depth_gradient,
        demodulated,
        history_length: first.map(|m| unpack_moments(*m).history_length),
        reasons: first.map(|m| unpack_moments(*m).reason),
        accumulated: accumulated.irradiance,
        moments: accumulated.moments,
        standard_deviation: with_deviation.iter().map(|image| image.map(|t| t[3])).collect(),
        levels,
    }
}

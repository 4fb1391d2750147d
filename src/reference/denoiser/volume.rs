//! The filter of a volume: what stands behind the surfaces of a frame, or by itself.

use super::*;

/// What a host with a volume gives; both have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub struct VolumeInputs<'a> {
    /// rgb: noisy radiance of the volume.
    pub noisy_volume: &'a Image<[f32; 4]>,
    /// See [`VolumePointsInputs::scattering_depth`].
    pub scattering_depth: Option<&'a Image<[f32; 4]>>,
}

/// What the next frame needs of the volume of this one.
#[derive(Clone, Debug)]
pub(super) struct VolumeHistory {
    /// Alpha: standard deviation of luminance.
    pub radiance: Image<[f32; 4]>,
    pub moments: Image<[u16; 4]>,
    points: Image<[u16; 4]>,
}

/// A filtered volume.
pub(super) struct FilteredVolume {
    pub denoised: Image<[f32; 4]>,
    pub history: VolumeHistory,
    /// Before outliers were scaled down, where they are.
    pub block_percentiles: Option<Image<u32>>,
    pub statistics: Statistics,
}

impl Denoiser {
    /// The volume of a frame, where the configuration has one.
    pub(super) fn volume(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        imported: &ImportOutputs,
        inputs: &DenoiserInputs,
    ) -> Option<FilteredVolume> {
        let inputs = inputs.volume.filter(|_| self.config.has_volume())?;
        let VolumeInputs { noisy_volume, scattering_depth } = inputs;
        let previous = self.history.as_ref().and_then(|history| Some((&history.guide, history.volume.as_ref()?)));
        let tuning = &volume_tuning(tuning);
        let extent = imported.guide.extent();
        let (none, mut claims) = (Image::new(extent, [0; 4]), Image::new(extent, 0));
        let points = previous.map_or(&none, |(_, volume)| &volume.points);
        volume_motion_claim(frame, &imported.guide, points, &mut claims);
        let volume_motion = volume_motion_resolve(frame, points, &imported.surface_motion, &claims);
        let taken_in = volume_points(frame, &VolumePointsInputs { noisy_volume, scattering_depth });
        let (radiance, block_percentiles) = self.volume_without_outliers(frame, tuning, taken_in.radiance);
        let signals = previous.map(|(_, volume)| SignalHistory { irradiance: &volume.radiance, moments: &volume.moments });
        let accumulation = VolumeAccumulationInputs {
            guide: &imported.guide,
            volume_motion: &volume_motion,
            radiance: &radiance,
            previous: previous.map(|(guide, _)| PreviousFrame { guide, signals: signals.as_slice() }),
        };
        let (accumulated, moments) = volume_accumulation(frame, tuning, &accumulation);
        let variance = VolumeVarianceInputs { guide: &imported.guide, radiance: &accumulated, moments: &moments };
        let level = |level, radiance: &_| volume_atrous(frame, tuning, level, &imported.guide, radiance);
        let first = level(0, &volume_variance(frame, tuning, &variance));
        // At least two: the first is the history.
        let denoised = (2..self.config.levels).fold(level(1, &first), |radiance, i| level(i, &radiance));
        let history = VolumeHistory { radiance: first, moments, points: taken_in.volume_points };
        Some(FilteredVolume { denoised, history, block_percentiles, statistics: taken_in.statistics })
    }

    /// With the percentiles that tell them.
    fn volume_without_outliers(
        &self,
        frame: &FrameConstants,
        tuning: &Tuning,
        irradiance: Image<[f32; 4]>,
    ) -> (Image<[f32; 4]>, Option<Image<u32>>) {
        if !self.config.firefly_filter {
            return (irradiance, None);
        }
        let block_percentiles = block_percentiles(frame, tuning, &BlockPercentilesInputs { guide: None, irradiance: &irradiance });
        let inputs = FireflyInputs { guide: None, block_percentiles: &block_percentiles, irradiance: &irradiance };
        (firefly(frame, tuning, &inputs), Some(block_percentiles))
    }
}

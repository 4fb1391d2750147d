//! What goes into a frame and what comes out of it.

use super::*;

/// What the host gives for one frame; every image has the allocated extent, where nothing else is said.
#[derive(Clone, Copy, Debug)]
pub struct DenoiserInputs<'a> {
    /// Depth, normals, motion and ids.
    pub guides: ImportInputs<'a>,
    /// rgb: noisy radiance of every signal: one, or direct and indirect.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// rgb: albedo at the primary hit.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// rgb: radiance that is not filtered.
    pub emission: Option<&'a Image<[f32; 4]>>,
    /// For presets with gradients.
    pub gradients: GradientSources<'a>,
    /// Where the configuration has a volume.
    pub volume: Option<VolumeInputs<'a>>,
}

impl<'a> DenoiserInputs<'a> {
    /// Guides and noise, without anything optional.
    pub fn new(guides: ImportInputs<'a>, noisy: &'a [&'a Image<[f32; 4]>]) -> Self {
        Self { guides, noisy, albedo: None, emission: None, gradients: GradientSources::default(), volume: None }
    }
}

/// What the presets `Asvgf` and `Stabilize` take besides; which of it is read, [`Config::gradient_source`] says.
#[derive(Clone, Copy, Debug, Default)]
pub struct GradientSources<'a> {
    /// At the pixels of the previous frame its motion to this one: see [`ForwardProjectInputs::forward_motion`].
    pub forward_motion: Option<&'a Image<[f32; 4]>>,
    /// rgb: the paths of the previous frame in the scene of this one, at the pixels of the previous frame.
    pub reshaded_radiance: Option<&'a Image<[f32; 4]>>,
    /// One texel a stratum: x: δ, y: Δ.
    pub sparse_gradient: Option<&'a Image<[f32; 4]>>,
    /// x: 1 keeps the history, 0 drops it.
    pub confidence: Option<&'a Image<[f32; 4]>>,
    /// rgb: the picture that `Stabilize` accumulates.
    pub other_denoised_radiance: Option<&'a Image<[f32; 4]>>,
}

/// What one frame gives back.
#[derive(Clone, Debug, PartialEq)]
pub struct DenoiserOutputs {
    /// rgb: linear radiance; alpha 1. Black from a preset without surfaces.
    pub denoised_radiance: Image<[f32; 4]>,
    /// rgb: linear radiance of the volume; alpha: its standard deviation.
    pub denoised_volume: Option<Image<[f32; 4]>>,
    /// rgb: 0..1, where the configuration has a post-process.
    pub display: Option<Image<[f32; 4]>>,
    /// Bad input, summed over the stages.
    pub statistics: Statistics,
    /// What is between the stages, where it was asked for.
    pub views: Option<DenoiserViews>,
}

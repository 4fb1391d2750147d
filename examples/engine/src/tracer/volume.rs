//! The medium of a scene at one sample per pixel of light: beside the surfaces, in images of its own.

use ash::vk;

use super::{shaders, Outputs};
use crate::error::Result;
use crate::gpu::{storage_images, DescriptorSet, Gpu, Image, Pipeline, SetLayout};

/// What the lighting of a frame leaves of the medium. Images are in layout `GENERAL`, last written at stage `COMPUTE_SHADER` with access
/// `SHADER_WRITE`.
pub struct Volume {
    /// `R32G32B32A32_SFLOAT`: radiance of light that the medium scattered once towards the eye. a: 1. The radiance of surfaces in [`Outputs`] is
    /// what reaches the eye through the medium, so the sum of both is the picture.
    pub noisy_volume: Image,
    /// `R32_SFLOAT`: depth along the view axis at which it was scattered, scene units; chosen by transmittance.
    pub scattering_depth: Image,
    pub(super) set: DescriptorSet,
    pub(super) pipeline: Pipeline,
}

impl Volume {
    pub(super) fn new(gpu: &Gpu, scene_layout: &SetLayout, outputs: &Outputs) -> Result<Self> {
        let extent = outputs.scattered.extent;
        let noisy_volume = Image::new(gpu, "noisy_volume", vk::Format::R32G32B32A32_SFLOAT, extent)?;
        let scattering_depth = Image::new(gpu, "scattering_depth", vk::Format::R32_SFLOAT, extent)?;
        let layout = SetLayout::new(gpu, &storage_images(4))?;
        let images = [&outputs.seed, &outputs.depth, &noisy_volume, &scattering_depth].map(|image| image.view);
        let set = DescriptorSet::of_images(gpu, &layout, &images)?;
        let pipeline = Pipeline::new(gpu, &shaders::VOLUME, &[scene_layout, &layout], 0)?;
        Ok(Self { noisy_volume, scattering_depth, set, pipeline })
    }
}

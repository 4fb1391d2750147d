//! Ambient occlusion at one ray per pixel of light: beside the path, in images of its own.

use ash::vk;

use super::{shaders, Outputs};
use crate::error::Result;
use crate::gpu::{storage_images, DescriptorSet, Gpu, Image, Pipeline, SetLayout};

/// What is farther away occludes nothing, scene units.
pub const AMBIENT_REACH: f32 = 1.0;

/// What the lighting of a frame leaves of ambient occlusion, with [`super::TracerOptions::ambient`]. Images are in layout `GENERAL`, last written
/// at stage `COMPUTE_SHADER` with access `SHADER_WRITE`.
pub struct Ambient {
    /// `R32_SFLOAT`: 0 where one ray, drawn by the cosine, met something within [`AMBIENT_REACH`], else 1.
    pub noisy_ambient: Image,
    /// `R32_SFLOAT`: how far away that is, scene units; 0: nothing was met.
    pub ambient_distance: Image,
    pub(super) set: DescriptorSet,
    pub(super) pipeline: Pipeline,
}

impl Ambient {
    pub(super) fn new(gpu: &Gpu, scene_layout: &SetLayout, outputs: &Outputs) -> Result<Self> {
        let extent = outputs.scattered.extent;
        let noisy_ambient = Image::new(gpu, "noisy_ambient", vk::Format::R32_SFLOAT, extent)?;
        let ambient_distance = Image::new(gpu, "ambient_distance", vk::Format::R32_SFLOAT, extent)?;
        let layout = SetLayout::new(gpu, &storage_images(4))?;
        let images = [&outputs.visibility, &outputs.seed, &noisy_ambient, &ambient_distance].map(|image| image.view);
        let set = DescriptorSet::of_images(gpu, &layout, &images)?;
        let pipeline = Pipeline::new(gpu, &shaders::AMBIENT, &[scene_layout, &layout], 4)?;
        Ok(Self { noisy_ambient, ambient_distance, set, pipeline })
    }
}

//! The sun of a scene at one shadow ray per pixel: beside the path, in images of its own.

use ash::vk;

use super::{shaders, Outputs};
use crate::error::Result;
use crate::gpu::{storage_images, DescriptorSet, Gpu, Image, Pipeline, SetLayout};
use crate::scene::{Lamp, Scene};

/// What the lighting of a frame leaves of the sun, with [`super::TracerOptions::sun_apart`]. Images are in layout `GENERAL`, last written at stage
/// `COMPUTE_SHADER` with access `SHADER_WRITE`.
pub struct Sun {
    /// `R32_SFLOAT`: 1 where one shadow ray reached it, else 0.
    pub noisy_visibility: Image,
    /// `R32_SFLOAT`: how far along that ray something is in the way, scene units; 0: nothing is.
    pub occluder_distance: Image,
    /// `R32_UINT`: `surface_id` of that thing; 0: nothing is.
    pub occluder_id: Image,
    /// `R32G32B32A32_SFLOAT`: radiance that it gives the surface where nothing is in the way. a: 1. Times the visibility it adds to the light of
    /// [`Outputs`], which has none of it.
    pub unshadowed_direct: Image,
    /// Angular radius, radians.
    pub radius: f32,
    pub(super) set: DescriptorSet,
    pub(super) pipeline: Pipeline,
}

impl Sun {
    /// Nothing for a scene without a sun.
    pub(super) fn new(gpu: &Gpu, scene: &Scene, scene_layout: &SetLayout, outputs: &Outputs) -> Result<Option<Self>> {
        let radius = scene.lamps.iter().find_map(|lamp| match lamp {
            Lamp::Sun { radius, .. } => Some(radius.asin()),
            Lamp::Point { .. } => None,
        });
        let Some(radius) = radius else { return Ok(None) };
        let extent = outputs.depth.extent;
        let noisy_visibility = Image::new(gpu, "noisy_visibility", vk::Format::R32_SFLOAT, extent)?;
        let occluder_distance = Image::new(gpu, "occluder_distance", vk::Format::R32_SFLOAT, extent)?;
        let unshadowed_direct = Image::new(gpu, "unshadowed_direct", vk::Format::R32G32B32A32_SFLOAT, extent)?;
        let occluder_id = Image::new(gpu, "occluder_id", vk::Format::R32_UINT, extent)?;
        let layout = SetLayout::new(gpu, &storage_images(6))?;
        let images = [&outputs.visibility, &outputs.seed, &noisy_visibility, &occluder_distance, &unshadowed_direct, &occluder_id];
        let set = DescriptorSet::of_images(gpu, &layout, &images.map(|image| image.view))?;
        let pipeline = Pipeline::new(gpu, &shaders::SUN, &[scene_layout, &layout], 0)?;
        Ok(Some(Self { noisy_visibility, occluder_distance, occluder_id, unshadowed_direct, radius, set, pipeline }))
    }

    pub(super) fn images(&self) -> [&Image; 4] {
        [&self.noisy_visibility, &self.occluder_distance, &self.unshadowed_direct, &self.occluder_id]
    }
}

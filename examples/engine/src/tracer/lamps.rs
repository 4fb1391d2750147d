//! Lamps of a scene at one shadow ray per pixel of light each: beside the path, in images of their own.

use ash::vk;

use super::{shaders, Outputs};
use crate::error::Result;
use crate::gpu::{storage_images, DescriptorSet, Gpu, Image, Pipeline, SetLayout};
use crate::scene::{Lamp, Scene};

/// Lamps that can be apart: as many as a denoiser filters.
pub const LAMPS_APART: usize = 4;

/// What the lighting of a frame leaves of one lamp, with [`super::TracerOptions::lamps_apart`]. Images are in layout `GENERAL`, last written at
/// stage `COMPUTE_SHADER` with access `SHADER_WRITE`.
pub struct LampApart {
    /// `R16G16B16A16_SFLOAT`: 1 where one shadow ray reached it, 0 where it met a thing, the colour of panes between. a: 1.
    pub noisy_visibility: Image,
    /// `R32_SFLOAT`: how far along that ray something is in the way, scene units; 0: nothing is.
    pub occluder_distance: Image,
    /// `R32_UINT`: `surface_id` of that thing; 0: nothing is.
    pub occluder_id: Image,
    /// `R32G32B32A32_SFLOAT`, of every pixel of the picture: radiance that it gives the surface where nothing is in the way. a: 1. Times the visibility it adds to the light of
    /// [`Outputs`], which has none of it.
    pub unshadowed_direct: Image,
    set: DescriptorSet,
}

/// The lamps that are apart.
pub struct LampsApart {
    /// In the order of the scene.
    pub lamps: Vec<LampApart>,
    pub(super) pipeline: Pipeline,
}

impl LampsApart {
    /// Nothing for a scene without lamps.
    pub(super) fn new(gpu: &Gpu, scene: &Scene, scene_layout: &SetLayout, outputs: &Outputs) -> Result<Option<Self>> {
        let count = scene.lamps.len().min(LAMPS_APART);
        if count == 0 {
            return Ok(None);
        }
        let layout = SetLayout::new(gpu, &storage_images(6))?;
        let lamps = (0..count).map(|_| LampApart::new(gpu, &layout, outputs)).collect::<Result<_>>()?;
        Ok(Some(Self { lamps, pipeline: Pipeline::new(gpu, &shaders::LAMP, &[scene_layout, &layout], 4)? }))
    }

    pub(super) fn images(&self) -> Vec<&Image> {
        self.lamps.iter().flat_map(LampApart::images).collect()
    }

    pub(super) fn record(&self, cmd: vk::CommandBuffer, scene_set: &DescriptorSet, extent: vk::Extent2D) {
        for (number, lamp) in (0u32..).zip(&self.lamps) {
            self.pipeline.record(cmd, &[scene_set, &lamp.set], &number.to_ne_bytes(), extent);
        }
    }
}

impl LampApart {
    fn new(gpu: &Gpu, layout: &SetLayout, outputs: &Outputs) -> Result<Self> {
        let image = |name, format| Image::new(gpu, name, format, outputs.scattered.extent);
        let noisy_visibility = image("noisy_visibility", vk::Format::R16G16B16A16_SFLOAT)?;
        let occluder_distance = image("occluder_distance", vk::Format::R32_SFLOAT)?;
        let unshadowed_direct = Image::new(gpu, "unshadowed_direct", vk::Format::R32G32B32A32_SFLOAT, outputs.depth.extent)?;
        let occluder_id = image("occluder_id", vk::Format::R32_UINT)?;
        let images = [&outputs.visibility, &outputs.seed, &noisy_visibility, &occluder_distance, &unshadowed_direct, &occluder_id];
        let set = DescriptorSet::of_images(gpu, layout, &images.map(|image| image.view))?;
        Ok(Self { noisy_visibility, occluder_distance, occluder_id, unshadowed_direct, set })
    }

    fn images(&self) -> [&Image; 4] {
        [&self.noisy_visibility, &self.occluder_distance, &self.unshadowed_direct, &self.occluder_id]
    }
}

/// The size that a lamp has for the eye of a shadow: radians of a sun; of a lamp near by as from `distance` scene units.
pub fn angular_radius(lamp: &Lamp, distance: f32) -> f32 {
    match lamp {
        Lamp::Sun { radius, .. } => radius.asin(),
        Lamp::Point { radius, .. } => (radius / distance).atan(),
    }
}

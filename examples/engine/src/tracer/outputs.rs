//! The images that a frame leaves behind.

use ash::vk;

use crate::error::Result;
use crate::gpu::{Gpu, Image};

/// Everything that the passes write. Light has fewer pixels with [`super::TracerOptions::half_light`]. All images are in layout `GENERAL` once the first frame was recorded, last
/// written at stage `COMPUTE_SHADER` with access `SHADER_WRITE` (in synchronization2: `SHADER_STORAGE_WRITE`).
/// The next frame's passes wait for all earlier commands of the queue and then overwrite every texel.
pub struct Outputs {
    /// `R32G32B32A32_UINT`: instance (`u32::MAX`: background), triangle of its mesh, barycentrics as bits of two floats.
    pub visibility: Image,
    /// `R32_UINT`: hash of pixel, frame index and user seed; all the random numbers of the pixel follow from it.
    pub seed: Image,
    /// `R32_SFLOAT`: depth along the view axis, scene units, positive; 0: background.
    pub depth: Image,
    /// `R16G16B16A16_SFLOAT`: world-space unit shading normal that faces the camera; 0: background. a: 0.
    pub normal: Image,
    /// `R16G16B16A16_SFLOAT`: object-space unit shading normal as the mesh has it (not turned to the camera). a: 0.
    pub object_normal: Image,
    /// `R16G16B16A16_SFLOAT`: diffuse reflectance plus the coat's or metal's directional albedo; 1: background. a: roughness.
    pub albedo: Image,
    /// `R16G16B16A16_SFLOAT`: the part of `albedo` that divides diffuse light. a: 0.
    pub diffuse_albedo: Image,
    /// `R16G16B16A16_SFLOAT`: the part of `albedo` that divides specular light. a: 0.
    pub specular_albedo: Image,
    /// `R32_SFLOAT`: perceptual roughness, 0 to 1; 1: background.
    pub roughness: Image,
    /// `R32G32B32A32_SFLOAT`: xy: previous minus current pixel position, y down, without jitter; z: linear depth of the
    /// point in the previous frame's camera (0: background); w: 0.
    pub motion: Image,
    /// `R32_UINT`: instance index plus one; 0: background.
    pub surface_id: Image,
    /// `R32G32B32A32_SFLOAT`: radiance of light that was scattered once. a: 1.
    pub direct: Image,
    /// `R32G32B32A32_SFLOAT`: radiance of light that was scattered twice. a: 1.
    pub indirect: Image,
    /// `R32G32B32A32_SFLOAT`: emitters and environment seen directly, without noise. a: 1. Of the visibility pass.
    pub emission: Image,
    /// `R32G32B32A32_SFLOAT`: direct plus indirect, for a denoiser that filters them together. a: 1.
    pub scattered: Image,
    /// `R32G32B32A32_SFLOAT`: the part of `scattered` that the base reflects. a: 1.
    pub diffuse: Image,
    /// `R32G32B32A32_SFLOAT`: the part of `scattered` that the coat or the metal reflects. a: 1.
    pub specular: Image,
    /// `R32_SFLOAT`: distance from the surface to what is seen in it, scene units; 0: beyond the scene.
    pub hit_distance: Image,
    /// `R32_UINT`: `surface_id` of the thing that is seen in the surface; 0: none, beyond the scene, or a light without a mesh.
    pub hit_id: Image,
    /// `R32G32B32A32_SFLOAT`: previous minus current place of that thing, world space. a: 0.
    pub specular_motion: Image,
}

impl Outputs {
    /// `light`: of the images that the lighting pass writes.
    pub(super) fn new(gpu: &Gpu, extent: vk::Extent2D, light: vk::Extent2D) -> Result<Self> {
        let image = |name, format| Image::new(gpu, name, format, extent);
        let lit = |name, format| Image::new(gpu, name, format, light);
        Ok(Self {
            visibility: image("visibility", vk::Format::R32G32B32A32_UINT)?,
            seed: image("seed", vk::Format::R32_UINT)?,
            depth: image("depth", vk::Format::R32_SFLOAT)?,
            normal: image("normal", vk::Format::R16G16B16A16_SFLOAT)?,
            object_normal: image("object_normal", vk::Format::R16G16B16A16_SFLOAT)?,
            albedo: image("albedo", vk::Format::R16G16B16A16_SFLOAT)?,
            diffuse_albedo: image("diffuse_albedo", vk::Format::R16G16B16A16_SFLOAT)?,
            specular_albedo: image("specular_albedo", vk::Format::R16G16B16A16_SFLOAT)?,
            roughness: image("roughness", vk::Format::R32_SFLOAT)?,
            motion: image("motion", vk::Format::R32G32B32A32_SFLOAT)?,
            surface_id: image("surface_id", vk::Format::R32_UINT)?,
            direct: lit("direct", vk::Format::R32G32B32A32_SFLOAT)?,
            indirect: lit("indirect", vk::Format::R32G32B32A32_SFLOAT)?,
            emission: image("emission", vk::Format::R32G32B32A32_SFLOAT)?,
            scattered: lit("scattered", vk::Format::R32G32B32A32_SFLOAT)?,
            diffuse: lit("diffuse", vk::Format::R32G32B32A32_SFLOAT)?,
            specular: lit("specular", vk::Format::R32G32B32A32_SFLOAT)?,
            hit_distance: lit("hit_distance", vk::Format::R32_SFLOAT)?,
            hit_id: lit("hit_id", vk::Format::R32_UINT)?,
            specular_motion: lit("specular_motion", vk::Format::R32G32B32A32_SFLOAT)?,
        })
    }

    /// What the visibility pass writes, in the order of its bindings.
    pub fn gbuffer(&self) -> [&Image; 12] {
        [
            &self.visibility,
            &self.seed,
            &self.depth,
            &self.normal,
            &self.object_normal,
            &self.albedo,
            &self.motion,
            &self.surface_id,
            &self.diffuse_albedo,
            &self.specular_albedo,
            &self.roughness,
            &self.emission,
        ]
    }

    /// What the lighting pass writes, in the order of its bindings.
    pub fn lighting(&self) -> [&Image; 8] {
        [
            &self.direct,
            &self.indirect,
            &self.scattered,
            &self.diffuse,
            &self.specular,
            &self.hit_distance,
            &self.hit_id,
            &self.specular_motion,
        ]
    }
}

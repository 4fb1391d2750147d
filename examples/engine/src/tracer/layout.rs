//! The Rust twins of the structures in `glsl/include/scene.glsl`.

use bytemuck::{Pod, Zeroable};
use glam::{Affine3A, Vec3};

/// Three rows of an affine map.
pub type Rows = [[f32; 4]; 3];

/// "No texture", as the shaders write it.
pub const NO_TEXTURE: u32 = u32::MAX;
/// "Checker in place of a texture", as the shaders write it.
pub const CHECKER_TEXTURE: u32 = u32::MAX - 1;
/// How many textures the shaders' header table holds.
pub const TEXTURE_LIMIT: usize = 64;

#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CameraFrame {
    pub eye: [f32; 4],
    pub right: [f32; 4],
    pub up: [f32; 4],
    pub forward: [f32; 4],
}

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct FrameConstants {
    pub camera: CameraFrame,
    pub previous_camera: CameraFrame,
    pub extent_frame_seed: [u32; 4],
    pub jitter_epsilon_weight: [f32; 4],
    pub sky_zenith: [f32; 4],
    pub sky_horizon: [f32; 4],
    pub sky_ground: [f32; 4],
    pub counts: [u32; 4],
    pub medium: [f32; 4],
    pub medium_scattering: [f32; 4],
    pub light: [u32; 4],
    pub glass: [u32; 4],
}

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct InstanceData {
    pub world_from_object: Rows,
    pub previous_world_from_object: Rows,
    pub first_triangle: u32,
    pub material: u32,
    pub surface_id: u32,
    pub unused: u32,
}

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct TriangleAttributes {
    pub position_u: [[f32; 4]; 3],
    pub normal_v: [[f32; 4]; 3],
}

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct MaterialData {
    pub base_color_roughness: [f32; 4],
    pub checker_color_scale: [f32; 4],
    /// The weight is negative when both sides emit.
    pub emission_weight: [f32; 4],
    pub metallic: f32,
    pub specular: f32,
    pub base_color_texture: u32,
    pub emission_texture: u32,
}

#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub struct LightData {
    pub position_kind: [f32; 4],
    pub edge1_cdf: [f32; 4],
    pub edge2_probability: [f32; 4],
    pub radiance_material: [f32; 4],
}

/// The rows of an affine map.
pub fn rows(map: &Affine3A) -> Rows {
    let (m, t) = (map.matrix3, map.translation);
    [
        [m.x_axis.x, m.y_axis.x, m.z_axis.x, t.x],
        [m.x_axis.y, m.y_axis.y, m.z_axis.y, t.y],
        [m.x_axis.z, m.y_axis.z, m.z_axis.z, t.z],
    ]
}

/// A vector and one more number.
pub fn with(v: Vec3, w: f32) -> [f32; 4] {
    [v.x, v.y, v.z, w]
}

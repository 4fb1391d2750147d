//! The camera of a frame: matrices for the denoiser, and the basis that the shaders use.

use ash::vk;
use glam::camera::rh;
use glam::{Mat4, Vec3};

use super::layout::{with, CameraFrame};
use crate::scene::View;

/// Depth 0 in clip space lies at this distance (scene units).
const NEAR: f32 = 0.01;
/// Depth 1 in clip space lies at this distance (scene units).
const FAR: f32 = 1000.0;

/// Matrices of one frame, column-major. View space is right-handed, +Y up, looking along -Z. Clip space is Vulkan's:
/// y down, depth 0 to 1. Both are without jitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World space to view space.
    pub view_from_world: [[f32; 4]; 4],
    /// View space to clip space.
    pub clip_from_view: [[f32; 4]; 4],
    /// Where the primary rays went through each pixel, relative to its centre, in pixels, y down, -0.5 to 0.5.
    pub jitter: [f32; 2],
}

impl Camera {
    pub(super) fn new(view: &View, extent: vk::Extent2D, jitter: [f32; 2]) -> Self {
        let (right, up, forward) = axes(view);
        let aspect = extent.width as f32 / extent.height as f32;
        let rotation = Mat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), glam::Vec4::W).transpose();
        Self {
            view_from_world: (rotation * Mat4::from_translation(-view.eye)).to_cols_array_2d(),
            clip_from_view: rh::proj::vulkan::perspective(view.vertical_fov, aspect, NEAR, FAR).to_cols_array_2d(),
            jitter,
        }
    }
}

/// What the shaders take.
pub fn camera_frame(view: &View, extent: vk::Extent2D) -> CameraFrame {
    let (right, up, forward) = axes(view);
    let tangent = (0.5 * view.vertical_fov).tan();
    let aspect = extent.width as f32 / extent.height as f32;
    CameraFrame {
        eye: with(view.eye, 0.0),
        right: with(right * tangent * aspect, 0.0),
        up: with(up * tangent, 0.0),
        forward: with(forward, 0.0),
    }
}

/// Offsets of a Halton (2, 3) sequence of 16 points.
pub fn halton_jitter(frame: u32) -> [f32; 2] {
    let index = frame % 16 + 1;
    [radical_inverse(index, 2) - 0.5, radical_inverse(index, 3) - 0.5]
}

fn radical_inverse(mut index: u32, base: u32) -> f32 {
    let (mut value, mut digit) = (0.0, 1.0 / base as f32);
    while index > 0 {
        value += (index % base) as f32 * digit;
        index /= base;
        digit /= base as f32;
    }
    value
}

fn axes(view: &View) -> (Vec3, Vec3, Vec3) {
    let forward = (view.target - view.eye).normalize_or(Vec3::NEG_Z);
    let side = forward.cross(view.up);
    // A camera that looks along its own up vector still needs some right.
    let right = if side.length_squared() > 1e-10 { side.normalize() } else { forward.any_orthonormal_vector() };
    (right, right.cross(forward), forward)
}

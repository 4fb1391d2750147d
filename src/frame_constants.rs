//! The uniform block that every pass reads, and the bits of its flags.

use crate::config::{Conventions, MotionDirection, NormalSpace, RoughnessEncoding, ViewForward};

/// The uniform block that every pass reads: the Rust twin of `FrameConstants` in `glsl/include/frame.glsl`.
/// The build asserts that the offsets are equal.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[allow(missing_docs)] // the GLSL block documents every member
pub struct FrameConstants {
    pub clip_from_view: [[f32; 4]; 4],
    pub world_from_view: [[f32; 4]; 4],
    pub previous_clip_from_world: [[f32; 4]; 4],
    pub previous_view_from_world: [[f32; 4]; 4],
    pub world_from_previous_sample: [[f32; 4]; 4],
    pub sample_from_world: [[f32; 4]; 4],
    pub render_extent: [u32; 2],
    pub previous_render_extent: [u32; 2],
    pub jitter: [f32; 2],
    pub previous_jitter: [f32; 2],
    pub frame_index: u32,
    pub flags: u32,
    pub exposure_ratio: f32,
    pub background_depth: f32,
    pub previous_clip_w_scale: f32,
    pub previous_clip_w_offset: f32,
    pub filter_exposure: f32,
    pub inverse_filter_exposure: f32,
    pub eye: [f32; 4],
    pub lights: [[f32; 4]; 4],
    pub previous_lights: [[f32; 4]; 4],
    pub materials: [[f32; 4]; 16],
    pub output_extent: [u32; 2],
    pub previous_output_extent: [u32; 2],
    pub guide_extent: [u32; 2],
    pub previous_guide_extent: [u32; 2],
    pub guide_jitter: [f32; 2],
    pub previous_guide_jitter: [f32; 2],
    pub light_ratio: [u32; 2],
    pub light_offset: [u32; 2],
    pub viewport_origin: [u32; 2],
    pub motion_scale: f32,
}

impl FrameConstants {
    /// As a stage reads it that runs once for each pixel of the guides: `GUIDE_PIXELS` of `frame.glsl`.
    pub(crate) fn of_guides(&self) -> Self {
        Self {
            render_extent: self.guide_extent,
            previous_render_extent: self.previous_guide_extent,
            jitter: self.guide_jitter,
            previous_jitter: self.previous_guide_jitter,
            light_ratio: [1; 2],
            light_offset: [0; 2],
            ..*self
        }
    }

    /// The pixel of the guides that a pixel of light was traced for.
    pub(crate) fn guide_pixel(&self, p: glam::IVec2) -> glam::IVec2 {
        p * glam::UVec2::from(self.light_ratio).as_ivec2() + glam::UVec2::from(self.light_offset).as_ivec2()
    }
}

/// Bits of [`FrameConstants::flags`]: the reset, and your conventions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flags;

impl Flags {
    /// No previous image may be read.
    pub const RESET: u32 = 1;
    /// Two bits: `DepthEncoding`.
    pub const DEPTH_SHIFT: u32 = 1;
    /// Two bits: `NormalEncoding`.
    pub const NORMAL_SHIFT: u32 = 3;
    /// Normals are in view space.
    pub const NORMAL_VIEW: u32 = 1 << 5;
    /// Two bits: `MotionUnit`.
    pub const MOTION_UNIT_SHIFT: u32 = 6;
    /// Motion is current minus previous.
    pub const MOTION_NEGATED: u32 = 1 << 8;
    /// y of the motion points up.
    pub const MOTION_Y_UP: u32 = 1 << 9;
    /// Motion includes jitter.
    pub const MOTION_JITTERED: u32 = 1 << 10;
    /// Two bits: `MotionDepth`.
    pub const MOTION_DEPTH_SHIFT: u32 = 11;
    /// The camera looks along +z.
    pub const VIEW_POSITIVE_Z: u32 = 1 << 13;
    /// Roughness is GGX's α, the square of the perceptual one.
    pub const ROUGHNESS_ALPHA: u32 = 1 << 14;
    /// Two bits: the channel of roughness.
    pub const ROUGHNESS_CHANNEL_SHIFT: u32 = 17;
    /// Light comes divided by the albedo.
    pub const DEMODULATED: u32 = 1 << 19;
    /// The host re-shades the gradient samples of this frame.
    pub const RESHADED: u32 = 1 << 16;

    /// The bits of conventions, and of a reset.
    pub fn of(c: &Conventions, reset: bool) -> u32 {
        let bit = |on: bool, flag: u32| if on { flag } else { 0 };
        bit(reset, Self::RESET)
            | (c.depth as u32) << Self::DEPTH_SHIFT
            | (c.normal as u32) << Self::NORMAL_SHIFT
            | bit(c.normal_space == NormalSpace::View, Self::NORMAL_VIEW)
            | (c.motion_unit as u32) << Self::MOTION_UNIT_SHIFT
            | bit(c.motion_direction == MotionDirection::CurrentMinusPrevious, Self::MOTION_NEGATED)
            | bit(c.motion_y_up, Self::MOTION_Y_UP)
            | bit(c.motion_jittered, Self::MOTION_JITTERED)
            | (c.motion_depth as u32) << Self::MOTION_DEPTH_SHIFT
            | bit(c.view_forward == ViewForward::PositiveZ, Self::VIEW_POSITIVE_Z)
            | bit(c.roughness == RoughnessEncoding::Alpha, Self::ROUGHNESS_ALPHA)
            | (c.roughness_channel as u32) << Self::ROUGHNESS_CHANNEL_SHIFT
            | bit(c.demodulated, Self::DEMODULATED)
    }
}

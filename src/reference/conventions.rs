//! The host's encodings, read back from the flags of the uniform block.

use crate::config::{DepthEncoding, MotionDepth, MotionUnit, NormalEncoding};
use crate::{Flags, FrameConstants};

fn has(frame: &FrameConstants, flag: u32) -> bool {
    frame.flags & flag != 0
}

fn two_bits(frame: &FrameConstants, shift: u32) -> u32 {
    frame.flags >> shift & 3
}

/// Whether no previous image may be read.
pub(crate) fn is_reset(frame: &FrameConstants) -> bool {
    has(frame, Flags::RESET)
}

/// Whether the host re-shades the gradient samples.
pub(crate) fn is_reshaded(frame: &FrameConstants) -> bool {
    has(frame, Flags::RESHADED)
}

pub(crate) fn depth_encoding(frame: &FrameConstants) -> DepthEncoding {
    match two_bits(frame, Flags::DEPTH_SHIFT) {
        0 => DepthEncoding::Linear,
        1 => DepthEncoding::Device,
        _ => DepthEncoding::RayLength,
    }
}

pub(crate) fn normal_encoding(frame: &FrameConstants) -> NormalEncoding {
    match two_bits(frame, Flags::NORMAL_SHIFT) {
        0 => NormalEncoding::Xyz,
        1 => NormalEncoding::XyzUnorm,
        2 => NormalEncoding::Octahedral,
        _ => NormalEncoding::OctahedralUnorm,
    }
}

pub(crate) fn normals_are_in_view_space(frame: &FrameConstants) -> bool {
    has(frame, Flags::NORMAL_VIEW)
}

pub(crate) fn motion_unit(frame: &FrameConstants) -> MotionUnit {
    match two_bits(frame, Flags::MOTION_UNIT_SHIFT) {
        0 => MotionUnit::Pixels,
        1 => MotionUnit::Uv,
        _ => MotionUnit::Ndc,
    }
}

pub(crate) fn motion_is_negated(frame: &FrameConstants) -> bool {
    has(frame, Flags::MOTION_NEGATED)
}

pub(crate) fn motion_points_up(frame: &FrameConstants) -> bool {
    has(frame, Flags::MOTION_Y_UP)
}

pub(crate) fn motion_is_jittered(frame: &FrameConstants) -> bool {
    has(frame, Flags::MOTION_JITTERED)
}

pub(crate) fn motion_depth(frame: &FrameConstants) -> MotionDepth {
    match two_bits(frame, Flags::MOTION_DEPTH_SHIFT) {
        0 => MotionDepth::None,
        1 => MotionDepth::Difference,
        _ => MotionDepth::Absolute,
    }
}

/// The component of a texel of roughness that holds it.
pub(crate) fn roughness_channel(frame: &FrameConstants) -> usize {
    two_bits(frame, Flags::ROUGHNESS_CHANNEL_SHIFT) as usize
}

/// Whether light comes divided by the albedo.
pub(crate) fn is_demodulated(frame: &FrameConstants) -> bool {
    has(frame, Flags::DEMODULATED)
}

pub(crate) fn roughness_is_alpha(frame: &FrameConstants) -> bool {
    has(frame, Flags::ROUGHNESS_ALPHA)
}

/// z of view space along the view axis: −1 or +1.
pub(crate) fn forward(frame: &FrameConstants) -> f32 {
    if has(frame, Flags::VIEW_POSITIVE_Z) {
        1.0
    } else {
        -1.0
    }
}

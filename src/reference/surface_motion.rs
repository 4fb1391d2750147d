//! Packing of a surface's place in the previous frame.

use super::binary16::{from_half_bits, half_bits, LARGEST_HALF};
use super::octahedral::{octahedral8, octahedral8_to_normal};

/// Motion is clamped to ± this many pixels, which is beyond any image.
pub(crate) const LARGEST_MOTION: f32 = 16384.0;

/// A pixel of `surface_motion`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SurfaceMotion {
    /// Pixels of the previous frame: the surface of pixel p was at `(p + 0.5)·E'/E + motion`.
    pub motion: [f32; 2],
    /// Previous linear depth divided by linear depth, minus 1.
    pub depth_ratio: f32,
    /// The world-space unit normal that is expected in the previous frame.
    pub previous_normal: [f32; 3],
}

/// A texel of `surface_motion`; `surface` = (depth ratio, expected previous normal), `None` for the background, whose z and w are
/// 0.
pub(crate) fn pack_surface_motion(motion: [f32; 2], surface: Option<(f32, [f32; 3])>) -> [u16; 4] {
    let [x, y] = motion.map(|m| half_bits(m.clamp(-LARGEST_MOTION, LARGEST_MOTION)));
    match surface {
        Some((ratio, normal)) => [x, y, half_bits(ratio.clamp(-LARGEST_HALF, LARGEST_HALF)), octahedral8(normal)],
        None => [x, y, 0, 0],
    }
}

/// The content of a texel of `surface_motion`.
pub(crate) fn unpack_surface_motion(texel: [u16; 4]) -> SurfaceMotion {
    let [x, y, z, w] = texel;
    SurfaceMotion {
        motion: [from_half_bits(x), from_half_bits(y)],
        depth_ratio: from_half_bits(z),
        previous_normal: octahedral8_to_normal(w),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_survives_packing_and_is_clamped() {
        let texel = pack_surface_motion([1.5, -2.25], Some((0.125, [0.0, 0.0, -1.0])));
        let expected = SurfaceMotion { motion: [1.5, -2.25], depth_ratio: 0.125, previous_normal: [0.0, 0.0, -1.0] };
        assert_eq!(unpack_surface_motion(texel), expected);
        let far = unpack_surface_motion(pack_surface_motion([1e9, -1e9], Some((1e30, [0.0, 0.0, 1.0]))));
        assert_eq!((far.motion, far.depth_ratio), ([LARGEST_MOTION, -LARGEST_MOTION], LARGEST_HALF));
    }
}

//! What is seen in a glossy surface: how far behind it, and how wide its lobe is.

use super::binary16::{from_half_bits, half_bits, store};
use super::conventions::roughness_is_alpha;
use super::projection::pixel_size;
use crate::FrameConstants;

/// Hit distance that stands for what is beyond the scene.
pub const FARTHEST_HIT: f32 = 65504.0;

/// A pixel of `reflection*`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeenReflection {
    /// Distance from the surface to what is seen in it, scene units; 0: unknown.
    pub hit_distance: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
}

/// A texel of `reflection*`.
pub fn pack_reflection(reflection: &SeenReflection) -> u32 {
    let [distance, roughness] = [reflection.hit_distance, reflection.roughness].map(|x| u32::from(half_bits(store(x))));
    distance | roughness << 16
}

/// The content of a texel of `reflection*`.
pub fn unpack_reflection(texel: u32) -> SeenReflection {
    SeenReflection { hit_distance: from_half_bits(texel as u16), roughness: from_half_bits((texel >> 16) as u16) }
}

/// Whether a host's roughness is in range.
pub(crate) fn is_roughness(stored: f32) -> bool {
    (0.0..=1.0).contains(&stored)
}

/// Perceptual roughness of a host's; what is not finite is rough.
pub(crate) fn roughness_of(frame: &FrameConstants, stored: f32) -> f32 {
    let roughness = if stored.is_finite() { stored.clamp(0.0, 1.0) } else { 1.0 };
    if roughness_is_alpha(frame) {
        roughness.sqrt()
    } else {
        roughness
    }
}

/// Width α of the GGX distribution.
pub(crate) fn lobe_width(roughness: f32) -> f32 {
    roughness * roughness
}

/// Share of a lobe's light that moves as the image in a mirror does (Lagarde and de Rousiers 2014, the dominant direction of GGX).
pub(crate) fn mirror_share(roughness: f32) -> f32 {
    let width = lobe_width(roughness);
    let smoothness = 1.0 - width;
    (smoothness * (smoothness.sqrt() + width)).clamp(0.0, 1.0)
}

/// Pixels that a lobe covers at the distance of what is seen in it: of a perspective projection `α d / (z + d)` by its scale.
pub(crate) fn lobe_radius(frame: &FrameConstants, linear_depth: f32, seen: SeenReflection) -> f32 {
    if seen.hit_distance == 0.0 {
        return FARTHEST_HIT;
    }
    let pixel = pixel_size(frame, linear_depth + seen.hit_distance).y;
    (lobe_width(seen.roughness) * seen.hit_distance / pixel).min(FARTHEST_HIT)
}

/// Distance behind the surface of the image of what it mirrors: 1/d' = 1/d + 2κ, times the share that is mirrored.
pub(crate) fn image_distance(seen: SeenReflection, curvature: f32) -> f32 {
    seen.hit_distance * mirror_share(seen.roughness) / (1.0 + 2.0 * curvature * seen.hit_distance).max(0.1)
}

/// The hit distance as a share of the way from the eye; 0 of the background, too.
pub(crate) fn nearness(linear_depth: f32, hit_distance: f32) -> f32 {
    hit_distance / (linear_depth + hit_distance).max(1e-20)
}

/// The opposite of [`nearness`].
pub(crate) fn hit_distance_of(linear_depth: f32, nearness: f32) -> f32 {
    if nearness > 0.0 {
        (linear_depth * nearness / (1.0 - nearness).max(1e-6)).clamp(1.0 / 16384.0, FARTHEST_HIT)
    } else {
        0.0
    }
}

//! What is seen in a glossy surface: how far behind it, and how wide its lobe is.

use super::binary16::{from_half_bits, half_bits, store};
use super::conventions::roughness_is_alpha;
use super::projection::pixel_size;
use crate::FrameConstants;

/// Hit distance that stands for what is beyond the scene.
pub(crate) const FARTHEST_HIT: f32 = 65504.0;

/// The distance where a host does not know it, as where it has none at all.
pub(crate) const UNKNOWN_HIT: f32 = -1.0;

/// A pixel of `reflection*`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SeenReflection {
    /// Distance from the surface to what is seen in it, scene units; 0: unknown.
    pub hit_distance: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
}

const ROUGHNESS_STEPS: f32 = 1023.0;
const SHARE_STEPS: f32 = 62.0;

/// A texel of `reflection*`. `image_share`: how much of the past comes from where the image of what is seen was, 0 to 1, or how likely it
/// is that it is seen, where the hit distance is unknown; `None`: there is no past.
pub(crate) fn pack_reflection(reflection: &SeenReflection, image_share: Option<f32>) -> u32 {
    let steps = |x: f32, count: f32| (x.clamp(0.0, 1.0) * count + 0.5).floor() as u32;
    let share = image_share.map_or(0, |share| 1 + steps(share, SHARE_STEPS));
    u32::from(half_bits(store(reflection.hit_distance))) | steps(reflection.roughness, ROUGHNESS_STEPS) << 16 | share << 26
}

/// The content of a texel of `reflection*`.
pub(crate) fn unpack_reflection(texel: u32) -> SeenReflection {
    let roughness = (texel >> 16 & 0x3ff) as f32 / ROUGHNESS_STEPS;
    SeenReflection { hit_distance: from_half_bits(texel as u16), roughness }
}

/// How much of the past comes from where the image was; `None`: there is no past.
pub(crate) fn unpack_image_share(texel: u32) -> Option<f32> {
    (texel >> 26).checked_sub(1).map(|steps| steps as f32 / SHARE_STEPS)
}

/// The roughness where a host does not know it, as where it has none at all.
pub(crate) const UNKNOWN_ROUGHNESS: f32 = -1.0;

/// Whether a host's roughness is in range.
pub(crate) fn is_roughness(stored: f32) -> bool {
    stored == UNKNOWN_ROUGHNESS || (0.0..=1.0).contains(&stored)
}

/// Perceptual roughness of a host's; what is not known or not finite is rough.
pub(crate) fn roughness_of(frame: &FrameConstants, stored: f32) -> f32 {
    let is_known = stored.is_finite() && stored != UNKNOWN_ROUGHNESS;
    let roughness = if is_known { stored.clamp(0.0, 1.0) } else { 1.0 };
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

/// Of a lobe that explains half of the light: its width, and its radius in pixels, both squared.
const MIXED_WIDTH: f32 = 1e-3;
const MIXED_RADIUS: f32 = 4.0;

/// Roughness of diffuse and specular light together: the less of it the lobe explains, the wider the light may be blurred.
pub(crate) fn mixed_roughness(frame: &FrameConstants, linear_depth: f32, seen: SeenReflection, explained: f32) -> f32 {
    let width = lobe_width(seen.roughness);
    let pixels = lobe_radius(frame, linear_depth, SeenReflection { roughness: 1.0, ..seen });
    let share = explained.max(1e-3);
    let rest = MIXED_WIDTH + MIXED_RADIUS / (pixels * pixels).max(1e-6);
    (width * width / share + (1.0 / share - 1.0) * rest).min(1.0).powf(0.25)
}

/// Distance behind a mirror of the image of what it reflects: 1/d' = 1/d + 2κ. Convex surfaces pull it near.
pub(crate) fn mirror_image_distance(hit_distance: f32, curvature: f32) -> f32 {
    hit_distance / (1.0 + 2.0 * curvature * hit_distance).max(0.1)
}

/// The hit distance as a share of the way from the eye; 0 of the background, too.
pub(crate) fn nearness(linear_depth: f32, hit_distance: f32) -> f32 {
    hit_distance / (linear_depth + hit_distance).max(1e-20)
}

/// As [`nearness`], where what nobody knows may be beyond the scene.
pub(crate) fn reach(linear_depth: f32, hit_distance: f32) -> f32 {
    if hit_distance > 0.0 {
        nearness(linear_depth, hit_distance)
    } else {
        1.0
    }
}

/// The opposite of [`nearness`].
pub(crate) fn hit_distance_of(linear_depth: f32, nearness: f32) -> f32 {
    if nearness > 0.0 {
        (linear_depth * nearness / (1.0 - nearness).max(1e-6)).clamp(1.0 / 16384.0, FARTHEST_HIT)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reflection_survives_packing() {
        for (hit_distance, roughness, share) in
            [(0.0, 0.0, None), (2.0, 1.0, Some(0.0)), (FARTHEST_HIT, 0.3, Some(1.0)), (0.5, 0.7, Some(0.5))]
        {
            let texel = pack_reflection(&SeenReflection { hit_distance, roughness }, share);
            let seen = unpack_reflection(texel);
            assert_eq!((seen.hit_distance, unpack_image_share(texel)), (hit_distance, share));
            assert!((seen.roughness - roughness).abs() < 5e-4, "{roughness}: {seen:?}");
        }
        let texel = pack_reflection(&SeenReflection { hit_distance: 1e9, roughness: 7.0 }, Some(9.0));
        let seen = unpack_reflection(texel);
        assert_eq!((seen.hit_distance, seen.roughness, unpack_image_share(texel)), (FARTHEST_HIT, 1.0, Some(1.0)));
    }
}

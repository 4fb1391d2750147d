//! A texel of the history of the stage `temporal_upscale`.

use super::luminance::luminance;
use glam::Vec3;

/// A pixel of the output, as the next frame reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Kept {
    /// r/(1 + luminance(r)) of the radiance r divided by the light around. Components have 11 bits of the largest one.
    pub even: Vec3,
    /// Weight of what was gathered, 0 to 128. Its root has steps of 1/1023.
    pub weight: f32,
    /// Linear depth of the surface that it belongs to, with 8 bits of mantissa; 0: background.
    pub depth: f32,
}

impl Kept {
    /// Of a radiance over the light around.
    pub(crate) fn new(ratio: Vec3, weight: f32, depth: f32) -> Self {
        Self { even: ratio / (1.0 + luminance(ratio.to_array())), weight, depth }
    }
}

/// Radiance over the light around of one that is even.
pub(crate) fn ratio_of(even: Vec3) -> Vec3 {
    even / (1.0 - luminance(even.to_array())).max(LEAST_EVENNESS)
}

/// That of the brightest light.
const LEAST_EVENNESS: f32 = 1e-4;
const LARGEST_WEIGHT: f32 = 128.0;
const WEIGHT_STEPS: f32 = 1023.0;
/// Of the shared exponent, and so of numbers as large as those of a half.
const LEAST_EXPONENT: i32 = -15;
const LARGEST: f32 = 65504.0;
const MANTISSA_BITS: i32 = 11;

/// A texel of `upscale_history`.
pub(crate) fn pack_upscale_history(kept: &Kept) -> [u16; 4] {
    let c = kept.even.clamp(Vec3::ZERO, Vec3::splat(LARGEST));
    // The least power of two above the largest component.
    let exponent = ((c.max_element().to_bits() >> 23) as i32 - 126).max(LEAST_EXPONENT);
    let [r, g, b] = (c * 2.0_f32.powi(MANTISSA_BITS - exponent) + 0.5).to_array().map(|m| (m as u32).min(2047));
    let weight = ((kept.weight.min(LARGEST_WEIGHT) / LARGEST_WEIGHT).sqrt() * WEIGHT_STEPS + 0.5) as u32;
    let low = r | g << 11 | weight << 22;
    let high = b | ((exponent - LEAST_EXPONENT) as u32) << 11;
    [low as u16, (low >> 16) as u16, high as u16, ((kept.depth.to_bits() + 0x4000) >> 15) as u16]
}

/// The pixel of a texel of `upscale_history`.
pub(crate) fn unpack_upscale_history([x, y, z, w]: [u16; 4]) -> Kept {
    let low = u32::from(x) | u32::from(y) << 16;
    let mantissas = [low & 0x7ff, low >> 11 & 0x7ff, u32::from(z & 0x7ff)].map(|m| m as f32);
    let exponent = i32::from(z >> 11) + LEAST_EXPONENT;
    let root = (low >> 22) as f32 / WEIGHT_STEPS;
    Kept {
        even: Vec3::from(mantissas) * 2.0_f32.powi(exponent - MANTISSA_BITS),
        weight: root * root * LARGEST_WEIGHT,
        depth: f32::from_bits(u32::from(w) << 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stored(kept: Kept) -> Kept {
        unpack_upscale_history(pack_upscale_history(&kept))
    }

    #[test]
    fn what_is_kept_is_as_near_as_halves() {
        for scale in [1e-4, 0.02, 0.4, 1.0, 77.0, 60_000.0] {
            for (i, c) in [[1.0, 0.3, 0.07], [0.9, 0.9, 0.9], [0.0, 0.5, 0.999], [0.51, 0.0, 0.0]].into_iter().enumerate() {
                let kept = Kept { even: scale * Vec3::from(c), weight: 0.3 * (i * i * i * i) as f32, depth: scale * 3.0 };
                let back = stored(kept);
                let error = (back.even - kept.even).abs().max_element();
                assert!(error <= kept.even.max_element() / 2048.0, "{kept:?} {back:?}");
                assert!((back.weight - kept.weight).abs() <= 0.002 + 0.02 * kept.weight.sqrt(), "{kept:?} {back:?}");
                assert!((back.depth - kept.depth).abs() <= 0.002 * kept.depth, "{kept:?} {back:?}");
                assert_eq!(stored(back), back, "it stays");
            }
        }
        let absurd = stored(Kept { even: Vec3::splat(f32::MAX), weight: 1e9, depth: 0.0 });
        assert_eq!((absurd.weight, absurd.depth), (128.0, 0.0));
        assert!(absurd.even.min_element() > 65_000.0 && absurd.even.max_element() <= 65_536.0, "{absurd:?}");
    }
}

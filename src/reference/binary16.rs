//! Half precision, as the GPU's images store it.

use super::Image;
use half::f16;

/// The largest finite half; every store of irradiance is clamped to it.
pub(crate) const LARGEST_HALF: f32 = 65504.0;

/// `x` rounded to binary16, to nearest, ties to even. Beyond the range it becomes infinite.
pub(crate) fn round_to_half(x: f32) -> f32 {
    f16::from_f32(x).to_f32()
}

/// Every component rounded to binary16: what an RGBA16_SFLOAT image keeps of one that is wider.
pub(crate) fn round_image_to_half(image: &Image<[f32; 4]>) -> Image<[f32; 4]> {
    image.map(|texel| texel.map(round_to_half))
}

/// The value that a half-float image of irradiance, luminance or deviation keeps: clamped to 0..65504, NaN to 0, rounded to nearest, of
/// two the larger. `storable` of `glsl/include/luminance.glsl`.
pub(crate) fn store(x: f32) -> f32 {
    // `clamp` would pass a NaN on.
    if x.is_nan() {
        0.0
    } else {
        round_to_half(f32::from_bits((x.clamp(0.0, LARGEST_HALF).to_bits() + 0x1000) & 0xffff_e000))
    }
}

/// As [`store`], of light that may be less than nothing: a sharp look-up undershoots beside a bright pixel. `signed_storable` of
/// `glsl/include/luminance.glsl`.
pub(crate) fn store_signed(x: f32) -> f32 {
    store(x.abs()).copysign(x)
}

/// Clamped to what a half-float image can hold on either side of 0; NaN becomes 0. `signed_half_range` of
/// `glsl/include/luminance.glsl`.
pub(crate) fn signed_half_range(x: f32) -> f32 {
    if x.is_nan() {
        0.0
    } else {
        x.clamp(-LARGEST_HALF, LARGEST_HALF)
    }
}

/// The nearest number that a half holds, of two the larger, at most the largest one. `nearest_half` of
/// `glsl/include/kept_radiance.glsl`.
pub(crate) fn nearest_half(x: f32) -> f32 {
    const SMALLEST_NORMAL: f32 = 6.103_515_6e-5;
    const STEPS: f32 = 16_777_216.0;
    if x < SMALLEST_NORMAL {
        (x * STEPS + 0.5).floor() / STEPS
    } else {
        f32::from_bits((x.min(LARGEST_HALF).to_bits() + 0x1000) & 0xffff_e000)
    }
}

/// The bits of `x` as binary16.
pub(crate) fn half_bits(x: f32) -> u16 {
    f16::from_f32(x).to_bits()
}

/// The value of the bits of a binary16.
pub(crate) fn from_half_bits(bits: u16) -> f32 {
    f16::from_bits(bits).to_f32()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_to_nearest_even() {
        assert_eq!(round_to_half(1.0 + 1.0 / 2048.0), 1.0);
        assert_eq!(round_to_half(1.0 + 3.0 / 2048.0), 1.0 + 2.0 / 1024.0);
        assert_eq!(round_to_half(0.1), 0.099_975_586);
    }

    #[test]
    fn a_store_takes_the_larger_of_two_that_are_as_near() {
        assert_eq!(store(1.0 + 1.0 / 2048.0), 1.0 + 1.0 / 1024.0);
        assert_eq!(store(1.0 + 0.99 / 2048.0), 1.0);
    }

    #[test]
    fn the_nearest_half_is_a_half() {
        for x in [0.0, -1.0, 1e-8, 2.9e-8, 3e-8, 1e-6, 3e-5, 6.1e-5, 6.2e-5, 0.1, 1.0 + 1.0 / 2048.0, 777.7, 65504.0, 65519.0, 1e9]
        {
            let half = nearest_half(x);
            assert_eq!(round_to_half(half), half, "{x}");
            let difference = (half - x.min(LARGEST_HALF)).abs();
            assert!(difference <= (x.abs() / 2048.0).max(2f32.powi(-25)), "{x}: {half}");
        }
        assert_eq!(nearest_half(1.0 + 1.0 / 2048.0), 1.0 + 1.0 / 1024.0);
    }

    #[test]
    fn a_store_is_finite_and_not_negative() {
        for (x, kept) in
            [(f32::NAN, 0.0), (f32::INFINITY, LARGEST_HALF), (-1.0, 0.0), (1e9, LARGEST_HALF), (2.0, 2.0), (65503.0, LARGEST_HALF)]
        {
            assert_eq!(store(x), kept);
        }
    }
}

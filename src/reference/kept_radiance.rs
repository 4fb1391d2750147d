//! The noisy radiance that one frame keeps, so that the next one can tell how the light changed.

use super::binary16::{half_bits, nearest_half, LARGEST_HALF};
use super::luminance::luminance;
use super::Image;
use crate::FrameConstants;
use glam::IVec2;

/// Whether a texel holds a colour.
pub(crate) fn is_finite(texel: [f32; 4]) -> bool {
    texel[..3].iter().all(|c| c.is_finite())
}

/// Light of the host as the filter counts it. What is finite stays finite.
pub(crate) fn exposed(frame: &FrameConstants, [r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let [r, g, b] = [r, g, b].map(|c| (c * frame.filter_exposure).clamp(-3e38, 3e38));
    [r, g, b, a]
}

/// Radiance of all signals at a pixel, as the filter counts it; `None` where one is not finite, which says nothing of how bright the light
/// is.
pub(crate) fn kept_radiance(frame: &FrameConstants, noisy: &[&Image<[f32; 4]>], p: IVec2) -> Option<[f32; 3]> {
    noisy.iter().all(|noisy| is_finite(noisy.at(p))).then(|| finite_radiance(frame, noisy, p))
}

/// Radiance of all signals at a pixel, as the filter counts it, each 0 where it is not finite.
pub(crate) fn finite_radiance(frame: &FrameConstants, noisy: &[&Image<[f32; 4]>], p: IVec2) -> [f32; 3] {
    let signals = noisy.iter().map(|noisy| storable(frame, noisy.at(p)));
    signals.fold([0.0; 3], |sum, radiance| [0, 1, 2].map(|i| sum[i] + radiance[i]))
}

/// Radiance as the filter counts it and a half-float image holds it; black where it is not finite.
pub(crate) fn storable(frame: &FrameConstants, texel: [f32; 4]) -> [f32; 3] {
    let [r, g, b, _] = if is_finite(texel) { exposed(frame, texel) } else { [0.0; 4] };
    [r, g, b].map(|c| c.clamp(0.0, LARGEST_HALF))
}

/// Whether a half float cannot hold one of the components of a light.
pub(crate) fn is_saturated(light: [f32; 3]) -> bool {
    light.iter().any(|c| *c > LARGEST_HALF)
}

/// Luminance as a texel of `noisy_luminance` has it.
pub(crate) fn kept_luminance(radiance: [f32; 3]) -> f32 {
    nearest_half(luminance(radiance))
}

/// Red and blue as a texel of `noisy_red_blue` has them.
pub(crate) fn kept_red_blue([r, _, b]: [f32; 3]) -> [f32; 2] {
    [r, b].map(nearest_half)
}

/// The colour that has this luminance, and these components red and blue.
pub(crate) fn radiance_of(luminance: f32, [red, blue]: [f32; 2]) -> [f32; 3] {
    [red, ((luminance - 0.2126 * red - 0.0722 * blue) / 0.7152).max(0.0), blue]
}

/// Two numbers as the halves of a texel.
pub(crate) fn pack_halves([low, high]: [f32; 2]) -> u32 {
    u32::from(half_bits(nearest_half(low))) | u32::from(half_bits(nearest_half(high))) << 16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::{frame, paint};

    #[test]
    fn green_follows_of_luminance_red_and_blue() {
        for rgb in [[0.25, 0.5, 4.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0; 3]] {
            let back = radiance_of(luminance(rgb), [rgb[0], rgb[2]]);
            assert!((0..3).all(|i| (back[i] - rgb[i]).abs() < 1e-5), "{back:?} for {rgb:?}");
        }
        assert_eq!(radiance_of(0.1, [1.0, 0.0])[1], 0.0, "no colour is negative");
    }

    #[test]
    fn signals_are_added_and_of_what_is_not_finite_nothing_is_known() {
        let [good, bad] = [1.0, f32::NAN].map(|r| paint([1, 1], |_, _| [r, 2.0, 1e9, 0.0]));
        let frame = frame([1, 1]);
        assert_eq!(finite_radiance(&frame, &[&good, &bad, &good], IVec2::ZERO), [2.0, 4.0, 2.0 * LARGEST_HALF]);
        assert_eq!(kept_radiance(&frame, &[&good, &good], IVec2::ZERO), Some([2.0, 4.0, 2.0 * LARGEST_HALF]));
        assert_eq!(kept_radiance(&frame, &[&good, &bad, &good], IVec2::ZERO), None);
        let darker = FrameConstants { filter_exposure: 0.25, ..frame };
        assert_eq!(kept_radiance(&darker, &[&good], IVec2::ZERO), Some([0.25, 0.5, LARGEST_HALF]));
        assert_eq!(kept_red_blue([2.0, 4.0, 2.0 * LARGEST_HALF]), [2.0, LARGEST_HALF]);
    }
}

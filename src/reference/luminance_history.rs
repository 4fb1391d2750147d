//! Mean and deviation of luminance with the history length, packed.

use super::binary16::{from_half_bits, half_bits, round_to_half, store};
use super::Image;

/// The reason why a pixel has no history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u16)]
pub enum Reason {
    /// No reason: there is a history.
    #[default]
    None = 0,
    /// The surface was outside the previous image.
    OffScreen = 1,
    /// A different surface id, or the background, was there.
    Id = 2,
    /// The depth there was not the expected one.
    Depth = 3,
    /// The normal there was not the expected one.
    Normal = 4,
    /// A reset dropped all history.
    Reset = 5,
}

/// A pixel of `luminance_history*`. Mean and deviation rather than E\[l\] and E\[l²\]: their difference would cancel in half precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LuminanceHistory {
    /// Mean luminance of the irradiance over the history.
    pub mean: f32,
    /// Standard deviation of that luminance over the history, for one sample.
    pub deviation: f32,
    /// Frames accumulated.
    pub history_length: f32,
    /// A [`Reason`] as a number.
    pub reason: u16,
}

/// A texel of `luminance_history*`.
pub(crate) fn pack_luminance_history(luminance_history: &LuminanceHistory) -> [u16; 4] {
    let [mean, deviation, history_length] =
        [luminance_history.mean, luminance_history.deviation, luminance_history.history_length].map(|x| half_bits(store(x)));
    [mean, deviation, history_length, luminance_history.reason]
}

/// The content of a texel of `luminance_history*`.
pub fn unpack_luminance_history([mean, deviation, history_length, reason]: [u16; 4]) -> LuminanceHistory {
    LuminanceHistory {
        mean: from_half_bits(mean),
        deviation: from_half_bits(deviation),
        history_length: from_half_bits(history_length),
        reason,
    }
}

/// Luminance of this frame as the stage `temporal_accumulation` hands them on: mean and deviation in an image of their own, and in the
/// alpha of the irradiance the history length, or the negative reason of a loss, whose length is 1.
pub(crate) fn split_luminance_history(
    irradiance: &Image<[f32; 4]>,
    luminance_history: &Image<[u16; 4]>,
) -> (Image<[f32; 4]>, Image<u32>) {
    let accumulated = Image::compute(irradiance.extent(), irradiance.extent(), |p| {
        let ([r, g, b, _], m) = (irradiance.at(p), unpack_luminance_history(luminance_history.at(p)));
        [r, g, b, if m.reason == Reason::None as u16 { round_to_half(m.history_length) } else { -f32::from(m.reason) }]
    });
    (accumulated, luminance_history.map(|[mean, deviation, ..]| u32::from(*mean) | u32::from(*deviation) << 16))
}

/// The opposite of [`split_luminance_history`].
pub(crate) fn join_luminance_history(accumulated: &Image<[f32; 4]>, new_luminance: &Image<u32>) -> Image<[u16; 4]> {
    Image::compute(accumulated.extent(), accumulated.extent(), |p| {
        let (alpha, packed) = (accumulated.at(p)[3], new_luminance.at(p));
        let (history_length, reason) = if alpha < 0.0 { (1.0, -alpha as u16) } else { (alpha, Reason::None as u16) };
        [packed as u16, (packed >> 16) as u16, half_bits(history_length), reason]
    })
}

#[cfg(test)]
mod tests {
    use super::super::LARGEST_HALF;
    use super::*;

    #[test]
    fn moments_survive_packing() {
        let luminance_history = LuminanceHistory { mean: 3.5, deviation: 0.25, history_length: 17.0, reason: Reason::Depth as u16 };
        assert_eq!(unpack_luminance_history(pack_luminance_history(&luminance_history)), luminance_history);
        assert_eq!(
            unpack_luminance_history(pack_luminance_history(&LuminanceHistory { mean: f32::INFINITY, ..luminance_history })).mean,
            LARGEST_HALF
        );
    }

    #[test]
    fn moments_survive_the_way_from_stage_to_stage() {
        let kept = LuminanceHistory { mean: 3.5, deviation: 0.25, history_length: 17.5, reason: 0 };
        let lost = LuminanceHistory { history_length: 1.0, reason: Reason::Normal as u16, ..kept };
        let luminance_history =
            Image::from_texels([2, 1], vec![pack_luminance_history(&kept), pack_luminance_history(&lost)]).expect("two texels");
        let (accumulated, new_luminance) = split_luminance_history(&Image::new([2, 1], [1.0, 2.0, 3.0, 9.0]), &luminance_history);
        assert_eq!(accumulated.texels(), [[1.0, 2.0, 3.0, 17.5], [1.0, 2.0, 3.0, -4.0]]);
        assert_eq!(join_luminance_history(&accumulated, &new_luminance), luminance_history);
    }
}

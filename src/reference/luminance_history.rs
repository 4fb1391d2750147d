//! Mean and deviation of luminance with the history length, packed.

use super::binary16::{from_half_bits, half_bits, round_to_half, store};
use super::bindings::Bindings;
use super::guide::pcg;
use super::Image;
use crate::Error;
use glam::IVec2;

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
    /// Within a frame, of a history of one frame: how far its sample lies outside of its past, as a deviation. Where it is told,
    /// `deviation` is 0.
    pub(crate) outside: Option<f32>,
}

impl LuminanceHistory {
    /// As stages hand it on within a frame.
    pub(crate) fn in_halves(self) -> Self {
        let [mean, deviation, history_length] = [self.mean, self.deviation, self.history_length].map(store);
        Self { mean, deviation, history_length, outside: self.outside.map(store), ..self }
    }
}

/// The code of a length is the upper part of its half, of which the smallest is this one, 1/16 of a frame; 0: none.
const SHORTEST_LENGTH: u32 = 351;

/// Codes above this one are reasons of a loss.
const NO_REASON_CODE: u32 = 506;

/// Of a history of one frame whose detail is told in the place of a deviation.
const DETAIL_CODE: u32 = NO_REASON_CODE;

/// Half of the steps of that detail.
const DETAIL_STEPS: f32 = 511.5;

/// A half without its sign and its lowest bits. They are rounded up as often as they would fill the next step: small weights add up so.
fn upper_bits(x: f32, dropped: u32, random: u32) -> u32 {
    let bits = u32::from(half_bits(store(x)) & 0x7fff) + (random & ((1 << dropped) - 1));
    bits.min(0x7bff) >> dropped
}

fn from_upper_bits(bits: u32, dropped: u32) -> f32 {
    from_half_bits((bits << dropped) as u16)
}

/// The texel `p` of `luminance_history*`. What is rounded decides how, with its pixel, and not the number of the frame. Of mean and
/// deviation all but the lowest bits decide: two devices that differ by a step of a half mostly agree.
pub(crate) fn pack_luminance_history(m: &LuminanceHistory, p: IVec2) -> u32 {
    let m = &LuminanceHistory { outside: None, ..*m };
    let (pixel, new) = (p.x as u32 | (p.y as u32) << 16, new_luminance(m));
    let random = pcg(pixel.wrapping_add(pcg((new & 0xffe0_fff8).wrapping_add(half_bits(length_or_reason(m)).into()))));
    let code = match m.reason {
        0 => upper_bits(m.history_length, 5, pcg(pixel.wrapping_add(pcg(new)))).saturating_sub(SHORTEST_LENGTH),
        reason => NO_REASON_CODE + u32::from(reason),
    };
    upper_bits(m.mean, 2, random) << 19 | upper_bits(m.deviation, 5, random >> 2) << 9 | code
}

/// A texel of `luminance_history*` that tells the detail around its pixel: a share from -1 to 1, of which noise explains the rest.
pub(crate) fn with_detail(packed: u32, detail: f32) -> u32 {
    packed & 0xfff8_0000 | ((DETAIL_STEPS * detail + 512.0) as u32) << 9 | DETAIL_CODE
}

/// That detail, where a texel tells it.
pub(crate) fn detail_of(packed: u32) -> Option<f32> {
    (packed & 511 == DETAIL_CODE).then(|| (packed >> 9 & 1023) as f32 / DETAIL_STEPS - 1.0)
}

/// The content of a texel of `luminance_history*`, but for the detail around the pixel.
pub fn unpack_luminance_history(packed: u32) -> LuminanceHistory {
    let (history_length, reason) = match packed & 511 {
        0 => (0.0, 0),
        DETAIL_CODE => (1.0, 0),
        code if code > NO_REASON_CODE => (1.0, (code - NO_REASON_CODE) as u16),
        code => (from_upper_bits(code + SHORTEST_LENGTH, 5), 0),
    };
    LuminanceHistory {
        mean: from_upper_bits(packed >> 19, 2),
        deviation: if detail_of(packed).is_some() { 0.0 } else { from_upper_bits(packed >> 9 & 1023, 5) },
        history_length,
        reason,
        outside: None,
    }
}

/// The image `luminance_history*` of a signal, unpacked.
pub(crate) fn luminance_history_of(packed: &Image<u32>) -> Image<LuminanceHistory> {
    packed.map(|texel| unpack_luminance_history(*texel))
}

/// `luminance_history*` of every signal of a pass, unpacked.
pub(crate) fn luminance_histories(b: &Bindings, name: &str) -> Result<Vec<Image<LuminanceHistory>>, Error> {
    Ok(b.uints(name)?.into_iter().map(luminance_history_of).collect())
}

/// Luminance of this frame as the stage `temporal_accumulation` hands them on: mean and deviation in an image of their own, and in the
/// alpha of the irradiance the history length, or the negative reason of a loss, whose length is 1.
pub(crate) fn split_luminance_history(
    irradiance: &Image<[f32; 4]>,
    luminance_history: &Image<LuminanceHistory>,
) -> (Image<[f32; 4]>, Image<u32>) {
    let accumulated = Image::compute(irradiance.extent(), irradiance.extent(), |p| {
        let ([r, g, b, _], m) = (irradiance.at(p), luminance_history.at(p));
        [r, g, b, round_to_half(length_or_reason(&m))]
    });
    (accumulated, luminance_history.map(new_luminance))
}

/// How far a sample lies outside of its past is in the place of the deviation, negative and never 0.
const LEAST_OUTSIDE: f32 = 1.0 / 16384.0;

fn length_or_reason(m: &LuminanceHistory) -> f32 {
    match m.reason {
        0 => m.history_length,
        reason => -f32::from(reason),
    }
}

fn new_luminance(m: &LuminanceHistory) -> u32 {
    let second = m.outside.map_or(half_bits(store(m.deviation)), |outside| half_bits(-store(outside.max(LEAST_OUTSIDE))));
    u32::from(half_bits(store(m.mean))) | u32::from(second) << 16
}

/// The opposite of [`split_luminance_history`].
pub(crate) fn join_luminance_history(accumulated: &Image<[f32; 4]>, new_luminance: &Image<u32>) -> Image<LuminanceHistory> {
    Image::compute(accumulated.extent(), accumulated.extent(), |p| {
        let (alpha, packed) = (accumulated.at(p)[3], new_luminance.at(p));
        let (history_length, reason) = if alpha < 0.0 { (1.0, -alpha as u16) } else { (alpha, Reason::None as u16) };
        let [mean, second] = [packed as u16, (packed >> 16) as u16].map(from_half_bits);
        let (deviation, outside) = if second < 0.0 { (0.0, Some(-second)) } else { (second, None) };
        LuminanceHistory { mean, deviation, history_length, reason, outside }
    })
}

#[cfg(test)]
mod tests {
    use super::super::LARGEST_HALF;
    use super::*;

    /// As the pixels of a picture keep it.
    fn packed(m: LuminanceHistory) -> impl Iterator<Item = LuminanceHistory> {
        let pixels = (0..64).flat_map(|y| (0..64).map(move |x| IVec2::new(x, y)));
        pixels.map(move |p| unpack_luminance_history(pack_luminance_history(&m, p)))
    }

    #[test]
    fn what_fits_survives_packing_in_every_pixel() {
        for history_length in [0.0, 0.5, 1.0, 17.0, 63.0, 256.0, 1024.0] {
            let kept = LuminanceHistory { mean: 3.5, deviation: 0.25, history_length, reason: 0, outside: None };
            let lost = LuminanceHistory { history_length: 1.0, reason: Reason::Depth as u16, ..kept };
            assert!(packed(kept).all(|m| m == kept) && packed(lost).all(|m| m == lost));
        }
        let endless = LuminanceHistory { mean: f32::INFINITY, deviation: LARGEST_HALF, ..LuminanceHistory::default() };
        assert!(packed(endless).all(|m| m.mean > 65000.0 && m.mean.is_finite() && m.deviation.is_finite()));
    }

    #[test]
    fn detail_stands_in_the_place_of_a_deviation() {
        let one = LuminanceHistory { mean: 3.5, deviation: 0.0, history_length: 1.0, reason: 0, outside: None };
        let texel = pack_luminance_history(&one, IVec2::new(3, 4));
        for detail in [-1.0, -0.999, -0.5, 0.0, 0.123, 0.999, 1.0] {
            let told = with_detail(texel, detail);
            assert_eq!(unpack_luminance_history(told), one, "{detail}");
            assert!((detail_of(told).expect("told") - detail).abs() <= 0.501 / DETAIL_STEPS, "{detail}");
        }
        let others = [
            one,
            LuminanceHistory { history_length: 0.0, ..one },
            LuminanceHistory { history_length: 1024.0, deviation: 2.0, ..one },
            LuminanceHistory { reason: Reason::OffScreen as u16, ..one },
            LuminanceHistory { reason: Reason::Reset as u16, ..one },
        ];
        assert!(others.iter().all(|m| detail_of(pack_luminance_history(m, IVec2::ZERO)).is_none()));
    }

    #[test]
    fn small_steps_add_up_over_pixels() {
        let m = LuminanceHistory { mean: 1.003, deviation: 0.111, history_length: 301.0, reason: 0, outside: None }.in_halves();
        let mean = |of: fn(LuminanceHistory) -> f32| packed(m).map(of).sum::<f32>() / 4096.0;
        let means = [mean(|m| m.mean), mean(|m| m.deviation), mean(|m| m.history_length)];
        for (given, [expected, step]) in means.into_iter().zip([[m.mean, 1.0 / 256.0], [m.deviation, 1.0 / 512.0], [301.0, 8.0]]) {
            assert!((given - expected).abs() < 0.03 * step, "{given} for {expected}");
        }
    }

    #[test]
    fn moments_survive_the_way_from_stage_to_stage() {
        let kept = LuminanceHistory { mean: 3.5, deviation: 0.25, history_length: 17.5, reason: 0, outside: None };
        let lost = LuminanceHistory { history_length: 1.0, reason: Reason::Normal as u16, ..kept };
        let luminance_history = Image::from_texels([2, 1], vec![kept, lost]).expect("two texels");
        let (accumulated, new_luminance) = split_luminance_history(&Image::new([2, 1], [1.0, 2.0, 3.0, 9.0]), &luminance_history);
        assert_eq!(accumulated.texels(), [[1.0, 2.0, 3.0, 17.5], [1.0, 2.0, 3.0, -4.0]]);
        assert_eq!(join_luminance_history(&accumulated, &new_luminance), luminance_history);
    }

    #[test]
    fn how_far_a_sample_lies_outside_of_its_past_lasts_for_a_frame() {
        let of = |outside| LuminanceHistory { mean: 2.0, history_length: 1.0, outside, ..LuminanceHistory::default() };
        let handed_on = |outside| {
            let image = Image::new([1, 1], of(outside));
            let (accumulated, new_luminance) = split_luminance_history(&Image::new([1, 1], [2.0; 4]), &image);
            join_luminance_history(&accumulated, &new_luminance).texels()[0]
        };
        assert_eq!(handed_on(Some(0.75)), of(Some(0.75)));
        assert_eq!(handed_on(Some(0.0)), of(Some(LEAST_OUTSIDE)), "told, and not 0");
        assert_eq!(handed_on(None), of(None));
        assert!(packed(of(Some(0.75))).all(|m| m == of(None)), "no deviation of the next frame's past");
    }
}

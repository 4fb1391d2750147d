//! The stage `filter_exposure`: the power of 2 by which light is multiplied in the filter. Equal to the bit on every device.

use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::conventions::is_reset;
use crate::reference::rules::{rule, EXACT};
use crate::reference::{Image, Texels};
use crate::{Error, FrameConstants};
use glam::{IVec2, UVec2};

/// Pixels looked at along either side.
const SIDE: u32 = 64;
/// Powers of 2 that the mean may be away from 1 before the exposure changes.
const BAND: i32 = 6;
/// More where it is dark: a brighter filter leaves less room for a sky or a lamp that is seen directly.
const DARK_BAND: i32 = 10;
const LARGEST: i32 = 40;
/// Darker is black.
const DARKEST: f32 = 1e-36;
/// Added to an exponent in its texel.
const OFFSET: i32 = 128;

/// The exponent of the exposure of this frame, after that of the frame before.
pub(crate) fn filter_exposure(frame: &FrameConstants, noisy: &[&Image<[f32; 4]>], before: i32) -> i32 {
    let extent = UVec2::from(frame.render_extent);
    let cells = extent.min(UVec2::splat(SIDE));
    let places = (0..cells.y).flat_map(|y| (0..cells.x).map(move |x| UVec2::new(x, y)));
    let pixels = places.map(|cell| ((2 * cell + 1) * extent / (2 * cells)).as_ivec2());
    let exponents: Vec<i32> = pixels.flat_map(|p| noisy.iter().filter_map(move |noisy| exponent(noisy.at(p)))).collect();
    let (sum, count) = (exponents.iter().sum::<i32>(), exponents.len() as i32);
    if count == 0 || (-DARK_BAND * count..=BAND * count).contains(&(sum + before * count)) {
        return before;
    }
    let mean = (f64::from(sum) / f64::from(count) + 0.5).floor() as i32;
    (-mean).clamp(-LARGEST, LARGEST)
}

/// log2 of the luminance, rounded down; `None` where it is black or not finite.
fn exponent([r, g, b, _]: [f32; 4]) -> Option<i32> {
    if ![r, g, b].iter().all(|c| c.is_finite()) {
        return None;
    }
    let [r, g, b] = [r, g, b].map(|c| c.clamp(0.0, 1e38));
    let luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    (luminance >= DARKEST).then(|| (luminance.to_bits() >> 23) as i32 - 127)
}

/// The constants of a frame with an exposure, after that of the frame before.
fn exposed(frame: &FrameConstants, now: i32, before: i32) -> FrameConstants {
    let power = |exponent: i32| (f64::from(exponent)).exp2() as f32;
    FrameConstants {
        filter_exposure: power(now),
        inverse_filter_exposure: power(-now),
        exposure_ratio: (frame.exposure_ratio * power(now - before)).min(3e38),
        ..*frame
    }
}

/// How what it writes is compared with the GPU: to the bit.
pub(crate) const RULES: &[Rule] =
    &[rule("exposure", Unit::Frame, Reading::Plain, EXACT), rule("frame", Unit::Buffer, Reading::Plain, EXACT)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let signals = ["noisy_0", "noisy_1", "noisy_2"].into_iter().filter_map(|name| b.optional_colour(name).transpose());
    let noisy = signals.collect::<Result<Vec<_>, _>>()?;
    let before = if is_reset(b.frame) { 0 } else { b.uint("previous_exposure")?.at(IVec2::ZERO) as i32 - OFFSET };
    let now = filter_exposure(b.frame, &noisy, before);
    let frame = exposed(b.frame, now, before);
    b.write("exposure", Image::new(b.extent_of("exposure")?, (now + OFFSET) as u32))?;
    b.write("frame", Texels::Bytes(bytemuck::bytes_of(&frame).to_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;

    const EXTENT: [u32; 2] = [90, 50];

    fn chosen(noisy: &Image<[f32; 4]>, before: i32) -> i32 {
        filter_exposure(&frame(EXTENT), &[noisy], before)
    }

    #[test]
    fn light_around_1_is_left_as_it_is_and_other_light_comes_near() {
        for (l, expected) in
            [(1.0, 0), (0.02, 0), (0.002, 0), (60.0, 0), (1e-6, 20), (1e7, -23), (0.0, 0), (3e38, -40), (1e-30, 40)]
        {
            assert_eq!(chosen(&Image::new(EXTENT, [l; 4]), 0), expected, "{l}");
        }
    }

    #[test]
    fn it_stays_while_light_stays_near_and_in_the_dark() {
        for (l, before, expected) in [(1e-6, 20, 20), (1e-5, 20, 20), (1e-3, 20, 10), (0.0, 20, 20), (f32::NAN, 7, 7), (1.0, 6, 6)]
        {
            assert_eq!(chosen(&Image::new(EXTENT, [l; 4]), before), expected, "{l} after {before}");
        }
    }

    #[test]
    fn a_few_bright_samples_and_black_ones_do_not_count_for_more_than_others() {
        let rare = paint(EXTENT, |x, y| match (x + y * 7) % 50 {
            0 => [1e9; 4],
            1 => [f32::INFINITY; 4],
            i if i % 3 == 0 => [0.0; 4],
            _ => [0.5; 4],
        });
        assert_eq!(chosen(&rare, 0), 0);
    }

    #[test]
    fn the_history_follows() {
        let next = exposed(&FrameConstants { exposure_ratio: 3.0, ..frame(EXTENT) }, 4, 1);
        assert_eq!((next.filter_exposure, next.inverse_filter_exposure, next.exposure_ratio), (16.0, 1.0 / 16.0, 24.0));
    }
}

//! Rules by which the output of the GPU counts as equal to that of the twin.

use super::binary16::from_half_bits;
use super::blocks::{BLOCK_SIZE, CELL_SIZE};
use super::both_confidences::specular_confidence;
use super::guide::unpack_guide;
use super::luminance_history::{detail_of, unpack_luminance_history};
use super::octahedral::octahedral10_to_normal;
use super::rare_light::is_rare;
use super::reflection::{unpack_image_share, unpack_reflection};
use super::surface_motion::unpack_surface_motion;
use super::texels::Texels;
use super::upscale_history::unpack_upscale_history;
use super::visibility::unpack_visibility;
use crate::nodes::block_difference::twin::unpack_difference;
use glam::IVec2;

/// The difference that two values may have, and the share of texels that may differ by more, since a test against a threshold fell
/// the other way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance {
    /// Share of the larger value.
    pub relative: f32,
    /// Absolute difference that is added, in the unit of the value.
    pub absolute: f32,
    /// Share of the texels that exist.
    pub outliers: f32,
}

/// A slope below which no direction is compared: depth per pixel, over the depth.
const FLAT: f32 = 2e-3;

/// The reading of a texel as numbers that can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reading {
    /// The values as they are: floats, or packed bits 16 at a time.
    Plain,
    /// Red, green and blue alone.
    Rgb,
    /// Whether the deviation in alpha says that light is rare.
    RareLight,
    /// The confidence of specular light beside that of diffuse light.
    SpecularConfidence,
    /// Words of a buffer, 32 bits each.
    Counts,
    /// A texel as two or four halves.
    Halves,
    /// Light now and before, deviation, pixels and both noises of `block_difference*`.
    BlockDifference,
    /// Depth, normal, id and darkness.
    Guide,
    /// The gradient of the depth, over the depth: sum of its components, and each over that sum.
    GuideGradient,
    /// Motion and depth ratio of `surface_motion`.
    SurfaceMotion,
    /// The normal of `surface_motion`. All bits 0, which stand where there is no surface, are one of four ways to say −z.
    PreviousNormal,
    /// Even light, root of the weight and depth of `upscale_history`.
    UpscaleHistory,
    /// A packed normal.
    Normal,
    /// Mean, deviation, history length and reason.
    LuminanceHistory,
    /// The detail that `luminance_history*` tells, -1 where it tells none.
    Detail,
    /// Mean of `visibility_history`.
    Visibility,
    /// Hit distance and roughness of `reflection*`.
    Reflection,
    /// Share of the past of `reflection*` that comes from the image, −1 without a past.
    ImageShare,
    /// Green and blue means of `history_colours`.
    VisibilityColours,
    /// Steps of the deviation, of the history length and of the distance of `visibility_history`.
    VisibilitySteps,
}

/// The unit that an image has a texel for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    /// Every pixel.
    Pixel,
    /// Every 8×8 pixels.
    Block,
    /// Every 4×4 pixels.
    Cell,
    /// Every stratum.
    Stratum,
    /// The frame: it is a single texel.
    Frame,
    /// No unit: it is a buffer, and every byte counts.
    Buffer,
}

/// The passes of a stage for which a rule holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Condition {
    /// All passes.
    Always,
    /// Passes whose specialisation constant has this value.
    Is(&'static str, u32),
    /// Passes whose specialisation constant has another value.
    IsNot(&'static str, u32),
    /// Passes whose specialisation constants are both off.
    Neither([&'static str; 2]),
}

/// The rule by which one binding that a stage writes is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rule {
    /// Name of the binding.
    pub binding: &'static str,
    /// The unit that it has a texel for.
    pub per: Unit,
    /// The reading of a texel as numbers.
    pub values: Reading,
    /// The difference that they may have.
    pub tolerance: Tolerance,
    /// The passes for which it holds.
    pub when: Condition,
}

/// Words of a texel of [`Texels::Wide`].
const MOST_WORDS: usize = 4;

impl Rule {
    /// Whether it holds for a pass with these specialisation constants.
    pub(crate) fn holds(&self, constants: &[(&str, u32)]) -> bool {
        let value = |name: &str| constants.iter().find(|c| c.0 == name).map(|c| c.1);
        match self.when {
            Condition::Always => true,
            Condition::Is(name, wanted) => value(name) == Some(wanted),
            Condition::IsNot(name, other) => value(name) != Some(other),
            Condition::Neither(names) => names.iter().all(|name| value(name) != Some(1)),
        }
    }

    /// Compares over the part of the image that a frame of `render_extent` pixels fills. Both must be finite there.
    ///
    /// # Errors
    /// A message with the number of texels that differ, and the first of them.
    pub(crate) fn compare(&self, stratum_size: u32, render_extent: [u32; 2], gpu: &Texels, twin: &Texels) -> Result<(), String> {
        let (what, kinds) = (self.binding, [gpu.kind(), twin.kind()]);
        if kinds[0] != kinds[1] || gpu.extent() != twin.extent() {
            let (a, b) = (gpu.extent(), twin.extent());
            return Err(format!("{what}: the GPU wrote {} of {a:?}, the twin {} of {b:?}", kinds[0], kinds[1]));
        }
        let extent = match self.per {
            Unit::Pixel => render_extent,
            Unit::Block => render_extent.map(|side| side.div_ceil(BLOCK_SIZE)),
            Unit::Cell => render_extent.map(|side| side.div_ceil(CELL_SIZE)),
            Unit::Stratum => render_extent.map(|side| side.div_ceil(stratum_size.max(1))),
            Unit::Frame => [1, 1],
            Unit::Buffer => gpu.extent(),
        };
        // Each light of several has a word, to which the bound applies as to the texel of one.
        let words = if matches!(gpu, Texels::Wide(_)) { MOST_WORDS } else { 1 };
        let (mut differ, mut first) = ([0_usize; MOST_WORDS], None);
        for y in 0..extent[1] as i32 {
            for x in 0..extent[0] as i32 {
                let p = IVec2::new(x, y);
                let (a, b) = (self.values.of(gpu, p), self.values.of(twin, p));
                let of_words = a.chunks(a.len() / words).zip(b.chunks(b.len() / words));
                for (count, (a_word, b_word)) in differ.iter_mut().zip(of_words) {
                    if !self.tolerance.admits(a_word, b_word) {
                        *count += 1;
                        first.get_or_insert((x, y, a, b));
                    }
                }
            }
        }
        let differ = differ.into_iter().max().unwrap_or(0);
        let allowed = (self.tolerance.outliers * (extent[0] * extent[1]) as f32).ceil() as usize;
        match first {
            Some((x, y, a, b)) if differ > allowed => Err(format!(
                "{what}: {differ} texels of {extent:?} differ, {allowed} may; the first at {x},{y}: GPU {a:?}, twin {b:?}"
            )),
            _ => Ok(()),
        }
    }
}

impl Tolerance {
    fn admits(&self, a: &[f32], b: &[f32]) -> bool {
        a.iter().zip(b).all(|(a, b)| {
            let limit = self.absolute + self.relative * a.abs().max(b.abs());
            a.is_finite() && b.is_finite() && (a - b).abs() <= limit
        })
    }
}

/// The numbers of a texel; those that it does not have are 0.
type Numbers = [f32; 12];

fn padded<const N: usize>(values: [f32; N]) -> Numbers {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

impl Reading {
    /// The numbers of the texel at `p`.
    fn of(self, texels: &Texels, p: IVec2) -> Numbers {
        match texels {
            Texels::Colour(image) if self == Self::Rgb => {
                let [r, g, b, _] = image.at(p);
                padded([r, g, b])
            }
            Texels::Colour(image) if self == Self::RareLight => padded([is_rare(image.at(p)[3]).into()]),
            Texels::Colour(image) => padded(image.at(p)),
            Texels::Scalar(image) if self == Self::SpecularConfidence => padded([specular_confidence(image.at(p))]),
            Texels::Scalar(image) => padded([image.at(p)]),
            Texels::Packed(image) => self.of_packed(image.at(p)),
            Texels::Uint(image) => self.of_uint(image.at(p)),
            Texels::Wide(image) if self == Self::BlockDifference => {
                let d = unpack_difference(image.at(p));
                let ([r, g, b], [before_r, before_g, before_b]) = (d.now, d.before);
                padded([r, g, b, before_r, before_g, before_b, d.deviation, d.count, d.noise, d.past_noise])
            }
            Texels::Wide(image) => {
                // Three numbers of a word at most.
                let words = image.at(p).map(|word| self.of_uint(word));
                std::array::from_fn(|i| words[i / 3][i % 3])
            }
            Texels::Bytes(bytes) if self == Self::Counts => {
                // Once a word: at its first byte.
                let word = bytes.get(p.x as usize..p.x as usize + 4).filter(|_| p.x % 4 == 0);
                padded([word.map_or(0.0, |word| bytemuck::pod_read_unaligned::<u32>(word) as f32)])
            }
            Texels::Bytes(bytes) => padded([bytes.get(p.x as usize).copied().map_or(0.0, f32::from)]),
        }
    }

    fn of_packed(self, texel: [u16; 4]) -> Numbers {
        match self {
            Self::Guide => {
                let s = unpack_guide(texel);
                let [x, y, z] = s.normal;
                padded([s.linear_depth, x, y, z, s.id.into(), s.is_apart.into()])
            }
            Self::GuideGradient => {
                let s = unpack_guide(texel);
                let [x, y] = s.gradient.map(|g| g / s.linear_depth.max(f32::MIN_POSITIVE));
                let sum = x.abs() + y.abs();
                padded([sum, x / sum.max(FLAT), y / sum.max(FLAT)])
            }
            Self::SurfaceMotion => {
                let m = unpack_surface_motion(texel);
                padded([m.motion[0], m.motion[1], m.depth_ratio])
            }
            Self::PreviousNormal => padded(unpack_surface_motion(texel).previous_normal),
            Self::UpscaleHistory => {
                let kept = unpack_upscale_history(texel);
                padded([kept.even.x, kept.even.y, kept.even.z, kept.weight.sqrt(), kept.depth])
            }
            Self::Halves => padded(texel.map(from_half_bits)),
            _ => padded(texel.map(f32::from)),
        }
    }

    fn of_uint(self, texel: u32) -> Numbers {
        let parts = [texel as u16, (texel >> 16) as u16];
        match self {
            Self::Normal => padded(octahedral10_to_normal(texel)),
            Self::Halves => padded(parts.map(from_half_bits)),
            Self::Reflection => {
                let seen = unpack_reflection(texel);
                padded([seen.hit_distance, seen.roughness])
            }
            Self::LuminanceHistory => {
                let m = unpack_luminance_history(texel);
                padded([m.mean, m.deviation, m.history_length, m.reason.into()])
            }
            Self::Detail => padded([detail_of(texel).unwrap_or(-1.0)]),
            Self::ImageShare => padded([unpack_image_share(texel).unwrap_or(-1.0)]),
            Self::Visibility => padded([unpack_visibility(texel, None).mean[0]]),
            Self::VisibilityColours => {
                let [_, green, blue] = unpack_visibility(0, Some(texel)).mean;
                padded([green, blue])
            }
            Self::VisibilitySteps => padded([(texel >> 12 & 0x3f) as f32, (texel >> 18 & 0x3f) as f32, (texel >> 24) as f32]),
            _ => padded(parts.map(f32::from)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Image;
    use super::*;

    fn rule(tolerance: Tolerance) -> Rule {
        Rule { binding: "output_0", per: Unit::Pixel, values: Reading::Plain, tolerance, when: Condition::Always }
    }

    const EXACT: Tolerance = Tolerance { relative: 0.0, absolute: 0.0, outliers: 0.0 };

    fn with_change(x: i32, y: i32, value: f32) -> Texels {
        let mut image = Image::new([8, 8], 1.0);
        *image.get_mut(x, y).expect("inside") = value;
        Texels::Scalar(image)
    }

    #[test]
    fn only_what_the_frame_fills_counts() {
        let (plain, changed) = (with_change(0, 0, 1.0), with_change(5, 1, 1.5));
        assert!(rule(EXACT).compare(1, [5, 8], &plain, &changed).is_ok());
        let message = rule(EXACT).compare(1, [6, 8], &plain, &changed).expect_err("one texel");
        assert!(message.contains("5,1") && message.contains("1 texels"), "{message}");
        let strata = Rule { per: Unit::Stratum, ..rule(EXACT) };
        assert!(strata.compare(3, [15, 6], &plain, &changed).is_ok());
        assert!(strata.compare(3, [16, 6], &plain, &changed).is_err());
    }

    #[test]
    fn a_tolerance_is_relative_absolute_and_a_share() {
        let plain = with_change(0, 0, 1.0);
        let within = |tolerance, value| rule(tolerance).compare(1, [8, 8], &plain, &with_change(3, 3, value)).is_ok();
        let relative = Tolerance { relative: 0.1, ..EXACT };
        assert!(within(relative, 1.1) && !within(relative, 1.2));
        let absolute = Tolerance { absolute: 0.25, ..EXACT };
        assert!(within(absolute, 1.25) && !within(absolute, 1.3));
        let outliers = Tolerance { outliers: 0.01, ..EXACT };
        assert!(within(outliers, 9.0) && !within(EXACT, 9.0));
        assert!(!within(Tolerance { absolute: f32::MAX, ..EXACT }, f32::NAN));
    }

    #[test]
    fn every_bit_of_a_packed_texel_counts() {
        for bit in 0..32 {
            let texel = |bits| Texels::Uint(Image::new([1, 1], bits));
            assert!(rule(EXACT).compare(1, [1, 1], &texel(0x9e37_79b9), &texel(0x9e37_79b9 ^ (1 << bit))).is_err(), "{bit}");
        }
    }

    #[test]
    fn a_kind_or_an_extent_that_differs_is_an_error() {
        let (a, b) = (Texels::Uint(Image::new([2, 2], 0)), Texels::Scalar(Image::new([2, 2], 0.0)));
        assert!(rule(EXACT).compare(1, [1, 1], &a, &b).is_err());
        assert!(rule(EXACT).compare(1, [1, 1], &a, &Texels::Uint(Image::new([2, 1], 0))).is_err());
    }
}

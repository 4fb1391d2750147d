//! The range of light: half floats, of which the filter's images are, end at 65504 and lose precision
//! below 0.0001. A power of two by sequence brings the light into their middle, and the result back.

use crate::output_size::OutputSize;
use std::collections::BTreeMap;

/// The largest half float.
const MAX: f32 = 65504.0;
/// Light that needs no change: its geometric mean is at most 2 to this away from 1.
const CALM: f32 = 6.0;
/// The same of light that is shown.
const BRIGHT: f32 = 3.0;
/// Room above the brightest pixel of the frames that are looked at.
const ROOM: f32 = 32768.0;
/// The geometric mean is made no darker than 2 to this for the sake of the brightest pixels.
const DARKEST: f32 = -8.0;
/// Images that hold light, or differences of it.
const LIGHT: [&str; 12] = [
    "noisy_radiance",
    "noisy_direct",
    "noisy_indirect",
    "noisy_diffuse",
    "noisy_specular",
    "emission",
    "reshaded_radiance",
    "other_denoised_radiance",
    "noisy_volume",
    "unshadowed_direct",
    "sparse_gradient",
    "lighting",
];

type Texels = Vec<[f32; 4]>;

/// The scale of a sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// Light is multiplied by 2 to this.
    pub exponent: i32,
}

/// Light that does not fit even so.
#[derive(Clone, Debug, Default)]
pub struct Excess {
    /// Pixels of surfaces that were cut.
    pub cut: usize,
    /// Emission and background that go by the filter, which would pass them on: pixel, and light before
    /// the scale.
    passed: Vec<(usize, [f32; 3])>,
}

/// The mean of the logarithms and the maximum of the lit pixels.
fn statistics<'a>(pixels: impl Iterator<Item = &'a [f32; 3]>) -> Option<(f32, f32)> {
    let (mut sum, mut count, mut most) = (0.0f64, 0u64, 0.0f32);
    for v in pixels.map(|p| p[0].max(p[1]).max(p[2])).filter(|v| v.is_finite() && *v > 0.0) {
        sum += f64::from(v.log2());
        count += 1;
        most = most.max(v);
    }
    (count > 0).then(|| ((sum / count as f64) as f32, most))
}

/// The exponent by which light is shown and scored: a geometric mean of about 1, or 0 where it is near
/// enough to that.
pub fn shown<'a>(pixels: impl Iterator<Item = &'a [f32; 3]>) -> i32 {
    statistics(pixels).map_or(0.0, |(mean, _)| to_one(mean, BRIGHT)) as i32
}

/// The exponent for a mean of logarithms, unless that is `calm` at most.
fn to_one(mean: f32, calm: f32) -> f32 {
    if mean.abs() > calm {
        -mean.round()
    } else {
        0.0
    }
}

impl Range {
    /// The range for frames like these.
    pub fn of<'a>(pixels: impl Iterator<Item = &'a [f32; 3]>) -> Self {
        let Some((mean, most)) = statistics(pixels) else { return Self::default() };
        let centred = to_one(mean, CALM);
        let fitting = (ROOM / most).log2().floor();
        let exponent = centred.min(fitting.max((DARKEST - mean).ceil()));
        // Powers beyond these are no floats.
        Self { exponent: exponent.clamp(-126.0, 126.0) as i32 }
    }

    /// The factor.
    pub fn factor(self) -> f32 {
        (self.exponent as f32).exp2()
    }

    /// Scales the images of a frame. `is_background` tells of a pixel that it shows no surface.
    pub fn scale(self, images: &mut BTreeMap<&'static str, Texels>, is_background: impl Fn(usize) -> bool) -> Excess {
        let mut excess = Excess::default();
        let factor = self.factor();
        for (name, texels) in images.iter_mut().filter(|(name, _)| LIGHT.contains(name)) {
            let is_part = !matches!(*name, "reshaded_radiance" | "other_denoised_radiance" | "sparse_gradient");
            for (i, texel) in texels.iter_mut().enumerate() {
                let light = [texel[0], texel[1], texel[2]];
                let whole = light.map(|v| v * factor);
                let fits = whole.map(|v| v.clamp(-MAX, MAX));
                *texel = [fits[0], fits[1], fits[2], texel[3]];
                if !is_part || whole.iter().all(|v| v.is_nan() || v.abs() <= MAX) {
                    continue;
                }
                if *name == "emission" || is_background(i) {
                    // All of it: beside other light, the largest half float would become infinite.
                    *texel = [0.0, 0.0, 0.0, texel[3]];
                    excess.passed.push((i, light));
                } else {
                    excess.cut += 1;
                }
            }
        }
        excess
    }

    /// Brings a result back. `size` is that of the result, where not that of the frame.
    pub fn restore(self, radiance: &mut [[f32; 3]], excess: &Excess, size: Option<OutputSize>) {
        if self.exponent != 0 {
            let factor = self.factor().recip();
            radiance.iter_mut().flatten().for_each(|v| *v *= factor);
        }
        let mut add = |i: usize, more: &[f32; 3]| {
            if let Some(pixel) = radiance.get_mut(i) {
                *pixel = std::array::from_fn(|c| pixel[c] + more[c]);
            }
        };
        match size {
            _ if excess.passed.is_empty() => {}
            None => excess.passed.iter().for_each(|(i, more)| add(*i, more)),
            Some(size) => {
                let mut passed = vec![[0.0; 3]; size.frame_pixels()];
                excess.passed.iter().for_each(|(i, more)| passed[*i] = std::array::from_fn(|c| passed[*i][c] + more[c]));
                size.enlarged(&passed).iter().enumerate().for_each(|(i, more)| add(i, more));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(pixels: &[f32]) -> i32 {
        let pixels: Vec<_> = pixels.iter().map(|v| [*v; 3]).collect();
        Range::of(pixels.iter()).exponent
    }

    #[test]
    fn light_in_the_middle_is_left_alone() {
        assert_eq!(of(&[0.02, 0.5, 60.0, 30000.0]), 0);
        assert_eq!((of(&[]), of(&[0.0, f32::NAN, -1.0])), (0, 0));
    }

    #[test]
    fn light_far_off_is_centred() {
        assert_eq!((of(&[1e5; 9]), of(&[1e-6; 9])), (-17, 20));
        // A sun does not put the surfaces beside it into the dark.
        assert_eq!(of(&[&[1.0; 99][..], &[300_000.0]].concat()), -4);
        assert_eq!(of(&[&[1.0; 9999][..], &[1e20]].concat()), -8);
    }

    #[test]
    fn what_passes_the_filter_keeps_its_value() {
        let range = Range { exponent: -1 };
        let mut images = BTreeMap::from([
            ("noisy_radiance", vec![[2.0; 4], [1e6; 4], [1e6; 4]]),
            ("emission", vec![[3e5, 0.0, 0.0, 0.0]; 3]),
            ("albedo", vec![[0.5; 4]; 3]),
        ]);
        let excess = range.scale(&mut images, |i| i == 1);
        assert_eq!((images["noisy_radiance"][0][0], images["noisy_radiance"][1][0], images["albedo"][0][0]), (1.0, 0.0, 0.5));
        assert_eq!(excess.cut, 1);
        // The filter passes emission and background, and adds them.
        let mut result: Vec<[f32; 3]> =
            (0..3).map(|i| std::array::from_fn(|c| images["noisy_radiance"][i][c] + images["emission"][i][c])).collect();
        range.restore(&mut result, &excess, None);
        assert_eq!(result[0], [300_002.0, 2.0, 2.0]);
        assert_eq!(result[1], [1_300_000.0, 1e6, 1e6]);
        assert_eq!(result[2][1], 131_008.0);
    }
}

//! The stage `tone_map`: radiance to display-referred linear 0..1.

use crate::reference::binary16::round_to_half;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::luminance::luminance;
use crate::reference::rules::{pixels, HALF};
use crate::reference::Image;
use crate::{Error, ToneCurve, Tuning};

/// Applies exposure and tone curve to the sum of radiances, of surfaces and of a volume. rgb of the result is 0..1 in half
/// precision, alpha 1. Only the first `pixels` are mapped. Without any radiance an empty image.
pub(crate) fn tone_map(pixels: [u32; 2], tuning: &Tuning, denoised: &[&Image<[f32; 4]>]) -> Image<[f32; 4]> {
    let extent = denoised.first().map_or([0; 2], |image| image.extent());
    Image::compute(extent, pixels, |p| {
        let [r, g, b] = [0, 1, 2].map(|i| denoised.iter().map(|image| image.at(p)[i]).sum::<f32>().min(1e30));
        let [r, g, b] = curve(tuning.tone_curve, [r, g, b].map(|c| c * tuning.exposure)).map(|c| round_to_half(c.clamp(0.0, 1.0)));
        [r, g, b, 1.0]
    })
}

fn curve(tone_curve: ToneCurve, x: [f32; 3]) -> [f32; 3] {
    match tone_curve {
        // [Narkowicz 2015]
        ToneCurve::Aces => x.map(|x| x.min(1e4)).map(|x| (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)),
        ToneCurve::Reinhard => {
            let scale = 1.0 / (1.0 + luminance(x));
            x.map(|x| x * scale)
        }
        ToneCurve::Linear => x,
    }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("tone_mapped", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let pixels = if b.is_on("OUTPUT")? { b.frame.output_extent } else { b.frame.guide_extent };
    let mapped = tone_map(pixels, b.tuning, &b.colours("radiance")?);
    b.write("tone_mapped", mapped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::svgf_tuning;

    fn mapped(tone_curve: ToneCurve, exposure: f32, c: [f32; 3]) -> [f32; 4] {
        let tuning = Tuning { tone_curve, exposure, ..svgf_tuning() };
        tone_map([1, 1], &tuning, &[&Image::new([1, 1], [c[0], c[1], c[2], 0.5])]).texels()[0]
    }

    #[test]
    fn known_values() {
        assert_eq!(mapped(ToneCurve::Linear, 2.0, [0.25, 0.125, 3.0]), [0.5, 0.25, 1.0, 1.0]);
        let [r, g, b, _] = mapped(ToneCurve::Reinhard, 1.0, [1.0; 3]);
        assert!((r - 0.5).abs() < 1e-3 && r == g && g == b);
        let [r, ..] = mapped(ToneCurve::Aces, 1.0, [1.0; 3]);
        assert!((r - 2.54 / 3.16).abs() < 1e-3, "{r}");
        assert_eq!(mapped(ToneCurve::Aces, 1.0, [0.0; 3]), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn reinhard_keeps_the_hue_and_every_curve_rises_within_bounds() {
        let [r, g, ..] = mapped(ToneCurve::Reinhard, 1.0, [0.8, 0.2, 0.1]);
        assert!((r / g - 4.0).abs() < 0.01, "{r} {g}");
        for tone_curve in [ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Linear] {
            let mut last = -1.0;
            for x in [0.0, 0.01, 0.1, 0.5, 0.9, 10.0, 65504.0] {
                let [y, ..] = mapped(tone_curve, 1.0, [x; 3]);
                assert!(y >= last && (0.0..=1.0).contains(&y), "{tone_curve:?} {x} {y}");
                last = y;
            }
            for brightest in [65504.0, 3e38] {
                let [y, ..] = mapped(tone_curve, 65504.0, [brightest; 3]);
                assert!(y > 0.99 && y <= 1.0, "{tone_curve:?} {y}");
            }
        }
    }
}

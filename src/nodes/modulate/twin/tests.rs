//! Sums, emission, bad values.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::LARGEST_HALF;

const EXTENT: [u32; 2] = [3, 1];

#[test]
fn signals_are_summed_and_emission_is_added() {
    let guides = guides(EXTENT, |x, _| surface(if x == 2 { 0.0 } else { 4.0 }));
    let (direct, indirect) = (Image::new(EXTENT, [2.0, 4.0, 8.0, 9.0]), Image::new(EXTENT, [1.0, 1.0, 1.0, 9.0]));
    let albedo = paint(EXTENT, |x, _| [0.5, 0.25, if x == 1 { f32::NAN } else { 0.125 }, 0.0]);
    let emission = paint(EXTENT, |x, _| if x == 0 { [10.0, f32::NAN, 0.0, 0.0] } else { [1.0, 2.0, 3.0, 0.0] });
    let inputs = ModulateInputs {
        guide: &guides.guide,
        irradiance: &[&direct, &indirect],
        albedo: Some(&albedo),
        specular: None,
        emission: Some(&emission),
        outgoing: Outgoing::Halves,
    };
    let output = modulate(&frame(EXTENT), &inputs);
    let expected = [[1.5, 1.25, 1.125, 1.0], [2.5, 3.25, 12.0, 1.0], [4.0, 7.0, 12.0, 1.0]];
    assert_eq!(output.denoised_radiance.texels(), &expected);
    assert_eq!(output.statistics, counted(&[(Counter::Emission, 1)]));
}

#[test]
fn the_result_is_a_finite_radiance() {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    let bright = Image::new(EXTENT, [LARGEST_HALF; 4]);
    let emission = Image::new(EXTENT, [3e38, -1e30, 0.0, 0.0]);
    let inputs = ModulateInputs {
        guide: &guides.guide,
        irradiance: &[&bright, &bright],
        albedo: Some(&bright),
        specular: None,
        emission: Some(&emission),
        outgoing: Outgoing::Halves,
    };
    let output = modulate(&frame(EXTENT), &inputs);
    assert_eq!(output.denoised_radiance.texels()[0], [LARGEST_HALF, 0.0, LARGEST_HALF, 1.0]);
}

#[test]
fn floats_hold_light_of_any_unit() {
    let guides = guides(EXTENT, |_, _| surface(4.0));
    let irradiance = Image::new(EXTENT, [1.0, 0.5, f32::NAN, 0.0]);
    for (outgoing, exponent, expected) in [
        (Outgoing::Floats, -23, [8_388_608.0, 4_194_304.0, 0.0, 1.0]),
        (Outgoing::Floats, 23, [1.0 / 8_388_608.0, 0.5 / 8_388_608.0, 0.0, 1.0]),
        (Outgoing::Halves, -23, [LARGEST_HALF, LARGEST_HALF, 0.0, 1.0]),
    ] {
        let frame = FrameConstants { inverse_filter_exposure: (-exponent as f32).exp2(), ..frame(EXTENT) };
        let inputs = ModulateInputs {
            guide: &guides.guide,
            irradiance: &[&irradiance],
            albedo: None,
            specular: None,
            emission: None,
            outgoing,
        };
        let output = modulate(&frame, &inputs);
        assert_eq!(output.denoised_radiance.texels()[0], expected, "{outgoing:?}, 2^{exponent}");
        let lost = if outgoing == Outgoing::Halves { 3 } else { 0 };
        assert_eq!(output.statistics[Counter::Saturated], lost, "{outgoing:?}, 2^{exponent}");
    }
}

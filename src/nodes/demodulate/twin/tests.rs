//! Division, bad values, background.

use super::*;
use crate::nodes::modulate::twin::SpecularAlbedos;
use crate::nodes::modulate::twin::{modulate, ModulateInputs};
use crate::reference::holes::EMPTY_HOLE;
use crate::reference::outgoing::Outgoing;
use crate::reference::test_scene::*;
use crate::reference::LARGEST_HALF;

const EXTENT: [u32; 2] = [6, 4];

fn run(guides: &Guides, noisy: &[&Image<[f32; 4]>], albedo: Option<&Image<[f32; 4]>>) -> DemodulateOutputs {
    demodulate(
        &frame(EXTENT),
        &Tuning::default(),
        &DemodulateInputs {
            guide: &guides.guide,
            noisy,
            albedo,
            specular_f0: None,
            specular_hit_distance: None,
            is_specular: false,
            is_sub_sampled: false,
        },
    )
}

fn flat() -> Guides {
    guides(EXTENT, |_, _| surface(4.0))
}

#[test]
fn radiance_is_divided_by_albedo_and_by_a_tenth_of_its_largest_component_at_least() {
    let noisy = Image::new(EXTENT, [1.0, 0.5, 0.25, 7.0]);
    let albedo = Image::new(EXTENT, [0.625, 0.0, -1.0, 7.0]);
    let output = run(&flat(), &[&noisy], Some(&albedo));
    assert!(
        output.irradiance[0].texels().iter().all(|t| *t == [1.5996094, 8.0, 4.0, 0.0]),
        "{:?}",
        output.irradiance[0].texels()[0]
    );
    assert_eq!(run(&flat(), &[&noisy], None).irradiance[0].texels()[0], [1.0, 0.5, 0.25, 0.0]);
}

#[test]
fn light_over_an_odd_albedo_is_not_multiplied_up() {
    let largest_factor = |albedo: [f32; 3]| {
        let [r, g, b] = albedo;
        let (divisor, _) = divisor(Some([r, g, b, 0.0]));
        assert!(divisor.iter().all(|d| *d > 0.0 && *d <= 1.0), "{albedo:?} divides by {divisor:?}");
        divisor.into_iter().fold(0.0_f32, |largest, d| largest.max(1.0 / d))
    };
    for nothing in [0.0, -1.0, f32::NAN, f32::INFINITY, 6.65] {
        assert_eq!(largest_factor([nothing; 3]), 1.0, "{nothing}");
    }
    for i in 0..=1000 {
        let a = i as f32 / 1000.0;
        assert!(largest_factor([a; 3]) < 20.5, "grey of {a}");
        assert!(largest_factor([a, 0.0, a / 3.0]) < 50.5, "saturated of {a}");
    }
    assert!((largest_factor([0.25, 0.1, 0.05]) - 20.0).abs() < 1e-3, "a dark texture is divided by itself");
}

#[test]
fn specular_light_is_divided_by_a_dark_albedo_too() {
    for (albedo, diffuse, specular) in
        [(0.0, 1.0, 0.05), (0.02, 1.0, 0.05), (0.025, 0.05, 0.05), (0.06, 0.06, 0.06), (0.5, 0.5, 0.5)]
    {
        let given = Some([albedo; 4]);
        assert_eq!((divisor(given), specular_divisor(given)), (([diffuse; 3], false), ([specular; 3], false)), "{albedo}");
    }
    let unknown = Some([f32::NAN, 0.5, 0.04, 1.0]);
    assert_eq!((divisor(unknown), specular_divisor(unknown)), (([1.0, 0.5, 0.1], true), ([1.0, 0.5, 0.1], true)));
}

#[test]
fn modulation_brings_the_radiance_back() {
    let noisy = noise(EXTENT, 1).map(|t| [t[0], 2.0 * t[0], 0.5, 0.0]);
    let albedo = noise(EXTENT, 2).map(|t| [t[0], 0.0, 1e-4, 0.0]);
    let guides = guides(EXTENT, |x, _| surface(if x == 2 { 0.0 } else { 4.0 }));
    let c = run(&guides, &[&noisy], Some(&albedo)).irradiance.remove(0);
    let inputs = ModulateInputs {
        guide: &guides.guide,
        irradiance: &[&c],
        albedo: Some(&albedo),
        specular: None,
        emission: None,
        outgoing: Outgoing::Halves,
    };
    let back = modulate(&frame(EXTENT), &inputs).denoised_radiance;
    for (given, back) in noisy.texels().iter().zip(back.texels()) {
        assert!((0..3).all(|i| (given[i] - back[i]).abs() <= 1.1e-3 * given[i]), "{given:?} {back:?}");
    }
}

#[test]
fn bad_radiance_is_counted_and_no_sample() {
    let bad = [
        [f32::NAN, 1.0, 1.0, 0.0],
        [1.0, f32::INFINITY, 1.0, 0.0],
        [1.0, 1.0, f32::NEG_INFINITY, 0.0],
        [-1.0, 2.0, 3e38, f32::NAN],
    ];
    let first = paint(EXTENT, |x, _| if x < 4 { bad[x as usize] } else { [1.0; 4] });
    let second = paint(EXTENT, |x, _| if x == 5 { bad[0] } else { [1.0; 4] });
    let output = run(&flat(), &[&first, &second], None);
    assert_eq!(output.statistics, counted(&[(Counter::Radiance, 3 * 4 + 4), (Counter::Saturated, 4)]));
    let row = &output.irradiance[0].texels()[..6];
    assert_eq!(row[..2], [[0.0, 0.0, 0.0, EMPTY_HOLE]; 2], "no sample around them");
    assert_eq!(row[2], [0.0, 2.0, LARGEST_HALF, HOLE], "of the only samples around it");
    assert_eq!(row[3], [0.0, 2.0, LARGEST_HALF, 0.0]);
    assert_eq!(row[4], [1.0, 1.0, 1.0, 0.0]);
}

#[test]
fn bad_albedo_is_counted_once_and_divides_nothing() {
    let noisy = Image::new(EXTENT, [1.0; 4]);
    let albedo =
        paint(EXTENT, |x, _| [if x == 1 { f32::NAN } else { 0.5 }, 0.5, if x == 1 { f32::INFINITY } else { 0.5 }, f32::NAN]);
    let output = run(&flat(), &[&noisy, &noisy], Some(&albedo));
    assert_eq!(output.statistics, counted(&[(Counter::Albedo, 4)]));
    assert_eq!(output.irradiance[1].texels()[..2], [[2.0, 2.0, 2.0, 0.0], [1.0, 2.0, 1.0, 0.0]]);
}

#[test]
fn the_background_keeps_its_radiance_but_no_bad_value() {
    let sky = guides(EXTENT, |_, _| surface(0.0));
    let noisy = paint(EXTENT, |x, _| [if x == 0 { f32::NAN } else { 3.0 }, -1.0, 1e6, 0.0]);
    let output = run(&sky, &[&noisy], Some(&Image::new(EXTENT, [f32::NAN; 4])));
    assert_eq!(output.statistics, counted(&[(Counter::Radiance, 4), (Counter::Saturated, 5 * 4)]), "albedo is not looked at");
    assert_eq!(output.irradiance[0].texels()[..2], [[3.0, 0.0, LARGEST_HALF, HOLE], [3.0, 0.0, LARGEST_HALF, 0.0]]);
}

#[test]
fn outside_the_render_extent_nothing_is_read() {
    let large = [9, 9];
    let in_large = FrameConstants { render_extent: EXTENT, ..frame(large) };
    let noisy = noise(EXTENT, 1);
    let expected = run(&flat(), &[&noisy], Some(&noisy));
    let loose = embed(&noisy, large, [f32::NAN; 4]);
    let guides = guides(large, |_, _| surface(4.0));
    let inputs = DemodulateInputs {
        guide: &guides.guide,
        noisy: &[&loose],
        albedo: Some(&loose),
        specular_f0: None,
        specular_hit_distance: None,
        is_specular: false,
        is_sub_sampled: false,
    };
    let output = demodulate(&in_large, &Tuning::default(), &inputs);
    assert_eq!(output.irradiance[0], embed(&expected.irradiance[0], large, [0.0; 4]));
    assert_eq!(output.statistics, Statistics::default());
}

#[test]
fn hit_distances_stand_in_alpha_and_bad_ones_are_counted() {
    let extent = [7, 1];
    let guides = guides(extent, |x, _| surface(if x == 5 { 0.0 } else { 4.0 }));
    let given = [0.0, 2.5, f32::NAN, -2.0, f32::INFINITY, f32::NAN, -1.0];
    let (noisy, distances) = (Image::new(extent, [1.0; 4]), paint(extent, |x, _| [given[x as usize]; 4]));
    let inputs = DemodulateInputs {
        guide: &guides.guide,
        noisy: &[&noisy],
        albedo: None,
        specular_f0: None,
        specular_hit_distance: Some(&distances),
        is_specular: false,
        is_sub_sampled: false,
    };
    let output = demodulate(&frame(extent), &Tuning::default(), &inputs);
    let stored: Vec<f32> = output.irradiance[0].texels().iter().map(|texel| texel[3]).collect();
    assert_eq!(stored, [FARTHEST_HIT, 2.5, 0.0, 0.0, FARTHEST_HIT, 0.0, 0.0]);
    assert_eq!(output.statistics[Counter::HitDistance], 2, "the background has no hit, and -1 says that none is known");
}

#[test]
fn specular_light_comes_back_through_either_albedo() {
    let (guides, roughness) = (guides(EXTENT, |_, _| surface(4.0)), Image::new(EXTENT, [0.4; 4]));
    let (noisy, none) = (Image::new(EXTENT, [0.5, 0.25, 2.0, 0.0]), Image::new(EXTENT, [0.0; 4]));
    let reflectance = paint(EXTENT, |x, _| if x == 0 { [f32::NAN, 0.0, 0.5, 0.0] } else { [0.9, 0.0, 0.04, 0.0] });
    let f0 = SpecularF0 { image: &reflectance, roughness: Some(&roughness) };
    for (albedo, f0) in [(Some(&reflectance), None), (None, Some(f0))] {
        let inputs = DemodulateInputs {
            guide: &guides.guide,
            noisy: &[&noisy],
            albedo,
            specular_f0: f0,
            specular_hit_distance: None,
            is_specular: true,
            is_sub_sampled: false,
        };
        let frame = frame(EXTENT);
        let divided = demodulate(&frame, &Tuning::default(), &inputs);
        assert_eq!(divided.statistics[Counter::Albedo], EXTENT[1]);
        assert_ne!(divided.irradiance[0].at(IVec2::X), noisy.at(IVec2::X));
        let inputs = ModulateInputs {
            guide: &guides.guide,
            irradiance: &[&none, &divided.irradiance[0]],
            albedo: None,
            specular: Some(SpecularAlbedos { albedo, f0 }),
            emission: None,
            outgoing: Outgoing::Halves,
        };
        for texel in modulate(&frame, &inputs).denoised_radiance.texels() {
            assert!((0..3).all(|i| (texel[i] / noisy.at(IVec2::ZERO)[i] - 1.0).abs() < 2e-3), "{texel:?}");
        }
    }
}

#[test]
fn a_pixel_without_a_sample_takes_that_of_its_surface_and_not_its_texture() {
    let guides = guides(EXTENT, |x, _| surface(if x < 3 { 4.0 } else { 9.0 }));
    let albedo = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.25 } else { 0.5 }; 4]);
    let light = |x: i32| if x < 3 { 2.0 } else { 8.0 };
    let noisy = paint(EXTENT, |x, y| [if (x, y) == (2, 1) { f32::NAN } else { light(x) * albedo.at(IVec2::new(x, y))[0] }; 4]);
    let output = run(&guides, &[&noisy], Some(&albedo));
    assert_eq!(*output.irradiance[0].get(2, 1).expect("inside"), [2.0, 2.0, 2.0, HOLE]);
    assert_eq!(output.irradiance[0].get(3, 1).expect("inside")[0], 8.0);
}

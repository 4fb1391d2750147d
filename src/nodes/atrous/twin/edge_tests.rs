//! Edges that the filter does not blur across.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_reflection, SeenReflection, Surface};

const EXTENT: [u32; 2] = [24, 9];

/// A step of radiance at column 12 on a scene that `right` changes from there on, filtered over five levels; the columns of the
/// middle row.
fn filtered(tuning: &Tuning, gradient: f32, left: impl Fn(i32, &mut Surface), right: impl Fn(i32, &mut Surface)) -> Vec<f32> {
    let scene = guides(EXTENT, |x, _| {
        let mut s = Surface { gradient: [gradient, 0.0], ..surface(10.0) };
        if x < 12 {
            left(x, &mut s);
        } else {
            right(x, &mut s);
        }
        s
    });
    // A large deviation: luminance alone would not stop.
    let mut image = paint(EXTENT, |x, _| if x < 12 { [1.0, 1.0, 1.0, 100.0] } else { [8.0, 8.0, 8.0, 100.0] });
    for level in 0..5 {
        let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[&image] };
        image = atrous(&frame(EXTENT), tuning, AtrousLevel::new(level), &inputs).remove(0);
    }
    (0..24).map(|x| image.get(x, 4).expect("inside")[0]).collect()
}

fn is_kept(row: &[f32]) -> bool {
    row.iter().enumerate().all(|(x, l)| (l - if x < 12 { 1.0 } else { 8.0 }).abs() < 0.02)
}

#[test]
fn without_an_edge_the_step_blurs() {
    let row = filtered(&svgf_tuning(), 0.0, |_, _| (), |_, _| ());
    assert!(row[11] > 2.0 && row[12] < 7.0, "{row:?}");
}

#[test]
fn a_depth_step_stops() {
    let row = filtered(&svgf_tuning(), 0.0, |_, _| (), |_, s| s.linear_depth = 10.5);
    assert!(is_kept(&row), "{row:?}");
}

#[test]
fn a_normal_step_stops_and_sigma_zero_lets_it_pass() {
    let step = |_: i32, s: &mut Surface| s.normal = [0.6, 0.0, 0.8];
    let row = filtered(&svgf_tuning(), 0.0, |_, _| (), step);
    assert!(is_kept(&row), "{row:?}");
    let row = filtered(&Tuning { sigma_n: 0.0, ..svgf_tuning() }, 0.0, |_, _| (), step);
    assert!(row[11] > 2.0, "{row:?}");
}

#[test]
fn a_slope_does_not_stop_where_the_gradient_explains_it() {
    let slope = |x: i32, s: &mut Surface| s.linear_depth = 4.0 + 0.5 * x as f32;
    let row = filtered(&svgf_tuning(), 0.5, slope, slope);
    assert!(row[11] > 1.7, "{row:?}");
    let row = filtered(&svgf_tuning(), 0.0, slope, slope);
    assert!(is_kept(&row), "without the gradient a slope is a row of steps: {row:?}");
    let row = filtered(&Tuning { sigma_z: 0.0, ..svgf_tuning() }, 0.5, slope, slope);
    assert!(is_kept(&row), "sigma_z 0 ignores the gradient: {row:?}");
}

#[test]
fn the_background_is_neither_filtered_nor_used() {
    let row = filtered(&svgf_tuning(), 0.0, |_, _| (), |_, s| s.linear_depth = 0.0);
    assert!(row[12..].iter().all(|l| *l == 8.0), "{row:?}");
    assert!(row[..12].iter().all(|l| *l == 1.0), "{row:?}");
}

#[test]
fn light_that_an_albedo_divides_is_kept_from_light_that_none_divides() {
    // As steep as beside an outline, where the gradient explains any depth.
    let row = filtered(&svgf_tuning(), 1000.0, |_, _| (), |_, s| s.is_apart = true);
    assert!(is_kept(&row), "{row:?}");
    let row = filtered(&svgf_tuning(), 0.0, |_, s| s.is_apart = true, |_, s| s.is_apart = true);
    assert!(row[11] > 2.0, "both are dark: {row:?}");
}

#[test]
fn luminance_stops_where_the_deviation_is_small() {
    let scene = guides(EXTENT, |_, _| surface(10.0));
    let contrast = |deviation: f32| {
        let image = paint(EXTENT, |x, _| {
            let l = if x < 12 { 1.0 } else { 2.0 };
            [l, l, l, deviation]
        });
        let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[&image] };
        let output = atrous(&frame(EXTENT), &svgf_tuning(), AtrousLevel::new(0), &inputs).remove(0);
        output.get(12, 4).expect("inside")[0] - output.get(11, 4).expect("inside")[0]
    };
    assert!(contrast(0.0) > 0.999);
    assert!(contrast(0.01) > 0.999);
    assert!(contrast(0.25) < 0.8 && contrast(10.0) < 0.5, "{} {}", contrast(0.25), contrast(10.0));
    // exp(−1/(4·0.25 + ε)) against 1, over the kernel's columns 5/16 and 11/16.
    let w = (-1.0_f32 / 1.0001).exp();
    let expected = 1.0 - 2.0 * (5.0 / 16.0 * w) / (11.0 / 16.0 + 5.0 / 16.0 * w);
    assert!((contrast(0.25) - expected).abs() < 2e-3, "{} for {expected}", contrast(0.25));
}

#[test]
fn the_deviation_in_the_weight_is_blurred_over_three_by_three() {
    // The centre is certain, its neighbours are not: without the blur nothing would pass.
    let scene = guides([5, 5], |_, _| surface(10.0));
    let image = paint([5, 5], |x, y| if (x, y) == (2, 2) { [1.0, 1.0, 1.0, 0.0] } else { [2.0, 2.0, 2.0, 1.0] });
    let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[&image] };
    let [l, ..] = atrous(&frame([5, 5]), &svgf_tuning(), AtrousLevel::new(0), &inputs).remove(0).at(IVec2::new(2, 2));
    let (centre, w) = (9.0 / 64.0, (-1.0_f32 / (4.0 * 0.75_f32.sqrt() + 1e-4)).exp());
    let expected = (centre + (1.0 - centre) * w * 2.0) / (centre + (1.0 - centre) * w);
    assert!((l - expected).abs() < 2e-3, "{l} for {expected}");
}

#[test]
fn a_mirror_is_not_filtered_and_the_roughest_surface_as_diffuse_light_is() {
    let extent = [24, 16];
    let at = camera(extent, glam::Vec3::ZERO);
    let frame = frame_with(&crate::Config::new(extent), &at, &at);
    let scene = guides(extent, |_, _| surface(4.0));
    let image = noise(extent, 7).map(|t| [t[0], t[0], t[0], 4.0]);
    let filtered = |seen: Option<SeenReflection>| {
        let reflection = seen.map(|seen| Image::new(extent, pack_reflection(&seen, None)));
        let inputs = AtrousInputs { guide: &scene.guide, reflection: reflection.as_ref(), irradiance: &[&image] };
        atrous(&frame, &svgf_tuning(), AtrousLevel::new(0), &inputs).remove(0)
    };
    let at = |roughness, hit_distance| filtered(Some(SeenReflection { hit_distance, roughness })).at(IVec2::new(9, 9))[0];
    let (own, diffuse) = (image.at(IVec2::new(9, 9))[0], filtered(None).at(IVec2::new(9, 9))[0]);
    assert!((at(0.0, 3.0) - own).abs() < 1e-3 && (own - diffuse).abs() > 0.05, "{own} {diffuse}");
    assert!((at(1.0, 3.0) - diffuse).abs() < 1e-3, "{} {diffuse}", at(1.0, 3.0));
    // Half-way, and what touches the surface is sharper than what lies far behind it.
    let distance = |value: f32| (value - diffuse).abs();
    assert!(distance(at(0.3, 0.01)) > 2.0 * distance(at(0.3, 50.0)), "{} {}", at(0.3, 0.01), at(0.3, 50.0));
}

#[test]
fn specular_light_beside_diffuse_light_is_filtered_as_it_is_alone() {
    let extent = [20, 14];
    let at = camera(extent, glam::Vec3::ZERO);
    let frame = frame_with(&crate::Config::new(extent), &at, &at);
    let scene = guides(extent, |x, _| surface(if x < 11 { 4.0 } else { 5.0 }));
    let reflection = paint(extent, |x, _| pack_reflection(&SeenReflection { hit_distance: 1.0 + x as f32, roughness: 0.4 }, None));
    let [diffuse, specular] = [3, 8].map(|seed| noise(extent, seed).map(|t| [t[0], t[1], t[2], 4.0]));
    for luminance_weight in LuminanceWeight::ALL {
        let filtered = |reflection, irradiance: &[&Image<[f32; 4]>]| {
            let inputs = AtrousInputs { guide: &scene.guide, reflection, irradiance };
            atrous(&frame, &svgf_tuning(), AtrousLevel { luminance_weight, ..AtrousLevel::new(1) }, &inputs)
        };
        let alone = [filtered(None, &[&diffuse]).remove(0), filtered(Some(&reflection), &[&specular]).remove(0)];
        assert_ne!(filtered(None, &[&specular])[0], alone[1], "the lobe counts");
        assert_eq!(filtered(Some(&reflection), &[&diffuse, &specular]), alone);
    }
}

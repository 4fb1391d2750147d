//! What is seen in a surface, where no hit distance tells things apart.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_reflection, SeenReflection};

const EXTENT: [u32; 2] = [40, 16];

/// Columns of the middle row of a mirror's light after five levels.
fn seen(hit_distance: f32, mut light: Image<[f32; 4]>) -> Vec<[f32; 4]> {
    let at = camera(EXTENT, glam::Vec3::ZERO);
    let frame = frame_with(&crate::Config::new(EXTENT), &at, &at);
    let scene = guides(EXTENT, |_, _| surface(4.0));
    let reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance, roughness: 1.0 }, None));
    for number in 0..5 {
        let inputs = AtrousInputs { guide: &scene.guide, reflection: Some(&reflection), irradiance: &[&light] };
        let level = AtrousLevel { number, kernel: Kernel::Box, luminance_weight: LuminanceWeight::OfMeans, is_marked: true };
        light = atrous(&frame, &Tuning::default(), level, &inputs).remove(0);
    }
    (0..EXTENT[0] as i32).map(|x| light.at(IVec2::new(x, 8))).collect()
}

/// Noise that every pixel has, or rare light, beside the darkness that a mirror shows of an open door.
fn beside_darkness(rare: bool) -> Image<[f32; 4]> {
    let noise = noise(EXTENT, 7);
    paint(EXTENT, move |x, y| {
        let l = if x < 20 { 0.5 + noise.at(IVec2::new(x, y))[0] } else { 0.0 };
        [l, l, l, if x < 20 { marked(2.0, rare) } else { 0.0 }]
    })
}

#[test]
fn light_that_is_not_rare_does_not_leak_into_darkness() {
    let leaked = |hit_distance, rare| seen(hit_distance, beside_darkness(rare))[22][0];
    assert!(leaked(0.0, false) < 1e-3, "{}", leaked(0.0, false));
    // Rare light does, since the dark pixels may be those that it never hit.
    assert!(leaked(0.0, true) > 0.02, "{}", leaked(0.0, true));
    // A hit distance tells the two apart, where they are.
    assert!(leaked(3.0, false) > 0.02, "{}", leaked(3.0, false));
}

#[test]
fn noise_that_is_not_rare_is_filtered_all_the_same() {
    let row = seen(0.0, beside_darkness(false));
    let spread = row[2..14].iter().map(|texel| (texel[0] - 1.0).abs()).fold(0.0, f32::max);
    assert!(spread < 0.2, "{spread}");
}

#[test]
fn two_colours_as_bright_as_each_other_stay_apart() {
    // Of luminance 0.2126 both.
    let (red, grey) = ([1.0, 0.0, 0.0], [0.2126; 3]);
    let image = paint(EXTENT, |x, _| {
        let [r, g, b] = if x < 20 { red } else { grey };
        [r, g, b, marked(0.05, false)]
    });
    let row = seen(3.0, image.clone());
    assert!(row[19][1] < 0.01 && row[20][0] < 0.22, "{:?} {:?}", row[19], row[20]);
    // Diffuse light has no such edges, but noise of hue.
    let scene = guides(EXTENT, |_, _| surface(4.0));
    let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[&image] };
    let level = AtrousLevel { luminance_weight: LuminanceWeight::OfMeans, ..AtrousLevel::new(0) };
    assert!(atrous(&frame(EXTENT), &Tuning::default(), level, &inputs)[0].at(IVec2::new(19, 8))[1] > 0.05);
}

#[test]
fn what_is_filtered_still_says_whether_light_is_rare() {
    for rare in [false, true] {
        assert!(seen(0.0, beside_darkness(rare))[..12].iter().all(|texel| is_rare(texel[3]) == rare));
    }
}

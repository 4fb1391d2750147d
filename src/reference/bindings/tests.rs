//! Names and kinds of what is read and written, and adapters against the functions that they call.

use super::super::test_scene::*;
use super::super::*;
use super::*;
use crate::nodes::atrous::twin::*;
use crate::nodes::volume_points::twin::*;
use crate::nodes::{Kernel, LuminanceWeight};
use crate::reference::holes::HOLE;
use crate::Counter;

const EXTENT: [u32; 2] = [12, 9];

fn message<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    result.expect_err("not bound").to_string()
}

#[test]
fn what_is_missing_or_of_another_kind_is_named() {
    let (frame, tuning) = (frame(EXTENT), svgf_tuning());
    let (guide, ids) = (Texels::Packed(Image::new(EXTENT, [0; 4])), Texels::Uint(Image::new(EXTENT, 0)));
    let mut b = Bindings::new("atrous", &frame, &tuning).with_constants(&[("KERNEL", 1)]);
    b.reads("guide", &guide);
    b.reads("surface_id", &ids);
    assert!(b.packed("guide").is_ok() && b.uint("surface_id").is_ok() && b.optional_colour("albedo").expect("absent").is_none());
    let missing = message(b.packed("previous_guide"));
    assert!(["atrous", "previous_guide", "guide, surface_id"].iter().all(|part| missing.contains(part)), "{missing}");
    for other in [message(b.colour("guide")), message(b.optional_colour("guide"))] {
        assert!(["atrous", "guide", COLOUR, PACKED].iter().all(|part| other.contains(part)), "{other}");
    }
    assert_eq!(b.constant("KERNEL"), Ok(1));
    let constant = message(b.constant("VOLUME"));
    assert!(constant.contains("VOLUME") && constant.contains("KERNEL"), "{constant}");
}

#[test]
fn only_what_the_pass_writes_can_be_written() {
    let (frame, tuning) = (frame(EXTENT), svgf_tuning());
    let mut b = Bindings::new("atrous", &frame, &tuning);
    b.writes("output_0", EXTENT);
    let other = message(b.write("output_1", Image::new(EXTENT, [0.0; 4])));
    assert!(other.contains("output_1") && other.contains("output_0"), "{other}");
    let small = message(b.write("output_0", Image::new([3, 3], [0.0; 4])));
    assert!(small.contains("output_0") && small.contains("[3, 3]") && small.contains("[12, 9]"), "{small}");
    b.write("output_0", Image::new(EXTENT, [0.5; 4])).expect("it may");
    assert_eq!(b.into_written(), [("output_0", Texels::Colour(Image::new(EXTENT, [0.5; 4])))]);
}

#[test]
fn the_second_signal_is_there_or_not() {
    let (frame, tuning) = (frame(EXTENT), svgf_tuning());
    let images = [noise(EXTENT, 1), noise(EXTENT, 2)].map(Texels::Colour);
    let mut b = Bindings::new("atrous", &frame, &tuning);
    assert!(message(b.colours("input")).contains("input_0"));
    b.reads("input_0", &images[0]);
    assert_eq!(b.colours("input").map(|signals| signals.len()), Ok(1));
    b.reads("input_1", &images[1]);
    assert_eq!(b.colours("input").map(|signals| signals[1].clone()), Ok(noise(EXTENT, 2)));
}

#[test]
fn counts_are_added_to_those_before() {
    let (frame, tuning) = (frame([2, 1]), svgf_tuning());
    let counts = |counts: &[(Counter, u32)]| Texels::Bytes(counted(counts).as_bytes().to_vec());
    let before = counts(&[(Counter::Depth, 1), (Counter::Radiance, 7)]);
    let guide = Texels::Packed(Image::new([2, 1], pack_guide(&surface(2.0))));
    let noisy = Texels::Colour(paint([2, 1], |x, _| [if x == 0 { f32::NAN } else { 1.0 }; 4]));
    let mut b = Bindings::new("demodulate", &frame, &tuning).with_constants(&[("SAMPLING", 0), ("SPECULAR", 0), ("COAT", 0)]);
    for (name, texels) in [("statistics", &before), ("guide", &guide), ("noisy_0", &noisy)] {
        b.reads(name, texels);
    }
    b.writes("statistics", [size_of::<Statistics>() as u32, 1]);
    b.writes("irradiance_0", [2, 1]);
    crate::nodes::demodulate::twin::twin(&mut b).expect("all is bound");
    let written = b.into_written();
    assert_eq!(written[0], ("statistics", counts(&[(Counter::Depth, 1), (Counter::Radiance, 8)])));
    assert_eq!(
        written[1].1,
        Texels::Colour(Image::from_texels([2, 1], vec![[1.0, 1.0, 1.0, HOLE], [1.0, 1.0, 1.0, 0.0]]).expect("two"))
    );
}

#[test]
fn a_constant_chooses_the_kernel_and_the_geometry() {
    let (frame, tuning) = (frame(EXTENT), svgf_tuning());
    let scene = guides(EXTENT, |x, _| surface(if x < 5 { 2.0 } else { 2.3 }));
    let image = noise(EXTENT, 3).map(|t| [t[0], t[0], t[0], 0.5]);
    let guide = Texels::Packed(scene.guide.clone());
    let input = Texels::Colour(image.clone());
    let run = |constants: &[(&str, u32)]| {
        let mut b = Bindings::new("atrous", &frame, &tuning).with_level(1).with_constants(constants);
        b.reads("guide", &guide);
        b.reads("input_0", &input);
        b.writes("output_0", EXTENT);
        crate::nodes::atrous::twin::twin(&mut b).expect("all is bound");
        b.into_written().remove(0).1
    };
    let inputs = AtrousInputs { guide: &scene.guide, reflection: None, irradiance: &[&image] };
    let level = AtrousLevel::new(1);
    let surfaces = |level| atrous(&frame, &tuning, level, &inputs).remove(0);
    let expected = [
        ([0, 0, 0], surfaces(level)),
        ([1, 0, 0], surfaces(AtrousLevel { kernel: Kernel::Box, ..level })),
        ([0, 0, 1], surfaces(AtrousLevel { luminance_weight: LuminanceWeight::OfMeans, ..level })),
        ([0, 1, 0], volume_atrous(&frame, &tuning, level, &scene.guide, &image)),
    ];
    for ([kernel, volume, ours], expected) in expected {
        let constants = [("KERNEL", kernel), ("VOLUME", volume), ("OURS", ours), ("LAST", 0), ("MARKED", 0)];
        assert_eq!(run(&constants), Texels::Colour(expected), "{constants:?}");
    }
}

#[test]
fn what_is_claimed_before_stays_where_its_key_is_larger() {
    let extent = [8, 8];
    let (frame, tuning) = (frame_with(&crate::Config::new(extent), &still(extent), &still(extent)), svgf_tuning());
    let guide = Texels::Packed(Image::new(extent, [0; 4]));
    let point = VolumePoint { linear_depth: 2.0, contribution: 1 };
    let points = Texels::Packed(Image::new(extent, pack_volume_point(&point)));
    let claims = Texels::Uint(paint(extent, |x, _| if x == 0 { u32::MAX } else { 0 }));
    let mut b = Bindings::new("volume_motion", &frame, &tuning);
    for (name, texels) in [("guide", &guide), ("previous_points", &points), ("claims", &claims)] {
        b.reads(name, texels);
    }
    b.writes("claims", extent);
    crate::nodes::volume_motion::twin::twin(&mut b).expect("all is bound");
    let Texels::Uint(claims) = b.into_written().remove(0).1 else { panic!("claims are keys") };
    assert!((0..8).all(|y| claims.get(0, y) == Some(&u32::MAX)));
    assert!(claims.texels().iter().all(|key| *key != 0));
}

fn still(extent: [u32; 2]) -> crate::FrameParams {
    camera(extent, glam::Vec3::ZERO)
}

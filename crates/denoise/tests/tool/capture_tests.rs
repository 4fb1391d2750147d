//! Captures that `atrous::capture` writes of slices are read by this tool; on the CPU alone.

use ash::vk::Format;
use atrous::capture::{InputFrame, InputImage, SequenceWriter};
use atrous::config::{
    AdaptiveRule, Conventions, DepthEncoding, EawWeights, GradientSource, MotionDepth, MotionDirection, MotionUnit, NormalEncoding,
    NormalSpace, Preset, Sampling, Signals, ViewForward,
};
use atrous::{Config, FrameParams, ResetReason, Tuning};
use atrous_denoise::frame_files;
use atrous_denoise::setup::{Options, Setup};
use std::path::Path;

/// `first_sequence.json` was written by the first version that wrote the configuration, with nothing at its default. Never edit it: it
/// stands for captures that users kept.
#[test]
fn the_description_of_an_old_capture_is_read() {
    let text = include_str!("first_sequence.json");
    let file = atrous_denoise::camera::parse(Path::new("sequence.json"), text).expect("a sequence");
    let mut config = Config::new([3, 2]);
    file.config.apply(&mut config);
    for (key, value) in &file.conventions {
        atrous_denoise::conventions::set(&mut config.conventions, key, value).expect("a convention");
    }
    let conventions = Conventions {
        depth: DepthEncoding::RayLength,
        background_depth: 0.1,
        normal: NormalEncoding::OctahedralUnorm,
        normal_space: NormalSpace::View,
        motion_unit: MotionUnit::Ndc,
        motion_direction: MotionDirection::CurrentMinusPrevious,
        motion_y_up: true,
        motion_jittered: true,
        motion_depth: MotionDepth::Absolute,
        view_forward: ViewForward::PositiveZ,
        ..Conventions::default()
    };
    let expected = Config {
        levels: Some(3),
        stratum_size: 4,
        gradient_source: GradientSource::Reshaded,
        firefly_filter: true,
        adaptive_rule: AdaptiveRule::Percentiles,
        eaw_weights: EawWeights { radiance: true, normal: false, position: true },
        sampling: Sampling::OneOf2x2,
        conventions,
        ..Config::new([3, 2])
    };
    assert_eq!(config, expected);
    assert_eq!((file.config.preset, file.verbatim, file.tuning["alpha"]), (Some(Preset::Percentile), true, 0.05));
    let [first, second] = [&file.cameras[&0], &file.cameras[&1]];
    assert_eq!((first.reset, second.reset), (Some(ResetReason::OriginShift), None));
    assert_eq!((first.jitter, first.exposure_ratio, first.view_from_world[3]), ([0.1, -0.7], 1.1, [0.3, -1e-7, 12345.678, 1.0]));
    assert_eq!((first.tuning.len(), second.tuning["sigma_l"]), (0, 2.3));
}

/// Written by the first revision that wrote captures: it names no preset, since there was one, and its levels stand beside the frames.
#[test]
fn the_first_capture_is_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/captures/first");
    let files = frame_files::find(&[folder]).expect("frames");
    let setup = Setup::new(&files, &Options::default()).expect("a set-up");
    let conventions = Conventions {
        depth: DepthEncoding::Device,
        normal_space: NormalSpace::View,
        motion_unit: MotionUnit::Pixels,
        motion_depth: MotionDepth::Absolute,
        motion_y_up: true,
        // It has none.
        roughness: setup.config.conventions.roughness,
        ..Conventions::default()
    };
    assert_eq!((setup.config.conventions, setup.config.signals), (conventions, Signals::Apart));
    assert_eq!((setup.config.preset, setup.config.levels), (Preset::Svgf, Some(3)), "best replays nothing of it");
    assert!(setup.config.surface_id && setup.config.object_normal);
    let inputs = ["depth", "normal", "object_normal", "motion", "albedo", "emission", "noisy_direct", "noisy_indirect"];
    for (number, file) in files.iter().enumerate() {
        let frame = atrous_denoise::frame::load(file, &setup).expect("a frame");
        let mut params = FrameParams { jitter: [0.25, -0.5], ..FrameParams::new([3, 2]) };
        params.view_from_world[3] = [0.5, 0.0, 12.0, 1.0];
        params.clip_from_view = [[1.5, 0.0, 0.0, 0.0], [0.0, -2.0, 0.0, 0.0], [0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.1, 0.0]];
        // The numbers of the first frame were kept alone.
        assert_eq!((frame.params, frame.tuning.sigma_l), (params, 3.5));
        for (input, name) in inputs.into_iter().enumerate() {
            let value = |i: usize| (input * 8 + i) as f32 / 256.0 + number as f32 / 8.0 + 0.0625;
            let components = if name == "depth" { 1 } else { 3 };
            let texel = |texel: usize| std::array::from_fn(|c| if c < components { value(4 * texel + c) } else { 0.0 });
            let expected: Vec<[f32; 4]> = (0..6).map(texel).collect();
            assert_eq!(frame.images[name], expected, "{name}");
        }
        assert_eq!(frame.surface_id, Some((1..=6).collect()));
    }
}

fn variants() -> Vec<Conventions> {
    let base = Conventions::default();
    let (depths, normals) =
        ([DepthEncoding::Device, DepthEncoding::RayLength], [NormalEncoding::XyzUnorm, NormalEncoding::Octahedral]);
    let mut all = vec![
        base,
        Conventions { background_depth: 0.1, normal: NormalEncoding::OctahedralUnorm, ..base },
        Conventions { normal_space: NormalSpace::View, view_forward: ViewForward::PositiveZ, ..base },
        Conventions { motion_unit: MotionUnit::Pixels, motion_depth: MotionDepth::Difference, ..base },
        Conventions { motion_unit: MotionUnit::Ndc, motion_depth: MotionDepth::Absolute, ..base },
        Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, motion_y_up: true, motion_jittered: true, ..base },
    ];
    all.extend(depths.map(|depth| Conventions { depth, ..base }));
    all.extend(normals.map(|normal| Conventions { normal, ..base }));
    all
}

#[test]
fn every_convention_and_texel_arrives_as_it_was() {
    for conventions in variants() {
        let folder = tempfile::tempdir().expect("a folder");
        let config = Config { conventions, surface_id: false, ..Config::new([2, 1]) };
        let texels: [[f32; 4]; 2] = [[0.1, 1e-30, f32::INFINITY, 4.0], [5.0, f32::MAX, -7.0, 8.0]];
        let image = |name| InputImage { name, format: Format::R32G32B32A32_SFLOAT, texels: bytemuck::cast_slice(&texels) };
        let images = ["depth", "normal", "motion", "noisy_radiance", "roughness", "emission"].map(image);
        let params = FrameParams { jitter: [0.1, -0.7], exposure_ratio: 1.1, ..FrameParams::new([2, 1]) };
        let tuning = Tuning { alpha: 0.05, ..Tuning::default() };
        let mut writer = SequenceWriter::new(folder.path(), &config.declare().expect("valid")).expect("a writer");
        let input = InputFrame { index: 0, params: &params, tuning: &tuning, images: &images, instance_transforms: None };
        writer.write_frame(&input).expect("written");
        let files = frame_files::find(&[folder.path().to_owned()]).expect("frames");
        let setup = Setup::new(&files, &Options::default()).expect("a set-up");
        assert_eq!(setup.config.conventions, conventions);
        assert_eq!(setup.tuning(0).expect("tunables"), tuning);
        let frame = atrous_denoise::frame::load(&files[0], &setup).expect("a frame");
        assert_eq!(frame.params, params);
        let z = if conventions.motion_depth == MotionDepth::None { [0.0; 2] } else { [f32::INFINITY, -7.0] };
        assert_eq!(frame.images["motion"], [[0.1, 1e-30, z[0], 0.0], [5.0, f32::MAX, z[1], 0.0]]);
        for name in ["normal", "noisy_radiance", "emission"] {
            assert_eq!(frame.images[name], [[0.1, 1e-30, f32::INFINITY, 0.0], [5.0, f32::MAX, -7.0, 0.0]], "{name}");
        }
        assert_eq!(frame.images["roughness"], [[0.1; 4], [5.0; 4]]);
    }
}

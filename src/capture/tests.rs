//! Refusals of the writer, and that they leave nothing behind.

use super::*;
use crate::contract::texel::Plane;
use crate::Config;

const EXTENT: [u32; 2] = [3, 2];

fn config() -> Config {
    Config { surface_id: false, ..Config::new([4, 4]) }
}

/// Bytes of an image of six texels of four floats.
fn texels() -> Vec<u8> {
    vec![0; 6 * 16]
}

fn images<'a>(names: &[&'a str], texels: &'a [u8]) -> Vec<InputImage<'a>> {
    names.iter().map(|name| InputImage { name, format: vk::Format::R32G32B32A32_SFLOAT, texels }).collect()
}

fn write(writer: &mut SequenceWriter, params: &FrameParams, images: &[InputImage]) -> Result<(), Error> {
    writer.write_frame(&InputFrame { index: 0, params, tuning: &Tuning::default(), images, instance_transforms: None })
}

const NEEDED: [&str; 3] = ["depth", "normal", "noisy_radiance"];

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_sequence_can_be_replayed_after_every_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("new/folder");
    let mut writer = SequenceWriter::new(&path, &config().declare().expect("valid")).expect("a writer");
    for count in 1..=2 {
        let bytes = texels();
        let params = FrameParams::new(EXTENT);
        write(&mut writer, &params, &images(&NEEDED, &bytes)).expect("written");
        assert_eq!(writer.frames_written(), count);
        let text = std::fs::read_to_string(path.join("sequence.json")).expect("a file");
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(json["frames"].as_array().map(Vec::len), Some(count as usize), "{text}");
    }
    assert_eq!(names_in(&path), ["frame_0000.exr", "frame_0001.exr", "sequence.json"]);
}

#[test]
fn what_does_not_fit_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut writer = SequenceWriter::new(folder.path(), &config().declare().expect("valid")).expect("a writer");
    let bytes = texels();
    let mut refused =
        |params: FrameParams, images: &[InputImage]| write(&mut writer, &params, images).expect_err("refused").to_string();
    let params = FrameParams::new(EXTENT);
    let message = refused(params, &images(&NEEDED[..2], &bytes));
    assert!(message.contains("`noisy_radiance`"), "{message}");
    let message = refused(params, &images(&["depth", "normal", "noisy_radiance", "dept"], &bytes));
    assert!(message.contains("`dept`") && message.contains("albedo"), "{message}");
    let message = refused(params, &images(&NEEDED, &bytes[1..]));
    assert!(message.contains("95 bytes") && message.contains("3x2 texels of 16 bytes"), "{message}");
    let mut unsupported = images(&NEEDED, &bytes);
    unsupported[2].format = vk::Format::R64_SFLOAT;
    let message = refused(params, &unsupported);
    assert!(message.contains("R64_SFLOAT") && message.contains("B10G11R11"), "{message}");
    let message = refused(FrameParams { jitter: [f32::NAN; 2], ..params }, &images(&NEEDED, &bytes));
    assert!(message.contains("jitter"), "{message}");
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn later_frames_are_like_the_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut writer = SequenceWriter::new(folder.path(), &config().declare().expect("valid")).expect("a writer");
    let bytes = texels();
    let params = FrameParams::new(EXTENT);
    write(&mut writer, &params, &images(&NEEDED, &bytes)).expect("written");
    let other = FrameParams::new([2, 3]);
    let message = write(&mut writer, &other, &images(&NEEDED, &bytes)).expect_err("extent").to_string();
    assert!(message.contains("[2, 3]") && message.contains("[3, 2]"), "{message}");
    let more = images(&["depth", "normal", "noisy_radiance", "emission"], &bytes);
    let message = write(&mut writer, &params, &more).expect_err("images").to_string();
    assert!(message.contains("emission"), "{message}");
    assert_eq!(names_in(folder.path()), ["frame_0000.exr", "sequence.json"]);
}

#[test]
fn nothing_is_overwritten() {
    for name in ["sequence.json", "frame_0007.exr"] {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join(name), b"kept").expect("a file");
        let message = SequenceWriter::new(folder.path(), &config().declare().expect("valid")).err().expect("refused").to_string();
        assert!(message.contains(name) && message.contains("not overwritten"), "{message}");
        assert_eq!(std::fs::read(folder.path().join(name)).expect("a file"), b"kept");
    }
}

#[test]
fn two_captures_in_one_folder_are_not_mixed() {
    let folder = tempfile::tempdir().expect("a folder");
    let writer = || SequenceWriter::new(folder.path(), &config().declare().expect("valid")).expect("a writer");
    let (mut first, mut second) = (writer(), writer());
    let bytes = texels();
    let params = FrameParams::new(EXTENT);
    write(&mut first, &params, &images(&NEEDED, &bytes)).expect("written");
    let files = || names_in(folder.path()).into_iter().map(|name| std::fs::read(folder.path().join(name)).expect("a file"));
    let before: Vec<_> = files().collect();
    let message = write(&mut second, &params, &images(&NEEDED, &[1; 6 * 16])).expect_err("another capture").to_string();
    assert!(message.contains("frame_0000.exr") && message.contains("Choose a folder"), "{message}");
    assert!(files().eq(before));
}

#[cfg(unix)]
#[test]
fn planted_links_are_not_followed() {
    let folder = tempfile::tempdir().expect("a folder");
    let victim = folder.path().join("victim");
    std::fs::write(&victim, "kept").expect("a file");
    for name in [".capture.part", ".frame_0000.exr.part", ".sequence.json.part"] {
        std::os::unix::fs::symlink(&victim, folder.path().join(name)).expect("a link");
    }
    let mut writer = SequenceWriter::new(folder.path(), &config().declare().expect("valid")).expect("a writer");
    write(&mut writer, &FrameParams::new(EXTENT), &images(&NEEDED, &texels())).expect("written");
    assert_eq!(std::fs::read_to_string(&victim).expect("a file"), "kept");
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, b"").expect("a file");
    let message = SequenceWriter::new(file.join("below"), &config().declare().expect("valid")).err().expect("refused").to_string();
    assert!(message.contains("below") && message.contains("Choose a folder"), "{message}");
}

/// A file has it in the one channel of its layer.
#[test]
fn roughness_is_written_from_its_channel() {
    use crate::config::{Channel, Conventions};
    let planes = || (0..4).map(|i| Plane::Float(vec![i as f32])).collect::<Vec<_>>();
    for (channel, expected) in [(Channel::R, 0.0), (Channel::G, 1.0), (Channel::A, 3.0)] {
        let conventions = Conventions { roughness_channel: channel, ..Default::default() };
        let layer = Layer::of_input("roughness", &conventions, false, planes(), 1);
        let values: Vec<Vec<f32>> = layer.planes.iter().map(|(_, plane)| plane.values_as_f32().collect()).collect();
        assert_eq!(values, [[expected]], "{channel}");
        let other = Layer::of_input("noisy_visibility", &conventions, false, planes(), 1);
        assert_eq!(other.planes[0].1.values_as_f32().collect::<Vec<_>>(), [0.0]);
    }
}

/// The description of a capture without a single default, as `golden_sequence.json` has it.
fn written_now(folder: &Path) -> String {
    use crate::config::*;
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
        roughness: RoughnessEncoding::Alpha,
        motion_scale: 0.02,
        roughness_channel: Channel::B,
        demodulated: true,
    };
    let config = Config {
        preset: Preset::Percentile,
        levels: Some(3),
        stratum_size: 4,
        gradient_source: GradientSource::Reshaded,
        firefly_filter: true,
        adaptive_rule: AdaptiveRule::Percentiles,
        eaw_weights: EawWeights { radiance: true, normal: false, position: true },
        sampling: Sampling::OneOf2x2,
        conventions,
        ..config()
    };
    let mut writer = SequenceWriter::new(folder, &config.declare().expect("valid")).expect("a writer");
    let bytes = texels();
    let first = Tuning { alpha: 0.05, ..Tuning::for_preset(Preset::Svgf) };
    let later = Tuning { sigma_l: 2.3, ..first };
    for (reset, tuning) in [(Some(crate::ResetReason::OriginShift), first), (None, later)] {
        let mut params = FrameParams { reset, jitter: [0.1, -0.7], exposure_ratio: 1.1, ..FrameParams::new(EXTENT) };
        params.view_from_world[3] = [0.3, -1e-7, 12345.678, 1.0];
        let images = images(&NEEDED, &bytes);
        let index = u64::from(writer.frames_written());
        let frame = InputFrame { index, params: &params, tuning: &tuning, images: &images, instance_transforms: None };
        writer.write_frame(&frame).expect("written");
    }
    std::fs::read_to_string(folder.join("sequence.json")).expect("a file")
}

/// The default may change, and what a capture replays must not.
#[test]
fn a_capture_names_its_preset_and_every_number() {
    let (config, tuning) = (Config::new(EXTENT), Tuning::default());
    let text =
        sequence_json::Head::new(Some(&config), [("light_extent", None), ("output_extent", None)], &config.conventions, &tuning)
            .expect("JSON")
            .with_frames([]);
    let written: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(written["config"]["preset"], config.preset.name(), "{text}");
    assert_eq!(written["tuning"].as_object().map(|numbers| numbers.len()), Some(Tuning::FIELDS.len()), "{text}");
}

#[test]
fn a_sequence_is_described_as_in_the_golden_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let written = written_now(folder.path());
    let json = |text: &str| serde_json::from_str::<serde_json::Value>(text).expect("JSON");
    // Whole numbers may be written with a point: what a reader gets is the same.
    fn as_read(value: &serde_json::Value) -> serde_json::Value {
        use serde_json::Value as V;
        match value {
            V::Number(n) => n.as_f64().into(),
            V::Array(values) => values.iter().map(as_read).collect(),
            V::Object(fields) => V::Object(fields.iter().map(|(key, value)| (key.clone(), as_read(value))).collect()),
            other => other.clone(),
        }
    }
    assert_eq!(as_read(&json(&written)), as_read(&json(include_str!("golden_sequence.json"))), "{written}");
}

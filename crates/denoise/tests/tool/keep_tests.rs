//! What goes out is what came in: names, metadata, windows, other layers.

use crate::samples::{bounds, denoise, frame_path, Sample, Type};
use atrous_denoise::exr_read::{read, read_header, Samples};
use exr::compression::Compression;
use exr::image::{AnyChannels, FlatSamples, Image};
use exr::meta::attribute::{AttributeValue, Chromaticities, TimeCode};
use exr::prelude::{ImageAttributes, SmallVec, Text, Vec2, WritableImage};
use std::path::Path;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn text(text: &str) -> Text {
    Text::new_or_panic(text)
}

/// Writes parts with attributes of their own: name, comment, sample.
fn write_parts(path: &Path, parts: &[(&str, &str, &Sample)], shared: impl FnOnce(&mut ImageAttributes)) {
    let mut attributes = ImageAttributes::new(parts[0].2.display);
    shared(&mut attributes);
    let layers: SmallVec<[exr::image::Layer<AnyChannels<FlatSamples>>; 2]> = parts
        .iter()
        .map(|(name, comment, sample)| {
            let mut layer = sample.layer(Some(name));
            layer.attributes.comments = Some(text(comment));
            layer.attributes.other.insert(text("cryptomatte/1/name"), AttributeValue::Text(text("crypto")));
            layer
        })
        .collect();
    Image::from_layers(attributes, layers).write().non_parallel().to_file(path).expect("a file");
}

/// Depth in PIZ first, a matte, and the beauty last, in ZIP.
fn beauty_last(folder: &Path) {
    for number in 0..2 {
        let depth = Sample { compression: Compression::PIZ, ..Sample::new(16, 12).flat("Z", Type::Float, 2.0) };
        let matte = Sample::new(16, 12).channel("crypto00.R", Type::Float, |x, _| x as f32).flat("crypto00.G", Type::Uint, 9.0);
        let colour = Sample::new(16, 12).flat("R G B", Type::Half, 0.5).flat("A", Type::Half, 1.0);
        let parts = [("depth", "depth pass", &depth), ("matte", "ids", &matte), ("C", "beauty pass", &colour)];
        write_parts(&frame_path(folder, number), &parts, |shared| {
            shared.time_code = Some(TimeCode { hours: 1, minutes: 2, seconds: 3, frame: 4, ..TimeCode::default() });
            shared.chromaticities =
                Some(Chromaticities { red: Vec2(0.7, 0.3), green: Vec2(0.2, 0.8), blue: Vec2(0.1, 0.1), white: Vec2(0.3, 0.3) });
        });
    }
}

#[test]
fn the_result_has_the_attributes_of_the_part_of_the_beauty() {
    let (input, output) = (folder(), folder());
    beauty_last(input.path());
    denoise(input.path(), output.path(), &[]).expect("a run");
    let header = read_header(&frame_path(output.path(), 1)).expect("a result");
    let part = &header.parts[0];
    assert_eq!(header.parts.len(), 1);
    assert_eq!(part.layer_name.as_ref().map(ToString::to_string).as_deref(), Some("C"));
    assert_eq!(part.comments.as_ref().map(ToString::to_string).as_deref(), Some("beauty pass"));
    assert_eq!(header.compressions[0], Compression::ZIP16);
    let names: Vec<_> = header.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["A", "B", "G", "R"]);
    assert!(!part.other.keys().any(|name| name.to_string().starts_with("cryptomatte")), "its channels are not there");
    assert_eq!(header.shared.time_code.map(|code| code.frame), Some(4));
    assert_eq!(header.shared.chromaticities.map(|c| c.green), Some(Vec2(0.2, 0.8)));
    denoise(input.path(), output.path(), &["--resume", "--strip"]).expect("finished frames are found");
}

#[test]
fn other_parts_are_kept_where_they_are_asked_for() {
    let (input, output) = (folder(), folder());
    beauty_last(input.path());
    denoise(input.path(), output.path(), &["--keep-layers"]).expect("a run");
    let path = frame_path(output.path(), 0);
    let header = read_header(&path).expect("a result");
    let names: Vec<_> = header.parts.iter().filter_map(|p| p.layer_name.as_ref()).map(ToString::to_string).collect();
    assert_eq!(names, ["depth", "matte", "C"]);
    assert_eq!(header.compressions, [Compression::PIZ, Compression::ZIP16, Compression::ZIP16]);
    let kept = read(&path, |_| true).expect("a result").samples;
    assert_eq!(kept["depth.Z"], Samples::Float(vec![2.0; 16 * 12]));
    assert_eq!(kept["matte.crypto00.G"], Samples::Uint(vec![9; 16 * 12]));
    assert!(matches!(&kept["C.R"], Samples::Float(values) if values.iter().all(|v| (v - 0.5).abs() < 0.02)));
    assert!(header.parts[2].other.contains_key(&text("cryptomatte/1/name")));
    denoise(input.path(), output.path(), &["--keep-layers", "--resume", "--strip"]).expect("finished frames are found");
    let other = denoise(input.path(), output.path(), &["--resume"]).expect_err("other options").to_string();
    assert!(other.contains("keep_layers"), "{other}");
}

#[test]
fn the_result_stands_where_a_compositor_looks_for_it() {
    for view in ["ViewLayer.", ""] {
        let (input, output) = (folder(), folder());
        let components = ["A", "B", "G", "R"];
        for number in 0..2 {
            let sample = Sample::new(16, 12).flat(&format!("{view}Depth.Z"), Type::Float, 3.0);
            let sample = components.into_iter().fold(sample, |sample, c| {
                let sample = sample.channel(&format!("{view}Combined.{c}"), Type::Half, |_, _| 0.25);
                sample.channel(&format!("{view}Noisy Image.{c}"), Type::Half, |_, _| 0.75)
            });
            sample.write(&frame_path(input.path(), number));
        }
        denoise(input.path(), output.path(), &[]).expect("a run");
        let planes = read(&frame_path(output.path(), 1), |_| true).expect("a result").samples;
        let names: Vec<_> = planes.keys().cloned().collect();
        assert_eq!(names, components.map(|c| format!("{view}Combined.{c}")));
        // What Blender's own denoiser made is not what was filtered.
        let red = &planes[&format!("{view}Combined.R")];
        assert!(matches!(red, Samples::Float(values) if values.iter().all(|v| (v - 0.75).abs() < 0.02)), "{view}");
    }
}

#[test]
fn overscan_and_crops_are_kept() {
    for data in [bounds(-4, -3, 24, 18), bounds(2, 3, 10, 6)] {
        let (input, output) = (folder(), folder());
        for number in 0..2 {
            let sample = Sample { data, ..Sample::new(16, 12) };
            let sample = sample.channel("R", Type::Float, |x, y| 1.0 + 0.01 * (x + y) as f32).flat("G B", Type::Float, 0.5);
            sample.write(&frame_path(input.path(), number));
        }
        denoise(input.path(), output.path(), &["--float", "--preset", "eaw"]).expect("a run");
        let header = read_header(&frame_path(output.path(), 1)).expect("a result");
        assert_eq!((header.part_windows[0], header.shared.display_window), (data, bounds(0, 0, 16, 12)));
        let given = read(&frame_path(input.path(), 1), |c| c.name == "R").expect("an input").samples.remove("R");
        let made = read(&frame_path(output.path(), 1), |c| c.name == "R").expect("a result").samples.remove("R");
        let (Some(Samples::Float(given)), Some(Samples::Float(made))) = (given, made) else { panic!("floats") };
        let worst = given.iter().zip(&made).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // A slope is hardly changed; another place would be.
        assert!(given.len() == made.len() && worst < 0.08, "{data:?}: {worst}");
    }
}

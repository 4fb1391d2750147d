//! The gate: on every kind of input that renderers write, the result is nearer to the truth than the
//! input, and has its light.

use crate::samples::scene::{Frame, Scene, Seen, SIZE};
use crate::samples::{denoise, Sample};
use atrous_denoise::exr_read::{read, Samples};
use std::path::Path;

const FRAMES: u32 = 5;
/// Values above this are cut before they are compared: no firefly decides.
const CAP: f32 = 4.0;
const SCENE: Scene = Scene { speed: 0.03, animates: true, samples: 8, is_carried: false, fog: 0.0 };

/// A kind of input: its name, the scene, what is written of a frame, and the unit of its light.
struct Kind {
    name: &'static str,
    scene: Scene,
    write: fn(&Path, u32, &Frame),
    has_cameras: bool,
    /// The channels of the result's colour, and the unit of its light.
    result: (&'static str, f32),
}

fn path(folder: &Path, number: u32) -> std::path::PathBuf {
    crate::samples::frame_path(folder, number)
}

fn scaled(frame: &Frame, unit: f32) -> Sample {
    let sample = frame.add(Frame::sample(), "", "RGB", move |s: &Seen| s.noisy.map(|v| v * unit));
    let sample = frame.add(sample, "ref", "RGB", move |s: &Seen| s.reference.map(|v| v * unit));
    let sample = frame.add(sample, "albedo", "RGB", |s| s.albedo);
    let sample = frame.add(sample, "normal", "XYZ", |s| s.normal);
    let sample = frame.add(sample, "depth", "Z", |s| [s.depth]);
    frame.add(sample, "motion", "XY", |s| s.motion)
}

fn blender(frame: &Frame, light: impl Fn(&Seen) -> [f32; 3] + Clone + 'static) -> Sample {
    let sample = frame.add(Frame::sample(), "ViewLayer.Combined", "RGB", light);
    let sample = frame.add(sample, "ViewLayer.DiffCol", "RGB", |s| s.albedo);
    let sample = frame.add(sample, "ViewLayer.Normal", "XYZ", |s| s.normal);
    let sample = frame.add(sample, "ViewLayer.Depth", "Z", |s| [if s.id == 0 { 1e10 } else { s.depth }]);
    let sample = frame.add(sample, "ViewLayer.Vector", "XY", |s| [s.motion[0], -s.motion[1]]);
    let sample = frame.add(sample, "ViewLayer.IndexOB", "X", |s| [s.id as f32]);
    frame.add(sample, "ref", "RGB", |s| s.reference)
}

fn transparent(folder: &Path, number: u32, frame: &Frame) {
    let of_surfaces = |s: &Seen| if s.id == 0 { [0.0; 3] } else { s.noisy };
    let sample = blender(frame, of_surfaces);
    let sample = frame.add(sample, "ViewLayer.Combined", "A", |s| [f32::from(s.id != 0)]);
    // The sky that the film lets through.
    let sample = frame.add(sample, "ViewLayer.Env", "RGB", |s| if s.id == 0 { s.noisy } else { [0.0; 3] });
    let sample = Sample { channels: sample.channels.into_iter().filter(|c| !c.0.starts_with("ref.")).collect(), ..sample };
    let sample = frame.add(sample, "ref", "RGB", |s| if s.id == 0 { [0.0; 3] } else { s.reference });
    sample.write(&path(folder, number));
}

/// Blender's passes: what the fog scatters is apart, and all guides are noisy.
fn fog(folder: &Path, number: u32, frame: &Frame) {
    let sample = blender(frame, |s| s.noisy);
    let sample = frame.add(sample, "ViewLayer.VolumeDir", "RGB", |s| s.volume);
    frame.add(sample, "ViewLayer.Env", "RGB", |s| s.environment).write(&path(folder, number));
}

fn negative(folder: &Path, number: u32, frame: &Frame) {
    // A filter with negative lobes: one pixel in eight gives light to the next one, and more than it has.
    let mut pixels: Vec<Seen> = frame.pixels.to_vec();
    for i in (0..pixels.len() - 1).step_by(8) {
        let given = pixels[i].noisy.map(|v| 1.3 * v);
        pixels[i].noisy = std::array::from_fn(|c| pixels[i].noisy[c] - given[c]);
        pixels[i + 1].noisy = std::array::from_fn(|c| pixels[i + 1].noisy[c] + given[c]);
    }
    Frame { pixels: std::rc::Rc::new(pixels) }.plain().write(&path(folder, number));
}

/// Files of their own for every guide, beside the colour.
fn apart(folder: &Path, number: u32, frame: &Frame) {
    let file = |ending: &str| folder.join(format!("frame_{number:04}_v002_{ending}.exr"));
    frame.add(Frame::sample(), "", "RGB", |s| s.noisy).write(&file("hdr"));
    frame.add(Frame::sample(), "", "RGB", |s| s.albedo).write(&file("ALBEDO"));
    frame.add(Frame::sample(), "", "RGB", |s| s.normal).write(&file("SHADING_NORMAL"));
    frame.add(Frame::sample(), "", "RGB", |s| [s.depth; 3]).write(&file("DEPTH"));
    frame.add(Frame::sample(), "", "RGB", |s| [f32::from(s.id != 0); 3]).write(&file("ALPHA"));
    frame.add(Frame::sample(), "", "RGB", |s| s.reference).write(&file("ref"));
}

fn parts(folder: &Path, number: u32, frame: &Frame) {
    let colour = frame.add(Frame::sample(), "", "RGB", |s| s.noisy);
    let guides = frame.guides(Frame::sample());
    Sample::write_parts(
        [("guides", &Sample { channels: guides.channels, ..Frame::sample() }), ("rgba", &colour)],
        &path(folder, number),
    );
}

fn grey(folder: &Path, number: u32, frame: &Frame) {
    let sample = frame.add(Frame::sample(), "", "Y", |s| [s.noisy[1]]);
    let sample = frame.add(sample, "ref", "RGB", |s| [s.reference[1]; 3]);
    frame.add(sample, "albedo", "RGB", |s| [s.albedo[1]; 3]).write(&path(folder, number));
}

const KINDS: &[Kind] = &[
    Kind {
        name: "plain layers",
        scene: SCENE,
        write: |folder, number, frame| frame.plain().write(&path(folder, number)),
        has_cameras: true,
        result: ("RGB", 1.0),
    },
    Kind {
        name: "Blender's transparent film",
        scene: SCENE,
        write: transparent,
        has_cameras: true,
        result: ("ViewLayer.Combined.RGB", 1.0),
    },
    Kind {
        name: "Blender's fog",
        scene: Scene { fog: 0.12, ..SCENE },
        write: fog,
        has_cameras: true,
        result: ("ViewLayer.Combined.RGB", 1.0),
    },
    Kind {
        name: "physical units",
        scene: SCENE,
        write: |folder, number, frame| scaled(frame, 2e5).write(&path(folder, number)),
        has_cameras: true,
        result: ("RGB", 2e5),
    },
    Kind {
        name: "tiny units",
        scene: SCENE,
        write: |folder, number, frame| scaled(frame, 1e-9).write(&path(folder, number)),
        has_cameras: true,
        result: ("RGB", 1e-9),
    },
    Kind {
        name: "the same noise in every frame",
        scene: Scene { animates: false, samples: 16, ..SCENE },
        write: |folder, number, frame| frame.plain().write(&path(folder, number)),
        has_cameras: true,
        result: ("RGB", 1.0),
    },
    Kind {
        name: "a thing that the camera carries",
        scene: Scene { is_carried: true, ..SCENE },
        write: |folder, number, frame| frame.plain().write(&path(folder, number)),
        has_cameras: true,
        result: ("RGB", 1.0),
    },
    Kind { name: "negative pixels", scene: SCENE, write: negative, has_cameras: true, result: ("RGB", 1.0) },
    Kind {
        name: "a file for each guide, with a version",
        scene: Scene { speed: 0.0, ..SCENE },
        write: apart,
        has_cameras: false,
        result: ("RGB", 1.0),
    },
    Kind { name: "the colour in the last part", scene: SCENE, write: parts, has_cameras: true, result: ("RGB", 1.0) },
    Kind { name: "grey", scene: Scene { speed: 0.0, ..SCENE }, write: grey, has_cameras: false, result: ("Y", 1.0) },
];

/// A colour in units of the light, of as many channels as there are letters.
fn colour(file: &Path, (names, unit): (&str, f32)) -> Vec<f32> {
    let (layer, letters) = names.rsplit_once('.').map_or(("", names), |(layer, letters)| (layer, letters));
    let name = |letter: char| if layer.is_empty() { letter.to_string() } else { format!("{layer}.{letter}") };
    let names: Vec<String> = letters.chars().map(name).collect();
    let planes = read(file, |c| names.contains(&c.name)).expect("a result");
    let plane = |name: &String| match planes.samples.get(name) {
        Some(Samples::Float(values)) => values.iter().map(|v| v / unit).collect::<Vec<_>>(),
        other => panic!("{}: {name}: {other:?}", file.display()),
    };
    names.iter().flat_map(plane).collect()
}

fn error(a: &[f32], b: &[f32]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| f64::from(a.min(CAP) - b.min(CAP)).powi(2));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

#[test]
fn every_kind_of_input_is_made_better_and_keeps_its_light() {
    for kind in KINDS {
        let (input, output) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
        let frames: Vec<Frame> = (0..FRAMES).map(|number| kind.scene.frame(number)).collect();
        for (number, frame) in frames.iter().enumerate() {
            (kind.write)(input.path(), number as u32, frame);
        }
        if kind.has_cameras {
            std::fs::write(input.path().join("sequence.json"), kind.scene.cameras(0..FRAMES)).expect("cameras");
        }
        let options: &[&str] = if kind.name == "grey" { &["--float", "--channel", "noisy=Y"] } else { &["--float"] };
        denoise(input.path(), output.path(), options).unwrap_or_else(|e| panic!("{}: {e}", kind.name));
        let files = atrous_denoise::frame_files::find(&[output.path().to_owned()]).expect("results");
        let frame = &frames[FRAMES as usize - 1];
        let result = colour(&files[FRAMES as usize - 1].colour, kind.result);
        let channels = result.len() / (SIZE[0] * SIZE[1]);
        let hidden = |s: &Seen| kind.name == "Blender's transparent film" && s.id == 0;
        let of = |value: fn(&Seen) -> [f32; 3]| -> Vec<f32> {
            let component = |c: usize| frame.pixels.iter().map(move |s| if hidden(s) { 0.0 } else { value(s)[c] });
            if channels == 1 {
                component(1).collect()
            } else {
                (0..3).flat_map(component).collect()
            }
        };
        let (noisy, truth) = (of(|s| s.noisy), of(|s| s.reference));
        let (before, after) = (error(&noisy, &truth), error(&result, &truth));
        let light = |values: &[f32]| values.iter().map(|v| f64::from(*v)).sum::<f64>();
        let share = light(&result) / light(&truth);
        println!("{}: error {before:.4} to {after:.4}, light {share:.4}", kind.name);
        assert!(after < before, "{}: {after} is no better than {before}", kind.name);
        assert!((share - 1.0).abs() < 0.02, "{}: {share} of the light", kind.name);
    }
}

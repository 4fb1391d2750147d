//! What is seen in mirrors and through glass, by Blender's depth for denoisers.

use super::look_tests::folder;
use crate::samples::{frame_path, Sample, Type};
use atrous::config::NormalSpace;
use atrous_denoise::first_look;
use atrous_denoise::frame::FrameInputs;
use atrous_denoise::frame_files;
use atrous_denoise::loader::Loader;
use atrous_denoise::roles::Role;
use atrous_denoise::setup::{Options, Setup};

const WIDTH: u32 = 36;
const HEIGHT: u32 = 12;
/// Surfaces stand here; what is seen in the mirror this far behind it, and through the glass at that depth.
const DEPTH: f32 = 4.0;
const IN_MIRROR: f32 = 6.0;
const BEHIND: f32 = 12.0;
/// Of the mirror.
const REFLECTED: f32 = 0.75;
/// Of the camera, to the right from frame to frame.
const STEP: f32 = 0.5;
const FOCAL: [f32; 2] = [2.5, 7.5];

const WALL: usize = 5;
const MIRROR: usize = 18;
const GLASS: usize = 30;

/// Twelve columns each of a wall, a mirror and glass.
#[derive(Clone, Copy)]
struct Sequence {
    /// Of normals, from pixel to pixel.
    turn: f32,
    has_paths: bool,
    /// The sky is seen, where no path ends.
    shows_sky: bool,
    /// Of what is seen, in mirror and glass.
    radiance: f32,
    is_perspective: bool,
}

const FLAT: Sequence = Sequence { turn: 0.0, has_paths: true, shows_sky: false, radiance: 0.0, is_perspective: true };

fn frames(sequence: Sequence) -> tempfile::TempDir {
    let Sequence { turn, has_paths, shows_sky, radiance, is_perspective } = sequence;
    let folder = folder();
    let (half, float) = (Type::Half, Type::Float);
    let ray = |x: u32, y: u32| {
        let at = |place: u32, side: u32, focal: f32| ((place as f32 + 0.5) / side as f32 * 2.0 - 1.0) / focal;
        (1.0 + at(x, WIDTH, FOCAL[0]).powi(2) + at(y, HEIGHT, FOCAL[1]).powi(2)).sqrt()
    };
    let length = move |x: u32, y: u32| match x / 12 {
        0 => DEPTH * ray(x, y),
        _ if shows_sky => 0.0,
        1 => DEPTH * ray(x, y) + REFLECTED * IN_MIRROR,
        _ => BEHIND * ray(x, y),
    };
    let colours = |sample: Sample, name: &str, values: [f32; 3]| {
        let channels = ["R", "G", "B"].map(|c| format!("ViewLayer.{name}.{c}"));
        channels.iter().fold(sample, |sample, name| sample.channel(name, half, move |x, _| values[x as usize / 12]))
    };
    for number in 1..=2 {
        let sample = Sample::new(WIDTH as usize, HEIGHT as usize)
            .flat("ViewLayer.Emit.R ViewLayer.Emit.G ViewLayer.Emit.B", half, 0.0)
            .flat("ViewLayer.Depth.Z", float, DEPTH)
            .flat("ViewLayer.Vector.X", float, FOCAL[0] * WIDTH as f32 / 2.0 * STEP / DEPTH)
            .flat("ViewLayer.Vector.Y ViewLayer.Normal.Y", float, 0.0)
            .channel("ViewLayer.Normal.X", float, move |x, _| (turn * x as f32).sin())
            .channel("ViewLayer.Normal.Z", float, move |x, _| (turn * x as f32).cos())
            .channel("ViewLayer.IndexOB.X", float, |x, _| (1 + x / 12) as f32);
        let sample = colours(sample, "DiffCol", [0.5, 0.0, 0.0]);
        let sample = colours(sample, "GlossCol", [0.0, REFLECTED, 0.0625]);
        let sample = colours(sample, "Combined", [0.75, 0.75 + REFLECTED * radiance, 0.75 + radiance]);
        let sample = colours(sample, "Denoising Albedo", [0.5, REFLECTED * (0.5 + radiance), 0.5 + radiance]);
        let sample = colours(sample, "GlossDir", [0.0, 0.5 + radiance, 0.5]);
        let mut sample = colours(sample, "GlossInd", [0.0, 0.5, 0.5]);
        if has_paths {
            sample = sample.channel("ViewLayer.Denoising Depth.Z", float, move |x, y| length(x as u32, y as u32));
        }
        sample.write(&frame_path(folder.path(), number));
    }
    write_cameras(folder.path(), is_perspective);
    folder
}

fn write_cameras(folder: &std::path::Path, is_perspective: bool) {
    let camera = |i: u32| {
        format!(
            r#"{{"i": {i}, "view": [[1, 0, 0, {}], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
            "proj": [[{}, 0, 0, 0], [0, -{}, 0, 0], [0, 0, -1.0001, -0.1], [0, 0, {}]]}}"#,
            -STEP * i as f32,
            FOCAL[0],
            FOCAL[1],
            if is_perspective { "-1, 0" } else { "0, 1" }
        )
    };
    std::fs::write(folder.join("sequence.json"), format!(r#"{{"frames": [{}, {}]}}"#, camera(1), camera(2))).expect("written");
}

/// The second frame.
fn loaded(sequence: Sequence, channels: &[(Role, String)]) -> FrameInputs {
    let folder = frames(sequence);
    let files = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&files, &Options { channels: channels.to_vec(), ..Options::default() }).expect("a setup");
    let mut loader = Loader::new(&setup);
    files.iter().map(|files| loader.load(files).expect("a frame")).last().expect("two frames")
}

fn at(inputs: &FrameInputs, image: &str, column: usize) -> f32 {
    inputs.images[image][6 * WIDTH as usize + column][0]
}

fn assert_motion(inputs: &FrameInputs, column: usize, depth: f32) {
    let (motion, expected) = (at(inputs, "motion", column), FOCAL[0] * WIDTH as f32 / 2.0 * STEP / depth);
    assert!((motion - expected).abs() < 0.01, "{column}: {motion} for {expected}");
}

#[test]
fn what_is_seen_through_flat_glass_moves_as_it_does() {
    let inputs = loaded(FLAT, &[]);
    assert_motion(&inputs, GLASS, BEHIND);
    assert_motion(&inputs, MIRROR, DEPTH);
    assert_motion(&inputs, WALL, DEPTH);
    assert_motion(&loaded(Sequence { has_paths: false, ..FLAT }, &[]), GLASS, DEPTH);
}

#[test]
fn the_sky_behind_flat_glass_and_in_a_mirror_is_far_away() {
    let inputs = loaded(Sequence { shows_sky: true, ..FLAT }, &[]);
    assert_motion(&inputs, GLASS, 1e4 * DEPTH);
    assert_motion(&inputs, WALL, DEPTH);
    assert!(at(&inputs, "specular_hit_distance", MIRROR) > 1e4 * DEPTH);
}

/// What shines there is no noise, and nothing that a surface reflects.
#[test]
fn lamps_in_flat_mirrors_are_not_filtered() {
    let of = |turn| {
        let inputs = loaded(Sequence { radiance: 3.0, turn, ..FLAT }, &[]);
        [WALL, MIRROR, GLASS].map(|column| ["emission", "noisy_specular", "noisy_diffuse"].map(|image| at(&inputs, image, column)))
    };
    // Of 3.5 that is seen in the mirror, 1 may be light of a surface.
    let mirror = REFLECTED * 2.5;
    assert_eq!(of(0.0), [[0.0, 0.0, 0.75], [mirror, 3.0 - mirror, 0.0], [0.0, 0.0625, 3.6875]]);
    assert_eq!(of(0.03), [[0.0, 0.0, 0.75], [0.0, 3.0, 0.0], [0.0, 0.0625, 3.6875]], "curved");
}

#[test]
fn a_lens_moves_as_its_surface() {
    // As a sphere that is as wide as the picture.
    assert_motion(&loaded(Sequence { turn: 0.03, ..FLAT }, &[]), GLASS, DEPTH);
}

#[test]
fn a_mirror_has_the_distance_of_what_is_seen_in_it() {
    let inputs = loaded(FLAT, &[]);
    let distance = at(&inputs, "specular_hit_distance", MIRROR);
    assert!((distance - IN_MIRROR).abs() < 0.02, "{distance}");
    assert!((at(&inputs, "roughness", MIRROR) - 0.15).abs() < 1e-6);
    for column in [WALL, GLASS] {
        assert_eq!([at(&inputs, "specular_hit_distance", column), at(&inputs, "roughness", column)], [-1.0; 2], "{column}");
    }
    let round = loaded(Sequence { turn: 0.03, ..FLAT }, &[]);
    assert!((at(&round, "specular_hit_distance", MIRROR) - IN_MIRROR).abs() < 0.02);
    for other in [loaded(Sequence { turn: 0.1, ..FLAT }, &[]), loaded(Sequence { has_paths: false, ..FLAT }, &[])] {
        assert!(!other.images.contains_key("specular_hit_distance") && !other.images.contains_key("roughness"));
    }
}

#[test]
fn where_lines_of_sight_are_parallel_nothing_is_followed() {
    let inputs = loaded(Sequence { is_perspective: false, ..FLAT }, &[]);
    assert_motion(&inputs, GLASS, DEPTH);
    assert!(!inputs.images.contains_key("specular_hit_distance"));
    // A wall that is black is paint.
    let folder = frames_for_denoisers(0.0, 0.0, true);
    write_cameras(folder.path(), false);
    assert!(!looked_at(&folder).1.has_lobes);
}

#[test]
fn given_distances_stay() {
    let given = (Role::HitDistance, "ViewLayer.Depth.Z".to_owned());
    let inputs = loaded(FLAT, &[given]);
    assert_eq!(at(&inputs, "specular_hit_distance", MIRROR), DEPTH);
    assert!(!inputs.images.contains_key("roughness"));
}

/// The same surfaces with the passes for denoisers alone. `bulge`: of the mirror, over the square of columns from its middle.
fn frames_for_denoisers(bulge: f32, albedo_of_wall: f32, emits: bool) -> tempfile::TempDir {
    let folder = folder();
    let ray = |x: i32, y: i32| {
        let at = |place: i32, side: u32, focal: f32| ((place as f32 + 0.5) / side as f32 * 2.0 - 1.0) / focal;
        (1.0 + at(x, WIDTH, FOCAL[0]).powi(2) + at(y, HEIGHT, FOCAL[1]).powi(2)).sqrt()
    };
    let depth = move |x: i32| DEPTH + if x / 12 == 1 { bulge * (x as f32 - 17.5).powi(2) } else { 0.0 };
    let length = move |x: i32, y: i32| match x / 12 {
        0 => DEPTH * ray(x, y),
        1 => (depth(x) + IN_MIRROR) * ray(x, y),
        _ => BEHIND * ray(x, y),
    };
    for number in 1..=2 {
        let mut sample = Sample::new(WIDTH as usize, HEIGHT as usize)
            .channel("ViewLayer.Depth.Z", Type::Float, move |x, _| depth(x))
            .channel("ViewLayer.Denoising Depth.Z", Type::Float, length)
            .flat("ViewLayer.Vector.X", Type::Float, FOCAL[0] * WIDTH as f32 / 2.0 * STEP / DEPTH)
            .flat("ViewLayer.Vector.Y", Type::Float, 0.0)
            .channel("ViewLayer.Denoising Normal.X", Type::Float, |_, _| 0.0)
            .channel("ViewLayer.Denoising Normal.Y", Type::Float, |_, _| 0.0)
            .channel("ViewLayer.Denoising Normal.Z", Type::Float, |_, _| -1.0)
            .channel("ViewLayer.IndexOB.X", Type::Float, |x, _| (1 + x / 12) as f32);
        for c in ["R", "G", "B"] {
            let albedo = move |x: i32, _: i32| [albedo_of_wall, 0.25, 0.5][x as usize / 12];
            let light = move |x: i32, _: i32| [6.0, 0.75, 0.75][x as usize / 12];
            sample = sample.channel(&format!("ViewLayer.Denoising Albedo.{c}"), Type::Float, albedo);
            sample = sample.channel(&format!("ViewLayer.Combined.{c}"), Type::Float, light);
            if emits {
                sample = sample.flat(&format!("ViewLayer.Emit.{c}"), Type::Float, 0.0);
            }
        }
        sample.write(&frame_path(folder.path(), number));
    }
    write_cameras(folder.path(), true);
    folder
}

/// Its second frame, after the first look.
fn looked_at(folder: &tempfile::TempDir) -> (FrameInputs, Setup) {
    let files = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let mut setup = Setup::new(&files, &Options::default()).expect("a setup");
    first_look::take(&files, &mut setup).expect("a look");
    let mut loader = Loader::new(&setup);
    let inputs = files.iter().map(|files| loader.load(files).expect("a frame")).last().expect("two frames");
    (inputs, setup)
}

#[test]
fn paths_alone_tell_flat_mirrors_and_glass() {
    let (inputs, setup) = looked_at(&frames_for_denoisers(0.0, 0.5, true));
    assert!(setup.has_lobes, "{:?}", setup.report);
    let of = |image: &str| [WALL, MIRROR, GLASS].map(|column| at(&inputs, image, column));
    assert_eq!((of("noisy_diffuse"), of("noisy_specular")), ([6.0, 0.0, 0.0], [0.0, 0.75, 0.75]));
    // The albedo is that of what is seen.
    assert_eq!((of("albedo"), of("specular_albedo")), ([0.5, 0.0, 0.0], [0.0, 0.25, 0.5]));
    assert_motion(&inputs, WALL, DEPTH);
    assert_motion(&inputs, MIRROR, DEPTH + IN_MIRROR);
    assert_motion(&inputs, GLASS, BEHIND);
}

/// What is seen in it turns with its normals, which passes for denoisers have not.
#[test]
fn a_mirror_whose_depth_is_bent_is_no_window() {
    let (inputs, setup) = looked_at(&frames_for_denoisers(0.002, 0.5, true));
    assert!(setup.has_lobes);
    assert_eq!([at(&inputs, "noisy_specular", MIRROR), at(&inputs, "noisy_specular", GLASS)], [0.0, 0.75]);
    assert_motion(&inputs, MIRROR, DEPTH);
}

#[test]
fn normals_for_denoisers_are_in_the_space_of_the_camera() {
    let (inputs, setup) = looked_at(&frames_for_denoisers(0.0, 0.5, true));
    assert_eq!(setup.config.conventions.normal_space, NormalSpace::View);
    assert_eq!(inputs.images["normal"][0][..3], [0.0, 0.0, 1.0]);
}

#[test]
fn an_albedo_for_denoisers_above_1_is_a_lamp() {
    let (inputs, _) = looked_at(&frames_for_denoisers(0.0, 5.0, false));
    let of = |image: &str| [WALL, MIRROR, GLASS].map(|column| at(&inputs, image, column));
    assert_eq!((of("emission"), of("noisy_diffuse")), ([4.0, 0.0, 0.0], [2.0, 0.0, 0.0]));
    assert_eq!(of("noisy_specular"), [0.0, 0.75, 0.75]);
    // Emission of its own says so itself.
    let (inputs, _) = looked_at(&frames_for_denoisers(0.0, 5.0, true));
    assert_eq!((at(&inputs, "emission", WALL), at(&inputs, "noisy_diffuse", WALL)), (0.0, 6.0));
}

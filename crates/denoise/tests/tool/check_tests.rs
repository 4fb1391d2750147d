//! `--check` on a sequence on disk: a slanted wall that a camera passes, with motion as declared or not.

use crate::samples::{denoise, Sample, Type};
use std::path::Path;

const SIDE: [usize; 2] = [48, 27];
const FOCAL: f32 = 1.5;
const STEP: f32 = 0.1;

/// A sequence of three frames, in the layout of the data sets: a wall z = −4 − x/2, `motion` times the true motion.
fn sequence(folder: &Path, motion: f32) {
    let (width, height) = (SIDE[0] as f32, SIDE[1] as f32);
    let aspect = width / height;
    let mut frames = Vec::new();
    for number in 0..3 {
        let camera = STEP * number as f32;
        // Along the ray (dx·t, .., −t): −t = −4 − (camera + dx·t)/2.
        let depth = move |x: i32| {
            let dx = ((x as f32 + 0.5) / width * 2.0 - 1.0) * aspect / FOCAL;
            (4.0 + 0.5 * camera) / (1.0 - 0.5 * dx)
        };
        let pixels = move |x: i32| motion * STEP * FOCAL / (aspect * depth(x)) * 0.5 * width;
        let normal = [1.0 / 5.0_f32.sqrt(), 2.0 / 5.0_f32.sqrt()];
        let sample = Sample::new(SIDE[0], SIDE[1])
            .flat("noisy.R noisy.G noisy.B", Type::Half, 0.5)
            .channel("depth.Z", Type::Float, move |x, _| depth(x))
            .flat("normal.X", Type::Float, normal[0])
            .flat("normal.Y mv.Y", Type::Float, 0.0)
            .flat("normal.Z", Type::Float, normal[1])
            .channel("mv.X", Type::Float, move |x, _| pixels(x));
        sample.write(&crate::samples::frame_path(folder, number));
        let proj = format!("[[{},0,0,0],[0,{},0,0],[0,0,-1,-0.1],[0,0,-1,0]]", FOCAL / aspect, -FOCAL);
        frames.push(format!(r#"{{ "i": {number}, "view": [[1,0,0,{}],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "proj": {proj} }}"#, -camera));
    }
    std::fs::write(folder.join("sequence.json"), format!(r#"{{ "frames": [{}] }}"#, frames.join(","))).expect("sequence.json");
}

#[test]
fn guides_are_checked_without_a_result() {
    let folder = tempfile::tempdir().expect("a folder");
    sequence(folder.path(), 1.0);
    let check = |more: &[&str]| denoise(folder.path(), folder.path(), &[&["--check"], more].concat());
    check(&[]).expect("guides as declared");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 4, "nothing is written");
    for wrong in ["motion_direction=current_minus_previous", "depth=ray_length", "motion_unit=uv", "view_forward=positive_z"] {
        let error = check(&["--convention", wrong]).expect_err(wrong).to_string();
        assert!(error.contains("do not agree in 2 of 2 pairs"), "{error}");
    }
}

#[test]
fn a_wrong_sign_on_disk_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    sequence(folder.path(), -1.0);
    let frames = atrous_denoise::frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = atrous_denoise::setup::Setup::new(&frames, &atrous_denoise::setup::Options::default()).expect("a set-up");
    let reports = atrous_denoise::check::run(&frames, &setup).expect("reports");
    assert_eq!(reports.iter().map(|r| (r.0, r.1)).collect::<Vec<_>>(), [(0, 1), (1, 2)]);
    assert!(reports.iter().all(|r| r.2.motion.mistake == "the motion has the opposite sign"), "{}", reports[0].2);
}

#[test]
fn without_matrices_there_is_nothing_to_check() {
    let folder = crate::samples::sequence(2);
    let error = denoise(folder.path(), folder.path(), &["--check"]).expect_err("no camera").to_string();
    assert!(error.contains("sequence.json"), "{error}");
}

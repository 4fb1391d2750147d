//! `tools/blender_sequence.py` in a real Blender, and its frames through the tool. Ignored where there is none (Debian: package
//! `blender`); `ATROUS_REQUIRE_BLENDER=1` makes that a failure, and `ATROUS_BLENDER` names another program than `blender`.

#[allow(dead_code)] // the tests of the tool use the rest
mod samples;

use atrous_denoise::cli::Cli;
use atrous_denoise::layouts::Layout;
use atrous_denoise::roles::Role;
use atrous_denoise::setup::Setup;
use atrous_denoise::{frame, frame_files, tool};
use atrous_harness::{DeviceTest, Group, Need};
use clap::Parser;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BLENDER: Need = Need { tests: "tests with Blender", required_by: "ATROUS_REQUIRE_BLENDER" };
const TESTS: &[DeviceTest] = &[
    ("frames_need_no_further_options", frames_need_no_further_options),
    ("what_is_rendered_elsewhere_is_the_same", what_is_rendered_elsewhere_is_the_same),
    ("a_camera_that_changes_is_a_cut", a_camera_that_changes_is_a_cut),
    ("wrong_options_are_named", wrong_options_are_named),
];
const FRAMES: u32 = 3;

fn program() -> Command {
    Command::new(std::env::var_os("ATROUS_BLENDER").unwrap_or_else(|| "blender".into()))
}

fn main() {
    let found = program().arg("--version").output().map_err(|e| format!("no Blender: {e}"));
    atrous_harness::run_with(&BLENDER, &[Group { name: "", tests: TESTS, needs_device: true }], &found);
}

fn script(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn run(command: &mut Command) -> Output {
    command.output().expect("Blender starts")
}

fn text(output: &Output) -> String {
    [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat()
}

/// The scene of `blender_scene.py`; `more` goes to it.
fn scene(folder: &Path, more: &[&str]) -> PathBuf {
    let path = folder.join("scene.blend");
    let mut command = program();
    command.args(["-b", "--factory-startup", "--python-exit-code", "1", "--python"]).arg(script("tests/blender_scene.py"));
    let output = run(command.arg("--").arg(&path).args(more));
    assert!(output.status.success() && path.is_file(), "{}", text(&output));
    path
}

/// Runs the script on a scene.
fn sequence(scene: &Path, folder: &Path, more: &[&str]) -> Output {
    let mut command = program();
    command.arg("-b").arg(scene).args(["--python-exit-code", "1", "--python"]).arg(script("../../tools/blender_sequence.py"));
    run(command.arg("--").arg("-o").arg(folder).args(more))
}

/// A rendered sequence of the scene.
fn rendered() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene(folder.path(), &[]);
    let output = sequence(&scene, &folder.path().join("frames"), &["--samples", "2"]);
    assert!(output.status.success(), "{}", text(&output));
    folder
}

/// The mean difference of neighbours: noise, next to which edges count little.
fn roughness(pixels: &[[f32; 3]]) -> f32 {
    pixels.windows(2).map(|p| (0..3).map(|c| (p[0][c] - p[1][c]).abs()).sum::<f32>()).sum::<f32>() / pixels.len() as f32
}

fn frames_need_no_further_options() {
    let folder = rendered();
    let (input, output) = (folder.path().join("frames"), folder.path().join("denoised"));
    let paths = [&input, &output].map(|path| path.to_str().expect("UTF-8"));
    // Depth, motion, normals and matrices agree, as the renderer made them.
    tool::run(&Cli::parse_from(["atrous-denoise", "--quiet", "--check", paths[0]])).expect("guides as declared");

    let frames = frame_files::find(std::slice::from_ref(&input)).expect("frames");
    assert_eq!(frames.iter().map(|f| f.number).collect::<Vec<_>>(), [1, 2, 3]);
    let setup = Setup::new(&frames, &Cli::parse_from(["atrous-denoise", paths[0], "-o", paths[1]]).options()).expect("a setup");
    assert_eq!((setup.mapping.layout, setup.config.allocated_extent), (Layout::Blender, [160, 120]));
    for role in [Role::Depth, Role::Normal, Role::Motion, Role::Id, Role::Albedo, Role::Emission, Role::SpecularAlbedo] {
        assert!(setup.mapping.has(role), "{role:?}: {:?}", setup.report);
    }
    let inputs = frame::load(&frames[1], &setup).expect("a frame");
    let mut ids = inputs.surface_id.clone().expect("ids");
    ids.sort_unstable();
    ids.dedup();
    assert!(ids.len() >= 4, "sky, floor, ball and cube: {ids:?}");

    samples::denoise(&input, &output, &["--levels", "3"]).expect("a run");
    let denoised = frame_files::find(&[output]).expect("results");
    assert_eq!(denoised.len(), FRAMES as usize);
    let result_setup = Setup::new(&denoised, &Default::default()).expect("a setup");
    let result = frame::load(&denoised[2], &result_setup).expect("a result");
    let noisy = frame::load(&frames[2], &setup).expect("a frame");
    assert!(result.noisy.iter().flatten().all(|c| c.is_finite()));
    assert!(
        roughness(&result.noisy) < 0.5 * roughness(&noisy.noisy),
        "{} of {}",
        roughness(&result.noisy),
        roughness(&noisy.noisy)
    );
}

fn what_is_rendered_elsewhere_is_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let (here, elsewhere) = (folder.path().join("here"), folder.path().join("elsewhere"));
    let scene = scene(folder.path(), &[]);
    for (to, option) in [(&here, "--end=2"), (&elsewhere, "--no-render")] {
        let output = sequence(&scene, to, &["--samples", "1", "--end", "2", option]);
        assert!(output.status.success(), "{}", text(&output));
    }
    let output = run(program().arg("-b").arg(elsewhere.join("scene.blend")).arg("-a"));
    assert!(output.status.success(), "{}", text(&output));
    let frames = [&here, &elsewhere].map(|folder| frame_files::find(std::slice::from_ref(folder)).expect("frames"));
    assert_eq!(frames.each_ref().map(Vec::len), [2, 2]);
    let cameras = [&here, &elsewhere].map(|folder| std::fs::read_to_string(folder.join("sequence.json")).expect("cameras"));
    assert_eq!(cameras[0], cameras[1]);
    let pictures = frames.map(|frames| {
        let setup = Setup::new(&frames, &Default::default()).expect("a setup");
        frame::load(&frames[1], &setup).expect("a frame").images
    });
    assert!(pictures[0] == pictures[1], "another picture");
}

fn a_camera_that_changes_is_a_cut() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene(folder.path(), &["cut"]);
    let output = sequence(&scene, folder.path(), &["--no-render"]);
    assert!(output.status.success(), "{}", text(&output));
    let json: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("sequence.json")).expect("cameras")).expect("JSON");
    let resets: Vec<_> = json["frames"].as_array().expect("frames").iter().map(|f| f["reset"].as_bool().unwrap_or(false)).collect();
    assert_eq!(resets, [false, true, false]);
}

fn wrong_options_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let whole = scene(folder.path(), &[]);
    for (options, wanted) in [
        (&["--samples", "0"][..], "--samples is 0; it must be at least 1"),
        (&["--start", "5", "--end", "2"], "frames 5 to 2"),
        (&["--start", "-3"], "frames -3 to 3"),
    ] {
        let output = sequence(&whole, folder.path(), options);
        assert!(!output.status.success() && text(&output).contains(wanted), "{options:?}: {}", text(&output));
    }
    for (kind, wanted) in [("blind", "the scene has no camera"), ("panorama", "is panoramic")] {
        let other = tempfile::tempdir().expect("a folder");
        let output = sequence(&scene(other.path(), &[kind]), other.path(), &[]);
        assert!(!output.status.success() && text(&output).contains(wanted), "{kind}: {}", text(&output));
    }
}

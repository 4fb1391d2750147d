//! The command line: what it writes, and what it says when something is wrong.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use atrous_engine::testing::Validated;

fn demo(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-demo"));
    command.args(arguments).envs(atrous_harness::quick_shaders());
    command
}

fn refused(command: &mut Command) -> String {
    let Output { status, stderr, .. } = command.output().expect("the demo starts");
    let message = String::from_utf8_lossy(&stderr).into_owned();
    assert!(!status.success() && !message.contains("panicked"), "{message}");
    message
}

/// Where a run left its files, and what it printed.
fn run(name: &str, arguments: &[&str]) -> (PathBuf, String) {
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&out);
    let small = ["--scene", "cornell", "--size", "48x27", "--frames", "3", "--reference-spp", "4", "--validate", "--out"];
    let Output { status, stdout, stderr } = demo(&small).arg(&out).args(arguments).output().expect("the demo starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
    assert!(status.success(), "{arguments:?}: {stdout}{stderr}");
    (out, stdout.into_owned())
}

fn assert_files(out: &Path) {
    for name in ["strip_0001.png", "strip_0002.png", "sequence/0000.png", "sequence/0002.png", "table.md"] {
        assert!(out.join("cornell").join(name).is_file(), "{name}");
    }
}

#[test]
fn a_run_of_each_preset_leaves_strips_a_sequence_and_a_table() {
    let Some(_gpu) = Validated::new() else { return };
    for (preset, pass) in
        [("svgf", "atrous_4"), ("asvgf", "gradient_atrous_4"), ("percentile", "firefly"), ("eaw", "eaw_4"), ("best", "firefly")]
    {
        let (out, stdout) = run(&format!("cli_{preset}"), &["--preset", preset]);
        for word in ["RMSE", "SSIM", "temporal error", "bytes/pixel", pass] {
            assert!(stdout.contains(word), "{preset}: no {word} in {stdout}");
        }
        assert_files(&out);
    }
}

#[test]
#[cfg(feature = "capture")]
fn a_capture_is_of_the_default_preset_and_has_references() {
    let Some(_gpu) = Validated::new() else { return };
    let (out, _) = run("cli_capture", &["--capture"]);
    let text = std::fs::read_to_string(out.join("cornell/capture_best/sequence.json")).expect("a capture of `best`");
    assert!(text.replace(' ', "").contains("\"preset\":\"best\""), "{text}");
    for frame in 0..3 {
        let reference = out.join(format!("cornell/capture_best/frame_{frame:04}_ref.exr"));
        assert_eq!(reference.is_file(), frame > 0, "{}", reference.display());
    }
}

#[test]
fn a_comparison_has_every_preset_in_one_table() {
    let Some(_gpu) = Validated::new() else { return };
    let (out, stdout) = run("cli_compare", &["--compare", "--eaw-weights", "rt,normal"]);
    assert_files(&out);
    let table = std::fs::read_to_string(out.join("cornell/table.md")).expect("a table");
    assert!(stdout.contains(&table), "what is printed is not what is saved");
    for name in ["noisy", "SVGF", "A-SVGF", "percentile", "fast", "EAW"] {
        assert!(table.contains(&format!("| cornell, {name} ")), "no {name} in {table}");
    }
}

#[test]
fn no_vulkan_device_is_said_with_the_remedy() {
    let mut command = demo(&["--frames", "1"]);
    for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        command.env(variable, "/nonexistent/driver.json");
    }
    let message = refused(&mut command);
    assert!(message.contains("install"), "{message}");
}

#[test]
fn an_unknown_scene_is_told_which_there_are() {
    let error =
        atrous_engine::Scene::load("cornel", &atrous_engine::SceneOptions::default()).map(|_| ()).expect_err("no such scene");
    let message = error.to_string();
    for name in ["\"cornel\"", "cornell, pillars, glossy, mirror, mirror_moving, hall, hall_railings, hall_sun, fog", ".glb"] {
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn what_is_wrong_is_named() {
    let Some(_gpu) = Validated::new() else { return };
    let cases: [(&[&str], &str); 9] = [
        (&["--scene", "cornel"], "\"cornel\""),
        (&["--scene", "/nonexistent.glb"], "/nonexistent.glb"),
        (&["--size", "0x0"], "0x0"),
        (&["--size", "big"], "big"),
        (&["--frames", "0"], "0"),
        (&["--frames", "4", "--reference-frames", "9"], "reference frame 9"),
        (&["--set", "alfa=1"], "alfa"),
        (&["--eaw-weights", "rt,colour"], "colour"),
        (&["--compare", "--preset", "eaw"], "--compare"),
    ];
    for (arguments, word) in cases {
        let message = refused(&mut demo(arguments));
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    let message = refused(&mut demo(&["--device", "no such device", "--frames", "1"]));
    assert!(message.contains("no such device"), "{message}");
}

#[test]
fn light_of_half_the_size_ambient_occlusion_and_lamps_run() {
    let Some(_gpu) = Validated::new() else { return };
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cli_apart");
    let _ = std::fs::remove_dir_all(&out);
    let chapel = ["--scene", "chapel", "--size", "48x28", "--frames", "2", "--reference-spp", "4", "--validate", "--out"];
    let run = |arguments: &[&str]| {
        let Output { status, stdout, stderr } = demo(&chapel).arg(&out).args(arguments).output().expect("the demo starts");
        assert!(status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&stderr));
        String::from_utf8_lossy(&stdout).into_owned()
    };
    let text = run(&["--visibility", "--ambient"]);
    for signal in ["visibility of lamp 0", "visibility of lamp 3", "ambient occlusion"] {
        assert!(text.contains(&format!("RMSE of the {signal}")), "{signal}: {text}");
        assert!(out.join(format!("chapel/{}_0001.png", signal.replace(' ', "_"))).is_file(), "{signal}");
    }
    let half = run(&["--half-light", "--visibility", "--ambient"]);
    assert!(half.contains("chapel, best") && half.contains("RMSE of the visibility of lamp 3"), "{half}");
    let odd = ["--scene", "cornell", "--size", "47x27", "--half-light", "--out"];
    assert!(refused(demo(&odd).arg(&out)).contains("exactly half"));
}

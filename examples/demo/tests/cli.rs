//! The command line: what it writes, and what it says when something is wrong.

use std::path::PathBuf;
use std::process::{Command, Output};

fn demo(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-demo"));
    command.args(arguments);
    command
}

fn refused(command: &mut Command) -> String {
    let Output { status, stderr, .. } = command.output().expect("the demo starts");
    let message = String::from_utf8_lossy(&stderr).into_owned();
    assert!(!status.success() && !message.contains("panicked"), "{message}");
    message
}

#[test]
fn a_run_leaves_strips_a_sequence_and_a_table() {
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cli_run");
    let _ = std::fs::remove_dir_all(&out);
    let folder = out.to_str().expect("UTF-8");
    let arguments =
        ["--scene", "cornell", "--size", "48x27", "--frames", "3", "--reference-spp", "4", "--validate", "--out", folder];
    let Output { status, stdout, stderr } = demo(&arguments).output().expect("the demo starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
    assert!(status.success(), "{stdout}{stderr}");
    for word in ["RMSE", "SSIM", "temporal error", "atrous_4", "bytes/pixel"] {
        assert!(stdout.contains(word), "no {word} in {stdout}");
    }
    for name in ["strip_0001.png", "strip_0002.png", "sequence/0000.png", "sequence/0002.png", "table.md"] {
        assert!(out.join("cornell").join(name).is_file(), "{name}");
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
fn what_is_wrong_is_named() {
    let cases: [(&[&str], &str); 7] = [
        (&["--scene", "cornel"], "\"cornel\""),
        (&["--scene", "/nonexistent.glb"], "/nonexistent.glb"),
        (&["--size", "0x0"], "0x0"),
        (&["--size", "big"], "big"),
        (&["--frames", "0"], "0"),
        (&["--frames", "4", "--reference-frames", "9"], "reference frame 9"),
        (&["--set", "alfa=1"], "alfa"),
    ];
    for (arguments, word) in cases {
        let message = refused(&mut demo(arguments));
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    let message = refused(&mut demo(&["--device", "no such device", "--frames", "1"]));
    assert!(message.contains("no such device"), "{message}");
}

//! Pipes in the place of files, and names that are no text: refused by name, before anything waits for them.

use crate::samples::{self, denoise, frame_path, sequence};
use atrous_denoise::frame_files::find;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::time::Duration;

fn pipe(path: &Path) {
    let _ = std::fs::remove_file(path);
    rustix::fs::mkfifoat(rustix::fs::CWD, path, rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR).expect("a pipe");
}

/// The message of a run on a thread of its own: one that waits for a pipe would wait for ever, and the tests with it.
fn message(input: PathBuf, output: PathBuf, more: Vec<String>) -> String {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let more: Vec<&str> = more.iter().map(String::as_str).collect();
        let _ = sender.send(denoise(&input, &output, &more).expect_err("a pipe").to_string());
    });
    receiver.recv_timeout(Duration::from_secs(60)).expect("the run waits for a pipe")
}

#[test]
fn a_pipe_is_refused_wherever_a_file_is_read() {
    for (name, more) in [
        ("frame_0001.exr", ""),
        ("frame_0001_alb.exr", ""),
        ("sequence.json", ""),
        ("frame_0000_instance_transforms.f32", ""),
        ("matrices", "--camera"),
    ] {
        let (input, output) = (sequence(2), tempfile::tempdir().expect("a temporary folder"));
        let path = input.path().join(name);
        pipe(&path);
        let more = if more.is_empty() { Vec::new() } else { vec![more.to_owned(), path.display().to_string()] };
        let message = message(input.path().into(), output.path().into(), more);
        assert!(message.contains(name) && message.contains("a pipe"), "{message}");
    }
    let (input, output) = (sequence(1), tempfile::tempdir().expect("a temporary folder"));
    pipe(&frame_path(input.path(), 0));
    let message = message(frame_path(input.path(), 0), output.path().into(), Vec::new());
    assert!(message.contains("frame_0000.exr") && message.contains("a pipe"), "{message}");
}

#[test]
fn folders_and_dangling_links_with_the_name_of_a_frame_are_named() {
    let input = sequence(1);
    std::fs::create_dir(frame_path(input.path(), 1)).expect("a folder");
    let message = find(&[input.path().into()]).expect_err("a folder").to_string();
    assert!(message.contains("frame_0001.exr") && message.contains("a folder"), "{message}");
    std::fs::remove_dir(frame_path(input.path(), 1)).expect("removed");
    std::os::unix::fs::symlink("nowhere", frame_path(input.path(), 1)).expect("a link");
    for argument in [input.path().to_owned(), frame_path(input.path(), 1)] {
        let message = find(&[argument]).expect_err("a dangling link").to_string();
        assert!(message.contains("frame_0001.exr") && message.contains("cannot be read"), "{message}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_named() {
    let input = tempfile::tempdir().expect("a temporary folder");
    let path = input.path().join(OsStr::from_bytes(b"frame_\xff_0001.exr"));
    samples::frame(0).write(&path);
    for argument in [input.path().to_owned(), input.path().join("frame_*.exr"), path] {
        let message = find(&[argument]).expect_err("no text").to_string();
        assert!(message.contains("UTF-8") && message.contains("_0001.exr") && message.contains("rename"), "{message}");
    }
}

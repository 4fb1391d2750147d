//! What a capture refuses, and how it ends.

use super::support::rig::Rig;
use super::support::{assert_valid, gpu, scene::Scene, session, upload};
use atrous::executor::{Executor, Session};
use atrous::{Config, FrameParams, Phase, Tuning};
use atrous_harness::DeviceTest;
use std::path::Path;

pub const TESTS: &[DeviceTest] = &[
    ("what_cannot_be_captured_is_refused_at_once", what_cannot_be_captured_is_refused_at_once),
    ("a_capture_can_end_early_and_another_can_follow", a_capture_can_end_early_and_another_can_follow),
    ("a_failure_ends_the_capture_and_not_the_frame", a_failure_ends_the_capture_and_not_the_frame),
    ("a_resize_ends_a_capture", a_resize_ends_a_capture),
    ("a_frame_that_ends_in_the_middle_is_not_written", a_frame_that_ends_in_the_middle_is_not_written),
    ("a_frame_that_was_only_begun_is_not_waited_for", a_frame_that_was_only_begun_is_not_waited_for),
    ("what_is_outstanding_is_written_when_the_session_ends", what_is_outstanding_is_written_when_the_session_ends),
];

const EXTENT: [u32; 2] = [19, 17];

fn run(s: &mut Session, index: u32) {
    let scene = Scene::new(EXTENT);
    upload(s, &scene.frame(index, index));
    s.run(&scene.params(index), &Tuning::default()).expect("a frame");
}

fn frames_in(folder: &Path) -> usize {
    let is_frame = |name: &str| name.starts_with("frame_") && name.ends_with(".exr");
    std::fs::read_dir(folder).expect("a folder").flatten().filter(|e| is_frame(&e.file_name().to_string_lossy())).count()
}

fn what_cannot_be_captured_is_refused_at_once() {
    fn sendable<T: Send + Sync>() {}
    sendable::<Executor>();
    let folder = tempfile::tempdir().expect("a folder");
    let mut s = session(&Config::new(EXTENT));
    let message = s.capture(folder.path(), 0).expect_err("none").to_string();
    assert!(message.contains("0 frames") && message.contains("1 or more"), "{message}");
    let file = folder.path().join("file");
    std::fs::write(&file, b"").expect("a file");
    let message = s.capture(file.join("below"), 2).expect_err("a file in the way").to_string();
    assert!(message.contains("below") && message.contains("Choose a folder"), "{message}");
    let sequence = folder.path().join("sequence.json");
    std::fs::write(&sequence, b"{}").expect("a file");
    let message = s.capture(folder.path(), 2).expect_err("exists").to_string();
    assert!(message.contains("sequence.json") && message.contains("not overwritten"), "{message}");
    std::fs::remove_file(&sequence).expect("removed");
    s.capture(folder.path(), 2).expect("nothing of what was refused is left");
    let message = s.capture(folder.path().join("other"), 2).expect_err("two at once").to_string();
    assert!(message.contains("lacks 2 frames") && message.contains("finish_capture"), "{message}");
}

fn a_capture_can_end_early_and_another_can_follow() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut s = session(&Config::new(EXTENT));
    assert_eq!(s.finish_capture().expect("no capture is no error"), 0);
    s.capture(folder.path().join("a"), 10).expect("a capture");
    for i in 0..3 {
        run(&mut s, i);
    }
    assert_eq!(s.executor().frames_to_capture(), 8);
    assert_eq!(s.finish_capture().expect("written"), 3);
    run(&mut s, 3);
    s.capture(folder.path().join("b"), 2).expect("another");
    for i in 4..8 {
        run(&mut s, i);
    }
    assert_eq!(s.executor().frames_to_capture(), 0, "both were written as frames went on");
    assert_eq!((frames_in(&folder.path().join("a")), frames_in(&folder.path().join("b"))), (3, 2));
    assert!(folder.path().join("b/frame_0000.exr").exists());
    assert_eq!(s.finish_capture().expect("written"), 2);
    assert_valid();
}

fn a_failure_ends_the_capture_and_not_the_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut s = session(&Config::new(EXTENT));
    s.capture(folder.path().join("gone"), 4).expect("a capture");
    run(&mut s, 0);
    std::fs::remove_dir(folder.path().join("gone")).expect("removed");
    for i in 1..4 {
        run(&mut s, i);
    }
    assert_eq!(s.executor().frames_to_capture(), 0);
    let message = s.finish_capture().expect_err("the folder is gone").to_string();
    assert!(message.contains("frame_0000.exr") && message.contains("cannot be written"), "{message}");
    s.capture(folder.path().join("next"), 1).expect("another");
    run(&mut s, 4);
    assert_eq!(s.finish_capture().expect("written"), 1);
    assert_valid();
}

fn a_resize_ends_a_capture() {
    let folder = tempfile::tempdir().expect("a folder");
    let (whole, part) = (folder.path().join("whole"), folder.path().join("part"));
    let mut s = session(&Config::new(EXTENT));
    s.capture(&whole, 2).expect("a capture");
    (0..2).for_each(|i| run(&mut s, i));
    s.resize([24, 18]).expect("another extent");
    assert_eq!(frames_in(&whole), 2, "written before the images go");
    assert_eq!(s.finish_capture().expect("nothing is lacking"), 2);
    s.resize(EXTENT).expect("the first extent");
    s.capture(&part, 5).expect("a capture");
    (0..3).for_each(|i| run(&mut s, i));
    s.resize(EXTENT).expect("the same extent");
    assert_eq!(s.executor().frames_to_capture(), 0);
    run(&mut s, 0);
    let message = s.finish_capture().expect_err("two are lacking").to_string();
    assert!(message.contains("part") && message.contains("2 frames") && message.contains("resized"), "{message}");
    assert_eq!(frames_in(&part), 3);
    assert_valid();
}

fn a_frame_that_was_only_begun_is_not_waited_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    rig.fill_inputs();
    rig.executor.capture(folder.path(), 2).expect("a capture");
    for is_recorded in [false, true, false, false, true, true] {
        let frame = rig.executor.begin_frame(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
        if is_recorded {
            rig.submit(|rig, cmd| rig.record(cmd, &frame));
        }
    }
    assert_eq!(rig.executor.frames_to_capture(), 0);
    // SAFETY: every submission was waited for.
    assert_eq!(unsafe { rig.executor.finish_capture() }, Ok(2));
    assert_eq!(frames_in(folder.path()), 2);
    assert!(folder.path().join("frame_0000.exr").exists());
    assert_valid();
}

fn a_frame_that_ends_in_the_middle_is_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    rig.fill_inputs();
    rig.executor.capture(folder.path(), 3).expect("a capture");
    for phases in [&Phase::ALL[..], &Phase::ALL[..1]] {
        let frame = rig.executor.begin_frame(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
        rig.submit(|rig, cmd| {
            for phase in phases {
                // SAFETY: the command buffer is recording, and everything that was recorded before is complete.
                unsafe { rig.executor.record(cmd, &frame, *phase) }.expect("recorded");
            }
        });
    }
    // SAFETY: every submission was waited for.
    let message = unsafe { rig.executor.finish_capture() }.expect_err("half a frame").to_string();
    assert!(message.contains("frame 1 was begun") && message.contains("record each phase"), "{message}");
    assert_eq!(frames_in(folder.path()), 1);
    assert_valid();
}

fn what_is_outstanding_is_written_when_the_session_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut s = session(&Config::new(EXTENT));
    s.capture(folder.path(), 2).expect("a capture");
    run(&mut s, 0);
    run(&mut s, 1);
    drop(s);
    assert_eq!(frames_in(folder.path()), 2);
}

//! Frames are found and put into order.

use atrous_denoise::error::ToolError;
use atrous_denoise::frame_files::find;
use std::path::{Path, PathBuf};

fn folder(names: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in names {
        std::fs::write(folder.path().join(name), b"").expect("a file");
    }
    folder
}

fn numbers(argument: &Path) -> Vec<u64> {
    find(&[argument.to_owned()]).expect("frames").iter().map(|f| f.number).collect()
}

#[test]
fn folders_and_patterns() {
    let folder = folder(&["a_8.exr", "a_9.exr", "a_10.exr", ".a_11.exr.part", "notes.txt", "sequence.json"]);
    assert_eq!(numbers(folder.path()), [8, 9, 10]);
    for pattern in ["a_*.exr", "*.exr", "a_%d.exr", "?_%02d.exr", "a_*%d.*"] {
        assert_eq!(numbers(&folder.path().join(pattern)), [8, 9, 10], "{pattern}");
    }
    assert_eq!(numbers(&folder.path().join("a_##.exr")), [10]);
    assert_eq!(numbers(&folder.path().join("a_?.exr")), [8, 9]);
    assert_eq!(numbers(&folder.path().join("a_9.exr")), [9]);
    for nothing in ["b_*.exr", "a_%d.ex", "a_###.exr", "%d_*.exr"] {
        assert!(matches!(find(&[folder.path().join(nothing)]), Err(ToolError::NoFrames { .. })), "{nothing}");
    }
}

#[test]
fn files_one_by_one() {
    let folder = folder(&["a_1.exr", "a_2.exr", "a_3.exr"]);
    let files: Vec<PathBuf> = ["a_3.exr", "a_2.exr"].map(|n| folder.path().join(n)).to_vec();
    assert_eq!(find(&files).expect("frames").iter().map(|f| f.number).collect::<Vec<_>>(), [2, 3]);
    let message = find(&[folder.path().join("a_4.exr")]).expect_err("no such file").to_string();
    assert!(message.contains("a_4.exr"), "{message}");
}

#[test]
fn holes_are_named() {
    let folder = folder(&["a_001.exr", "a_002.exr", "a_005.exr", "a_099999999999.exr"]);
    let message = find(&[folder.path().to_owned()]).expect_err("holes").to_string();
    assert!(message.contains("a_003.exr") && message.contains("a_004.exr") && message.contains("more"), "{message}");
}

#[test]
fn two_sequences_are_not_mixed() {
    let two = folder(&["a_1.exr", "b_1.exr"]);
    let message = find(&[two.path().to_owned()]).expect_err("two").to_string();
    assert!(message.contains("a_*.exr") && message.contains("b_*.exr"), "{message}");
    let same = folder(&["a_1.exr", "a_01.exr"]);
    assert!(find(&[same.path().to_owned()]).expect_err("twice").to_string().contains("same number"));
    let guides = folder(&["a_1_albedo.exr", "a_1_normal.exr"]);
    assert!(find(&[guides.path().to_owned()]).expect_err("no colour").to_string().contains("no colour"));
}

#[test]
fn nothing_there() {
    assert!(matches!(find(&[]), Err(ToolError::Usage(_))));
    let empty = folder(&[]);
    assert!(matches!(find(&[empty.path().to_owned()]), Err(ToolError::NoFrames { .. })));
}

//! Frames are found and put into order.

use atrous_denoise::error::ToolError;
use atrous_denoise::frame_files::{find, search};
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
    assert!(message.contains("a_%d.exr") && message.contains("b_%d.exr"), "{message}");
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

#[test]
fn the_number_may_stand_anywhere() {
    for names in [
        ["shot_0001_v002.exr", "shot_0002_v002.exr", "shot_0003_v002.exr"],
        ["plate.0001.v03.final.exr", "plate.0002.v03.final.exr", "plate.0003.v03.final.exr"],
        ["4k_shot2_0001.exr", "4k_shot2_0002.exr", "4k_shot2_0003.exr"],
        ["1.beauty_4k.exr", "2.beauty_4k.exr", "3.beauty_4k.exr"],
        ["take7-001-rev9.exr", "take7-002-rev9.exr", "take7-003-rev9.exr"],
    ] {
        let folder = folder(&names);
        assert_eq!(numbers(folder.path()), [1, 2, 3], "{names:?}");
        // By itself, too.
        assert_eq!(numbers(&folder.path().join(names[1])), [2], "{names:?}");
    }
    // A pattern says where it is, whatever else changes.
    let stamped = folder(&["s_01_20250101.exr", "s_02_20250103.exr", "s_03_20250102.exr"]);
    for pattern in ["s_%02d_*.exr", "s_##_*.exr"] {
        assert_eq!(numbers(&stamped.path().join(pattern)), [1, 2, 3], "{pattern}");
    }
    let versions = folder(&["s_0001_v002.exr", "s_0002_v003.exr"]);
    assert_eq!(numbers(&versions.path().join("s_%04d_v00?.exr")), [1, 2]);
}

/// Where two numbers change, the one with the fewest sequences counts frames, and of two alike the one that is no version.
#[test]
fn of_two_numbers_that_change_one_counts_frames() {
    for (names, wanted) in [
        (
            &["0001_cam1.exr", "0002_cam1.exr", "0003_cam1.exr", "0001_cam2.exr", "0002_cam2.exr", "0003_cam2.exr"][..],
            ["%d_cam1.exr", "%d_cam2.exr"],
        ),
        (
            &["sh010_1.exr", "sh010_2.exr", "sh010_3.exr", "sh020_1.exr", "sh020_2.exr", "sh020_3.exr"],
            ["sh010_%d.exr", "sh020_%d.exr"],
        ),
        (&["s_0001_v001.exr", "s_0002_v001.exr", "s_0001_v002.exr", "s_0002_v002.exr"], ["s_%d_v001.exr", "s_%d_v002.exr"]),
        (&["take1_1.exr", "take1_2.exr", "take2_1.exr", "take2_2.exr"], ["take1_%d.exr", "take2_%d.exr"]),
    ] {
        let folder = folder(names);
        let message = find(&[folder.path().to_owned()]).expect_err("several").to_string();
        let patterns: Vec<&str> = message.split('"').skip(1).step_by(2).collect();
        let ends = patterns.iter().zip(wanted).all(|(pattern, wanted)| Path::new(pattern).ends_with(wanted));
        assert!(patterns.len() == 2 && ends, "{message}");
    }
}

/// Every pattern that a message proposes finds a sequence.
#[test]
fn proposals_can_be_typed() {
    for names in [
        &["a_1.exr", "a_2.exr", "b_1.exr", "b_2.exr"][..],
        &["s_0001_v001.exr", "s_0002_v001.exr", "s_0001_v002.exr", "s_0002_v002.exr"],
        &["a_1.exr", "a_2.exr", "a_b_1.exr", "a_b_2.exr"],
        &["x#1_1.exr", "x#1_2.exr", "100%d_1.exr", "100%d_2.exr"],
        &["still.exr", "other.exr"],
    ] {
        let folder = folder(names);
        let message = find(&[folder.path().to_owned()]).expect_err("several").to_string();
        let patterns: Vec<&str> = message.split('"').skip(1).step_by(2).collect();
        assert_eq!(patterns.len(), 2, "{message}");
        let found = |pattern: &&str| find(&[PathBuf::from(pattern)]).unwrap_or_else(|e| panic!("{pattern}: {e}"));
        let colours: Vec<_> = patterns.iter().flat_map(found).map(|frame| frame.colour).collect();
        assert_eq!(colours.len(), names.len(), "{message}");
    }
    let steps = folder(&["a_1.exr", "a_3.exr", "a_5.exr"]);
    let message = find(&[steps.path().to_owned()]).expect_err("holes").to_string();
    assert!(message.contains("--step 2"), "{message}");
    let found = search(&[steps.path().to_owned()], 2).expect("frames");
    assert_eq!(found.frames.iter().map(|f| f.number).collect::<Vec<_>>(), [1, 3, 5]);
    let message = search(&[steps.path().to_owned()], 3).expect_err("another step").to_string();
    assert!(message.contains("--step is 3"), "{message}");
}

#[test]
fn guides_beside_the_frames_are_found() {
    let names =
        ["f_0_hdr.exr", "f_0_ALBEDO.exr", "f_0_ALPHA.exr", "f_0_SHADING_NORMAL.exr", "f_0_GEOMETRY_NORMAL.exr", "g_0_DEPTH.exr"];
    let lux = folder(&names);
    for argument in ["f_*_hdr.exr", "f_%d_hdr.exr", "f_0_hdr.exr", ""] {
        let found = search(&[lux.path().join(argument)], 1).unwrap_or_else(|e| panic!("{argument}: {e}"));
        let guides = &found.frames[0].guides;
        let of = |layer: &str| guides.iter().find(|g| g.0 == layer).map(|g| g.1.file_name().expect("a name").to_owned());
        assert_eq!(of("albedo"), Some("f_0_ALBEDO.exr".into()), "{argument}");
        assert_eq!(of("normal"), Some("f_0_SHADING_NORMAL.exr".into()), "{argument}");
        assert!(of("alpha").is_some() && found.frames[0].colour.ends_with("f_0_hdr.exr"), "{argument}");
    }
    // Those of another shot are none of this one's.
    let shots = folder(&["a_1.exr", "a_1_albedo.exr", "b_1.exr", "b_1_albedo.exr"]);
    let found = find(&[shots.path().join("b_%d.exr")]).expect("frames");
    assert_eq!(found[0].guides, [("albedo", shots.path().join("b_1_albedo.exr"))]);
}

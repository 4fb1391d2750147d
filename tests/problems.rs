//! docs/problems.md: each problem has an answer, and the answer names what exists.

use super::documents::outputs;
use atrous::{Config, FrameParams, Input, Tuning};
use atrous_harness::DeviceTest;
use std::collections::BTreeSet;
use std::path::Path;

pub const TESTS: &[DeviceTest] = &[
    ("each_problem_has_an_answer", each_problem_has_an_answer),
    ("problems_name_what_exists", problems_name_what_exists),
    ("the_versions_are_those_of_the_manifests", the_versions_are_those_of_the_manifests),
];

const PROBLEMS: &str = include_str!("../docs/problems.md");
const BEVY: &str = include_str!("../crates/bevy/Cargo.toml");

/// Headings of the problems with what stands below them.
fn problems() -> Vec<(&'static str, &'static str)> {
    PROBLEMS.split("\n## ").skip(1).filter_map(|section| section.split_once('\n')).collect()
}

/// Each heading has a link to where more stands, or a table.
fn each_problem_has_an_answer() {
    let problems = problems();
    assert!(problems.len() > 25, "{problems:?}");
    for (heading, answer) in problems {
        assert!(answer.split_whitespace().count() > 10, "`{heading}` has no answer: {answer}");
        assert!(answer.contains("](") || answer.contains("\n| --- |"), "`{heading}` has neither a link nor a table");
    }
}

/// What a host can set or bind, by name.
fn settings() -> BTreeSet<String> {
    let config = Config::new([1, 1]);
    let structs = [format!("{config:#?}"), format!("{:#?}", FrameParams::new([1, 1]))].join("\n");
    let fields = structs.lines().filter_map(|line| line.trim().split_once(": ")).map(|(name, _)| name.to_owned());
    let tuning = Tuning::FIELDS.iter().map(|field| field.name.to_owned());
    let inputs = Input::ALL.iter().map(|input| input.name.to_owned());
    fields.chain(tuning).chain(inputs).chain(outputs()).collect()
}

/// Each name in the problems, but for those of other denoisers in the first column of a table.
fn problems_name_what_exists() {
    let settings = settings();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = String::new();
    for folder in ["src", "crates/denoise/src", "glsl/host"] {
        read_sources(&root.join(folder), &mut sources);
    }
    let words: BTreeSet<&str> = sources.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let ours = |line: &'static str| match line.strip_prefix("| ") {
        Some(row) => row.split_once(" | ").map_or("", |(_, ours)| ours),
        None => line,
    };
    let text: Vec<&str> = PROBLEMS.lines().map(ours).collect();
    let text = text.join("\n");
    let spans: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    assert!(spans.len() > 80, "{spans:?}");
    for span in spans {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let exists = if span == "bevy_atrous" {
            root.join("crates/bevy").exists()
        } else if let Some(package) = span.split(' ').next().and_then(|first| first.strip_prefix("atrous-")) {
            root.join("crates").join(package).exists()
        } else if span.contains('/') {
            root.join(span).exists()
        } else if span.starts_with(|c: char| c.is_ascii_lowercase()) && span.chars().all(is_word) {
            settings.contains(span)
        } else {
            span.replace('-', "_").split(|c: char| !is_word(c)).map(|word| word.trim_matches('_')).all(|word| words.contains(word))
        };
        assert!(exists, "docs/problems.md names `{span}`, which does not exist");
    }
}

fn the_versions_are_those_of_the_manifests() {
    let (ours, wgpu) = (include_str!("../Cargo.toml"), include_str!("../crates/wgpu/Cargo.toml"));
    let of = |manifest: &str, key: &str| -> String {
        let line = manifest.lines().find(|line| line.starts_with(&format!("{key} = ")) && line.contains('"'));
        let (_, version) = line.and_then(|line| line.split_once('"')).unwrap_or_else(|| panic!("no version of {key}"));
        version.split('"').next().unwrap_or_default().to_owned()
    };
    let (version, _) = env!("CARGO_PKG_VERSION").rsplit_once('.').expect("three numbers");
    let (rust, ash, wgpu, bevy) = (of(ours, "rust-version"), of(ours, "ash"), of(wgpu, "wgpu"), of(BEVY, "bevy"));
    let row = format!("| {version} | {rust} | 1.1 | {ash}, or any by `Device::from_raw` | {wgpu} | {bevy} |");
    assert!(PROBLEMS.contains(&row), "docs/problems.md must have this row:\n{row}");
}

fn read_sources(folder: &Path, sources: &mut String) {
    for path in folder.read_dir().expect("a folder").flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            read_sources(&path, sources);
        } else if path.extension().is_some_and(|extension| extension == "rs" || extension == "glsl") {
            *sources += &std::fs::read_to_string(path).expect("a source");
        }
    }
}

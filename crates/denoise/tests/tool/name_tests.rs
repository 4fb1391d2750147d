//! Names on the command line are those of the library.

use atrous::config::{Conventions, Preset};
use atrous_denoise::cli::Cli;
use atrous_denoise::conventions::{self, Scales};
use clap::Parser;

#[test]
fn every_convention_that_the_help_lists_can_be_set() {
    let mut seen = Vec::new();
    for (key, values) in conventions::keys().split(", ").filter_map(|entry| entry.split_once('=')) {
        seen.push(key.to_owned());
        let numbers = if key == "background_depth" { "0.5|inf" } else { "0.5|2" };
        let values = if values == "NUMBER" { numbers } else { values };
        let set = |value: &str| {
            let (mut c, mut scales) = (Conventions::default(), Scales::default());
            if let Some(set) = scales.set(key, value) {
                set.unwrap_or_else(|e| panic!("{key}={value}: {e}"));
                return serde_json::json!(scales.depth);
            }
            conventions::set(&mut c, key, value).unwrap_or_else(|e| panic!("{key}={value}: {e}"));
            serde_json::to_value(c).expect("JSON")
        };
        let changed: Vec<_> = values.split('|').map(set).collect();
        assert!(changed.iter().enumerate().all(|(i, c)| !changed[..i].contains(c)), "{key}: {changed:?}");
    }
    let fields = serde_json::to_value(Conventions::default()).expect("JSON");
    let mut fields: Vec<_> = fields.as_object().expect("an object").keys().cloned().collect();
    fields.push("depth_scale".to_owned());
    fields.sort();
    seen.sort();
    assert_eq!(seen, fields);
    for (key, value, word) in [("depth", "reversed", "ray_length"), ("depth", "1", "string"), ("background_depth", "-1", "above 0")]
    {
        let message = conventions::set(&mut Conventions::default(), key, value).expect_err(value).to_string();
        assert!(message.contains(word), "{key}={value}: {message}");
    }
}

#[test]
fn filters_are_chosen_by_the_names_of_the_library() {
    let parsed = |preset: &str| Cli::try_parse_from(["denoise", "frames", "-o", "out", "--preset", preset]);
    for preset in Preset::ALL.into_iter().filter(|preset| *preset != Preset::Volume) {
        assert_eq!(parsed(preset.name()).expect("a preset").options().preset, Some(preset));
    }
    for wrong in ["volume", "svfg"] {
        let message = parsed(wrong).expect_err("no such preset").to_string();
        assert!(message.contains(wrong) && message.contains("svgf, asvgf, stabilize, percentile, eaw, fast, best"), "{message}");
    }
}

/// Who installs the tool has no C++ compiler: nothing that it is built of asks for one.
#[test]
fn no_toolchain_but_that_of_rust_is_needed() {
    let mut tree = std::process::Command::new(env!("CARGO"));
    tree.args(["tree", "--package", "atrous-denoise", "--edges", "normal,build", "--prefix", "none", "--offline"]);
    let output = tree.current_dir(env!("CARGO_MANIFEST_DIR")).output().expect("cargo");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && text.contains("atrous-conventions"), "{}", String::from_utf8_lossy(&output.stderr));
    for builder in ["shaderc", "cmake ", "cc "] {
        assert!(!text.lines().any(|line| line.starts_with(builder)), "{builder}: {text}");
    }
}

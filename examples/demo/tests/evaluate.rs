//! The command `evaluate`: what it writes, what it keeps, and what it refuses.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use atrous_engine::testing::Validated;

fn evaluate(out: &Path, arguments: &[&str]) -> Output {
    measuring(2, out, arguments)
}

fn measuring(frames: u32, out: &Path, arguments: &[&str]) -> Output {
    let small = ["evaluate", "--size", "48x27", "--frames", "4", "--reference-spp", "4", "--validate", "--out"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-demo"));
    command.envs(atrous_harness::quick_shaders());
    command.args(small).arg(out).args(["--measured", &frames.to_string()]).args(arguments).output().expect("the demo starts")
}

fn succeeded(output: Output) -> String {
    let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{stdout}{stderr}");
    stdout.into_owned()
}

fn refused(output: Output) -> String {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && !message.contains("panicked"), "{message}");
    message
}

fn empty(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn references(out: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(out.join("references")).expect("a folder");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files
}

#[test]
fn a_run_leaves_a_page_tables_and_pictures_and_keeps_its_results() {
    let Some(_gpu) = Validated::new() else { return };
    let out = empty("evaluate_run");
    let markdown = out.join("docs.md");
    fs::write(&markdown, "before\n<!-- evaluate -->\nold\n<!-- /evaluate -->\nafter\n").expect("a file");
    let arguments = ["--scene", "cornell", "--scene", "lamps", "--markdown", markdown.to_str().expect("a path")];
    succeeded(evaluate(&out, &arguments));
    let table = fs::read_to_string(out.join("quality.md")).expect("a table");
    for word in
        ["cornell", "lamps", "RMSE", "SSIM", "FLIP", "temporal RMSE", "bytes a pixel", "A-SVGF", "EAW, accumulated", "claim"]
    {
        assert!(table.contains(word), "no {word} in {table}");
    }
    let renewed = fs::read_to_string(&markdown).expect("a file");
    assert!(renewed.starts_with("before\n<!-- evaluate -->") && renewed.ends_with("<!-- /evaluate -->\nafter\n"), "{renewed}");
    let tables = table.rsplit_once("![").expect("a picture below the tables").0;
    assert!(renewed.contains(tables) && renewed.contains("(images/quality.png)") && !renewed.contains("old"), "{renewed}");
    assert!(out.join("images/quality.png").is_file());
    let page = fs::read_to_string(out.join("quality.html")).expect("a page");
    assert!(page.matches("data:image/png").count() > 2 * 11, "no pictures in the page");
    assert!(out.join("quality.png").is_file());
    assert_eq!(references(&out).len(), 8);

    // Times are the only figures that another measurement would change.
    fs::remove_file(out.join("quality.md")).expect("the table");
    succeeded(evaluate(&out, &arguments));
    assert_eq!(fs::read_to_string(out.join("quality.md")).expect("a table"), table, "a finished scene was measured again");
}

#[test]
fn experiments_and_the_rows_of_some_scenes_stand_in_the_report() {
    let Some(_gpu) = Validated::new() else { return };
    let out = empty("evaluate_experiments");
    let of_sun = ["--scene", "hall", "--filter", "best", "--filter", "best, visibility apart"];
    let arguments = [&of_sun[..], &["--experiment", "flicker", "--experiment", "other"]].concat();
    succeeded(evaluate(&out, &arguments));
    let table = fs::read_to_string(out.join("quality.md")).expect("a table");
    for word in
        ["| best, visibility apart", "### A lamp that flickers", "% of the pixels", "[ASVGF] Fig. 6", "| EAW, then stabilize"]
    {
        assert!(table.contains(word), "no {word} in {table}");
    }
    assert!(!table.contains("[SVGF] Fig. 10"), "an experiment that was not asked for: {table}");
    let page = fs::read_to_string(out.join("quality.html")).expect("a page");
    assert!(page.contains("RMSE inside") && page.contains("A lamp that flickers"), "no experiments in the page");

    fs::remove_file(out.join("experiments/flicker/change.png")).expect("a map");
    succeeded(evaluate(&out, &arguments));
    assert!(!out.join("experiments/flicker/change.png").exists(), "a finished experiment was done again");
    assert_eq!(fs::read_to_string(out.join("quality.md")).expect("a table"), table);
}

/// Two filters of an experiment that give the same picture are one filter: what tells them apart was not set.
#[test]
fn every_experiment_compares_filters_that_differ() {
    let Some(_gpu) = Validated::new() else { return };
    let out = empty("evaluate_filters");
    let all = ["still", "strata", "other", "eaw", "sparse", "energy", "resolution"];
    let asked: Vec<_> = all.iter().flat_map(|name| ["--experiment", name]).collect();
    succeeded(evaluate(&out, &[&["--scene", "cornell", "--filter", "EAW"], &asked[..]].concat()));
    for experiment in all {
        let text = fs::read_to_string(out.join("experiments").join(experiment).join("findings.json")).expect("findings");
        let kept: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        for table in kept["findings"]["tables"].as_array().expect("tables") {
            let rows = table["rows"].as_array().expect("rows");
            let name = |row: &serde_json::Value| row[0].as_str().expect("a name").to_owned();
            // The fifth level is already wider than a picture of 48x27 pixels.
            let rows: Vec<_> = rows.iter().filter(|row| !name(row).ends_with("10 levels")).collect();
            let first = |row: &serde_json::Value| row[1][0].as_f64().expect("a figure").to_bits();
            let different: HashSet<_> = rows.iter().map(|row| first(row)).collect();
            assert!(rows.len() > 1 && different.len() == rows.len(), "{experiment}: {rows:?}");
        }
    }
}

#[test]
fn references_are_kept_and_a_broken_one_is_rendered_again() {
    let Some(_gpu) = Validated::new() else { return };
    let out = empty("evaluate_references");
    let arguments = ["--scene", "cornell"];
    succeeded(evaluate(&out, &arguments));
    let files = references(&out);
    let [kept, broken, _, _] = &files[..] else { panic!("{files:?}") };
    let whole = fs::read(broken).expect("a reference");
    fs::write(broken, &whole[..whole.len() / 2]).expect("a file");
    let time = |path: &PathBuf| fs::metadata(path).and_then(|data| data.modified()).expect("a time");
    let before = time(kept);
    fs::remove_dir_all(out.join("cornell")).expect("the results");
    succeeded(evaluate(&out, &arguments));
    assert_eq!(references(&out), files);
    assert_eq!(time(kept), before, "a reference was rendered again");
    assert_eq!(fs::read(broken).expect("a reference"), whole, "half a reference was kept");
}

#[test]
fn what_cannot_be_evaluated_is_said_before_anything_is_rendered() {
    let out = empty("evaluate_refused");
    let message = refused(evaluate(&out, &["--scene", "cornell", "--scene", "cornel"]));
    assert!(message.contains("\"cornel\"") && message.contains("lamps, tiles, door"), "{message}");
    let markdown = out.join("plain.md");
    fs::write(&markdown, "no lines\n").expect("a file");
    let message = refused(evaluate(&out, &["--scene", "cornell", "--markdown", markdown.to_str().expect("a path")]));
    assert!(message.contains("<!-- evaluate -->") && message.contains("--markdown"), "{message}");
    assert_eq!(fs::read_to_string(&markdown).expect("a file"), "no lines\n");
    let Some(_gpu) = Validated::new() else { return };
    let message = refused(measuring(5, &out, &[]));
    assert!(message.contains("5 frames") && message.contains("--measured 4"), "{message}");
    assert!(!out.join("references").exists(), "something was rendered");
}

/// The figures are those of a device, so that what was measured on software Vulkan is asked of software Vulkan alone.
#[test]
fn what_is_claimed_of_the_quick_scenes_holds() {
    let Some(gpu) = Validated::new() else { return };
    if !gpu.info().to_string().contains("software") {
        return;
    }
    let out = empty("evaluate_quick");
    let mut command = Command::new(env!("CARGO_BIN_EXE_atrous-demo"));
    let stdout = succeeded(command.args(["evaluate", "--quick", "--out"]).arg(&out).output().expect("the demo starts"));
    assert!(stdout.contains("RMSE of A-SVGF to that of SVGF where light changes"), "{stdout}");
}

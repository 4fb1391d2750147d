//! The report of a run in a browser. Ignored where there is none; `ATROUS_REQUIRE_BROWSER=1` makes that a failure.

#[allow(dead_code)] // the tests of the tool use the rest
mod samples;

use atrous_harness::browser::{Chromium, BROWSER};
use atrous_harness::{DeviceTest, Group};
use serde_json::{json, Value};
use std::path::Path;
use std::sync::OnceLock;

const TESTS: &[DeviceTest] = &[
    ("a_scored_run_has_pictures_errors_and_curves", a_scored_run_has_pictures_errors_and_curves),
    ("a_run_without_a_reference_has_pictures", a_run_without_a_reference_has_pictures),
];
const OPTIONS: [&str; 3] = ["--report", "--preset", "eaw"];

static FOUND: OnceLock<Result<Chromium, String>> = OnceLock::new();

fn main() {
    let found = FOUND.get_or_init(|| Chromium::find(Path::new(env!("CARGO_TARGET_TMPDIR"))));
    atrous_harness::run_with(&BROWSER, &[Group { name: "", tests: TESTS, needs_device: true }], found);
}

/// Names of all pictures, sizes of the first, titles of the curves, and numbers of their lines and of the rows of tables.
fn observe(input: &Path, more: &[&str]) -> Value {
    let output = tempfile::tempdir().expect("a folder");
    samples::denoise(input, output.path(), &[&OPTIONS[..], more].concat()).expect("a run");
    let html = std::fs::read_to_string(output.path().join("report.html")).expect("a report");
    let Some(Ok(browser)) = FOUND.get() else { panic!("no browser") };
    browser.observe(
        &html,
        [1200, 900],
        "const all = (selector) => [...document.querySelectorAll(selector)];
        const layers = all('.layer');
        return {
            pictures: layers.map((l) => l.alt),
            size: [layers[0].naturalWidth, layers[0].naturalHeight],
            lines: all('figure svg').map((plot) => plot.querySelectorAll('polyline, path.line').length > 0),
            rows: all('tbody tr').length,
        };",
    )
}

fn a_scored_run_has_pictures_errors_and_curves() {
    let input = samples::sequence(3);
    let seen = observe(input.path(), &[]);
    assert_eq!(seen["pictures"], json!(["noisy", "denoised", "reference", "FLIP of noisy", "FLIP of denoised"]));
    assert_eq!(seen["size"], json!([samples::WIDTH, samples::HEIGHT]));
    // Three frames, their mean, and that of the noisy ones.
    assert_eq!(seen["rows"], json!(5), "{seen}");
    assert_eq!(seen["lines"], json!([true, true, true, true, true, true]), "{seen}");
}

fn a_run_without_a_reference_has_pictures() {
    let input = samples::sequence(2);
    let seen = observe(input.path(), &["--channel", "reference=none"]);
    assert_eq!(seen["pictures"], json!(["noisy", "denoised"]));
    assert_eq!((&seen["rows"], &seen["lines"]), (&json!(0), &json!([])), "{seen}");
}

//! The benchmark as a program: what it refuses, what it writes, and the statistics of shaders against the table that is kept.

use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, HeadlessOptions};
use atrous_harness::{DeviceTest, Group};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Those that need no device.
const TESTS: &[DeviceTest] = &[
    ("bad_input_is_refused", bad_input_is_refused),
    ("images_of_half_the_light_are_a_quarter", images_of_half_the_light_are_a_quarter),
    ("a_device_without_statistics_is_named", a_device_without_statistics_is_named),
    ("shaders_are_as_small_as_the_table_says", shaders_are_as_small_as_the_table_says),
];

/// Those that run on the device.
const DEVICE_TESTS: &[DeviceTest] = &[("every_preset_is_measured_and_compared", every_preset_is_measured_and_compared)];

fn main() {
    let device = HeadlessDevice::new(&HeadlessOptions::default());
    atrous_harness::run(
        &[Group { name: "", tests: TESTS, needs_device: false }, Group { name: "", tests: DEVICE_TESTS, needs_device: true }],
        &device,
    );
}

/// Exit status of `bench --isa` where no device offers statistics.
const NO_STATISTICS: i32 = 3;

fn bench() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bench"));
    command.envs(atrous_harness::quick_shaders());
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn run(command: &mut Command) -> Output {
    let output = command.output().expect("a process");
    assert!(output.status.success(), "{command:?}: {}\n{}", output.status, text(&output.stderr));
    output
}

fn bad_input_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let no_figures = folder.path().join("other.json");
    std::fs::write(&no_figures, "{\"format\": 1}").expect("a file");
    let no_figures = no_figures.to_str().expect("UTF-8");
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let refused: [(&[&str], &str); 13] = [
        (&["--size", "1920"], "\"1920\" is no size: give width and height like 320x180"),
        (&["--size", "0x4"], "\"0x4\" is no size"),
        (&["--preset", "sgvf"], "\"sgvf\" is no preset and no graph; there are: svgf, asvgf"),
        (&["--bandwidth", "0"], "\"0\" is no bandwidth: give GB/s above 0"),
        (&["--content", "walls"], "\"walls\" is no content; there are: moving, wall"),
        (&["--chip", "RTX 4080 Ti"], "\"RTX 4080 Ti\" is no chip whose data sheet is known here; there are: H200, H100"),
        (&["--light", "third"], "invalid value 'third' for '--light <LIGHT>'"),
        (&["--size", "8x8", "--levels", "11"], "Config::levels is 11; allowed is 1 to 10"),
        (&["--against", no_figures], "holds no figures of this benchmark; give a file that --json wrote"),
        (&["--against", "/nowhere.json"], "/nowhere.json: "),
        (&["--isa", "--against", manifest], "the lines `<!-- bench --isa: begin -->`"),
        (&["--update", manifest], "--isa"),
        (&["--isa", "--update", manifest, "--preset", "svgf"], "cannot be used with"),
    ];
    for (arguments, message) in refused {
        let output = bench().args(arguments).output().expect("a process");
        assert!(!output.status.success(), "{arguments:?}");
        let said = text(&output.stderr);
        assert!(said.starts_with("error: ") && said.contains(message), "{arguments:?}: {said}");
    }
}

/// Presets are measured at a size at which times mean nothing: what counts is that all figures are there.
fn every_preset_is_measured_and_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let (json, picture) = (folder.path().join("figures.json"), folder.path().join("bars.png"));
    let small = ["--frames", "1", "--rounds", "1", "--size", "48x27"];
    run(bench().args(small).arg("--json").arg(&json).arg("--picture").arg(&picture));
    let figures: Value = serde_json::from_slice(&std::fs::read(&json).expect("figures")).expect("JSON");
    let cases = figures["cases"].as_array().expect("cases");
    let names: Vec<_> = cases.iter().map(|case| case["graph"].as_str().unwrap_or_default()).collect();
    assert_eq!(names, Preset::ALL.map(|preset| preset.name()));
    for case in cases {
        let passes = case["passes"].as_array().expect("passes");
        assert!(passes.iter().any(|p| p["bytes"].as_u64() > Some(48 * 27 * 8)), "{case}");
        assert!(case["frame"]["median"].as_f64() > Some(0.0) && case["floor"]["arithmetic_ms"].as_f64() > Some(0.0), "{case}");
        assert!(case["host"]["recording_us"].as_f64() > Some(0.0) && case["memory"]["allocated"].as_u64() > Some(0), "{case}");
    }
    assert!(picture.metadata().expect("a picture").len() > 1000);
    let page = folder.path().join("page.md");
    run(bench().args(small).args(["--preset", "best", "--game", "--bandwidth", "0.01", "--report"]).arg(&page));
    let page = std::fs::read_to_string(page).expect("a page");
    for expected in ["- Driver: ", "- Memory bandwidth: 0.01 GB/s", "best + reflections + visibility + volume", "× floor"] {
        assert!(page.contains(expected), "{expected}:\n{page}");
    }
    let modulate = page.lines().find(|line| line.starts_with("| modulate ")).expect("a pass");
    let cells: Vec<f64> = modulate.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
    // MB by 0.01 GB/s; MB have two decimals.
    assert!(cells[4] > 0.02 && (cells[6] * 0.01 - cells[4]).abs() < 0.006, "{modulate}");
    // Every shader of the preset is in the table of the page.
    let chip = run(bench().args(["--frames", "1", "--rounds", "1", "--size", "480x270", "--preset", "best", "--chip", "6900 XT"]));
    let said = text(&chip.stdout);
    let column = |row: &str, name: &str| -> Option<f64> {
        let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
        let names = cells(said.lines().find(|line| line.contains("cycles ms"))?);
        cells(said.lines().find(|line| line.starts_with(&format!("| {row} ")))?)
            .get(names.iter().position(|n| n == name)?)?
            .parse()
            .ok()
    };
    let cycles = ["temporal_accumulation", "atrous_0", "all passes"].map(|row| column(row, "cycles ms").expect(&said));
    assert!(cycles[0] > 0.0 && cycles[1] > 0.0 && cycles[2] > cycles[0] + cycles[1], "{cycles:?}:\n{said}");
    let stamps = run(bench().args(small).args(["--preset", "svgf", "--timestamps"]));
    assert!(text(&stamps.stdout).contains("GPU timestamps"), "{}", text(&stamps.stdout));
    let both = run(bench().args(small).args(["--preset", "svgf,custom", "--growth", "--against"]).arg(&json));
    let said = text(&both.stdout);
    for expected in
        ["svgf 48x27 moving: atrous_4", "note: the earlier run has no custom 48x27 moving", "moving / wall", "× smallest"]
    {
        assert!(said.contains(expected), "{expected}:\n{said}");
    }
}

fn images_of_half_the_light_are_a_quarter() {
    let bytes_of = |light: &str| -> f64 {
        let output = run(bench().args(["--images", "--preset", "best", "--size", "96x48", "--output", "1", "--light", light]));
        let said = text(&output.stdout);
        let row = said.lines().find(|line| line.starts_with("| irradiance_history |")).expect("an image");
        row.split('|').rev().nth(1).and_then(|cell| cell.trim().parse().ok()).expect("bytes a pixel")
    };
    let [full, half] = ["full", "half"].map(bytes_of);
    assert!(full >= 8.0 && half == full / 4.0, "{half} of {full}");
}

fn a_device_without_statistics_is_named() {
    let output = bench().args(["--isa", "--device", "no device has this name"]).output().expect("a process");
    assert_eq!(output.status.code(), Some(NO_STATISTICS), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("RADV_FORCE_FAMILY"), "{}", text(&output.stderr));
}

/// Where Vulkan's drivers are described.
const DRIVERS: [&str; 3] = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];

/// The description of Mesa's driver for AMD, which compiles without a GPU.
fn radv() -> Option<PathBuf> {
    let files = DRIVERS.iter().filter_map(|folder| Path::new(folder).read_dir().ok()).flatten().flatten();
    let names = ["radeon_icd.json".to_owned(), format!("radeon_icd.{}.json", std::env::consts::ARCH)];
    files.map(|entry| entry.path()).find(|path| names.iter().any(|name| path.ends_with(name)))
}

fn shaders_are_as_small_as_the_table_says() {
    let Some(radv) = radv() else {
        println!("no radeon_icd.*.json in {DRIVERS:?} (Debian: mesa-vulkan-drivers): no statistics of shaders were compared");
        return;
    };
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../docs/lab/performance.md");
    let update = std::env::var_os("ATROUS_UPDATE_ISA").is_some();
    let mut command = bench();
    command.args(["--isa", if update { "--update" } else { "--against" }, table]);
    command.env("VK_ICD_FILENAMES", &radv).env("VK_DRIVER_FILES", &radv).env("RADV_FORCE_FAMILY", "navi21");
    let output = command.output().expect("a process");
    let said = text(&output.stderr);
    if output.status.code() == Some(NO_STATISTICS) {
        println!("{said}: no statistics of shaders were compared");
        return;
    }
    assert!(
        output.status.success(),
        "{said}\nWhere this is meant to be, renew the table of docs/lab/performance.md: ATROUS_UPDATE_ISA=1 cargo test -p \
         atrous-measure --test bench shaders"
    );
    if let Some(reason) = text(&output.stdout).lines().find(|line| line.contains("nothing was compared")) {
        println!("{reason}");
    }
}

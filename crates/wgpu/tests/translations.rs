//! Every shader in the languages of other graphics APIs: MSL by SPIRV-Cross, with which MoltenVK works, and MSL and WGSL by naga, with
//! which wgpu works. Without the tools they are ignored (Debian: `spirv-cross`, `spirv-tools`); `ATROUS_REQUIRE_TRANSLATORS=1` makes
//! that a failure.

use atrous_harness::{DeviceTest, Group, Need};
use naga::back::{msl, wgsl};
use naga::front::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

const TRANSLATORS: Need = Need { tests: "translations of shaders", required_by: "ATROUS_REQUIRE_TRANSLATORS" };
const TESTS: &[DeviceTest] = &[
    ("spirv_cross_makes_msl_of_every_shader", spirv_cross_makes_msl_of_every_shader),
    ("naga_makes_msl_and_wgsl_of_all_but_those_that_are_named", naga_makes_msl_and_wgsl_of_all_but_those_that_are_named),
];

/// What naga 30 does not read: a part of its message, and the shaders.
const UNREAD: &[(&str, &[&str])] = &[
    // The choice between two numbers by a specialisation constant, which spirv-opt does not fold.
    (
        "SpecConstantOp",
        &[
            "atrous_signals_1",
            "atrous_signals_1_material_1",
            "atrous_signals_1_specular_1",
            "atrous_signals_1_specular_1_material_1",
            "atrous_signals_2",
            "atrous_signals_2_material_1",
            "atrous_signals_2_specular_1",
            "atrous_signals_2_specular_1_material_1",
            "gradient_atrous_ratio_1",
            "modulate_float_0",
            "modulate_float_0_upsampled_1",
            "modulate_float_1",
            "modulate_float_1_upsampled_1",
            "shadowed_light_float_0",
            "shadowed_light_float_1",
            "temporal_upscale_float_0",
            "temporal_upscale_float_0_surface_id_0",
            "temporal_upscale_float_0_surface_id_1",
            "temporal_upscale_float_1",
            "temporal_upscale_float_1_surface_id_0",
            "temporal_upscale_float_1_surface_id_1",
        ],
    ),
    // Atomics on images.
    (
        "unsupported storage class",
        &["forward_project_resolve_0_forward_motion_0", "forward_project_resolve_0_forward_motion_1", "volume_motion_resolve_0"],
    ),
    // A sum of a signed and an unsigned number, which SPIR-V allows.
    ("Operation Add can't work", &["volume_motion_resolve_1"]),
];

fn main() {
    let program = |name: &str, option: &str| match Command::new(name).arg(option).output() {
        Ok(_) => Ok(()),
        Err(error) => Err(format!("no {name}: {error}")),
    };
    let found = program("spirv-cross", "--revision").and_then(|()| program("spirv-opt", "--version"));
    atrous_harness::run_with(&TRANSLATORS, &[Group { name: "", tests: TESTS, needs_device: true }], &found);
}

/// Names of the shaders, and their SPIR-V.
fn shaders() -> BTreeMap<String, PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../glsl/spirv");
    let files = folder.read_dir().expect("a folder").flatten().map(|entry| entry.path());
    let modules = files.filter(|path| path.extension().is_some_and(|extension| extension == "spv"));
    modules.map(|path| (path.file_stem().expect("a name").to_string_lossy().into_owned(), path)).collect()
}

/// The documents say how many shaders are left out. They do not count all, so that a new stage changes none of them.
fn assert_documented(left_out: usize) {
    let row = format!("| naga 30 to MSL 2.2 and WGSL | all but {left_out} |");
    assert!(include_str!("../../../docs/lab/hosts.md").contains(&row), "docs/lab/hosts.md must have this row:\n{row}");
    let share = format!("naga translates all but {left_out} to");
    assert!(include_str!("../../../docs/problems.md").contains(&share), "docs/problems.md must say: {share}");
}

fn spirv_cross_makes_msl_of_every_shader() {
    let shaders = shaders();
    assert!(shaders.len() > 40, "{shaders:?}");
    for (name, path) in &shaders {
        let output = Command::new("spirv-cross").arg(path).args(["--msl", "--msl-version", "20200"]).output().expect("spirv-cross");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{name}: {errors}");
        assert!(String::from_utf8_lossy(&output.stdout).contains("kernel void"), "{name} is no kernel: {errors}");
    }
    println!("SPIRV-Cross: {} shaders", shaders.len());
}

/// A shader whose specialisation constants are constants, as wgpu needs it.
fn frozen(path: &Path) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("frozen.spv");
    let passes = ["--freeze-spec-const", "--fold-spec-const-op-composite", "--eliminate-dead-const"];
    let output = Command::new("spirv-opt").args(passes).arg(path).arg("-o").arg(&file).output().expect("spirv-opt");
    assert!(output.status.success(), "{}: {}", path.display(), String::from_utf8_lossy(&output.stderr));
    std::fs::read(file).expect("a shader")
}

fn by_naga(spirv: &[u8]) -> Result<[String; 2], String> {
    let module = spv::parse_u8_slice(spirv, &spv::Options::default()).map_err(|error| chain(&error))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(&module).map_err(|error| chain(error.as_inner()))?;
    let text = wgsl::write_string(&module, &info, wgsl::WriterFlags::empty()).map_err(|error| chain(&error))?;
    let options = msl::Options { lang_version: (2, 2), ..msl::Options::default() };
    let metal = msl::write_string(&module, &info, &options, &msl::PipelineOptions::default()).map_err(|error| chain(&error))?;
    Ok([text, metal.0])
}

/// An error with its causes.
fn chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

fn naga_makes_msl_and_wgsl_of_all_but_those_that_are_named() {
    let shaders = shaders();
    let unread = |name: &str| UNREAD.iter().find(|(_, names)| names.contains(&name)).map(|(message, _)| *message);
    for (name, path) in &shaders {
        match (by_naga(&frozen(path)), unread(name)) {
            (Ok([wgsl, msl]), None) => {
                assert!(wgsl.contains("@compute") && msl.contains("kernel void"), "{name}:\n{wgsl}\n{msl}");
            }
            (Err(error), Some(message)) => assert!(error.contains(message), "{name} fails for a reason of its own: {error}"),
            (Ok(_), Some(_)) => panic!("naga reads {name} now: take it out of UNREAD"),
            (Err(error), None) => panic!("{name}: {error}"),
        }
    }
    let left_out: usize = UNREAD.iter().map(|(_, names)| names.len()).sum();
    assert!(UNREAD.iter().flat_map(|(_, names)| *names).all(|name| shaders.contains_key(*name)), "UNREAD names what is no shader");
    println!("naga: {} of {} shaders", shaders.len() - left_out, shaders.len());
    assert_documented(left_out);
}

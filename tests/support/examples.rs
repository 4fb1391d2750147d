//! Examples as the programs that Cargo makes of them.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// Features of the workspace as scripts/test.sh has them, so that what it built is used.
const FEATURES: &str = "capture,window,hot-reload";

/// The compute shader of the host in examples/custom_graph.rs.
pub const MEAN_3X3: &str = include_str!("../../examples/mean_3x3.comp");

/// SPIR-V of a compute shader, with its names.
pub fn compile(source: &str) -> Vec<u32> {
    let mut options = shaderc::CompileOptions::new().expect("options");
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_1 as u32);
    let compiler = shaderc::Compiler::new().expect("a compiler");
    let compiled = compiler.compile_into_spirv(source, shaderc::ShaderKind::Compute, "host.comp", "main", Some(&options));
    compiled.expect("SPIR-V").as_binary().to_vec()
}

/// An example, built where it is missing or older than its sources: `cargo test --test suite` alone does not build it.
pub fn program(name: &str) -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(build).join(name).with_extension(std::env::consts::EXE_EXTENSION)
}

/// Gives the folder of the examples, beside this program's own: `TARGET/PROFILE/deps/suite-HASH`.
fn build() -> PathBuf {
    let this = std::env::current_exe().expect("this program");
    let folder = this.ancestors().nth(2).expect("the folder of the profile");
    let (target, profile) = (folder.parent().expect("the target folder"), folder.file_name().expect("the profile"));
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(["build", "--quiet", "--workspace", "--features", FEATURES]);
    command.args(
        ["host_ash", "host_vk_graph", "host_vulkano", "host_wgpu", "custom_graph"].iter().flat_map(|name| ["--example", *name]),
    );
    command.arg("--profile");
    command.arg(if profile == Path::new("debug") { "dev".as_ref() } else { profile }).arg("--target-dir").arg(target);
    let output = command.output().expect("cargo");
    assert!(output.status.success(), "the examples are not built:\n{}", String::from_utf8_lossy(&output.stderr));
    folder.join("examples")
}

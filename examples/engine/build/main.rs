//! Compiles `glsl/*.comp` to SPIR-V (Vulkan 1.1) and writes `$OUT_DIR/shaders.rs`, one `Shader` for each; with the feature `hot-reload`
//! with their interfaces. Includes come from `glsl/include`, and from the folder of the crate that holds the header for hosts.

mod shaders;

use atrous_glsl::{Compiler, Detail, Glsl};
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), String> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(|e| e.to_string())?).join("glsl");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    let includes = [root.join("include"), root.join("../../../glsl/host")];
    for folder in [&root, &includes[0], &includes[1]] {
        println!("cargo:rerun-if-changed={}", folder.display());
    }
    println!("cargo:rustc-env=ATROUS_ENGINE_REFERENCES={:016x}", reference_hash(&root, &includes)?);
    shaders::write_table(&root, &includes, &out.join("shaders.rs"))
}

/// Shaders that draw references.
const OF_REFERENCES: [&str; 5] = ["gbuffer", "gbuffer_glass", "reference", "reference_glass", "volume_reference"];

/// Code of the path tracer that references do not depend on.
const NOT_OF_REFERENCES: [&str; 1] = ["reshading.rs"];

/// A hash of everything that references depend on: what their shaders were compiled to, and the code that runs them.
fn reference_hash(root: &Path, includes: &[PathBuf]) -> Result<u64, String> {
    let mut hasher = DefaultHasher::new();
    let compiler = Compiler::new().map_err(|e| format!("shaderc does not start: {e}"))?;
    for name in OF_REFERENCES {
        let source = Glsl::read(&root.join(name).with_extension("comp"), includes)?;
        for variant in source.variants() {
            source.compile(&compiler, &variant, Detail::Code)?.hash(&mut hasher);
        }
    }
    let folder = root.join("../src/tracer");
    println!("cargo:rerun-if-changed={}", folder.display());
    let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut files: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file()).collect();
    files.retain(|file| NOT_OF_REFERENCES.iter().all(|name| !file.ends_with(name)));
    files.sort();
    for file in files {
        fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))?.hash(&mut hasher);
    }
    Ok(hasher.finish())
}

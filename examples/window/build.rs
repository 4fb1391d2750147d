//! Compiles `glsl/` to SPIR-V (Vulkan 1.1) and writes `$OUT_DIR/shaders.rs`, one `Shader` for each.

#[path = "../engine/build/shaders.rs"]
mod shaders;

use std::env;
use std::path::PathBuf;

fn main() -> Result<(), String> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(|e| e.to_string())?).join("glsl");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    println!("cargo:rerun-if-changed={}", root.display());
    shaders::write_table(&root, std::slice::from_ref(&root), &out.join("shaders.rs"))
}

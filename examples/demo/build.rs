//! Compiles `glsl/*.comp` to SPIR-V (Vulkan 1.1) and writes `$OUT_DIR/shaders.rs`, one constant for each shader; with the feature `window`
//! those of `glsl/window/` into `$OUT_DIR/window_shaders.rs`.
//! Includes come from `glsl/include`, and from the folder of the crate that holds the header for hosts.

use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), String> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(|e| e.to_string())?).join("glsl");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    println!("cargo:rerun-if-changed={}", root.display());
    println!("cargo:rerun-if-changed={}", root.join("include").display());
    write_table(&root, &root, &out.join("shaders.rs"))?;
    if env::var_os("CARGO_FEATURE_WINDOW").is_some() {
        println!("cargo:rerun-if-changed={}", root.join("window").display());
        write_table(&root, &root.join("window"), &out.join("window_shaders.rs"))?;
    }
    Ok(())
}

/// Compiles the shaders of a folder, with a table of constants beside them.
fn write_table(root: &Path, folder: &Path, table: &Path) -> Result<(), String> {
    let compiler = shaderc::Compiler::new().map_err(|e| format!("shaderc does not start: {e}"))?;
    let mut generated = String::new();
    for shader in shaders(folder)? {
        let name = shader.file_name().and_then(|s| s.to_str()).ok_or("a shader's name is not UTF-8")?;
        let stem = name.trim_end_matches(".comp").replace('.', "_");
        let words = compile(&compiler, root, &shader)?;
        let spirv = table.with_file_name(format!("{stem}.spv"));
        fs::write(&spirv, words).map_err(|e| format!("{}: {e}", spirv.display()))?;
        generated += &format!(
            "/// SPIR-V of `{name}`.\npub const {}: &[u8] = include_bytes!({:?});\n",
            stem.to_uppercase(),
            spirv.display().to_string()
        );
    }
    fs::write(table, generated).map_err(|e| e.to_string())
}

/// The shaders of a folder, sorted so that the generated file does not depend on the file system.
fn shaders(root: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(root).map_err(|e| format!("{}: {e}", root.display()))?;
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| kind(path).is_some()).collect();
    found.sort();
    Ok(found)
}

fn kind(path: &Path) -> Option<shaderc::ShaderKind> {
    match path.extension()?.to_str()? {
        "comp" => Some(shaderc::ShaderKind::Compute),
        "vert" => Some(shaderc::ShaderKind::Vertex),
        "frag" => Some(shaderc::ShaderKind::Fragment),
        _ => None,
    }
}

fn compile(compiler: &shaderc::Compiler, root: &Path, shader: &Path) -> Result<Vec<u8>, String> {
    println!("cargo:rerun-if-changed={}", shader.display());
    let source = fs::read_to_string(shader).map_err(|e| format!("{}: {e}", shader.display()))?;
    let kind = kind(shader).ok_or_else(|| format!("{}: not a shader", shader.display()))?;
    // One set of options for each shader: shaderc's include callback keeps state between compilations otherwise.
    let mut options = shaderc::CompileOptions::new().map_err(|e| e.to_string())?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_1 as u32);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    options.set_warnings_as_errors();
    let folders = [root.join("include"), root.join("../../../glsl/host")];
    options.set_include_callback(move |name, _, _, _| {
        let found = folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file());
        let path = found.unwrap_or_else(|| folders[0].join(name));
        println!("cargo:rerun-if-changed={}", path.display());
        fs::read_to_string(&path)
            .map(|content| shaderc::ResolvedInclude { resolved_name: path.display().to_string(), content })
            .map_err(|e| format!("{}: {e}", path.display()))
    });
    compiler
        .compile_into_spirv(&source, kind, &shader.display().to_string(), "main", Some(&options))
        .map(|artifact| artifact.as_binary_u8().to_vec())
        .map_err(|e| e.to_string())
}

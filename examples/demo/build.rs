//! Compiles `glsl/*.comp` to SPIR-V (Vulkan 1.1) and writes `$OUT_DIR/shaders.rs`, one `Shader` for each; with the feature `window` those of
//! `glsl/window/` into `$OUT_DIR/window_shaders.rs`; with the feature `hot-reload` with their interfaces.
//! Includes come from `glsl/include`, and from the folder of the crate that holds the header for hosts.

use atrous_glsl::{shaders, Compiler, Detail, Glsl, Variant};
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), String> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(|e| e.to_string())?).join("glsl");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(|e| e.to_string())?);
    let includes = [root.join("include"), root.join("../../../glsl/host")];
    println!("cargo:rerun-if-changed={}", includes[1].display());
    for folder in [&root, &includes[0]] {
        println!("cargo:rerun-if-changed={}", folder.display());
    }
    println!("cargo:rustc-env=ATROUS_DEMO_TRACER={:016x}", reference_hash(&root, &includes)?);
    write_table(&root, &includes, &out.join("shaders.rs"))?;
    if env::var_os("CARGO_FEATURE_WINDOW").is_some() {
        let window = root.join("window");
        let includes = [vec![window.clone()], includes.to_vec()].concat();
        write_table(&window, &includes, &out.join("window_shaders.rs"))?;
    }
    Ok(())
}

/// Compiles the shaders of a folder, with a table of constants beside them.
fn write_table(folder: &Path, includes: &[PathBuf], table: &Path) -> Result<(), String> {
    let compiler = Compiler::new().map_err(|e| format!("shaderc does not start: {e}"))?;
    let (mut generated, mut names) = (String::new(), String::new());
    for file in shaders(folder)? {
        let source = Glsl::read(&file, includes)?;
        for variant in source.variants() {
            let name = &variant.name;
            let words = source.compile(&compiler, &variant, Detail::Code)?;
            let spirv = table.with_file_name(format!("{name}.spv"));
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
            fs::write(&spirv, bytes).map_err(|e| format!("{}: {e}", spirv.display()))?;
            generated += &format!(
                "/// `{name}`.\npub static {constant}: Shader = Shader {{ name: {name:?}, spirv: include_bytes!({spirv:?}), interface: &{interface} }};\n",
                constant = name.to_uppercase(),
                spirv = spirv.display().to_string(),
                interface = interface_of(&source, &compiler, &variant)?,
            );
            names += &format!("&{}, ", name.to_uppercase());
        }
    }
    generated += &format!("/// Each.\n#[cfg(feature = \"hot-reload\")]\npub static ALL: &[&Shader] = &[{names}];\n");
    fs::write(table, generated).map_err(|e| e.to_string())
}

#[cfg(feature = "hot-reload")]
fn interface_of(source: &Glsl, compiler: &Compiler, variant: &Variant) -> Result<String, String> {
    atrous_glsl::interface(&source.compile(compiler, variant, Detail::Everything)?).map(|lines| format!("{lines:?}"))
}

#[cfg(not(feature = "hot-reload"))]
fn interface_of(_: &Glsl, _: &Compiler, _: &Variant) -> Result<String, String> {
    Ok("[]".into())
}

/// Shaders that draw references.
const OF_REFERENCES: [&str; 3] = ["gbuffer", "reference", "volume_reference"];

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

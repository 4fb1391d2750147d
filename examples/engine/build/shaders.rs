//! The shaders of a folder, compiled to SPIR-V, with a table of constants: for the build scripts of the engine and of programs around it.

use atrous_glsl::{shaders, Compiler, Detail, Glsl, Variant};
use std::fs;
use std::path::{Path, PathBuf};

/// Compiles the shaders of a folder, with a table of constants beside them.
pub fn write_table(folder: &Path, includes: &[PathBuf], table: &Path) -> Result<(), String> {
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

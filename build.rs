//! `glsl/*.comp` → SPIR-V (Vulkan 1.1) → reflection → `shaders.rs`, with compile-time asserts that the Rust twins of GLSL blocks agree.
//!
//! With the feature `shaderc` the GLSL is compiled here. Without it the SPIR-V and the table under `glsl/spirv/` are used, after a hash of
//! the GLSL was compared with the one that they were made from. `ATROUS_UPDATE_SPIRV=1 cargo build` renews them.

use std::{env, error::Error, fs, path::Path, process};

fn main() {
    println!("cargo:rerun-if-changed=glsl");
    println!("cargo:rerun-if-env-changed=ATROUS_UPDATE_SPIRV");
    if let Err(error) = build() {
        eprintln!("{error}");
        process::exit(1);
    }
}

fn build() -> Result<(), Box<dyn Error>> {
    let root = env::var("CARGO_MANIFEST_DIR")?;
    let glsl = Path::new(&root).join("glsl");
    let checked_in = glsl.join("spirv");
    let hash = hash_of_sources(&glsl)?;
    let current = fs::read_to_string(checked_in.join("sources.hash")).is_ok_and(|stored| stored.trim() == hash);
    #[cfg(feature = "shaderc")]
    let table = {
        let out = Path::new(&env::var("OUT_DIR")?).join("spirv");
        compile::all(&glsl, &out)?;
        if env::var("ATROUS_UPDATE_SPIRV").is_ok_and(|v| v == "1") {
            let _ = fs::remove_dir_all(&checked_in);
            fs::create_dir_all(&checked_in)?;
            for entry in fs::read_dir(&out)? {
                let entry = entry?;
                fs::copy(entry.path(), checked_in.join(entry.file_name()))?;
            }
            fs::write(checked_in.join("sources.hash"), format!("{hash}\n"))?;
        } else if !current {
            println!("cargo:warning=glsl/spirv is older than the GLSL: renew it with ATROUS_UPDATE_SPIRV=1 cargo build");
        }
        out
    };
    #[cfg(not(feature = "shaderc"))]
    let table = {
        if !current {
            return Err("glsl/spirv was not made from this GLSL: run `ATROUS_UPDATE_SPIRV=1 cargo build --features shaderc`".into());
        }
        checked_in
    };
    println!("cargo:rustc-env=ATROUS_SHADERS={}", table.join("shaders.rs").display());
    Ok(())
}

/// FNV-1a over the names and lines of every source, the header for hosts among them, sorted; line ends do not count, since a checkout may change them.
fn hash_of_sources(glsl: &Path) -> Result<String, Box<dyn Error>> {
    let mut sources = Vec::new();
    for folder in [glsl.to_path_buf(), glsl.join("include"), glsl.join("host")] {
        for entry in fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "comp" || e == "glsl") {
                sources.push((path.file_name().unwrap_or_default().to_owned(), fs::read_to_string(&path)?));
            }
        }
    }
    sources.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut eat = |byte: u8| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    for (name, text) in &sources {
        name.as_encoded_bytes().iter().copied().for_each(&mut eat);
        text.lines().flat_map(|line| line.bytes().chain([b'\n'])).for_each(&mut eat);
    }
    Ok(format!("{hash:016x}"))
}

#[cfg(feature = "shaderc")]
mod compile {
    use super::{fs, Error, Path};
    use atrous_glsl::{interface, shaders, Compiler, Glsl, Kept};
    use spirq::{prelude::*, ty::DescriptorType, ty::Type, var::Variable};
    use std::fmt::Write as _;

    /// Compiles every variant of every shader into `out`, with the table `shaders.rs` in it and the table `interfaces.rs` beside it.
    pub fn all(glsl: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
        let _ = fs::remove_dir_all(out);
        fs::create_dir_all(out)?;
        let (mut table, mut interfaces, mut names) = (String::new(), String::new(), Vec::new());
        let compiler = Compiler::new()?;
        for file in shaders(glsl)? {
            let source = Glsl::read(&file, &[glsl.join("include")])?;
            for variant in source.variants() {
                let compile = |kept| source.compile(&compiler, &variant, kept).map_err(|e| format!("{}:\n{e}", variant.name));
                let words = compile(Kept::Code)?;
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
                fs::write(out.join(format!("{}.spv", variant.name)), bytes)?;
                let named = compile(Kept::Everything)?;
                entry(&mut table, &variant.name, &named)?;
                writeln!(interfaces, "({:?}, &{:?}),", variant.name, interface(&named)?)?;
                names.push(variant.name.to_uppercase());
            }
        }
        writeln!(
            table,
            "#[cfg(test)]\npub(crate) static ALL: &[&Shader] = &[{}];",
            names.iter().map(|n| format!("&{n}, ")).collect::<String>()
        )?;
        fs::write(out.join("shaders.rs"), table)?;
        let interfaces = format!("pub(super) static INTERFACES: &[(&str, &[(&str, &str)])] = &[\n{interfaces}];\n");
        fs::write(out.with_file_name("interfaces.rs"), interfaces)?;
        Ok(())
    }

    /// The table entry of one module, and the asserts for the blocks that have a Rust twin.
    fn entry(table: &mut String, name: &str, spirv: &[u32]) -> Result<(), Box<dyn Error>> {
        let entry_points = ReflectConfig::new().spv(spirv).ref_all_rscs(true).combine_img_samplers(false).reflect()?;
        let entry_point = entry_points.first().ok_or_else(|| format!("{name}: no entry point"))?;
        let mut bindings = Vec::new();
        for variable in &entry_point.vars {
            match variable {
                Variable::Descriptor { name: binding, desc_bind, desc_ty, ty, .. } => {
                    bindings.push((desc_bind.bind(), kind(desc_ty, ty)?, binding.clone().unwrap_or_default()));
                    asserts(table, ty)?;
                }
                Variable::PushConstant { ty, .. } => asserts(table, ty)?,
                _ => {}
            }
        }
        bindings.sort();
        if !bindings.iter().enumerate().all(|(i, b)| b.0 as usize == i) {
            return Err(format!("{name}: bindings must be numbered from 0 without a gap, they are {bindings:?}").into());
        }
        writeln!(
            table,
            "pub(crate) static {}: Shader = Shader {{ name: {name:?}, spirv: include_bytes!({:?}),",
            name.to_uppercase(),
            format!("{name}.spv")
        )?;
        writeln!(table, "    bindings: &[")?;
        for (_, kind, binding) in bindings {
            writeln!(table, "        ShaderBinding {{ name: {binding:?}, kind: {kind} }},")?;
        }
        writeln!(table, "    ] }};")?;
        Ok(())
    }

    fn kind(descriptor: &DescriptorType, ty: &Type) -> Result<String, String> {
        Ok(match (descriptor, ty) {
            (DescriptorType::UniformBuffer(), _) => "BindingKind::UniformBuffer".into(),
            (DescriptorType::StorageBuffer(access), _) => format!("BindingKind::StorageBuffer(BindingAccess::{access:?})"),
            (DescriptorType::StorageImage(access), Type::StorageImage(image)) => {
                format!("BindingKind::StorageImage(TexelFormat::{:?}, BindingAccess::{access:?})", image.fmt)
            }
            (DescriptorType::SampledImage(), Type::SampledImage(image)) => match image.scalar_ty.to_string().as_str() {
                "f32" => "BindingKind::SampledImage(Component::Float)".into(),
                "u32" => "BindingKind::SampledImage(Component::Uint)".into(),
                other => return Err(format!("sampled image of {other}")),
            },
            other => return Err(format!("a binding of this kind is not used here: {other:?}")),
        })
    }

    /// A block named like a Rust struct of the crate must have its layout.
    fn asserts(table: &mut String, ty: &Type) -> Result<(), Box<dyn Error>> {
        let Type::Struct(block) = ty else { return Ok(()) };
        let Some(name) = block.name().filter(|n| ["FrameConstants", "PushConstants"].contains(n)) else { return Ok(()) };
        for member in &block.members {
            let (field, offset) = (member.name.as_deref().unwrap_or_default(), member.offset.unwrap_or(0));
            let assert = format!("const _: () = assert!(std::mem::offset_of!({name}, {field}) == {offset});\n");
            if !table.contains(&assert) {
                table.push_str(&assert);
            }
        }
        Ok(())
    }
}

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
        atrous_glsl::write_table(&glsl, &out)?;
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

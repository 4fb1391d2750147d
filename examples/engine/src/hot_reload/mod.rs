//! Shaders that are compiled again when they are saved, those of the denoiser and the engine's own (feature `hot-reload`).

mod watch;

pub use watch::{ShaderWatch, Stale};

use std::path::{Path, PathBuf};

use atrous_glsl::{Compiler, Detail, Glsl, Variant};

use crate::gpu::Shader;

/// Where the GLSL is.
#[derive(Clone, Debug)]
pub struct ShaderFolders {
    /// `glsl/` of the crate, with `include` and `host` in it.
    pub denoiser: PathBuf,
    /// `examples/engine/glsl/`, with `include` in it.
    pub engine: PathBuf,
    /// Those of a program around the engine.
    pub others: Vec<OtherShaders>,
}

/// Shaders of a program around the engine, for its own pipelines.
#[derive(Clone, Debug)]
pub struct OtherShaders {
    /// Their folder.
    pub folder: PathBuf,
    /// Those that the program was built with.
    pub built: &'static [&'static Shader],
}

impl ShaderFolders {
    /// Those that the engine was built from.
    pub fn of_the_build() -> Self {
        let package = Path::new(env!("CARGO_MANIFEST_DIR"));
        Self { denoiser: package.join("../../glsl"), engine: package.join("glsl"), others: Vec::new() }
    }
}

/// Whose shader it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// The denoiser's.
    Denoiser,
    /// That of the engine, or of the program around it.
    Engine,
}

/// A shader that was compiled while the program runs, and that fits where the built one is.
#[derive(Clone, Debug)]
pub struct Compiled {
    owner: Owner,
    name: String,
    spirv: Vec<u32>,
}

impl Compiled {
    /// Whose it is.
    pub fn owner(&self) -> Owner {
        self.owner
    }

    /// Its file without `.comp`, and the macros of its variant.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The module, made by shaderc for Vulkan 1.1.
    pub fn spirv(&self) -> &[u32] {
        &self.spirv
    }

    fn check(&self, built: &[&Shader]) -> Result<(), String> {
        let checked = match self.owner {
            Owner::Denoiser => atrous::hot_reload::check(&self.name, &self.spirv),
            Owner::Engine => {
                let built = built.iter().find(|shader| shader.name == self.name);
                let Some(built) = built else { return Err("the program was built without it: build it again".into()) };
                atrous::hot_reload::check_interface(&self.name, &self.spirv, built.interface)
            }
        };
        checked.map_err(|e| e.to_string())
    }
}

/// What came of a file that was saved, or that includes one that was.
#[derive(Clone, Debug)]
pub struct Recompiled {
    /// From its `glsl` on.
    pub file: String,
    /// Its variants; or what is wrong, with file and line.
    pub shaders: Result<Vec<Compiled>, String>,
}

/// Every variant of a file. `built`: those of the engine, or of the program around it, that it may take the place of.
fn compile(owner: Owner, built: &[&Shader], file: &Path, includes: &[PathBuf]) -> Result<Vec<Compiled>, String> {
    let source = Glsl::read(file, includes)?;
    let compiler = Compiler::new().map_err(|e| format!("shaderc does not start: {e}"))?;
    let compile = |(i, variant): (usize, Variant)| {
        // What fails in a later variant alone has to do with it.
        let of_variant = |text: String| if i == 0 { text } else { format!("{text}\nin {}", variant.name) };
        let spirv = source.compile(&compiler, &variant, Detail::CodeAndNames).map_err(of_variant)?;
        let compiled = Compiled { owner, name: variant.name, spirv };
        compiled.check(built).map_err(|problem| format!("{}: {problem}", file.display()))?;
        Ok(compiled)
    };
    source.variants().into_iter().enumerate().map(compile).collect()
}

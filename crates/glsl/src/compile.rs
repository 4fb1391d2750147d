//! Compiles GLSL to SPIR-V. The build scripts of the crate and of the demo use it, and so does what compiles while a program runs:
//! a shader is then the one that a build would have made.

use shaderc::{CompileOptions, Compiler, EnvVersion, OptimizationLevel, ResolvedInclude, ShaderKind, TargetEnv};
use std::fs;
use std::path::{Path, PathBuf};

/// A file of GLSL that is a shader.
pub struct Glsl {
    file: PathBuf,
    source: String,
    kind: ShaderKind,
    include_folders: Vec<PathBuf>,
}

/// Macros that a shader is compiled with, and the name that it has then.
pub struct Variant {
    /// Stem of the file, and the macros, as in `modulate_signals_1`.
    pub name: String,
    macros: String,
}

/// The detail that a module has of its source.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The code that runs, optimised.
    Code,
    /// The code that runs, optimised, with the names of what it uses: for reflection while a program runs and for debuggers.
    CodeAndNames,
    /// Everything that was declared, not optimised: for reflection.
    Everything,
}

impl Glsl {
    /// Includes are looked for in the folders, in their order.
    pub fn read(file: &Path, include_folders: &[PathBuf]) -> Result<Self, String> {
        let kind = kind(file).ok_or_else(|| format!("{}: neither .comp nor .vert nor .frag", file.display()))?;
        let source = fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
        Ok(Self { file: file.to_owned(), source, kind, include_folders: include_folders.to_vec() })
    }

    /// `// variants: A=1 A=2,B=1`: the sets of macros that a shader is compiled with, of every such line; one empty set without one.
    pub fn variants(&self) -> Vec<Variant> {
        let file = self.file.file_name().unwrap_or_default().to_string_lossy();
        let stem = file.trim_end_matches(".comp").replace('.', "_");
        let lines = self.source.lines().filter_map(|line| line.strip_prefix("// variants:"));
        let variant = |macros: &str| Variant {
            name: format!("{stem}_{}", macros.replace(['=', ','], "_").to_lowercase()),
            macros: macros.to_owned(),
        };
        let variants: Vec<_> = lines.flat_map(str::split_whitespace).map(variant).collect();
        if variants.is_empty() {
            return vec![Variant { name: stem, macros: String::new() }];
        }
        variants
    }

    /// `// optional: a, b`: the bindings that may have nothing, of every such line.
    pub fn optional(&self) -> Vec<String> {
        let lines = self.source.lines().filter_map(|line| line.strip_prefix("// optional:"));
        lines.flat_map(|names| names.split(',')).map(|name| name.trim().to_owned()).collect()
    }

    /// One module. The error is the compiler's text, which does not name the variant: file (an include's, where the mistake is
    /// there), line, problem.
    pub fn compile(&self, compiler: &Compiler, variant: &Variant, detail: Detail) -> Result<Vec<u32>, String> {
        // Options of its own for each module: shaderc's include callback keeps state between compilations otherwise.
        let mut options = CompileOptions::new().map_err(|e| e.to_string())?;
        options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_1 as u32);
        options.set_warnings_as_errors();
        let optimised = detail != Detail::Everything;
        options.set_optimization_level(if optimised { OptimizationLevel::Performance } else { OptimizationLevel::Zero });
        if detail == Detail::CodeAndNames {
            options.set_generate_debug_info();
        }
        for (name, value) in variant.macros.split(',').filter_map(|d| d.split_once('=')) {
            options.add_macro_definition(name, Some(value));
        }
        options.set_include_callback(|name, _, from, _| {
            let path = resolve(name, &self.include_folders);
            let content = fs::read_to_string(&path).map_err(|e| format!("{from} includes {}: {e}", path.display()))?;
            Ok(ResolvedInclude { resolved_name: path.to_string_lossy().into_owned(), content })
        });
        match compiler.compile_into_spirv(&self.source, self.kind, &self.file.to_string_lossy(), "main", Some(&options)) {
            Ok(artifact) => Ok(artifact.as_binary().to_vec()),
            Err(shaderc::Error::CompilationError(_, text)) => Err(text.trim_end().to_owned()),
            Err(other) => Err(format!("{}: {other}", self.file.display())),
        }
    }
}

/// The file that an include means. Where none is, the one that the first folder would have.
pub fn resolve(name: &str, folders: &[PathBuf]) -> PathBuf {
    let found = folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file());
    found.unwrap_or_else(|| folders.first().cloned().unwrap_or_default().join(name))
}

/// The shaders of a folder, sorted so that nothing depends on the file system.
pub fn shaders(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).filter(|path| kind(path).is_some()).collect();
    found.sort();
    Ok(found)
}

fn kind(path: &Path) -> Option<ShaderKind> {
    match path.extension()?.to_str()? {
        "comp" => Some(ShaderKind::Compute),
        "vert" => Some(ShaderKind::Vertex),
        "frag" => Some(ShaderKind::Fragment),
        _ => None,
    }
}

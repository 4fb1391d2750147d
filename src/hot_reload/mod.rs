//! Shaders that change while the program runs, for those who work on them (feature `hot-reload`).
//!
//! Compile a file of `glsl/` as the build does: for Vulkan 1.1, each set of macros of its line `// variants:`, includes from
//! `glsl/include`; `crates/glsl` has it, and the demo shows how. Keep the names (shaderc: `set_generate_debug_info`): blocks are
//! compared by those of their members. Then [`Denoiser::replace_shader`](crate::Denoiser::replace_shader), or that of the executor,
//! puts it in place between two frames.
//!
//! What the rest of the program assumes has to stay: a shader with other bindings, blocks or workgroups is refused by
//! [`Error::ShaderInterface`], which names the difference.

use crate::error::Error;
use atrous_shader::interface;

include!(concat!(env!("OUT_DIR"), "/interfaces.rs"));

/// Whether a module may take the place of the denoiser's shader of that name: its file without `.comp` and the macros of its
/// variant, as in `modulate_signals_1`.
///
/// # Errors
/// [`Error::ShaderInterface`] names the first difference, or says that there is no such shader.
pub fn check(name: &str, spirv: &[u32]) -> Result<(), Error> {
    match INTERFACES.iter().find(|shader| shader.0 == name) {
        Some((_, built)) => check_interface(name, spirv, built),
        None => Err(differs(name, "the program has none of this name".into())),
    }
}

/// Checks a shader of the host's own against the interface that its build found: pairs of a place and what is there
/// (`crates/glsl/src/interface.rs` makes them). What the module does not use any more may be missing; what it has must be what it
/// was.
///
/// # Errors
/// [`Error::ShaderInterface`] names the first difference.
pub fn check_interface(name: &str, spirv: &[u32], built: &[(&str, &str)]) -> Result<(), Error> {
    for (place, given) in interface(spirv).map_err(|problem| differs(name, problem))? {
        match built.iter().find(|b| b.0 == place) {
            Some((_, built)) if *built == given => {}
            Some((_, built)) => return Err(differs(name, format!("{place} is `{given}`, and was `{built}`"))),
            None => return Err(differs(name, format!("{place} is new: `{given}`"))),
        }
    }
    Ok(())
}

fn differs(shader: &str, difference: String) -> Error {
    Error::ShaderInterface { shader: shader.to_owned(), difference }
}

//! Internal to `atrous`, with no promise of stability: the way from GLSL to SPIR-V that the build scripts of the crate and of its
//! demo share with what compiles while a program runs, so that both make the same modules.

#![forbid(unsafe_code)]

mod compile;
mod table;

pub use atrous_shader::{interface, Interface};
pub use compile::{resolve, shaders, Detail, Glsl, Variant};
pub use shaderc::Compiler;
pub use table::write_table;

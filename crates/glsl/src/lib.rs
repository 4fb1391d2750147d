//! Internal to `atrous`, with no promise of stability: the way from GLSL to SPIR-V that the build scripts of the crate and of its demo share
//! with what compiles while a program runs, so that both make the same modules.

#![forbid(unsafe_code)]

#[cfg(feature = "compile")]
mod compile;
#[cfg(feature = "reflect")]
mod interface;

#[cfg(feature = "compile")]
pub use compile::{resolve, shaders, Glsl, Kept, Variant};
#[cfg(feature = "reflect")]
pub use interface::{interface, Interface};
#[cfg(feature = "compile")]
pub use shaderc::Compiler;

//! Internal to `atrous`, with no promise of stability: a compiled compute shader with what its SPIR-V says of it, for the build,
//! which makes tables of it, and for the program, which reads them and reflects the shaders of a host in the same way.

#![forbid(unsafe_code)]

#[cfg(feature = "reflect")]
mod interface;
mod module;
#[cfg(feature = "reflect")]
mod reflection;

#[cfg(feature = "reflect")]
pub use interface::{entry_point, interface, Interface};
pub use module::*;
#[cfg(feature = "reflect")]
pub use reflection::reflect;

//! Files as the tools of `atrous` read and write them: only regular files are read, and of one no more than a limit; what is
//! written stands under its name whole, or not at all.

#![forbid(unsafe_code)]

mod publish;
mod regular;

pub use publish::{check_writable, publish, remove_abandoned, Existing};
pub use regular::{check_regular, open_regular, read_regular, read_text};

#[cfg(test)]
mod tests;

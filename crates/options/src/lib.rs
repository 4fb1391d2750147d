//! Options of command lines, made from the tables of `atrous`, so that a field or a tunable has one name in every program.

#![forbid(unsafe_code)]

mod config_args;
mod size;
mod tunable;

pub use config_args::ConfigArgs;
pub use size::size;
pub use tunable::tunable;

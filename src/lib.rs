#![doc = include_str!("../README.md")]
#![forbid(clippy::unwrap_used)]

pub mod config;
pub mod contract;
mod error;
mod frame_constants;
pub mod reference;
mod shaders;

pub use config::Config;
pub use contract::*;
pub use error::Error;
pub use frame_constants::{Flags, FrameConstants};

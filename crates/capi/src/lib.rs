//! The C ABI: plain data in, plain data out, opaque handles, no callback into your code but for messages.
//!
//! `include/atrous.h` is made from this package by cbindgen, and a test compares the two. Every
//! function returns an [`AtrousStatus`]; [`atrous_last_error`] has the message. A panic never
//! crosses the boundary. You get an error for a handle that was destroyed or never existed.
//!
//! Build it with `cargo rustc -p atrous-capi --release --no-default-features --crate-type staticlib` (or `cdylib`).

// A host's input is answered by an error. Tests may panic.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod config;
mod conventions;
mod convert;
mod device;
mod executor;
mod functions;
mod graph;
mod handle;
mod log;
mod pipelines;
mod pointers;
mod record;
mod status;
mod structs;
mod tracker;
mod version;

pub use config::AtrousConfig;
pub use conventions::*;
pub use device::*;
pub use executor::*;
pub use functions::*;
pub use graph::*;
pub use handle::{AtrousDenoiser, AtrousExecutor, AtrousGraph, AtrousPipelines, AtrousTracker};
pub use log::*;
pub use pipelines::*;
pub use record::*;
pub use status::*;
pub use structs::*;
pub use tracker::*;
pub use version::*;

/// `vkGetInstanceProcAddr`, which may be null.
pub type GetInstanceProcAddr = Option<ash::vk::PFN_vkGetInstanceProcAddr>;

#[cfg(test)]
mod tests;

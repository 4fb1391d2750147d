#![doc = include_str!("../README.md")]
#![warn(unreachable_pub)]
// A host's input is answered by an error. Tests may panic.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

#[cfg(feature = "capture")]
pub mod capture;
#[forbid(unsafe_code)]
mod choice;
#[forbid(unsafe_code)]
pub mod config;
#[forbid(unsafe_code)]
pub mod contract;
mod error;
#[cfg(feature = "executor")]
pub mod executor;
mod frame_constants;
#[forbid(unsafe_code)]
pub mod graph;
#[cfg(feature = "hot-reload")]
pub mod hot_reload;
#[forbid(unsafe_code)]
pub mod nodes;
#[forbid(unsafe_code)]
mod parallel;
#[forbid(unsafe_code)]
pub mod presets;
mod record;
#[forbid(unsafe_code)]
pub mod reference;
mod shaders;

/// The examples of the pages for hosts.
#[cfg(doctest)]
mod pages {
    #[doc = include_str!("../docs/contract.md")]
    struct Contract;
    #[doc = include_str!("../docs/inputs.md")]
    struct Inputs;
    #[doc = include_str!("../docs/graphs.md")]
    struct Graphs;
    #[cfg(feature = "executor")]
    #[doc = include_str!("../docs/hosts/one_call.md")]
    struct OneCall;
}

/// The Vulkan bindings of the public interface, if you have a different version of them or none.
pub use ash;
pub use choice::Choice;
pub use config::{Config, Preset};
pub use contract::*;
pub use error::Error;
pub use frame_constants::{Flags, FrameConstants};
pub use record::{Checks, Denoiser, Device, ImageDescription, LoadedDevice, Requirements, SharedPipelines};

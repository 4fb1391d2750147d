#![doc = include_str!("../README.md")]
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
mod kernel;
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

/// The examples in docs/integrate.md.
#[cfg(doctest)]
#[doc = include_str!("../docs/integrate.md")]
struct Integrate;

/// The examples in docs/add_a_stage.md.
#[cfg(all(doctest, feature = "host-stages"))]
#[doc = include_str!("../docs/add_a_stage.md")]
struct AddAStage;

/// The Vulkan bindings of the public interface, for hosts that have another version or none.
pub use ash;
pub use choice::Choice;
pub use config::Config;
pub use contract::*;
pub use error::Error;
pub use frame_constants::{Flags, FrameConstants};
pub use record::{Denoiser, Device, LoadedDevice, Requirements};

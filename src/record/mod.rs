//! Writes the passes of a declaration into command buffers: devices, pipelines, descriptors, and the checks of a frame.
//!
//! Recording allocates nothing, places no barrier and submits nothing. Everything that may fail was checked before.

mod binding;
mod checks;
mod denoiser;
mod device;
mod frame_life;
mod names;
mod pipeline;
mod pipelines;
mod requirements;
mod shared_pipelines;

pub use checks::{Checks, ImageDescription};
pub use denoiser::Denoiser;
pub use device::{Device, LoadedDevice};
#[cfg(feature = "executor")]
pub(crate) use frame_life::check_slot;
#[cfg(feature = "executor")]
pub(crate) use names::Names;
pub use requirements::Requirements;
pub use shared_pipelines::SharedPipelines;

//! The denoisers of [`atrous`] on wgpu's Vulkan backend.
//!
//! Textures go in and come out, and its command buffers stand between yours, in one submission or
//! several. Your own passes before and after need no special care: each phase starts with the
//! transitions of its textures, which wgpu tracks, and leaves them as wgpu expects them.
//!
//! ```no_run
//! # fn host() -> (wgpu::Device, wgpu::Queue, wgpu::Texture) { unimplemented!() }
//! use atrous::{Config, FrameParams, Phase, Tuning};
//! use atrous_wgpu::WgpuDenoiser;
//!
//! let (device, queue, noisy) = host();
//! let config = Config::new([1280, 720]);
//! let mut denoiser = WgpuDenoiser::new(&device, config.declare()?)?;
//! denoiser.set_input("noisy_radiance", &noisy)?; // and depth, normal, surface_id
//! let frame = denoiser.begin_frame(&FrameParams::new([1280, 720]), &Tuning::for_preset(config.preset))?;
//! for phase in Phase::ALL {
//!     // SAFETY: both are submitted right here, once.
//!     queue.submit(unsafe { denoiser.encode(&frame, phase)? });
//! }
//! let denoised = denoiser.output("denoised_radiance"); // to be sampled by a pass of the host
//! # Ok::<(), atrous_wgpu::Error>(())
//! ```

#[cfg(feature = "capture")]
mod capture;
mod denoiser;
mod error;
mod format;
mod texture;

pub use denoiser::WgpuDenoiser;
pub use error::Error;

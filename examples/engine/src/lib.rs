//! A miniature engine for the denoiser `atrous`: its own Vulkan instance, device and allocator, animated scenes, and a
//! path tracer in compute shaders over a BVH. It stands for the engine that the denoiser is plugged into.
//!
//! [`Gpu`] owns the device, [`Scene`] the world, [`PathTracer`] one picture of it: each frame a visibility pass writes
//! the G-buffer and a seed for each pixel, then a lighting pass traces one path from each. [`PathTracer::render_reference`]
//! gives the ground truth. [`FrameDenoiser`] is all that it takes to plug the denoiser in: the engine's images are bound once, and the phases are
//! recorded around the lighting pass. Everything is deterministic: random numbers come from pixel, frame index and seed alone.

pub mod denoiser;
pub mod error;
pub mod gpu;
#[cfg(feature = "hot-reload")]
pub mod hot_reload;
pub mod scene;
#[doc(hidden)]
pub mod testing;
pub mod tracer;

pub use denoiser::{DenoiserOptions, FrameDenoiser, Reflections, FILTERS};
pub use error::{Doing, Error, Result};
pub use gpu::{Gpu, GpuOptions, Image};
pub use scene::{Scene, SceneOptions};
pub use tracer::{
    Ambient, Camera, GlassShown, LampApart, LightSampling, Noise, Outputs, PathTracer, Reference, Reshading, SampleEye,
    TracerOptions, Volume,
};

/// A hash of everything that references depend on: what their shaders were compiled to, and the code that runs them.
pub const REFERENCES: &str = env!("ATROUS_ENGINE_REFERENCES");

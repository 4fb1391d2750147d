//! The engine: pictures without a denoiser, and what a denoiser is given.

mod conventions;
mod energy;
mod frames;
mod glass;
mod gltf;
mod gltf_hostile;
#[cfg(feature = "hot-reload")]
mod hot_reload;
mod motion;

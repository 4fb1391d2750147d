//! Denoiser passes.

pub mod quality;

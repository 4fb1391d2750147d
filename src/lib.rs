//! Denoiser passes.

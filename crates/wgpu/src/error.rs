//! Errors: those of `atrous`, and those of wgpu alone.

/// Every error. A message names the given value, the allowed ones and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An error of the denoiser.
    #[error(transparent)]
    Denoiser(#[from] atrous::Error),
    /// A device of a different backend.
    #[error("the device runs on another backend than Vulkan; make the instance with `Backends::VULKAN`")]
    NotVulkan,
    /// A texture that cannot be used as it is.
    #[error("texture for `{name}`: {problem}")]
    Texture {
        /// Name of the resource.
        name: String,
        /// The given value, the allowed ones, and the remedy.
        problem: String,
    },
    /// Command buffers that block a slot.
    #[error("frame slot {slot} is taken by command buffers that were neither submitted nor dropped; submit each frame before the slot comes round")]
    NotSubmitted {
        /// The slot.
        slot: u32,
    },
    /// The device was lost while it was waited for.
    #[error("waiting for the device failed: {0}")]
    Poll(#[from] wgpu::PollError),
    /// The device is out of memory or lost.
    #[error("creating a texture failed: {0}")]
    Device(#[from] wgpu::hal::DeviceError),
}

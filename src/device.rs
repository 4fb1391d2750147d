//! The device of a host.

use ash::vk;

/// The host's device. Handles stay the host's: they are used, never destroyed.
#[derive(Clone, Copy)]
pub struct Device<'a> {
    /// Instance.
    pub instance: &'a ash::Instance,
    /// Physical device.
    pub physical_device: vk::PhysicalDevice,
    /// Device.
    pub device: &'a ash::Device,
    /// Cache of the host that pipelines are looked up in and added to; null: none. It is used while a denoiser is created, and not
    /// afterwards.
    ///
    /// Pipelines are created on several threads at once. Vulkan synchronises a cache itself, unless it was made with
    /// `VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT`: do not give such a one.
    pub pipeline_cache: vk::PipelineCache,
}

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
}

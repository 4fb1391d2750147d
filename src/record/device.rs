//! Your device.

use super::SharedPipelines;
use crate::error::Error;
use ash::vk;
use ash::vk::Handle;
use std::ffi::c_void;

/// Your device. Handles stay yours: they are used, never destroyed.
#[derive(Clone, Copy)]
pub struct Device<'a> {
    /// Instance.
    pub instance: &'a ash::Instance,
    /// Physical device.
    pub physical_device: vk::PhysicalDevice,
    /// Device.
    pub device: &'a ash::Device,
    /// Your pipeline cache; null: none. It is used while a denoiser is created, and not afterwards.
    ///
    /// Pipelines are created on several threads at once. Vulkan synchronises a cache itself, unless it was made with
    /// `VK_PIPELINE_CACHE_CREATE_EXTERNALLY_SYNCHRONIZED_BIT`: do not give such a one.
    pub pipeline_cache: vk::PipelineCache,
    /// Pipelines that denoisers of this device share; `None`: each has its own. Drop them before the device.
    pub pipelines: Option<&'a SharedPipelines>,
}

impl Device<'_> {
    /// Loads the functions of a device that was made elsewhere, if you have a different version of
    /// `ash`, or none. Handles come as the numbers that they are (`vk::Handle::as_raw`),
    /// `get_instance_proc_addr` as a pointer to the function of the loader that made the instance.
    ///
    /// ```no_run
    /// # use ash::vk::Handle;
    /// # fn host() -> (ash::Entry, ash::Instance, ash::vk::PhysicalDevice, ash::Device) { unimplemented!() }
    /// let (entry, instance, physical_device, device) = host(); // of any version of ash
    /// let function = entry.static_fn().get_instance_proc_addr as *const std::ffi::c_void;
    /// let handles = [instance.handle().as_raw(), physical_device.as_raw(), device.handle().as_raw()];
    /// // SAFETY: the handles are live, belong together, and outlive the denoiser.
    /// let denoiser = unsafe {
    ///     let loaded = atrous::Device::from_raw(function, handles[0], handles[1], handles[2])?;
    ///     atrous::Denoiser::new(loaded.device(), atrous::Config::new([1920, 1080]).declare()?)?
    /// };
    /// # Ok::<(), atrous::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NullHandle`] names the one that is null.
    ///
    /// # Safety
    /// `get_instance_proc_addr` is `vkGetInstanceProcAddr`; the handles are live, belong together,
    /// and outlive every object made from them.
    pub unsafe fn from_raw(
        get_instance_proc_addr: *const c_void,
        instance: u64,
        physical_device: u64,
        device: u64,
    ) -> Result<LoadedDevice, Error> {
        let handles = [
            ("get_instance_proc_addr", get_instance_proc_addr.is_null()),
            ("instance", instance == 0),
            ("physical_device", physical_device == 0),
            ("device", device == 0),
        ];
        if let Some((name, _)) = handles.into_iter().find(|(_, is_null)| *is_null) {
            return Err(Error::NullHandle(name));
        }
        // SAFETY: the pointer is not null, and by the caller's promise that of a function with this signature.
        let get_instance_proc_addr =
            unsafe { std::mem::transmute::<*const c_void, vk::PFN_vkGetInstanceProcAddr>(get_instance_proc_addr) };
        // SAFETY: instance and device are live, and of the loader that the function belongs to.
        let (instance, device) = unsafe {
            let instance = ash::Instance::load(&ash::StaticFn { get_instance_proc_addr }, vk::Instance::from_raw(instance));
            let device = ash::Device::load(instance.fp_v1_0(), vk::Device::from_raw(device));
            (instance, device)
        };
        Ok(LoadedDevice { instance, physical_device: vk::PhysicalDevice::from_raw(physical_device), device })
    }
}

/// A device with functions that [`Device::from_raw`] loaded. Dropping it destroys nothing.
#[derive(Clone)]
pub struct LoadedDevice {
    instance: ash::Instance,
    physical_device: vk::PhysicalDevice,
    device: ash::Device,
}

impl LoadedDevice {
    /// The device, without a pipeline cache and shared pipelines.
    pub fn device(&self) -> Device<'_> {
        let Self { instance, device, .. } = self;
        Device {
            instance,
            physical_device: self.physical_device,
            device,
            pipeline_cache: vk::PipelineCache::null(),
            pipelines: None,
        }
    }
}

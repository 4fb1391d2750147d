//! The Vulkan device and what lives on it. Every object is destroyed by its owner; all of them keep the device alive.

mod buffer;
mod choice;
mod image;
mod instance;
mod memory;
mod pipeline;
mod submit;
mod upload;

pub use buffer::{Buffer, MemoryKind};
pub use choice::DeviceInfo;
pub use image::Image;
pub use image::WHOLE_IMAGE;
pub use instance::MessageLog;
pub use pipeline::{storage_images, Bound, DescriptorSet, Pipeline, SetLayout, Shader};
pub use upload::Upload;

use std::ffi::CStr;
use std::mem::ManuallyDrop;
use std::sync::{Arc, Mutex, MutexGuard};

use ash::vk;
use gpu_allocator::vulkan::{Allocator, AllocatorCreateDesc};

use crate::error::{Doing, Error, Result};
use instance::Instance;

/// What device to open, and how.
#[derive(Clone, Debug, Default)]
pub struct GpuOptions {
    /// Index or a part of the name; none: discrete before integrated before software.
    pub device: Option<String>,
    /// Khronos validation with synchronisation validation; messages are counted, see [`Gpu::validation_messages`].
    pub validation: bool,
    /// Instance extensions beyond the engine's own, for a window system.
    pub instance_extensions: Vec<&'static CStr>,
    /// Device extensions beyond the engine's own; a device without them is not chosen.
    pub device_extensions: Vec<&'static CStr>,
}

/// The device, one queue with compute, and the allocator. Clones share the same device.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) shared: Arc<Shared>,
}

pub(crate) struct Shared {
    pub(crate) device: ash::Device,
    pub(crate) allocator: ManuallyDrop<Mutex<Allocator>>,
    pub(crate) command_pool: Mutex<vk::CommandPool>,
    /// Of every pipeline, so that what is made again, for another scene, is found in it.
    pub(crate) pipeline_cache: vk::PipelineCache,
    /// Of every denoiser: another preset makes those alone that no preset before it had.
    pipelines: atrous::SharedPipelines,
    /// Submitting and presenting need it to themselves.
    queue: Mutex<vk::Queue>,
    queue_family: u32,
    chosen: choice::Chosen,
    // Last: the instance outlives the device.
    instance: Instance,
}

impl Gpu {
    /// Opens a device.
    ///
    /// # Errors
    /// No loader, no device, no such device, or no validation layer: the message says what to install.
    pub fn new(options: &GpuOptions) -> Result<Self> {
        let instance = Instance::new(options.validation, &options.instance_extensions)?;
        let chosen = choice::choose(&instance.raw, options)?;
        let queue_family = chosen.queue_family;
        let device = choice::create_device(&instance.raw, &chosen, &options.device_extensions)?;
        // SAFETY: the device was created with one queue of this family.
        let queue = unsafe { device.get_device_queue(queue_family, 0) };
        let pool_info = vk::CommandPoolCreateInfo::default().queue_family_index(queue_family);
        // SAFETY: the device is alive, the family is one of its own.
        let pool = unsafe { device.create_command_pool(&pool_info, None) }.doing("create a command pool")?;
        // SAFETY: the device is alive.
        let pipeline_cache = unsafe { device.create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) };
        let pipeline_cache = pipeline_cache.doing("create a pipeline cache")?;
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: device.clone(),
            physical_device: chosen.physical_device,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: Default::default(),
        })
        .map_err(|source| Error::Memory { what: "the allocator".into(), bytes: 0, source })?;
        let shared = Shared {
            device,
            allocator: ManuallyDrop::new(Mutex::new(allocator)),
            command_pool: Mutex::new(pool),
            pipeline_cache,
            pipelines: atrous::SharedPipelines::default(),
            queue: Mutex::new(queue),
            queue_family,
            chosen,
            instance,
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// The devices of this machine, in the order of their indices.
    ///
    /// # Errors
    /// No loader.
    pub fn list_devices() -> Result<Vec<DeviceInfo>> {
        choice::list(&Instance::new(false, &[])?.raw)
    }

    /// Whether an extension of instances is there.
    ///
    /// # Errors
    /// No loader.
    pub fn has_instance_extension(name: &CStr) -> Result<bool> {
        Instance::has_extension(name)
    }

    /// The loader's entry points.
    pub fn entry(&self) -> &ash::Entry {
        &self.shared.instance.entry
    }

    /// The instance.
    pub fn instance(&self) -> &ash::Instance {
        &self.shared.instance.raw
    }

    /// The cache of every pipeline.
    pub fn pipeline_cache(&self) -> vk::PipelineCache {
        self.shared.pipeline_cache
    }

    /// The device's functions.
    pub fn device(&self) -> &ash::Device {
        &self.shared.device
    }

    /// The physical device.
    pub fn physical_device(&self) -> vk::PhysicalDevice {
        self.shared.chosen.physical_device
    }

    /// The handles that a denoiser is made with.
    pub fn host(&self) -> atrous::Device<'_> {
        atrous::Device {
            instance: self.instance(),
            physical_device: self.physical_device(),
            device: self.device(),
            pipeline_cache: self.shared.pipeline_cache,
            pipelines: Some(&self.shared.pipelines),
        }
    }

    /// The queue, locked for as long as the guard lives: it has compute (graphics, too, where the device has such a family).
    pub fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.shared.queue.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// The family of [`Gpu::queue`].
    pub fn queue_family(&self) -> u32 {
        self.shared.queue_family
    }

    /// Name and kind of the device.
    pub fn info(&self) -> &DeviceInfo {
        &self.shared.chosen.info
    }

    /// The device's limits.
    pub fn limits(&self) -> &vk::PhysicalDeviceLimits {
        &self.shared.chosen.limits
    }

    /// Whether `synchronization2` was there and is enabled.
    pub fn has_synchronization2(&self) -> bool {
        self.shared.chosen.synchronization2
    }

    /// Nanoseconds for one step of a timestamp; none where the queue has no timestamps.
    pub fn timestamp_period(&self) -> Option<f32> {
        self.shared.chosen.timestamps.then_some(self.limits().timestamp_period)
    }

    /// Warnings and errors of the validation layers so far.
    pub fn validation_messages(&self) -> Vec<String> {
        self.message_log().messages()
    }

    /// The same, to be asked again when the device and the instance are gone: what was not freed is known then.
    pub fn message_log(&self) -> MessageLog {
        self.shared.instance.log.clone()
    }
}

impl Shared {
    /// Locked for as long as the guard lives.
    fn allocator(&self) -> MutexGuard<'_, Allocator> {
        // A panic elsewhere while allocating leaves the allocator usable: its state changes last.
        self.allocator.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        let pool = *self.command_pool.get_mut().unwrap_or_else(|poisoned| poisoned.into_inner());
        // SAFETY: this is the last owner, so nothing is recorded any more and no object made from the device is left;
        // the allocator is dropped once, before its device.
        unsafe {
            let _ = self.device.device_wait_idle();
            self.device.destroy_command_pool(pool, None);
            drop(std::mem::take(&mut self.pipelines));
            self.device.destroy_pipeline_cache(self.pipeline_cache, None);
            ManuallyDrop::drop(&mut self.allocator);
            self.device.destroy_device(None);
        }
    }
}

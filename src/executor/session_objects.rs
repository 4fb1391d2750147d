//! The Vulkan objects that a session owns.

use super::transfer::UPLOADED;
use super::HostImage;
use crate::contract::{ResourceState, Subresource, WHOLE};
use crate::error::Error;
use ash::vk;

/// One command buffer, waited for after every submission.
pub(crate) struct Commands {
    device: ash::Device,
    pool: vk::CommandPool,
    pub cmd: vk::CommandBuffer,
    pub fence: vk::Fence,
}

/// An input image with memory of its own.
pub(crate) struct OwnedImage {
    device: ash::Device,
    pub image: vk::Image,
    pub view: vk::ImageView,
    memory: vk::DeviceMemory,
    pub format: vk::Format,
    pub extent: [u32; 2],
}

impl Commands {
    /// # Safety
    /// The device is live and outlives the result.
    pub(crate) unsafe fn new(device: &ash::Device, family: u32) -> Result<Self, Error> {
        let mut this = Self {
            device: device.clone(),
            pool: vk::CommandPool::null(),
            cmd: vk::CommandBuffer::null(),
            fence: vk::Fence::null(),
        };
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(family)
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER | vk::CommandPoolCreateFlags::TRANSIENT);
        // SAFETY: the device is live; what was created before a failure is destroyed when `this` is dropped.
        unsafe {
            this.pool = device.create_command_pool(&info, None).map_err(Error::vulkan("vkCreateCommandPool"))?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(this.pool).command_buffer_count(1);
            let commands = device.allocate_command_buffers(&info).map_err(Error::vulkan("vkAllocateCommandBuffers"))?;
            this.cmd = commands.first().copied().unwrap_or_default();
            this.fence = device.create_fence(&vk::FenceCreateInfo::default(), None).map_err(Error::vulkan("vkCreateFence"))?;
        }
        Ok(this)
    }
}

impl Drop for Commands {
    fn drop(&mut self) {
        // SAFETY: ours and idle.
        unsafe {
            self.device.destroy_fence(self.fence, None);
            self.device.destroy_command_pool(self.pool, None);
        }
    }
}

impl OwnedImage {
    /// # Safety
    /// The device is live and outlives the result.
    pub(crate) unsafe fn new(host: crate::Device<'_>, format: vk::Format, extent: [u32; 2]) -> Result<Self, Error> {
        let device = host.device;
        let mut this = Self {
            device: device.clone(),
            image: vk::Image::null(),
            view: vk::ImageView::null(),
            memory: vk::DeviceMemory::null(),
            format,
            extent,
        };
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: extent[0], height: extent[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: the device is live; what was created before a failure is destroyed when `this` is dropped.
        unsafe {
            this.image = device.create_image(&info, None).map_err(Error::vulkan("vkCreateImage"))?;
            let requirements = device.get_image_memory_requirements(this.image);
            let types = host.instance.get_physical_device_memory_properties(host.physical_device);
            let allowed = |i: &u32| requirements.memory_type_bits >> i & 1 == 1;
            let local = |i: &u32| types.memory_types[*i as usize].property_flags.contains(vk::MemoryPropertyFlags::DEVICE_LOCAL);
            let indices = 0..types.memory_type_count;
            let index = indices.clone().filter(allowed).find(local).or_else(|| indices.clone().find(allowed));
            let info =
                vk::MemoryAllocateInfo::default().allocation_size(requirements.size).memory_type_index(index.unwrap_or_default());
            this.memory = device
                .allocate_memory(&info, None)
                .map_err(|_| Error::OutOfMemory { what: "an input image".into(), bytes: requirements.size })?;
            device.bind_image_memory(this.image, this.memory, 0).map_err(Error::vulkan("vkBindImageMemory"))?;
            let range = WHOLE;
            let info = vk::ImageViewCreateInfo::default()
                .image(this.image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(this.format)
                .subresource_range(range);
            this.view = device.create_image_view(&info, None).map_err(Error::vulkan("vkCreateImageView"))?;
        }
        Ok(this)
    }
}

impl OwnedImage {
    /// The image as an input, in the state in which uploads leave it.
    pub(crate) fn uploaded(&self) -> HostImage {
        let &Self { image, view, format, extent, .. } = self;
        let ResourceState { stage, access, layout, .. } = UPLOADED;
        HostImage { image, view, subresource: Subresource::FIRST, format, extent, layout, stage, access }
    }
}

impl Drop for OwnedImage {
    fn drop(&mut self) {
        // SAFETY: ours and idle.
        unsafe {
            self.device.destroy_image_view(self.view, None);
            self.device.destroy_image(self.image, None);
            self.device.free_memory(self.memory, None);
        }
    }
}

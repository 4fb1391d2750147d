//! Getting texels in and out through a staging buffer.

use super::storage::StoredImage;
use crate::contract::texel::Texel;
use crate::contract::{Access, ResourceState};
use crate::error::Error;
use ash::vk;

/// A host-visible buffer, mapped for its whole life.
pub(crate) struct Staging {
    device: ash::Device,
    pub buffer: vk::Buffer,
    memory: vk::DeviceMemory,
    pointer: *mut u8,
    pub size: u64,
}

impl Staging {
    /// # Safety
    /// The handles are live, belong together and outlive the result.
    pub(crate) unsafe fn new(host: crate::Device<'_>, size: u64) -> Result<Self, Error> {
        // SAFETY: instance, physical device and device are live, belong together and outlive the result.
        unsafe {
            let types = host.instance.get_physical_device_memory_properties(host.physical_device);
            Self::of_types(host.device, &types, size)
        }
    }

    /// # Safety
    /// The device is live and outlives the result; the memory types are its own.
    pub(crate) unsafe fn of_types(
        device: &ash::Device,
        types: &vk::PhysicalDeviceMemoryProperties,
        size: u64,
    ) -> Result<Self, Error> {
        let mut this = Self {
            device: device.clone(),
            buffer: vk::Buffer::null(),
            memory: vk::DeviceMemory::null(),
            pointer: std::ptr::null_mut(),
            size,
        };
        let usage = vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST | vk::BufferUsageFlags::STORAGE_BUFFER;
        // SAFETY: the device is live and outlives the result. What was created before a failure is destroyed when `this` is
        // dropped.
        unsafe {
            let info = vk::BufferCreateInfo::default().size(size).usage(usage);
            this.buffer = device.create_buffer(&info, None).map_err(Error::vulkan("vkCreateBuffer"))?;
            let requirements = device.get_buffer_memory_requirements(this.buffer);
            let find = |wanted| {
                (0..types.memory_type_count).find(|&i| {
                    requirements.memory_type_bits >> i & 1 == 1 && types.memory_types[i as usize].property_flags.contains(wanted)
                })
            };
            let needed = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
            // Reading from memory that the CPU does not cache is slower by an order of magnitude.
            let index = find(needed | vk::MemoryPropertyFlags::HOST_CACHED).or_else(|| find(needed));
            let out_of_memory = || Error::OutOfMemory { what: "a staging buffer".into(), bytes: size };
            let info = vk::MemoryAllocateInfo::default()
                .allocation_size(requirements.size)
                .memory_type_index(index.ok_or_else(out_of_memory)?);
            this.memory = device.allocate_memory(&info, None).map_err(|_| out_of_memory())?;
            device.bind_buffer_memory(this.buffer, this.memory, 0).map_err(Error::vulkan("vkBindBufferMemory"))?;
            let pointer = device.map_memory(this.memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty());
            this.pointer = pointer.map_err(Error::vulkan("vkMapMemory"))?.cast();
        }
        Ok(this)
    }

    /// The mapped bytes. The GPU must not use them meanwhile.
    pub(crate) fn bytes(&mut self) -> &mut [u8] {
        // SAFETY: mapped for `size` bytes until drop, and borrowed with us.
        unsafe { std::slice::from_raw_parts_mut(self.pointer, self.size as usize) }
    }
}

// SAFETY: the memory is ours alone, and the mapped bytes are reached through `&mut self` alone.
unsafe impl Send for Staging {}
// SAFETY: a shared reference reaches the handle and the size alone; the mapped bytes need `&mut self`.
unsafe impl Sync for Staging {}

impl Drop for Staging {
    fn drop(&mut self) {
        // SAFETY: ours, and the owner waits for the GPU first.
        unsafe {
            self.device.destroy_buffer(self.buffer, None);
            self.device.free_memory(self.memory, None);
        }
    }
}

/// A part of an image from a pixel on, tightly packed in a buffer; of a depth-stencil image the depth.
pub(crate) fn region(image: &StoredImage, origin: [u32; 2], [width, height]: [u32; 2]) -> vk::BufferImageCopy {
    let aspect_mask = Texel::of(image.format).map_or(vk::ImageAspectFlags::COLOR, |texel| texel.copied_aspect());
    let layers = image.subresource.layers(aspect_mask);
    let [x, y] = origin.map(|side| side as i32);
    vk::BufferImageCopy::default().image_subresource(layers).image_offset(vk::Offset3D { x, y, z: 0 }).image_extent(vk::Extent3D {
        width,
        height,
        depth: 1,
    })
}

/// The state of an input behind a session's uploads and before the frame's passes.
pub(crate) const UPLOADED: ResourceState = ResourceState::of(Access::Sampled);

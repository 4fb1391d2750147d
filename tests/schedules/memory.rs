//! Images and buffers of the host, with their memory.

use crate::support::gpu;
use crate::support::rig::{plain_image, whole};
use ash::vk;
use atrous::executor::HeadlessDevice;
use std::sync::Arc;

#[derive(Clone, Copy)]
pub enum Stored {
    Image { image: vk::Image, view: vk::ImageView, extent: [u32; 2] },
    Buffer { buffer: vk::Buffer },
}

/// A buffer that is mapped.
#[derive(Clone, Copy)]
pub struct Mapped {
    pub buffer: vk::Buffer,
    pub pointer: *mut u8,
}

/// An image without memory.
#[derive(Clone, Copy)]
pub struct Bare {
    pub image: vk::Image,
    format: vk::Format,
    extent: [u32; 2],
    pub needs: vk::MemoryRequirements,
}

/// Everything that was made, until it is dropped; the device is idle then.
pub struct Memory {
    pub gpu: Arc<HeadlessDevice>,
    pub images: Vec<vk::Image>,
    views: Vec<vk::ImageView>,
    buffers: Vec<vk::Buffer>,
    memory: Vec<vk::DeviceMemory>,
    /// Format of images in whose place the allocator knows no RGBA16_UINT: their views have it.
    pub stands_for_rgba16_uint: Option<vk::Format>,
}

impl Memory {
    pub fn new() -> Self {
        let (images, views, buffers, memory) = Default::default();
        Self { gpu: gpu(), images, views, buffers, memory, stands_for_rgba16_uint: None }
    }

    pub fn image(&mut self, format: vk::Format, extent: [u32; 2], usage: vk::ImageUsageFlags) -> Bare {
        let usage = usage | vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        let stand_in = self.stands_for_rgba16_uint.filter(|_| format == vk::Format::R16G16B16A16_UINT);
        // The usage is that of the views.
        let mutable = vk::ImageCreateFlags::MUTABLE_FORMAT | vk::ImageCreateFlags::EXTENDED_USAGE;
        let flags = stand_in.map_or(vk::ImageCreateFlags::empty(), |_| mutable) | vk::ImageCreateFlags::ALIAS;
        let info = plain_image(stand_in.unwrap_or(format), extent, usage).flags(flags);
        // SAFETY: the device is live.
        let (image, needs) = unsafe {
            let image = self.gpu.device().create_image(&info, None).expect("image");
            (image, self.gpu.device().get_image_memory_requirements(image))
        };
        self.images.push(image);
        Bare { image, format, extent, needs }
    }

    /// Gives an image its memory.
    pub fn bind(&mut self, bare: Bare, memory: vk::DeviceMemory, offset: u64) -> Stored {
        let Bare { image, format, extent, .. } = bare;
        let info = vk::ImageViewCreateInfo::default().image(image).view_type(vk::ImageViewType::TYPE_2D).format(format);
        // SAFETY: image and memory are live and fit.
        let view = unsafe {
            self.gpu.device().bind_image_memory(image, memory, offset).expect("memory");
            self.gpu.device().create_image_view(&info.subresource_range(whole()), None).expect("view")
        };
        self.views.push(view);
        Stored::Image { image, view, extent }
    }

    pub fn mapped(&mut self, size: u64, usage: vk::BufferUsageFlags) -> Mapped {
        let usage = usage | vk::BufferUsageFlags::TRANSFER_SRC | vk::BufferUsageFlags::TRANSFER_DST;
        let gpu = self.gpu.clone();
        // SAFETY: the device is live, and the memory fits the buffer.
        unsafe {
            let info = vk::BufferCreateInfo::default().size(size).usage(usage);
            let buffer = gpu.device().create_buffer(&info, None).expect("buffer");
            let visible = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
            let memory = self.allocate(gpu.device().get_buffer_memory_requirements(buffer), visible);
            gpu.device().bind_buffer_memory(buffer, memory, 0).expect("memory");
            self.buffers.push(buffer);
            let pointer = gpu.device().map_memory(memory, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty()).expect("mapped");
            Mapped { buffer, pointer: pointer.cast() }
        }
    }

    pub fn allocate(&mut self, needs: vk::MemoryRequirements, flags: vk::MemoryPropertyFlags) -> vk::DeviceMemory {
        let host = self.gpu.host();
        // SAFETY: the handles are live and belong together.
        let memory = unsafe {
            let types = host.instance.get_physical_device_memory_properties(host.physical_device);
            let fits =
                |i: &u32| needs.memory_type_bits >> i & 1 == 1 && types.memory_types[*i as usize].property_flags.contains(flags);
            let index = (0..types.memory_type_count).find(fits).expect("a type of memory");
            let info = vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(index);
            host.device.allocate_memory(&info, None).expect("memory")
        };
        self.memory.push(memory);
        memory
    }
}

/// A whole image.
pub fn region([width, height]: [u32; 2]) -> vk::BufferImageCopy {
    let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
    vk::BufferImageCopy::default().image_subresource(layers).image_extent(vk::Extent3D { width, height, depth: 1 })
}

impl Drop for Memory {
    fn drop(&mut self) {
        let _queue = self.gpu.queue();
        let device = self.gpu.device();
        // SAFETY: ours; the device is idle.
        unsafe {
            let _ = device.device_wait_idle();
            self.views.iter().for_each(|&view| device.destroy_image_view(view, None));
            self.images.iter().for_each(|&image| device.destroy_image(image, None));
            self.buffers.iter().for_each(|&buffer| device.destroy_buffer(buffer, None));
            self.memory.iter().for_each(|&memory| device.free_memory(memory, None));
        }
    }
}

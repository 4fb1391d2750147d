//! Images, buffers and their memory: histories with memory of their own, transients aliased by lifetime.

use super::storage::{Object, Storages, StoredImage};
use super::{AllocatedMemory, ExecutorOptions};
use crate::contract::{alias, Declaration, Lifetime, ResourceDecl, ResourceId, Shape, Span, WHOLE};
use crate::error::Error;
use crate::record::Device;
use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc};
use gpu_allocator::MemoryLocation;
use std::ffi::{CStr, CString};

/// Everything that an executor allocates, and the images and buffers that a host bound.
pub(crate) struct Memory {
    device: ash::Device,
    allocator: Allocator,
    objects: Objects,
    pub storages: Storages,
    labels: Vec<CString>,
}

/// Vulkan objects with their memory.
#[derive(Default)]
struct Objects {
    owned: Vec<Owned>,
    allocations: Vec<Allocation>,
    allocated: AllocatedMemory,
}

/// A Vulkan object of the executor.
enum Owned {
    Image(vk::Image),
    View(vk::ImageView),
    Buffer(vk::Buffer),
}

impl Memory {
    /// # Safety
    /// Obligations of `Executor::new`.
    pub(crate) unsafe fn new(host: Device<'_>, declaration: &Declaration, options: &ExecutorOptions) -> Result<Self, Error> {
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: host.instance.clone(),
            device: host.device.clone(),
            physical_device: host.physical_device,
            debug_settings: Default::default(),
            buffer_device_address: false,
            allocation_sizes: Default::default(),
        })
        .map_err(|_| Error::OutOfMemory { what: "the allocator".into(), bytes: 0 })?;
        let mut this = Self {
            device: host.device.clone(),
            allocator,
            objects: Objects::default(),
            storages: Storages::new(declaration),
            labels: declaration.passes().iter().map(|p| CString::new(p.name.as_str()).unwrap_or_default()).collect(),
        };
        // SAFETY: the device is live, and formats, extents and limits were checked against it. There is nothing yet to replace.
        unsafe { this.reallocate(declaration, options)? };
        Ok(this)
    }

    /// Allocates everything anew, for a different extent of the same resources. Old and new exist
    /// for a moment, so that the old stays if this fails.
    ///
    /// # Safety
    /// Formats, extents and limits were checked against the device; GPU work that uses the old
    /// objects is complete.
    pub(crate) unsafe fn reallocate(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        let objects = std::mem::take(&mut self.objects);
        let storages = std::mem::replace(&mut self.storages, Storages::new(declaration));
        // SAFETY: the device is live, and formats, extents and limits were checked against it.
        let result =
            unsafe { self.allocate_own(declaration, options).and_then(|()| self.allocate_transient_images(declaration, options)) };
        let replaced = if result.is_ok() {
            self.storages.take_over(&storages);
            objects
        } else {
            self.storages = storages;
            std::mem::replace(&mut self.objects, objects)
        };
        // SAFETY: either GPU work with them is complete, or they were just made.
        unsafe { self.destroy(replaced) };
        result
    }

    /// Bytes that were allocated.
    pub(crate) fn allocated(&self) -> AllocatedMemory {
        self.objects.allocated
    }

    pub(crate) fn label(&self, pass: usize) -> &CStr {
        &self.labels[pass]
    }

    /// Histories, outputs, and every buffer.
    unsafe fn allocate_own(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        for (index, resource) in declaration.resources().iter().enumerate() {
            for copy in 0..resource.lifetime.copies() {
                if matches!(resource.shape, Shape::Image { .. }) && resource.lifetime == Lifetime::Transient {
                    continue;
                }
                // SAFETY: the device is live, and formats, extents and limits were checked against it.
                let (object, bytes) = unsafe {
                    match resource.shape {
                        Shape::Image { format, .. } => self.own_image(declaration, resource, format.preferred(), options)?,
                        Shape::Buffer { size } => self.own_buffer(resource, size)?,
                    }
                };
                self.storages.set(ResourceId(index as u32), copy, object);
                match resource.lifetime {
                    Lifetime::Output => self.objects.allocated.output += bytes,
                    Lifetime::Transient => self.objects.allocated.transient += bytes,
                    _ => self.objects.allocated.history += bytes,
                }
            }
        }
        Ok(())
    }

    unsafe fn own_image(
        &mut self,
        declaration: &Declaration,
        resource: &ResourceDecl,
        format: vk::Format,
        options: &ExecutorOptions,
    ) -> Result<(Object, u64), Error> {
        // SAFETY: the device is live; the memory fits the image's own requirements.
        unsafe {
            let mut image = self.create_image(declaration, resource, format, options, vk::ImageCreateFlags::empty())?;
            let requirements = self.device.get_image_memory_requirements(image.image);
            let (memory, offset) = self.allocate(&resource.name, requirements, false)?;
            self.device.bind_image_memory(image.image, memory, offset).map_err(Error::vulkan("vkBindImageMemory"))?;
            image.view = self.create_view(&image)?;
            Ok((Object::Image(image), requirements.size))
        }
    }

    unsafe fn own_buffer(&mut self, resource: &ResourceDecl, size: u64) -> Result<(Object, u64), Error> {
        let usage = resource.buffer_usage | vk::BufferUsageFlags::TRANSFER_SRC;
        let info = vk::BufferCreateInfo::default().size(size).usage(usage).sharing_mode(vk::SharingMode::EXCLUSIVE);
        // SAFETY: the device is live; the memory fits the buffer's own requirements.
        unsafe {
            let buffer = self.device.create_buffer(&info, None).map_err(Error::vulkan("vkCreateBuffer"))?;
            self.objects.owned.push(Owned::Buffer(buffer));
            let requirements = self.device.get_buffer_memory_requirements(buffer);
            let (memory, offset) = self.allocate(&resource.name, requirements, true)?;
            self.device.bind_buffer_memory(buffer, memory, offset).map_err(Error::vulkan("vkBindBufferMemory"))?;
            Ok((Object::Buffer { buffer, size }, size))
        }
    }

    /// One block for all transient images, each at the offset that the planner gave it.
    unsafe fn allocate_transient_images(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        let (mut ids, mut spans, mut images) = (Vec::new(), Vec::new(), Vec::new());
        let mut block = vk::MemoryRequirements { size: 0, alignment: 1, memory_type_bits: u32::MAX };
        for (id, first, last) in declaration.transients() {
            let resource = declaration.resource(id);
            let Shape::Image { format, .. } = resource.shape else { continue };
            // SAFETY: the device is live, and the format and extent were checked against it.
            let image =
                unsafe { self.create_image(declaration, resource, format.preferred(), options, vk::ImageCreateFlags::ALIAS)? };
            // SAFETY: the image was just created.
            let requirements = unsafe { self.device.get_image_memory_requirements(image.image) };
            let whole = (0, declaration.passes().len());
            let (first, last) = if options.no_aliasing { whole } else { (first, last) };
            spans.push(Span { first, last, size: requirements.size, alignment: requirements.alignment });
            block.alignment = block.alignment.max(requirements.alignment);
            block.memory_type_bits &= requirements.memory_type_bits;
            ids.push(id);
            images.push(image);
        }
        if ids.is_empty() {
            return Ok(());
        }
        let (offsets, total) = alias(&spans);
        block.size = total;
        self.objects.allocated.transient += total;
        // SAFETY: the block satisfies the requirements of every image at its offset.
        unsafe {
            let (memory, base) = self.allocate("transients", block, false)?;
            for ((id, image), offset) in ids.iter().zip(images).zip(&offsets) {
                self.device.bind_image_memory(image.image, memory, base + offset).map_err(Error::vulkan("vkBindImageMemory"))?;
                let view = self.create_view(&image)?;
                self.storages.set(*id, 0, Object::Image(StoredImage { view, ..image }));
            }
        }
        self.storages.share(&ids, &spans, &offsets);
        Ok(())
    }

    /// An image without memory and without a view.
    unsafe fn create_image(
        &mut self,
        declaration: &Declaration,
        resource: &ResourceDecl,
        format: vk::Format,
        options: &ExecutorOptions,
        flags: vk::ImageCreateFlags,
    ) -> Result<StoredImage, Error> {
        let extent = resource.extent(declaration.allocated_extent()).unwrap_or([1, 1]);
        let poison = if options.poison { vk::ImageUsageFlags::TRANSFER_DST } else { vk::ImageUsageFlags::empty() };
        let info = vk::ImageCreateInfo::default()
            .flags(flags)
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: extent[0], height: extent[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(resource.image_usage | options.extra_image_usage | poison)
            .sharing_mode(vk::SharingMode::EXCLUSIVE)
            .initial_layout(vk::ImageLayout::UNDEFINED);
        // SAFETY: the device is live; formats and extents were checked against it.
        let image = unsafe { self.device.create_image(&info, None) }.map_err(Error::vulkan("vkCreateImage"))?;
        self.objects.owned.push(Owned::Image(image));
        Ok(StoredImage::new(image, vk::ImageView::null(), format, extent))
    }

    unsafe fn create_view(&mut self, image: &StoredImage) -> Result<vk::ImageView, Error> {
        let info = vk::ImageViewCreateInfo::default()
            .image(image.image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(image.format)
            .subresource_range(WHOLE);
        // SAFETY: the image is live and has memory.
        let view = unsafe { self.device.create_image_view(&info, None) }.map_err(Error::vulkan("vkCreateImageView"))?;
        self.objects.owned.push(Owned::View(view));
        Ok(view)
    }

    unsafe fn allocate(
        &mut self,
        name: &str,
        requirements: vk::MemoryRequirements,
        linear: bool,
    ) -> Result<(vk::DeviceMemory, u64), Error> {
        let out_of_memory = || Error::OutOfMemory { what: name.to_owned(), bytes: requirements.size };
        let desc = AllocationCreateDesc {
            name,
            requirements,
            location: MemoryLocation::GpuOnly,
            linear,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        let allocation = self.allocator.allocate(&desc).map_err(|_| out_of_memory())?;
        // SAFETY: the allocation is kept as long as the objects in it.
        let place = (unsafe { allocation.memory() }, allocation.offset());
        self.objects.allocations.push(allocation);
        Ok(place)
    }

    /// # Safety
    /// GPU work that uses the objects is complete.
    unsafe fn destroy(&mut self, objects: Objects) {
        // Views were made after their images.
        for owned in objects.owned.into_iter().rev() {
            // SAFETY: ours, and GPU work with it is complete.
            unsafe {
                match owned {
                    Owned::Image(image) => self.device.destroy_image(image, None),
                    Owned::View(view) => self.device.destroy_image_view(view, None),
                    Owned::Buffer(buffer) => self.device.destroy_buffer(buffer, None),
                }
            }
        }
        for allocation in objects.allocations {
            if let Err(error) = self.allocator.free(allocation) {
                log::error!("atrous: freeing memory failed: {error}");
            }
        }
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        let objects = std::mem::take(&mut self.objects);
        // SAFETY: the executor's owner waits for the GPU before it drops it.
        unsafe { self.destroy(objects) };
    }
}

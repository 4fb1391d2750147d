//! Images, buffers and their memory: histories with memory of their own, transients aliased by lifetime.

use super::barriers::WHOLE;
use super::storage::{Storage, Storages};
use super::{AllocatedMemory, ExecutorOptions};
use crate::contract::{alias, component_of, Component, Declaration, Lifetime, ResourceDecl, ResourceId, Shape, Span};
use crate::denoiser::Device;
use crate::error::Error;
use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc};
use gpu_allocator::MemoryLocation;
use std::ffi::{CStr, CString};

/// Everything that an executor allocates, and what a host bound.
pub(crate) struct Memory {
    device: ash::Device,
    allocator: Option<Allocator>,
    allocations: Vec<Allocation>,
    pub storages: Storages,
    owned: Vec<Storage>,
    labels: Vec<CString>,
    pub allocated: AllocatedMemory,
}

impl Memory {
    /// # Safety
    /// As `Executor::new`.
    pub unsafe fn new(host: Device<'_>, declaration: &Declaration, options: &ExecutorOptions) -> Result<Self, Error> {
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
            allocator: Some(allocator),
            allocations: Vec::new(),
            storages: Storages::new(declaration),
            owned: Vec::new(),
            labels: declaration.passes().iter().map(|p| CString::new(p.name.as_str()).unwrap_or_default()).collect(),
            allocated: AllocatedMemory::default(),
        };
        // SAFETY: the caller's. What was created before a failure is destroyed when `this` is dropped.
        unsafe {
            this.allocate_own(declaration, options)?;
            this.allocate_transient_images(declaration, options)?;
        }
        Ok(this)
    }

    pub fn label(&self, pass: usize) -> &CStr {
        &self.labels[pass]
    }

    /// Histories, outputs, and every buffer.
    unsafe fn allocate_own(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        for (index, resource) in declaration.resources().iter().enumerate() {
            let is_image = matches!(resource.shape, Shape::Image { .. });
            for copy in 0..resource.lifetime.copies() {
                if is_image && resource.lifetime == Lifetime::Transient {
                    continue;
                }
                // SAFETY: the caller's.
                let (storage, bytes) = unsafe {
                    if is_image {
                        self.own_image(declaration, resource, options)?
                    } else {
                        self.own_buffer(resource)?
                    }
                };
                self.storages.set(ResourceId(index as u32), copy, storage);
                match resource.lifetime {
                    Lifetime::Output => self.allocated.output += bytes,
                    Lifetime::Transient => self.allocated.transient += bytes,
                    _ => self.allocated.history += bytes,
                }
            }
        }
        Ok(())
    }

    unsafe fn own_image(&mut self, d: &Declaration, r: &ResourceDecl, options: &ExecutorOptions) -> Result<(Storage, u64), Error> {
        // SAFETY: the caller's; memory fits the image's own requirements.
        unsafe {
            let mut storage = self.create_image(d, r, options, vk::ImageCreateFlags::empty())?;
            let requirements = self.device.get_image_memory_requirements(storage.image);
            let (memory, offset) = self.allocate(&r.name, requirements, false)?;
            self.device.bind_image_memory(storage.image, memory, offset).map_err(Error::vulkan("vkBindImageMemory"))?;
            self.create_view(&mut storage)?;
            Ok((storage, requirements.size))
        }
    }

    unsafe fn own_buffer(&mut self, r: &ResourceDecl) -> Result<(Storage, u64), Error> {
        let Shape::Buffer { size } = r.shape else { return Ok((Storage::EMPTY, 0)) };
        let usage = r.buffer_usage | vk::BufferUsageFlags::TRANSFER_SRC;
        let info = vk::BufferCreateInfo::default().size(size).usage(usage).sharing_mode(vk::SharingMode::EXCLUSIVE);
        // SAFETY: the caller's; memory fits the buffer's own requirements.
        unsafe {
            let buffer = self.device.create_buffer(&info, None).map_err(Error::vulkan("vkCreateBuffer"))?;
            let storage = Storage { buffer, size, ..Storage::EMPTY };
            self.owned.push(storage);
            let requirements = self.device.get_buffer_memory_requirements(buffer);
            let (memory, offset) = self.allocate(&r.name, requirements, true)?;
            self.device.bind_buffer_memory(buffer, memory, offset).map_err(Error::vulkan("vkBindBufferMemory"))?;
            Ok((storage, size))
        }
    }

    /// One block for all transient images, each at the offset that the planner gave it.
    unsafe fn allocate_transient_images(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        let (mut ids, mut spans, mut storages) = (Vec::new(), Vec::new(), Vec::new());
        let mut block = vk::MemoryRequirements { size: 0, alignment: 1, memory_type_bits: u32::MAX };
        for (id, first, last) in declaration.transients() {
            let resource = declaration.resource(id);
            if matches!(resource.shape, Shape::Buffer { .. }) {
                continue;
            }
            // SAFETY: the caller's.
            let storage = unsafe { self.create_image(declaration, resource, options, vk::ImageCreateFlags::ALIAS)? };
            // SAFETY: the image was just created.
            let requirements = unsafe { self.device.get_image_memory_requirements(storage.image) };
            let whole = (0, declaration.passes().len());
            let (first, last) = if options.no_aliasing { whole } else { (first, last) };
            spans.push(Span { first, last, size: requirements.size, alignment: requirements.alignment });
            block.alignment = block.alignment.max(requirements.alignment);
            block.memory_type_bits &= requirements.memory_type_bits;
            ids.push(id);
            storages.push(storage);
        }
        if ids.is_empty() {
            return Ok(());
        }
        let (offsets, total) = alias(&spans);
        block.size = total;
        self.allocated.transient += total;
        // SAFETY: the block satisfies the requirements of every image at its offset.
        unsafe {
            let (memory, base) = self.allocate("transients", block, false)?;
            for ((id, storage), offset) in ids.iter().zip(&mut storages).zip(&offsets) {
                self.device.bind_image_memory(storage.image, memory, base + offset).map_err(Error::vulkan("vkBindImageMemory"))?;
                self.create_view(storage)?;
                self.storages.set(*id, 0, *storage);
            }
        }
        self.storages.share(&ids, &spans, &offsets);
        Ok(())
    }

    unsafe fn create_image(
        &mut self,
        declaration: &Declaration,
        resource: &ResourceDecl,
        options: &ExecutorOptions,
        flags: vk::ImageCreateFlags,
    ) -> Result<Storage, Error> {
        let (Shape::Image { format, .. }, Some(extent)) = (resource.shape, resource.extent(declaration.allocated_extent())) else {
            return Ok(Storage::EMPTY);
        };
        let poison = if options.poison { vk::ImageUsageFlags::TRANSFER_DST } else { vk::ImageUsageFlags::empty() };
        let info = vk::ImageCreateInfo::default()
            .flags(flags)
            .image_type(vk::ImageType::TYPE_2D)
            .format(format.preferred())
            .extent(vk::Extent3D { width: extent[0], height: extent[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(resource.image_usage | options.extra_image_usage | poison)
            .sharing_mode(vk::SharingMode::EXCLUSIVE)
            .initial_layout(vk::ImageLayout::UNDEFINED);
        // SAFETY: the caller's; formats and extents were checked against the device.
        let image = unsafe { self.device.create_image(&info, None) }.map_err(Error::vulkan("vkCreateImage"))?;
        let is_uint = component_of(format.preferred()) == Some(Component::Uint);
        let storage = Storage { image, format: format.preferred(), extent, is_uint, ..Storage::EMPTY };
        self.owned.push(storage);
        Ok(storage)
    }

    unsafe fn create_view(&mut self, storage: &mut Storage) -> Result<(), Error> {
        let info = vk::ImageViewCreateInfo::default()
            .image(storage.image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(storage.format)
            .subresource_range(WHOLE);
        // SAFETY: the image is live and has memory.
        storage.view = unsafe { self.device.create_image_view(&info, None) }.map_err(Error::vulkan("vkCreateImageView"))?;
        if let Some(owned) = self.owned.iter_mut().find(|o| o.image == storage.image) {
            owned.view = storage.view;
        }
        Ok(())
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
        let allocator = self.allocator.as_mut().ok_or_else(out_of_memory)?;
        let allocation = allocator.allocate(&desc).map_err(|_| out_of_memory())?;
        // SAFETY: the allocation is kept until drop.
        let place = (unsafe { allocation.memory() }, allocation.offset());
        self.allocations.push(allocation);
        Ok(place)
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: all of them are ours, and the executor's owner waits for the GPU before it drops it.
        unsafe {
            for storage in &self.owned {
                self.device.destroy_image_view(storage.view, None);
                self.device.destroy_image(storage.image, None);
                self.device.destroy_buffer(storage.buffer, None);
            }
        }
        if let Some(allocator) = &mut self.allocator {
            for allocation in self.allocations.drain(..) {
                if let Err(error) = allocator.free(allocation) {
                    log::error!("atrous: freeing memory failed: {error}");
                }
            }
        }
    }
}

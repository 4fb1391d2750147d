//! Images, buffers and their memory: histories with memory of their own, transients aliased by lifetime.

mod blocks;

use super::storage::{Object, Storages, StoredImage};
use super::{AllocatedMemory, ExecutorOptions};
use crate::contract::{alias, Declaration, Lifetime, ResourceDecl, ResourceId, Shape, Span, WHOLE};
use crate::error::Error;
use crate::record::{Device, Names};
use ash::vk;
use blocks::{Demand, Limits};
use std::ffi::{CStr, CString};

/// Everything that an executor allocates, and the images and buffers that a host bound.
pub(crate) struct Memory {
    device: ash::Device,
    limits: Limits,
    objects: Objects,
    pub storages: Storages,
    labels: Vec<CString>,
    names: Names,
}

/// Vulkan objects with their memory.
#[derive(Default)]
struct Objects {
    owned: Vec<Owned>,
    blocks: Vec<vk::DeviceMemory>,
    allocated: AllocatedMemory,
}

/// A Vulkan object of the executor.
enum Owned {
    Image(vk::Image),
    View(vk::ImageView),
    Buffer(vk::Buffer),
}

/// What waits for a place in memory.
enum Waiting {
    Own(ResourceId, usize, Object),
    /// Images at their offsets in what they share.
    Transients(Vec<(ResourceId, StoredImage, u64)>),
}

impl Memory {
    /// # Safety
    /// Obligations of `Executor::new`.
    pub(crate) unsafe fn new(host: Device<'_>, declaration: &Declaration, options: &ExecutorOptions) -> Result<Self, Error> {
        let mut this = Self {
            device: host.device.clone(),
            // SAFETY: instance and physical device are live.
            limits: unsafe { Limits::new(host, options.largest_block) },
            objects: Objects::default(),
            storages: Storages::new(declaration, options.stay_in_general),
            names: Names::new(host, options.debug_labels),
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
        let storages = std::mem::replace(&mut self.storages, Storages::new(declaration, options.stay_in_general));
        // SAFETY: the device is live, and formats, extents and limits were checked against it.
        let result = unsafe { self.allocate(declaration, options) };
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

    /// Everything is created before memory is asked for, so that it takes as few blocks as there are types of memory.
    unsafe fn allocate(&mut self, declaration: &Declaration, options: &ExecutorOptions) -> Result<(), Error> {
        let (mut demands, mut waiting) = (Vec::new(), Vec::new());
        // SAFETY: the device is live, and formats, extents and limits were checked against it; objects are bound once, to memory that
        // meets their requirements.
        unsafe {
            self.create_own(declaration, options, &mut demands, &mut waiting)?;
            self.create_transient_images(declaration, options, &mut demands, &mut waiting)?;
            let (blocks, places) = self.limits.plan(&demands)?;
            for block in &blocks {
                let memory = block.allocate(&self.device, &blocks)?;
                self.objects.blocks.push(memory);
                self.objects.allocated.device += block.size;
            }
            for (waiting, place) in waiting.into_iter().zip(places) {
                self.place(waiting, self.objects.blocks[place.block], place.offset)?;
            }
            self.name(declaration);
        }
        Ok(())
    }

    /// Names what messages of a validation layer are about.
    ///
    /// # Safety
    /// What is stored is live, and no other thread uses it.
    unsafe fn name(&self, declaration: &Declaration) {
        for (resource, id) in declaration.resources().iter().zip(0..) {
            for copy in 0..resource.lifetime.copies() {
                let name = format!("{}, copy {copy}", resource.name);
                // SAFETY: live, and not used by other threads.
                unsafe {
                    match self.storages.object(ResourceId(id), copy) {
                        Some(Object::Image(StoredImage { image, view, .. })) => {
                            self.names.set(*image, &name);
                            self.names.set(*view, &name);
                        }
                        Some(Object::Buffer { buffer, .. }) => self.names.set(*buffer, &name),
                        None => {}
                    }
                }
            }
        }
    }

    unsafe fn place(&mut self, waiting: Waiting, memory: vk::DeviceMemory, offset: u64) -> Result<(), Error> {
        match waiting {
            Waiting::Own(id, copy, Object::Image(image)) => {
                // SAFETY: the obligations are the same.
                let image = unsafe { self.bind_image(image, memory, offset)? };
                self.storages.set(id, copy, Object::Image(image));
            }
            Waiting::Own(id, copy, Object::Buffer { buffer, size }) => {
                // SAFETY: the memory meets the buffer's requirements at this offset, and it has none yet.
                unsafe { self.device.bind_buffer_memory(buffer, memory, offset) }.map_err(Error::vulkan("vkBindBufferMemory"))?;
                self.storages.set(id, copy, Object::Buffer { buffer, size });
            }
            Waiting::Transients(images) => {
                for (id, image, inside) in images {
                    // SAFETY: the obligations are the same.
                    let image = unsafe { self.bind_image(image, memory, offset + inside)? };
                    self.storages.set(id, 0, Object::Image(image));
                }
            }
        }
        Ok(())
    }

    /// With its view.
    unsafe fn bind_image(&mut self, image: StoredImage, memory: vk::DeviceMemory, offset: u64) -> Result<StoredImage, Error> {
        // SAFETY: the memory meets the image's requirements at this offset, and it has none yet.
        unsafe {
            self.device.bind_image_memory(image.image, memory, offset).map_err(Error::vulkan("vkBindImageMemory"))?;
            Ok(StoredImage { view: self.create_view(&image)?, ..image })
        }
    }

    /// Histories, outputs, and every buffer.
    unsafe fn create_own(
        &mut self,
        declaration: &Declaration,
        options: &ExecutorOptions,
        demands: &mut Vec<Demand>,
        waiting: &mut Vec<Waiting>,
    ) -> Result<(), Error> {
        for (index, resource) in declaration.resources().iter().enumerate() {
            for copy in 0..resource.lifetime.copies() {
                if matches!(resource.shape, Shape::Image { .. }) && resource.lifetime == Lifetime::Transient {
                    continue;
                }
                // SAFETY: the device is live, and formats, extents and limits were checked against it.
                let (object, requirements, bytes) = unsafe {
                    match resource.shape {
                        Shape::Image { format, .. } => self.own_image(declaration, resource, format.preferred(), options)?,
                        Shape::Buffer { size } => self.own_buffer(resource, size)?,
                    }
                };
                demands.push(Demand { name: resource.name.clone(), requirements });
                waiting.push(Waiting::Own(ResourceId(index as u32), copy, object));
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
    ) -> Result<(Object, vk::MemoryRequirements, u64), Error> {
        // SAFETY: the device is live, and format and extent were checked against it.
        unsafe {
            let image = self.create_image(declaration, resource, format, options, vk::ImageCreateFlags::empty())?;
            let requirements = self.device.get_image_memory_requirements(image.image);
            Ok((Object::Image(image), requirements, requirements.size))
        }
    }

    unsafe fn own_buffer(&mut self, resource: &ResourceDecl, size: u64) -> Result<(Object, vk::MemoryRequirements, u64), Error> {
        let usage = resource.buffer_usage | vk::BufferUsageFlags::TRANSFER_SRC;
        let info = vk::BufferCreateInfo::default().size(size).usage(usage).sharing_mode(vk::SharingMode::EXCLUSIVE);
        // SAFETY: the device is live.
        unsafe {
            let buffer = self.device.create_buffer(&info, None).map_err(Error::vulkan("vkCreateBuffer"))?;
            self.objects.owned.push(Owned::Buffer(buffer));
            Ok((Object::Buffer { buffer, size }, self.device.get_buffer_memory_requirements(buffer), size))
        }
    }

    /// One place for all transient images, each at the offset that the planner gave it.
    unsafe fn create_transient_images(
        &mut self,
        declaration: &Declaration,
        options: &ExecutorOptions,
        demands: &mut Vec<Demand>,
        waiting: &mut Vec<Waiting>,
    ) -> Result<(), Error> {
        let (mut ids, mut spans, mut images) = (Vec::new(), Vec::new(), Vec::new());
        let mut shared = vk::MemoryRequirements { size: 0, alignment: 1, memory_type_bits: u32::MAX };
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
            shared.alignment = shared.alignment.max(requirements.alignment);
            shared.memory_type_bits &= requirements.memory_type_bits;
            ids.push(id);
            images.push(image);
        }
        if ids.is_empty() {
            return Ok(());
        }
        let (offsets, total) = alias(&spans);
        shared.size = total;
        self.objects.allocated.transient += total;
        self.storages.share(&ids, &spans, &offsets);
        demands.push(Demand { name: "transients".to_owned(), requirements: shared });
        waiting
            .push(Waiting::Transients(ids.into_iter().zip(images).zip(offsets).map(|((id, image), at)| (id, image, at)).collect()));
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
        let extent = resource.extent(declaration.setup()).unwrap_or([1, 1]);
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
        for block in objects.blocks {
            // SAFETY: ours, and what lay in it is destroyed.
            unsafe { self.device.free_memory(block, None) };
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

//! Barriers as the arguments of one call, for synchronization2 and for Vulkan 1.0.

use super::{Barrier, BarrierTarget};
use crate::contract::{Binding, ResourceId};
use ash::vk;

/// The part of an image that stands for a resource: one mip level of one array layer. The rest of the image is never touched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Subresource {
    /// Array layer.
    pub layer: u32,
    /// Mip level.
    pub level: u32,
}

impl Subresource {
    /// The whole of an image with one layer and one mip level.
    pub(crate) const FIRST: Self = Self { layer: 0, level: 0 };

    pub(crate) const fn range(self, aspect_mask: vk::ImageAspectFlags) -> vk::ImageSubresourceRange {
        let Self { layer, level } = self;
        vk::ImageSubresourceRange { aspect_mask, base_mip_level: level, level_count: 1, base_array_layer: layer, layer_count: 1 }
    }

    #[cfg(feature = "executor")]
    pub(crate) const fn layers(self, aspect_mask: vk::ImageAspectFlags) -> vk::ImageSubresourceLayers {
        vk::ImageSubresourceLayers { aspect_mask, mip_level: self.level, base_array_layer: self.layer, layer_count: 1 }
    }
}

/// The image or buffer that stands for one copy of a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhysicalResource {
    /// An image.
    Image {
        /// Image.
        image: vk::Image,
        /// 2D view of the subresource, of the colour or the depth aspect.
        view: vk::ImageView,
        /// All aspects of its format, depth and stencil together.
        aspects: vk::ImageAspectFlags,
        /// The layer and mip level that barriers name.
        subresource: Subresource,
    },
    /// A range of a buffer.
    Buffer {
        /// Buffer.
        buffer: vk::Buffer,
        /// Offset in bytes, aligned as the device demands for its descriptor type.
        offset: vk::DeviceSize,
        /// Bytes, or `WHOLE_SIZE`.
        size: vk::DeviceSize,
    },
}

impl PhysicalResource {
    /// A colour image with one layer and one mip level.
    pub const fn color(image: vk::Image, view: vk::ImageView) -> Self {
        Self::Image { image, view, aspects: vk::ImageAspectFlags::COLOR, subresource: Subresource::FIRST }
    }

    /// A whole buffer.
    pub const fn buffer(buffer: vk::Buffer) -> Self {
        Self::Buffer { buffer, offset: 0, size: vk::WHOLE_SIZE }
    }

    /// The binding for a use, in the layout that [`Tracker::state`](super::Tracker::state) has.
    pub fn binding(&self, layout: vk::ImageLayout) -> Binding {
        match *self {
            Self::Image { view, .. } => Binding::Image { view, layout },
            Self::Buffer { buffer, offset, size } => Binding::Buffer { buffer, offset, range: size },
        }
    }
}

/// The arguments of one `vkCmdPipelineBarrier2`. Keep it from pass to pass: its lists are used again.
#[derive(Debug, Default)]
pub struct Barriers2 {
    /// Barriers of all memory.
    pub memory: Vec<vk::MemoryBarrier2<'static>>,
    /// Barriers of images.
    pub images: Vec<vk::ImageMemoryBarrier2<'static>>,
    /// Barriers of buffers.
    pub buffers: Vec<vk::BufferMemoryBarrier2<'static>>,
}

impl Barriers2 {
    /// Takes these barriers in place of those from before. `physical` gives the image or buffer of a copy of a resource; where it
    /// gives none, the barrier is left out.
    pub fn set(&mut self, barriers: &[Barrier], physical: impl Fn(ResourceId, usize) -> Option<PhysicalResource>) {
        self.memory.clear();
        self.images.clear();
        self.buffers.clear();
        for barrier in barriers {
            match (barrier.target, object(barrier, &physical)) {
                (BarrierTarget::Memory, _) => self.memory.push(barrier.memory_barrier2()),
                (_, Some(PhysicalResource::Image { image, aspects, subresource, .. })) => {
                    self.images.push(barrier.image_memory_barrier2(image, aspects, subresource));
                }
                (_, Some(PhysicalResource::Buffer { buffer, offset, size })) => {
                    self.buffers.push(barrier.buffer_memory_barrier2(buffer, offset, size));
                }
                (_, None) => {}
            }
        }
    }

    /// Whether there is nothing to record.
    pub fn is_empty(&self) -> bool {
        self.memory.is_empty() && self.images.is_empty() && self.buffers.is_empty()
    }

    /// The argument of `vkCmdPipelineBarrier2`.
    pub fn dependency_info(&self) -> vk::DependencyInfo<'_> {
        // Null where there is none: an empty slice is a pointer as well, and Mesa allocates a copy of what it points to.
        let mut info = vk::DependencyInfo::default();
        if !self.memory.is_empty() {
            info = info.memory_barriers(&self.memory);
        }
        if !self.images.is_empty() {
            info = info.image_memory_barriers(&self.images);
        }
        if !self.buffers.is_empty() {
            info = info.buffer_memory_barriers(&self.buffers);
        }
        info
    }
}

/// The arguments of one `vkCmdPipelineBarrier`, for Vulkan 1.0 and devices without synchronization2. Keep it from pass to pass.
#[derive(Debug, Default)]
pub struct LegacyBarriers {
    /// Source stages of all barriers.
    pub src_stage: vk::PipelineStageFlags,
    /// Destination stages of all barriers.
    pub dst_stage: vk::PipelineStageFlags,
    /// Barriers of all memory.
    pub memory: Vec<vk::MemoryBarrier<'static>>,
    /// Barriers of images.
    pub images: Vec<vk::ImageMemoryBarrier<'static>>,
    /// Barriers of buffers.
    pub buffers: Vec<vk::BufferMemoryBarrier<'static>>,
}

impl LegacyBarriers {
    /// Takes these barriers in place of those from before: see [`Barriers2::set`].
    pub fn set(&mut self, barriers: &[Barrier], physical: impl Fn(ResourceId, usize) -> Option<PhysicalResource>) {
        self.memory.clear();
        self.images.clear();
        self.buffers.clear();
        (self.src_stage, self.dst_stage) = Default::default();
        for barrier in barriers {
            let physical = object(barrier, &physical);
            if physical.is_some() || barrier.target == BarrierTarget::Memory {
                self.push(barrier, physical);
            }
        }
        if self.src_stage.is_empty() {
            self.src_stage = vk::PipelineStageFlags::TOP_OF_PIPE;
        }
        if self.dst_stage.is_empty() {
            self.dst_stage = vk::PipelineStageFlags::BOTTOM_OF_PIPE;
        }
    }

    /// Whether there is nothing to record.
    pub fn is_empty(&self) -> bool {
        self.memory.is_empty() && self.images.is_empty() && self.buffers.is_empty()
    }

    fn push(&mut self, barrier: &Barrier, physical: Option<PhysicalResource>) {
        let ((src_stage, src_access), (dst_stage, dst_access)) = (barrier.from.legacy_scope(), barrier.to.legacy_scope());
        self.src_stage |= src_stage;
        self.dst_stage |= dst_stage;
        let [source, destination] = barrier.family_indices();
        match physical {
            None => self.memory.push(vk::MemoryBarrier::default().src_access_mask(src_access).dst_access_mask(dst_access)),
            Some(PhysicalResource::Image { image, aspects, subresource, .. }) => self.images.push(
                vk::ImageMemoryBarrier::default()
                    .image(image)
                    .subresource_range(subresource.range(aspects))
                    .src_queue_family_index(source)
                    .dst_queue_family_index(destination)
                    .src_access_mask(src_access)
                    .dst_access_mask(dst_access)
                    .old_layout(barrier.old_layout())
                    .new_layout(barrier.to.layout),
            ),
            Some(PhysicalResource::Buffer { buffer, offset, size }) => self.buffers.push(
                vk::BufferMemoryBarrier::default()
                    .buffer(buffer)
                    .offset(offset)
                    .size(size)
                    .src_queue_family_index(source)
                    .dst_queue_family_index(destination)
                    .src_access_mask(src_access)
                    .dst_access_mask(dst_access),
            ),
        }
    }
}

fn object(barrier: &Barrier, physical: &impl Fn(ResourceId, usize) -> Option<PhysicalResource>) -> Option<PhysicalResource> {
    match barrier.target {
        BarrierTarget::Memory => None,
        BarrierTarget::Image { resource, copy } | BarrierTarget::Buffer { resource, copy } => physical(resource, copy),
    }
}

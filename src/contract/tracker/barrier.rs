//! Barriers as plain data, and as the structures of Vulkan.

use super::{ResourceState, Subresource};
use crate::contract::ResourceId;
use ash::vk;

/// The thing that a barrier is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BarrierTarget {
    /// All memory: orders transients that share it.
    Memory,
    /// An image.
    Image {
        /// The resource.
        resource: ResourceId,
        /// The copy: 0, or 0 and 1 of a history.
        copy: usize,
    },
    /// A buffer.
    Buffer {
        /// The resource.
        resource: ResourceId,
        /// The copy: 0, or 0 and 1 of a history.
        copy: usize,
    },
}

/// A barrier to record: plain data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Barrier {
    /// The image, the buffer, or all memory.
    pub target: BarrierTarget,
    /// The state before: source scope, old layout, source queue family.
    pub from: ResourceState,
    /// The state behind: destination scope, new layout, destination queue family.
    pub to: ResourceState,
    /// Nobody needs the content: the old layout may be `UNDEFINED`, and ownership need not be transferred.
    pub discard: bool,
}

impl Barrier {
    /// The layout that an image is taken from: `UNDEFINED` where content is discarded.
    pub fn old_layout(&self) -> vk::ImageLayout {
        if self.discard {
            vk::ImageLayout::UNDEFINED
        } else {
            self.from.layout
        }
    }

    /// Source and destination family where the barrier transfers ownership.
    pub(crate) fn queue_families(&self) -> Option<[u32; 2]> {
        let families = [self.from.queue_family, self.to.queue_family];
        let transfers = families[0] != families[1] && !families.contains(&vk::QUEUE_FAMILY_IGNORED) && !self.discard;
        transfers.then_some(families)
    }

    /// Makes a barrier of memory of one that leaves its image in `GENERAL` and its owner in place. Content that nobody needs stays
    /// there, too.
    pub(super) fn keep_general(&mut self) {
        let general = vk::ImageLayout::GENERAL;
        let is_image = matches!(self.target, BarrierTarget::Image { .. });
        if is_image && [self.from.layout, self.to.layout] == [general; 2] && self.queue_families().is_none() {
            self.target = BarrierTarget::Memory;
        }
    }

    /// The half that a queue of the source family records, where the barrier transfers ownership; else the barrier itself.
    pub(super) fn release(self) -> Self {
        let to = ResourceState { stage: vk::PipelineStageFlags2::NONE, access: vk::AccessFlags2::NONE, ..self.to };
        if self.queue_families().is_some() {
            Self { to, ..self }
        } else {
            self
        }
    }

    /// The half that a queue of the destination family records, where the barrier transfers ownership; else the barrier itself.
    pub(super) fn acquire(self) -> Self {
        // It chains to the semaphore that the submission waits for.
        let from = ResourceState { stage: self.to.stage, access: vk::AccessFlags2::NONE, ..self.from };
        if self.queue_families().is_some() {
            Self { from, ..self }
        } else {
            self
        }
    }

    /// The barrier of all memory.
    pub(crate) fn memory_barrier2(&self) -> vk::MemoryBarrier2<'static> {
        vk::MemoryBarrier2::default()
            .src_stage_mask(self.from.stage)
            .src_access_mask(self.from.access)
            .dst_stage_mask(self.to.stage)
            .dst_access_mask(self.to.access)
    }

    /// The barrier of one subresource of an image. `aspects` are all that its format has.
    pub(crate) fn image_memory_barrier2(
        &self,
        image: vk::Image,
        aspects: vk::ImageAspectFlags,
        subresource: Subresource,
    ) -> vk::ImageMemoryBarrier2<'static> {
        let [source, destination] = self.family_indices();
        vk::ImageMemoryBarrier2::default()
            .image(image)
            .subresource_range(subresource.range(aspects))
            .src_queue_family_index(source)
            .dst_queue_family_index(destination)
            .src_stage_mask(self.from.stage)
            .src_access_mask(self.from.access)
            .old_layout(self.old_layout())
            .dst_stage_mask(self.to.stage)
            .dst_access_mask(self.to.access)
            .new_layout(self.to.layout)
    }

    /// The barrier of a range of a buffer.
    pub(crate) fn buffer_memory_barrier2(
        &self,
        buffer: vk::Buffer,
        offset: vk::DeviceSize,
        size: vk::DeviceSize,
    ) -> vk::BufferMemoryBarrier2<'static> {
        let [source, destination] = self.family_indices();
        vk::BufferMemoryBarrier2::default()
            .buffer(buffer)
            .offset(offset)
            .size(size)
            .src_queue_family_index(source)
            .dst_queue_family_index(destination)
            .src_stage_mask(self.from.stage)
            .src_access_mask(self.from.access)
            .dst_stage_mask(self.to.stage)
            .dst_access_mask(self.to.access)
    }

    pub(super) fn family_indices(&self) -> [u32; 2] {
        self.queue_families().unwrap_or([vk::QUEUE_FAMILY_IGNORED; 2])
    }
}

/// The one mip level and layer that every image of a declaration has.
#[cfg(feature = "executor")]
pub(crate) const WHOLE: vk::ImageSubresourceRange = Subresource::FIRST.range(vk::ImageAspectFlags::COLOR);

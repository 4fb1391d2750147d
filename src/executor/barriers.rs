//! Barriers, derived from the declared uses and from what was last done to each image and buffer.

use super::scope::Scope;
use super::storage::{Object, Storage, Storages, StoredImage};
use crate::contract::{Access, Declaration, FrameContext, Lifetime, ResourceId, UseFrame};
use ash::vk;

/// Collects barriers; the vectors are kept from pass to pass, so that a steady state allocates nothing.
#[derive(Default)]
pub(crate) struct Barriers {
    globals: Vec<vk::MemoryBarrier2<'static>>,
    images: Vec<vk::ImageMemoryBarrier2<'static>>,
    buffers: Vec<vk::BufferMemoryBarrier2<'static>>,
}

impl Barriers {
    /// # Safety
    /// Obligations of `Executor::record`.
    #[allow(clippy::too_many_arguments)]
    pub unsafe fn before_pass(
        &mut self,
        device: &ash::Device,
        cmd: vk::CommandBuffer,
        declaration: &Declaration,
        frame: &FrameContext,
        pass: usize,
        omit: bool,
        storages: &mut Storages,
    ) {
        self.collect(declaration, frame, pass, storages);
        // SAFETY: `cmd` is recording outside a render pass; every storage that was collected is live, and in the state that its
        // scope says.
        unsafe { self.flush(device, cmd, omit) };
    }

    fn collect(&mut self, declaration: &Declaration, frame: &FrameContext, pass: usize, storages: &mut Storages) {
        for u in &declaration.passes()[pass].uses {
            let copy = declaration.copy(u, frame);
            let starts = storages.starts_transient(u.resource, pass);
            let source = if starts { storages.scope_of_aliases(u.resource) } else { None };
            let Some(storage) = storages.storage_mut(u.resource, copy) else { continue };
            if let Some(source) = source {
                self.take_over(storage, &source, Scope::of(u.access));
                storage.scope.layout = vk::ImageLayout::UNDEFINED;
            }
            self.to(storage, Scope::of(u.access), u.access.reads());
        }
    }

    /// Brings the host's images and buffers back to the state that they were bound in.
    ///
    /// # Safety
    /// Obligations of `Executor::record`.
    pub unsafe fn hand_back(&mut self, device: &ash::Device, cmd: vk::CommandBuffer, storages: &mut Storages) {
        for storage in storages.touched_host_storages() {
            if let Some(home) = storage.home {
                // Even where only reads met: the host's next write must wait for ours.
                self.push(storage, home, true);
            }
        }
        // SAFETY: `cmd` is recording outside a render pass; the host keeps what it bound alive, in the state that its scope says.
        unsafe { self.flush(device, cmd, false) };
    }

    /// One barrier outside of any pass.
    ///
    /// # Safety
    /// Obligations of `Executor::record`.
    pub unsafe fn single(&mut self, device: &ash::Device, cmd: vk::CommandBuffer, storage: &mut Storage, next: Scope, keep: bool) {
        self.to(storage, next, keep);
        // SAFETY: `cmd` is recording outside a render pass; the storage is live, and in the state that its scope says.
        unsafe { self.flush(device, cmd, false) };
    }

    /// Fills what is undefined with NaN: transients, copies about to be written, and on a reset all previous copies.
    ///
    /// # Safety
    /// Obligations of `Executor::record`; images have `TRANSFER_DST` usage.
    pub unsafe fn poison(
        &mut self,
        device: &ash::Device,
        cmd: vk::CommandBuffer,
        declaration: &Declaration,
        frame: &FrameContext,
        storages: &mut Storages,
    ) {
        for index in 0..declaration.resources().len() as u32 {
            let id = ResourceId(index);
            let lifetime = declaration.resource(id).lifetime;
            for copy in 0..lifetime.copies() {
                let current = frame.history_copy(UseFrame::Current) == copy;
                let undefined = match lifetime {
                    Lifetime::Transient | Lifetime::Output => true,
                    Lifetime::History => current || frame.reset.is_some(),
                    Lifetime::HistoryInPlace => frame.reset.is_some(),
                    Lifetime::Input { .. } => false,
                };
                let source = storages.scope_of_aliases(id);
                let Some(storage) = storages.storage_mut(id, copy).filter(|_| undefined) else { continue };
                let Some(&StoredImage { image, .. }) = storage.image() else { continue };
                if let Some(source) = source {
                    self.take_over(storage, &source, Scope::of(Access::Clear));
                }
                self.to(storage, Scope::of(Access::Clear), false);
                let colour = if storage.image().is_some_and(StoredImage::is_uint) {
                    vk::ClearColorValue { uint32: [u32::MAX; 4] }
                } else {
                    vk::ClearColorValue { float32: [f32::NAN; 4] }
                };
                // SAFETY: `cmd` is recording; the image is live, has usage `TRANSFER_DST`, and the barrier before brings it to
                // TRANSFER_DST_OPTIMAL.
                unsafe {
                    self.flush(device, cmd, false);
                    device.cmd_clear_color_image(cmd, image, vk::ImageLayout::TRANSFER_DST_OPTIMAL, &colour, &[WHOLE]);
                }
            }
        }
    }

    /// Orders an image after what was done to its memory through others: a barrier of the image alone does not reach that, and a
    /// global one does not come before the image's own layout transition.
    fn take_over(&mut self, storage: &mut Storage, source: &Scope, next: Scope) {
        self.globals.push(dependency(source, &next));
        storage.scope.merge(source);
    }

    fn to(&mut self, storage: &mut Storage, next: Scope, keep: bool) {
        let relayout = storage.image().is_some() && storage.scope.layout != next.layout;
        if !storage.scope.writes() && !next.writes() && !relayout {
            storage.scope.merge(&next);
            storage.touched = true;
            return;
        }
        self.push(storage, next, keep);
    }

    fn push(&mut self, storage: &mut Storage, next: Scope, keep: bool) {
        let now = storage.scope;
        match &storage.object {
            Object::Image(image) => {
                let old = if keep { now.layout } else { vk::ImageLayout::UNDEFINED };
                self.images.push(
                    vk::ImageMemoryBarrier2::default()
                        .image(image.image)
                        .subresource_range(vk::ImageSubresourceRange { aspect_mask: image.aspects(), ..WHOLE })
                        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                        .src_stage_mask(now.stage)
                        .src_access_mask(now.access)
                        .old_layout(old)
                        .dst_stage_mask(next.stage)
                        .dst_access_mask(next.access)
                        .new_layout(next.layout),
                );
            }
            Object::Buffer { buffer, .. } => self.buffers.push(between(*buffer, &now, &next)),
        }
        storage.scope = next;
        storage.touched = true;
    }

    unsafe fn flush(&mut self, device: &ash::Device, cmd: vk::CommandBuffer, omit: bool) {
        let nothing = self.globals.is_empty() && self.images.is_empty() && self.buffers.is_empty();
        if !omit && !nothing {
            // Null where there is none: an empty slice is a pointer as well, and Mesa allocates a copy of what it points to.
            let mut info = vk::DependencyInfo::default();
            if !self.globals.is_empty() {
                info = info.memory_barriers(&self.globals);
            }
            if !self.images.is_empty() {
                info = info.image_memory_barriers(&self.images);
            }
            if !self.buffers.is_empty() {
                info = info.buffer_memory_barriers(&self.buffers);
            }
            // SAFETY: `cmd` is recording outside a render pass on a device with synchronization2; images and buffers are live, and
            // in the layouts named.
            unsafe { device.cmd_pipeline_barrier2(cmd, &info) };
        }
        self.globals.clear();
        self.images.clear();
        self.buffers.clear();
    }
}

/// One barrier of a buffer that is not ours to track.
///
/// # Safety
/// Obligations of `Executor::record`.
pub(crate) unsafe fn buffer_barrier(device: &ash::Device, cmd: vk::CommandBuffer, buffer: vk::Buffer, from: Scope, to: Scope) {
    let barrier = between(buffer, &from, &to);
    // SAFETY: `cmd` is recording outside a render pass on a device with synchronization2, and the buffer is live.
    unsafe { device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().buffer_memory_barriers(&[barrier])) };
}

fn between(buffer: vk::Buffer, from: &Scope, to: &Scope) -> vk::BufferMemoryBarrier2<'static> {
    vk::BufferMemoryBarrier2::default()
        .buffer(buffer)
        .size(vk::WHOLE_SIZE)
        .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
        .src_stage_mask(from.stage)
        .src_access_mask(from.access)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
}

fn dependency(from: &Scope, to: &Scope) -> vk::MemoryBarrier2<'static> {
    vk::MemoryBarrier2::default()
        .src_stage_mask(from.stage)
        .src_access_mask(from.access)
        .dst_stage_mask(to.stage)
        .dst_access_mask(to.access)
}

/// The one mip level and layer that every image of ours has.
pub(crate) const WHOLE: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

#[cfg(test)]
mod hazard_tests;

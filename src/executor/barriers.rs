//! The barriers of the tracker, recorded.

use super::storage::{Object, Storages, StoredImage};
use crate::contract::{
    Access, Barrier, BarrierTarget, Barriers2, Declaration, FrameContext, LegacyBarriers, Lifetime, PhysicalResource, ResourceId,
    ResourceState, UseFrame,
};
use ash::vk;

/// Records barriers; the lists are kept from pass to pass, so that a steady state allocates nothing.
pub(crate) enum Barriers {
    Synchronization2(Barriers2),
    Legacy(LegacyBarriers),
}

impl Barriers {
    /// Barriers by synchronization2, or by `vkCmdPipelineBarrier`.
    pub(crate) fn new(legacy: bool) -> Self {
        if legacy {
            Self::Legacy(LegacyBarriers::default())
        } else {
            Self::Synchronization2(Barriers2::default())
        }
    }

    fn set(&mut self, barriers: &[Barrier], physical: impl Fn(ResourceId, usize) -> Option<PhysicalResource>) {
        match self {
            Self::Synchronization2(arguments) => arguments.set(barriers, physical),
            Self::Legacy(arguments) => arguments.set(barriers, physical),
        }
    }

    /// # Safety
    /// Obligations of `Executor::record`.
    pub(crate) unsafe fn before_pass(
        &mut self,
        device: &ash::Device,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        omit: bool,
        storages: &mut Storages,
    ) {
        let (tracker, objects) = storages.split();
        let barriers = tracker.barriers(pass, frame);
        self.set(if omit { &[] } else { barriers }, |id, copy| objects.physical(id, copy));
        // SAFETY: `cmd` is recording outside a render pass; what is bound is live, and in the state that the tracker says.
        unsafe { self.flush(device, cmd) };
    }

    /// Brings the host's images and buffers back to the state that they were bound in.
    ///
    /// # Safety
    /// Obligations of `Executor::record`.
    pub(crate) unsafe fn hand_back(&mut self, device: &ash::Device, cmd: vk::CommandBuffer, storages: &mut Storages) {
        let (tracker, objects) = storages.split();
        self.set(tracker.hand_back(), |id, copy| objects.physical(id, copy));
        // SAFETY: `cmd` is recording outside a render pass; the host keeps what it bound alive, in the state that the tracker says.
        unsafe { self.flush(device, cmd) };
    }

    /// The barrier before a use outside any pass.
    ///
    /// # Safety
    /// Obligations of `Executor::record`.
    #[allow(clippy::too_many_arguments)]
    pub(crate) unsafe fn before_access(
        &mut self,
        device: &ash::Device,
        cmd: vk::CommandBuffer,
        storages: &mut Storages,
        (id, copy): (ResourceId, usize),
        next: ResourceState,
        discard: bool,
    ) {
        let (tracker, objects) = storages.split();
        self.set(tracker.access(id, copy, next, discard), |id, copy| objects.physical(id, copy));
        // SAFETY: `cmd` is recording outside a render pass; the object is live, and in the state that the tracker says.
        unsafe { self.flush(device, cmd) };
    }

    /// The barrier of an object that no declaration has.
    ///
    /// # Safety
    /// Obligations of `Executor::record`; the object is live and in the state `from`, or its content is not needed there.
    pub(crate) unsafe fn single(
        &mut self,
        device: &ash::Device,
        cmd: vk::CommandBuffer,
        object: Object,
        [from, to]: [ResourceState; 2],
        discard: bool,
    ) {
        // The number means nothing: there is one object.
        let target = BarrierTarget::Image { resource: ResourceId(0), copy: 0 };
        self.set(&[Barrier { target, from, to, discard }], |_, _| Some(object.physical()));
        // SAFETY: `cmd` is recording outside a render pass; the object is live, and in the state that the caller says.
        unsafe { self.flush(device, cmd) };
    }

    /// Fills undefined content with NaN: transients, copies about to be written, and on a reset all
    /// previous copies.
    ///
    /// # Safety
    /// Obligations of `Executor::record`; images have `TRANSFER_DST` usage.
    pub(crate) unsafe fn poison(
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
                    // Other pictures of the host may lie in it.
                    Lifetime::Output => declaration.setup().image_extent.is_none(),
                    Lifetime::Transient => true,
                    Lifetime::History => current || frame.reset.is_some(),
                    Lifetime::HistoryInPlace => frame.reset.is_some(),
                    Lifetime::Input { .. } => false,
                };
                let image = storages.object(id, copy).filter(|_| undefined).and_then(Object::image);
                let Some(&image @ StoredImage { image: handle, subresource, .. }) = image else { continue };
                let colour = if image.is_uint() {
                    vk::ClearColorValue { uint32: [u32::MAX; 4] }
                } else {
                    vk::ClearColorValue { float32: [f32::NAN; 4] }
                };
                // SAFETY: `cmd` is recording; the image is live, has usage `TRANSFER_DST`, and the barrier before brings it to
                // TRANSFER_DST_OPTIMAL.
                unsafe {
                    self.before_access(device, cmd, storages, (id, copy), ResourceState::of(Access::Clear), true);
                    let range = subresource.range(vk::ImageAspectFlags::COLOR);
                    device.cmd_clear_color_image(cmd, handle, vk::ImageLayout::TRANSFER_DST_OPTIMAL, &colour, &[range]);
                }
            }
        }
    }

    /// # Safety
    /// Obligations of `Executor::record`; every object of the arguments is live, and in the state that its barrier comes from.
    unsafe fn flush(&self, device: &ash::Device, cmd: vk::CommandBuffer) {
        // SAFETY: `cmd` is recording outside a render pass, and the device has synchronization2 where it is used; images and buffers
        // are live, and in the layouts named.
        unsafe {
            match self {
                Self::Synchronization2(b) if !b.is_empty() => device.cmd_pipeline_barrier2(cmd, &b.dependency_info()),
                Self::Legacy(b) if !b.is_empty() => {
                    let none = vk::DependencyFlags::empty();
                    device.cmd_pipeline_barrier(cmd, b.src_stage, b.dst_stage, none, &b.memory, &b.buffers, &b.images);
                }
                _ => {}
            }
        }
    }
}

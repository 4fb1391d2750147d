//! Copies of the inputs of a frame, recorded behind the passes that read them.

use super::*;
use crate::contract::{Phase, ResourceState, Shape, TexelGrid};
use crate::executor::readback::{COPIED, READ_BY_HOST};
use crate::executor::storage::{Object, StoredImage};
use crate::executor::transfer::region;

impl Executor {
    /// Copies the inputs that no later phase reads.
    ///
    /// # Safety
    /// Obligations of [`Self::record`].
    pub(in crate::executor) unsafe fn record_capture(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) {
        let captured = self.capture.slots.get(&frame.slot).and_then(|s| s.frame).is_some_and(|f| f.index == frame.index);
        if !captured {
            return;
        }
        let declaration = self.denoiser.declaration();
        let last_phase = |id| declaration.life(id).map(|(_, last)| declaration.passes()[last].phase);
        let is_wanted = |name: &str| self.capture.checker.is_none() || guides::NAMES.contains(&name);
        let inputs: Vec<_> =
            inputs(declaration).filter(|(_, name)| is_wanted(name)).map(|(id, name)| (id, name.to_owned())).collect();
        let is_last = inputs.iter().filter_map(|(id, _)| last_phase(*id)).max() == Some(phase);
        let here: Vec<_> = inputs.iter().filter(|(id, _)| last_phase(*id) == Some(phase)).collect();
        for (id, name) in here {
            // SAFETY: `cmd` is recording outside a render pass; the slot's earlier work is complete, so that its buffers are idle.
            if let Err(error) = unsafe { self.copy_input(cmd, frame, *id, name) } {
                return self.capture.fail(error);
            }
        }
        if let Some(slot) = self.capture.slots.get_mut(&frame.slot) {
            slot.complete |= is_last;
        }
    }

    unsafe fn copy_input(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, id: ResourceId, name: &str) -> Result<(), Error> {
        let shape = self.denoiser.declaration().resource(id).shape;
        let Some(&object) = self.memory.storages.object(id, 0) else { return Ok(()) };
        let is_part = self.denoiser.declaration().resource(id).is_part_of_image(self.denoiser.declaration().setup());
        let origin = if is_part { frame.constants.viewport_origin } else { [0; 2] };
        let texels = if let Shape::Image { texels, .. } = shape { texels } else { TexelGrid::Rendered(1) };
        let extent = texels.extent(self.denoiser.declaration().setup(), frame.render_extent);
        let (format, bytes) = match object {
            Object::Image(image @ StoredImage { format, .. }) => {
                (format, extent[0] as usize * extent[1] as usize * image.texel_bytes(name)? as usize)
            }
            Object::Buffer { size, .. } => (vk::Format::UNDEFINED, size as usize / TRANSFORM_BYTES * TRANSFORM_BYTES),
        };
        let capture = &mut self.capture;
        let slot = capture.slots.entry(frame.slot).or_default();
        if slot.buffers.get(name).is_none_or(|b| b.size < bytes as u64) {
            // SAFETY: the device outlives the executor. A buffer that is replaced is idle, since the slot's earlier work is
            // complete.
            let staging = unsafe { Staging::of_types(&capture.device, &capture.memory_types, bytes.max(TRANSFORM_BYTES) as u64)? };
            slot.buffers.insert(name.to_owned(), staging);
        }
        let Some(buffer) = slot.buffers.get(name).map(|b| b.buffer) else { return Ok(()) };
        slot.copies.push(Copied { name: name.to_owned(), format, bytes });
        let target = Object::Buffer { buffer, size: vk::WHOLE_SIZE };
        let (device, storages) = (&self.device, &mut self.memory.storages);
        // SAFETY: `cmd` is recording; image and buffer are live and large enough, and the input is handed back at the end of the
        // phase.
        unsafe {
            self.barriers.before_access(device, cmd, storages, (id, 0), ResourceState::COPY_SOURCE, false);
            // An earlier frame of the slot filled the same buffer.
            self.barriers.single(device, cmd, target, [COPIED, COPIED], false);
            copy(device, cmd, &object, [origin, extent], buffer, bytes as u64);
            self.barriers.single(device, cmd, target, [COPIED, READ_BY_HOST], false);
        }
        Ok(())
    }
}

/// # Safety
/// `cmd` is recording; the input is live, in the state of a copy's source, and `buffer` has room for it.
unsafe fn copy(
    device: &ash::Device,
    cmd: vk::CommandBuffer,
    from: &Object,
    [origin, extent]: [[u32; 2]; 2],
    buffer: vk::Buffer,
    bytes: u64,
) {
    let image = match from {
        Object::Image(image) => image,
        Object::Buffer { buffer: from, .. } => {
            if bytes > 0 {
                // SAFETY: `cmd` is recording, and both buffers are live with room for `bytes`.
                unsafe { device.cmd_copy_buffer(cmd, *from, buffer, &[vk::BufferCopy::default().size(bytes)]) };
            }
            return;
        }
    };
    // SAFETY: `cmd` is recording; the image is live and in the layout of a copy's source, and the buffer has room for its texels.
    unsafe {
        let layout = ResourceState::COPY_SOURCE.layout;
        device.cmd_copy_image_to_buffer(cmd, image.image, layout, buffer, &[region(image, origin, extent)])
    };
}

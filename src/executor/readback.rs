//! Copies of resources for tools, captures and tests.

use super::barriers::Barriers;
use super::storage::{Object, StoredImage};
use super::transfer::region;
use super::Executor;
use crate::contract::texel::Texel;
use crate::contract::{Access, FrameContext, Lifetime, ResourceId, ResourceState, UseFrame};
use crate::error::Error;
use ash::vk;

/// Format and size of a copy of a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Readback {
    /// Format of the texels; `UNDEFINED` for a buffer.
    pub format: vk::Format,
    /// Bytes, tightly packed.
    pub bytes: u64,
}

impl Readback {
    /// Texels as floats, from any format; missing components are 0. Words of a buffer are whole
    /// numbers. Bytes after the last whole texel are left out.
    pub fn to_floats(&self, bytes: &[u8]) -> Vec<[f32; 4]> {
        let format = if self.format == vk::Format::UNDEFINED { vk::Format::R32_UINT } else { self.format };
        Texel::of(format).map_or(Vec::new(), |texel| texel.to_floats(bytes))
    }
}

impl Executor {
    /// The format and size that a copy of a resource will have.
    ///
    /// # Errors
    /// [`Error::UnknownResource`]; [`Error::NotBound`] for an input without an image;
    /// [`Error::Format`] for an image whose texels have no known size.
    pub fn readback(&self, name: &str, frame: &FrameContext, which: UseFrame) -> Result<Readback, Error> {
        let (id, copy) = self.locate(name, frame, which)?;
        let object = self.memory.storages.object(id, copy).ok_or_else(|| Error::NotBound(name.to_owned()))?;
        Ok(match *object {
            Object::Image(image @ StoredImage { format, extent: [width, height], .. }) => {
                Readback { format, bytes: u64::from(width) * u64::from(height) * image.texel_bytes(name)? }
            }
            Object::Buffer { size, .. } => Readback { format: vk::Format::UNDEFINED, bytes: size },
        })
    }

    /// Records a copy of a resource into `buffer`, visible to the host once the command buffer has
    /// run. A transient holds the content of the last pass that used its memory, unless it has
    /// memory of its own: see [`super::ExecutorOptions::no_aliasing`].
    ///
    /// # Errors
    /// Errors of [`Self::readback`].
    ///
    /// # Safety
    /// Obligations of [`Self::record`]; images have `TRANSFER_SRC` usage (see [`super::ExecutorOptions::extra_image_usage`]), and
    /// `buffer` has `TRANSFER_DST` usage and room for [`Readback::bytes`].
    pub unsafe fn record_copy(
        &mut self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        name: &str,
        which: UseFrame,
        buffer: vk::Buffer,
    ) -> Result<(), Error> {
        let (id, copy) = self.locate(name, frame, which)?;
        let Self { memory, barriers, device, .. } = self;
        let storages = &mut memory.storages;
        let object = *storages.object(id, copy).ok_or_else(|| Error::NotBound(name.to_owned()))?;
        let before = storages.state(id, copy);
        // SAFETY: `cmd` is recording outside a render pass; the object is live, has usage `TRANSFER_SRC` and the state that the
        // tracker says; `buffer` is live, with room for it.
        unsafe {
            barriers.before_access(device, cmd, storages, (id, copy), ResourceState::COPY_SOURCE, false);
            copy_out(device, cmd, barriers, object, buffer);
            if storages.is_lent(id) {
                barriers.before_access(device, cmd, storages, (id, copy), before, false);
            }
        }
        Ok(())
    }

    fn locate(&self, name: &str, frame: &FrameContext, which: UseFrame) -> Result<(ResourceId, usize), Error> {
        let declaration = self.denoiser.declaration();
        let id = declaration.named(name)?;
        let copy = match declaration.resource(id).lifetime {
            Lifetime::History => frame.history_copy(which),
            _ => 0,
        };
        Ok((id, copy))
    }
}

/// The state of a buffer after a copy, for reads by the CPU.
pub(super) const COPIED: ResourceState = ResourceState::of(Access::Clear);
pub(super) const READ_BY_HOST: ResourceState =
    ResourceState::new(vk::PipelineStageFlags2::HOST, vk::AccessFlags2::HOST_READ, vk::ImageLayout::UNDEFINED);

unsafe fn copy_out(device: &ash::Device, cmd: vk::CommandBuffer, barriers: &mut Barriers, from: Object, buffer: vk::Buffer) {
    let target = Object::Buffer { buffer, size: vk::WHOLE_SIZE };
    // SAFETY: `cmd` is recording and the buffer live. An earlier copy may have filled the same buffer.
    unsafe { barriers.single(device, cmd, target, [COPIED, COPIED], false) };
    // SAFETY: `cmd` is recording; image or buffer is live and in the state of a copy's source, and `buffer` has room for all of it.
    unsafe {
        match from {
            Object::Image(image) => {
                let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
                device.cmd_copy_image_to_buffer(cmd, image.image, layout, buffer, &[region(&image, [0; 2], image.extent)]);
            }
            Object::Buffer { buffer: from, size } => {
                let region = vk::BufferCopy { src_offset: 0, dst_offset: 0, size };
                device.cmd_copy_buffer(cmd, from, buffer, &[region]);
            }
        }
    }
    // SAFETY: `cmd` is recording and the buffer live, written by the copy before.
    unsafe { barriers.single(device, cmd, target, [COPIED, READ_BY_HOST], false) };
}

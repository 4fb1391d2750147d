//! How the CPU hands data to the device: a staging buffer, and a device buffer that shaders may read as texels.

use std::sync::Arc;

use ash::vk;
use bytemuck::Pod;

use super::{Bound, Buffer, Gpu, MemoryKind, Shared};
use crate::error::{Doing, Error, Result};

/// A device buffer and its staging twin: write on the CPU, then record the copy.
pub struct Upload {
    /// The buffer on the device.
    pub buffer: Buffer,
    // Before the buffer that it views.
    texels: Option<TexelView>,
    staging: Buffer,
    pending: u64,
}

impl Upload {
    /// Room for `capacity` bytes.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, name: &str, capacity: u64) -> Result<Self> {
        let buffer = Buffer::new(gpu, name, capacity, MemoryKind::Device)?;
        Ok(Self { texels: None, buffer, staging: Buffer::new(gpu, name, capacity, MemoryKind::Upload)?, pending: 0 })
    }

    /// Room for `count` elements of `T`, which shaders read as texels of four words.
    ///
    /// # Errors
    /// More texels than the device allows, or no memory.
    pub fn texels<T: Pod>(gpu: &Gpu, name: &'static str, count: usize) -> Result<Self> {
        let mut upload = Self::new(gpu, name, (count * std::mem::size_of::<T>()) as u64)?;
        upload.texels = Some(TexelView::new(gpu, name, &upload.buffer)?);
        Ok(upload)
    }

    /// How a descriptor set takes it.
    pub(crate) fn bound(&self) -> Bound {
        self.texels.as_ref().map_or(Bound::Storage(self.buffer.handle), |view| Bound::Texels(view.handle))
    }

    /// Replaces the first bytes by `data`; what is beyond the capacity is left out. An earlier copy must be complete.
    pub fn write<T: Pod>(&mut self, data: &[T]) {
        let source: &[u8] = bytemuck::cast_slice(data);
        let target = self.staging.bytes_mut();
        let length = source.len().min(target.len());
        target[..length].copy_from_slice(&source[..length]);
        self.pending = length as u64;
    }

    /// Records the copy of what was written since the last time. The caller places the barriers
    /// (`TRANSFER`, `TRANSFER_WRITE`).
    pub fn record(&mut self, device: &ash::Device, cmd: vk::CommandBuffer) {
        let size = std::mem::take(&mut self.pending);
        if size > 0 {
            // SAFETY: `cmd` is recording; both buffers live as long as `self` and are at least `size` long.
            unsafe {
                device.cmd_copy_buffer(cmd, self.staging.handle, self.buffer.handle, &[vk::BufferCopy::default().size(size)])
            };
        }
    }
}

/// A view of a whole buffer as texels of four 32-bit words.
struct TexelView {
    handle: vk::BufferView,
    shared: Arc<Shared>,
}

impl TexelView {
    fn new(gpu: &Gpu, what: &'static str, buffer: &Buffer) -> Result<Self> {
        let (texels, limit) = ((buffer.size / 16) as usize, gpu.limits().max_texel_buffer_elements as usize);
        if texels > limit {
            return Err(Error::SceneLimit { what, given: texels, limit });
        }
        let info = vk::BufferViewCreateInfo::default()
            .buffer(buffer.handle)
            .format(vk::Format::R32G32B32A32_UINT)
            .range(texels as u64 * 16);
        // SAFETY: the buffer is alive, has the usage, and every device views it in this format.
        let handle = unsafe { gpu.device().create_buffer_view(&info, None) }.doing("create a buffer view")?;
        Ok(Self { handle, shared: gpu.shared.clone() })
    }
}

impl Drop for TexelView {
    fn drop(&mut self) {
        // SAFETY: every submit here waits, so no pending work uses the view.
        unsafe { self.shared.device.destroy_buffer_view(self.handle, None) };
    }
}

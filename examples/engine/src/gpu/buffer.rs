//! Buffers and their memory.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;

use super::memory::Memory;
use super::{Gpu, Shared};
use crate::error::{Doing, Result};

/// Where a buffer's memory lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemoryKind {
    /// On the device; the CPU cannot see it.
    Device,
    /// Written by the CPU.
    Upload,
    /// Read by the CPU.
    Readback,
}

/// A buffer and its memory. Usage: storage, texels, transfer source and destination.
pub struct Buffer {
    /// The buffer.
    pub handle: vk::Buffer,
    /// Its size in bytes.
    pub size: u64,
    memory: Option<Memory>,
    shared: Arc<Shared>,
}

impl Buffer {
    /// Makes a buffer of at least 16 bytes; its content is undefined.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, name: &str, size: u64, kind: MemoryKind) -> Result<Self> {
        let size = size.max(16);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER
            | vk::BufferUsageFlags::UNIFORM_TEXEL_BUFFER
            | vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(size).usage(usage);
        // SAFETY: the device is alive and the size is not zero.
        let handle = unsafe { gpu.device().create_buffer(&info, None) }.doing("create a buffer")?;
        let mut buffer = Self { handle, size, memory: None, shared: gpu.shared.clone() };
        // SAFETY: the buffer was just made by this device.
        let requirements = unsafe { gpu.device().get_buffer_memory_requirements(handle) };
        let location = match kind {
            MemoryKind::Device => MemoryLocation::GpuOnly,
            MemoryKind::Upload => MemoryLocation::CpuToGpu,
            MemoryKind::Readback => MemoryLocation::GpuToCpu,
        };
        let (memory, offset) = buffer.memory.insert(Memory::new(&gpu.shared, name, requirements, location, true)?).place();
        // SAFETY: fresh memory of the size and kind that the buffer asked for, bound once.
        unsafe { gpu.device().bind_buffer_memory(handle, memory, offset) }.doing("bind a buffer's memory")?;
        Ok(buffer)
    }

    /// What the CPU can see of it (nothing, for device memory).
    pub fn bytes(&self) -> &[u8] {
        let mapped = self.memory.as_ref().map_or(&[][..], Memory::bytes);
        &mapped[..mapped.len().min(self.size as usize)]
    }

    pub(super) fn bytes_mut(&mut self) -> &mut [u8] {
        self.memory.as_mut().map_or(&mut [][..], Memory::bytes_mut)
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: the owner keeps a buffer until the work that uses it is complete (every submit here waits).
        unsafe { self.shared.device.destroy_buffer(self.handle, None) };
    }
}

//! Buffers and their memory.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use gpu_allocator::MemoryLocation;

use super::{Gpu, Shared};
use crate::error::{Doing, Error, Result};

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
    allocation: Option<Allocation>,
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
        let mut buffer = Self { handle, size, allocation: None, shared: gpu.shared.clone() };
        // SAFETY: the buffer was just made by this device.
        let requirements = unsafe { gpu.device().get_buffer_memory_requirements(handle) };
        let location = match kind {
            MemoryKind::Device => MemoryLocation::GpuOnly,
            MemoryKind::Upload => MemoryLocation::CpuToGpu,
            MemoryKind::Readback => MemoryLocation::GpuToCpu,
        };
        let description = AllocationCreateDesc {
            name,
            requirements,
            location,
            linear: true,
            allocation_scheme: AllocationScheme::GpuAllocatorManaged,
        };
        let allocation = gpu.allocator().allocate(&description).map_err(|source| Error::Memory {
            what: name.into(),
            bytes: requirements.size,
            source,
        })?;
        let memory = &*buffer.allocation.insert(allocation);
        // SAFETY: fresh memory of the size and kind that the buffer asked for, bound once.
        unsafe { gpu.device().bind_buffer_memory(handle, memory.memory(), memory.offset()) }.doing("bind a buffer's memory")?;
        Ok(buffer)
    }

    /// What the CPU can see of it (nothing, for device memory).
    pub fn bytes(&self) -> &[u8] {
        let mapped = self.allocation.as_ref().and_then(|allocation| allocation.mapped_slice()).unwrap_or_default();
        &mapped[..mapped.len().min(self.size as usize)]
    }

    pub(super) fn bytes_mut(&mut self) -> &mut [u8] {
        self.allocation.as_mut().and_then(|allocation| allocation.mapped_slice_mut()).unwrap_or_default()
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: the owner keeps a buffer until the work that uses it is complete (every submit here waits).
        unsafe { self.shared.device.destroy_buffer(self.handle, None) };
        if let Some(allocation) = self.allocation.take() {
            // Freeing what this allocator gave cannot fail; there is nobody to tell if it did.
            let _ = self.shared.allocator().free(allocation);
        }
    }
}

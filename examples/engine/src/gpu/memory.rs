//! Memory of a buffer or an image.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};
use gpu_allocator::MemoryLocation;

use super::Shared;
use crate::error::{Error, Result};

/// Freed when dropped. Its owner destroys what is bound to it before.
pub(super) struct Memory {
    allocation: Allocation,
    shared: Arc<Shared>,
}

impl Memory {
    /// `linear`: for a buffer.
    pub fn new(
        shared: &Arc<Shared>,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Self> {
        let description =
            AllocationCreateDesc { name, requirements, location, linear, allocation_scheme: AllocationScheme::GpuAllocatorManaged };
        let allocation = shared.allocator().allocate(&description);
        let failed = |source| Error::Memory { what: name.into(), bytes: requirements.size, source };
        Ok(Self { allocation: allocation.map_err(failed)?, shared: shared.clone() })
    }

    /// The block that it lies in, and where.
    pub fn place(&self) -> (vk::DeviceMemory, vk::DeviceSize) {
        // SAFETY: the block is freed with `self` at the earliest; what is bound to it goes before.
        (unsafe { self.allocation.memory() }, self.allocation.offset())
    }

    /// What the CPU can see of it (nothing, for device memory).
    pub fn bytes(&self) -> &[u8] {
        self.allocation.mapped_slice().unwrap_or_default()
    }

    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.allocation.mapped_slice_mut().unwrap_or_default()
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // Freeing what this allocator gave cannot fail; there is nobody to tell if it did.
        let _ = self.shared.allocator().free(std::mem::take(&mut self.allocation));
    }
}

//! Blocks of device memory: exactly as large as what lies in them.

use crate::error::Error;
use crate::record::Device;
use ash::vk;

/// What a device says about its memory.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    types: vk::PhysicalDeviceMemoryProperties,
    /// Bytes that a buffer and an image lie apart at least.
    granularity: u64,
    /// Bytes of the largest block.
    largest: u64,
}

/// An object, or what shares a place, as it has to lie in memory.
#[derive(Clone, Debug)]
pub(super) struct Demand {
    /// For messages.
    pub name: String,
    pub requirements: vk::MemoryRequirements,
}

/// The place of a demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub block: usize,
    pub offset: u64,
}

/// A block that is not yet allocated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    memory_type: u32,
    pub size: u64,
}

impl Limits {
    /// # Safety
    /// Instance and physical device are live.
    pub(super) unsafe fn new(host: Device<'_>, largest_block: Option<u64>) -> Self {
        let mut maintenance = vk::PhysicalDeviceMaintenance3Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut maintenance);
        // SAFETY: both are live; Vulkan 1.1, which every host has, has the second call.
        let types = unsafe {
            host.instance.get_physical_device_properties2(host.physical_device, &mut properties);
            host.instance.get_physical_device_memory_properties(host.physical_device)
        };
        let granularity = properties.properties.limits.buffer_image_granularity;
        let largest = maintenance.max_memory_allocation_size;
        Self { types, granularity, largest: largest_block.map_or(largest, |wanted| wanted.min(largest)) }
    }

    /// The memory type for an object: on the device where that is to be had.
    fn memory_type(&self, bits: u32) -> Option<u32> {
        let allowed = || (0..self.types.memory_type_count).filter(|i| bits >> i & 1 == 1);
        let flags = |i: u32| self.types.memory_types[i as usize].property_flags;
        let unusable = vk::MemoryPropertyFlags::PROTECTED | vk::MemoryPropertyFlags::LAZILY_ALLOCATED;
        let local = |i: &u32| flags(*i).contains(vk::MemoryPropertyFlags::DEVICE_LOCAL) && !flags(*i).intersects(unusable);
        allowed().find(local).or_else(|| allowed().find(|i| !flags(*i).intersects(unusable)))
    }

    /// Blocks for all demands, in their order, and the place of each.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] for a demand that no type of memory meets.
    pub(super) fn plan(&self, demands: &[Demand]) -> Result<(Vec<Block>, Vec<Place>), Error> {
        let (mut blocks, mut places) = (Vec::<Block>::new(), Vec::with_capacity(demands.len()));
        for Demand { name, requirements } in demands {
            let none = || Error::OutOfMemory { what: name.clone(), bytes: requirements.size };
            let memory_type = self.memory_type(requirements.memory_type_bits).ok_or_else(none)?;
            let alignment = requirements.alignment.max(self.granularity).max(1);
            let open = blocks.iter().rposition(|block| block.memory_type == memory_type);
            let fitting = open.map(|block| Place { block, offset: blocks[block].size.next_multiple_of(alignment) });
            let place = fitting.filter(|place| place.offset + requirements.size <= self.largest).unwrap_or_else(|| {
                blocks.push(Block { memory_type, size: 0 });
                Place { block: blocks.len() - 1, offset: 0 }
            });
            blocks[place.block].size = place.offset + requirements.size;
            places.push(place);
        }
        Ok((blocks, places))
    }
}

impl Block {
    /// # Safety
    /// The device is live, and that of the limits.
    pub(super) unsafe fn allocate(&self, device: &ash::Device, all: &[Self]) -> Result<vk::DeviceMemory, Error> {
        let info = vk::MemoryAllocateInfo::default().allocation_size(self.size).memory_type_index(self.memory_type);
        // SAFETY: the type is one of the device's.
        unsafe { device.allocate_memory(&info, None) }.map_err(|_| {
            let total: u64 = all.iter().map(|block| block.size).sum();
            let what = format!("histories, transients and outputs, which take {total} bytes in all");
            Error::OutOfMemory { what, bytes: self.size }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits(largest: u64) -> Limits {
        let mut types = vk::PhysicalDeviceMemoryProperties { memory_type_count: 3, ..Default::default() };
        types.memory_types[0].property_flags = vk::MemoryPropertyFlags::HOST_VISIBLE;
        types.memory_types[1].property_flags = vk::MemoryPropertyFlags::DEVICE_LOCAL | vk::MemoryPropertyFlags::PROTECTED;
        types.memory_types[2].property_flags = vk::MemoryPropertyFlags::DEVICE_LOCAL;
        Limits { types, granularity: 16, largest }
    }

    fn demand(size: u64, alignment: u64, memory_type_bits: u32) -> Demand {
        Demand { name: "an image".into(), requirements: vk::MemoryRequirements { size, alignment, memory_type_bits } }
    }

    fn sizes(blocks: &[Block]) -> Vec<u64> {
        blocks.iter().map(|block| block.size).collect()
    }

    #[test]
    fn a_block_is_as_large_as_what_lies_in_it() {
        let (blocks, places) = limits(u64::MAX).plan(&[demand(100, 4, 7), demand(10, 64, 7), demand(1, 1, 7)]).expect("planned");
        assert_eq!(sizes(&blocks), [145]);
        assert_eq!(places.iter().map(|place| place.offset).collect::<Vec<_>>(), [0, 128, 144]);
        assert_eq!(blocks[0].memory_type, 2, "on the device, and not protected");
    }

    #[test]
    fn what_does_not_fit_opens_another_block_and_what_is_larger_than_all_has_its_own() {
        let (blocks, places) = limits(256).plan(&[demand(200, 1, 7), demand(100, 1, 7), demand(1000, 1, 7)]).expect("planned");
        assert_eq!(sizes(&blocks), [200, 100, 1000]);
        assert!(places.iter().all(|place| place.offset == 0));
    }

    #[test]
    fn each_type_of_memory_has_its_blocks() {
        let (blocks, places) = limits(u64::MAX).plan(&[demand(8, 1, 4), demand(8, 1, 1), demand(8, 1, 4)]).expect("planned");
        assert_eq!(sizes(&blocks), [24, 8]);
        assert_eq!(places.iter().map(|place| place.block).collect::<Vec<_>>(), [0, 1, 0]);
        let error = limits(u64::MAX).plan(&[demand(8, 1, 2)]).expect_err("protected memory alone").to_string();
        assert!(error.contains("an image") && error.contains('8'), "{error}");
    }
}

//! One command buffer at a time, submitted and waited for; and reading images back.

use std::time::{Duration, Instant};

use ash::vk;

use super::image::WHOLE_IMAGE;
use super::{Buffer, Gpu, Image, MemoryKind};
use crate::error::{Doing, Result};

/// A wait looks again after this share of the time that it has taken so far: short against the work, and few looks at long work.
const POLLING_SHARE: f64 = 1.0 / 16.0;
const SHORTEST_PAUSE: Duration = Duration::from_micros(50);
const LONGEST_PAUSE: Duration = Duration::from_millis(2);

/// All that an image here has.
const WHOLE_LAYER: vk::ImageSubresourceLayers =
    vk::ImageSubresourceLayers { aspect_mask: WHOLE_IMAGE.aspect_mask, mip_level: 0, base_array_layer: 0, layer_count: 1 };

impl Gpu {
    /// Records with `record`, submits, and waits until the device is done. `record` must not submit or read images
    /// itself: the command pool is locked meanwhile.
    ///
    /// # Errors
    /// What `record` returns, and a lost device.
    pub fn submit<T>(&self, record: impl FnOnce(vk::CommandBuffer) -> Result<T>) -> Result<T> {
        let device = self.device();
        let pool = self.shared.command_pool.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let info = vk::CommandBufferAllocateInfo::default().command_pool(*pool).command_buffer_count(1);
        // SAFETY: the pool is locked, so this thread is the only one to use it.
        let cmd = unsafe { device.allocate_command_buffers(&info) }.doing("allocate a command buffer")?[0];
        let result = self.record_and_wait(cmd, record);
        // SAFETY: the wait is over (or nothing was submitted), so the command buffer is not in use.
        unsafe { device.free_command_buffers(*pool, &[cmd]) };
        result
    }

    fn record_and_wait<T>(&self, cmd: vk::CommandBuffer, record: impl FnOnce(vk::CommandBuffer) -> Result<T>) -> Result<T> {
        let device = self.device();
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: `cmd` is fresh.
        unsafe { device.begin_command_buffer(cmd, &begin) }.doing("begin a command buffer")?;
        let value = record(cmd)?;
        // SAFETY: `cmd` is recording.
        unsafe { device.end_command_buffer(cmd) }.doing("end a command buffer")?;
        let commands = [cmd];
        let submits = [vk::SubmitInfo::default().command_buffers(&commands)];
        // SAFETY: the device is alive.
        let fence = unsafe { device.create_fence(&vk::FenceCreateInfo::default(), None) }.doing("create a fence")?;
        // SAFETY: the queue belongs to the device and is locked.
        let submitted = unsafe { device.queue_submit(*self.queue(), &submits, fence) };
        let done = submitted.and_then(|()| self.wait(fence));
        // SAFETY: nothing waits for it any more.
        unsafe { device.destroy_fence(fence, None) };
        done.doing("submit and wait for the device")?;
        Ok(value)
    }

    /// Another thread may submit while this one waits.
    fn wait(&self, fence: vk::Fence) -> std::result::Result<(), vk::Result> {
        let start = Instant::now();
        while !self.is_signalled(fence)? {
            std::thread::sleep(start.elapsed().mul_f64(POLLING_SHARE).clamp(SHORTEST_PAUSE, LONGEST_PAUSE));
        }
        Ok(())
    }

    /// Whether a fence that was submitted is signalled. Asked with the queue locked: the validation layer loses track of a wait that ends while
    /// another thread submits, and reports hazards that are none.
    pub fn is_signalled(&self, fence: vk::Fence) -> std::result::Result<bool, vk::Result> {
        let _queue = self.queue();
        // SAFETY: the fence is the device's.
        match unsafe { self.device().wait_for_fences(&[fence], true, 0) } {
            Ok(()) => Ok(true),
            Err(vk::Result::TIMEOUT) => Ok(false),
            Err(result) => Err(result),
        }
    }

    /// Texels of an image in layout `GENERAL`, row by row. Integers are converted to floating point; missing channels are 0.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read_image(&self, image: &Image) -> Result<Vec<[f32; 4]>> {
        let bytes = self.read_bytes(image)?;
        let texels = bytes.chunks_exact(image.texel_bytes() as usize);
        Ok(match image.format {
            vk::Format::R16G16B16A16_SFLOAT => texels.map(half_texel).collect(),
            vk::Format::R32_SFLOAT => texels.map(|t| [f32::from_bits(word(t, 0)), 0.0, 0.0, 0.0]).collect(),
            vk::Format::R32_UINT => texels.map(|t| [word(t, 0) as f32, 0.0, 0.0, 0.0]).collect(),
            vk::Format::R8G8B8A8_UNORM => texels.map(|t| [0, 1, 2, 3].map(|i| f32::from(t[i]) / 255.0)).collect(),
            vk::Format::R32G32B32A32_UINT => texels.map(|t| [0, 1, 2, 3].map(|i| word(t, i) as f32)).collect(),
            _ => texels.map(|t| [0, 1, 2, 3].map(|i| f32::from_bits(word(t, i)))).collect(),
        })
    }

    /// First channel of an image of 32-bit integers in layout `GENERAL`, row by row.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read_image_u32(&self, image: &Image) -> Result<Vec<u32>> {
        let bytes = self.read_bytes(image)?;
        Ok(bytes.chunks_exact(image.texel_bytes() as usize).map(|texel| word(texel, 0)).collect())
    }

    /// The bytes of an image in layout `GENERAL`, as its format lays them out, without padding.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read_bytes(&self, image: &Image) -> Result<Vec<u8>> {
        let size = u64::from(image.extent.width) * u64::from(image.extent.height) * image.texel_bytes();
        let target = Buffer::new(self, "readback", size, MemoryKind::Readback)?;
        self.submit(|cmd| {
            self.record_readback(cmd, image, vk::Offset3D::default(), image.extent.into(), &target);
            Ok(())
        })?;
        Ok(target.bytes()[..size as usize].to_vec())
    }

    /// One texel of an image of half floats in layout `GENERAL`; zeros outside of it.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read_half_texel(&self, image: &Image, [x, y]: [u32; 2]) -> Result<[f32; 4]> {
        if x >= image.extent.width || y >= image.extent.height {
            return Ok([0.0; 4]);
        }
        let target = Buffer::new(self, "texel", 8, MemoryKind::Readback)?;
        let (offset, extent) = (vk::Offset3D { x: x as i32, y: y as i32, z: 0 }, vk::Extent3D { width: 1, height: 1, depth: 1 });
        self.submit(|cmd| {
            self.record_readback(cmd, image, offset, extent, &target);
            Ok(())
        })?;
        Ok(half_texel(&target.bytes()[..8]))
    }

    /// Replaces the texels of an image of half floats in layout `GENERAL`, row by row. Those that are not given become 0, and those beyond
    /// its end are left out.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn write_half_texels(&self, image: &Image, texels: &[[f32; 4]]) -> Result<()> {
        let size = u64::from(image.extent.width) * u64::from(image.extent.height) * image.texel_bytes();
        let mut source = Buffer::new(self, "upload", size, MemoryKind::Upload)?;
        let given = texels.iter().flatten().map(|value| half::f16::from_f32(*value)).chain(std::iter::repeat(half::f16::ZERO));
        for (bytes, value) in source.bytes_mut().chunks_exact_mut(2).zip(given) {
            bytes.copy_from_slice(&value.to_le_bytes());
        }
        let region = vk::BufferImageCopy::default().image_subresource(WHOLE_LAYER).image_extent(image.extent.into());
        let before = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::TRANSFER_WRITE);
        let (all, copy) = (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::TRANSFER);
        self.submit(|cmd| {
            // SAFETY: `cmd` is recording; the image is in GENERAL, and the buffer has all of its texels. The submission is waited for.
            unsafe {
                let device = self.device();
                device.cmd_pipeline_barrier(cmd, all, copy, vk::DependencyFlags::empty(), &[before], &[], &[]);
                device.cmd_copy_buffer_to_image(cmd, source.handle, image.handle, vk::ImageLayout::GENERAL, &[region]);
            }
            Ok(())
        })
    }

    fn record_readback(&self, cmd: vk::CommandBuffer, image: &Image, offset: vk::Offset3D, extent: vk::Extent3D, target: &Buffer) {
        let device = self.device();
        let before = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::MEMORY_WRITE)
            .dst_access_mask(vk::AccessFlags::TRANSFER_READ);
        let after = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
            .dst_access_mask(vk::AccessFlags::HOST_READ);
        let region = vk::BufferImageCopy::default().image_subresource(WHOLE_LAYER).image_offset(offset).image_extent(extent);
        let (all, copy, host) =
            (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::TRANSFER, vk::PipelineStageFlags::HOST);
        let none = vk::DependencyFlags::empty();
        // SAFETY: `cmd` is recording; the image is in GENERAL, and the part lies in it, and the buffer has room for its texels.
        unsafe {
            device.cmd_pipeline_barrier(cmd, all, copy, none, &[before], &[], &[]);
            device.cmd_copy_image_to_buffer(cmd, image.handle, vk::ImageLayout::GENERAL, target.handle, &[region]);
            device.cmd_pipeline_barrier(cmd, copy, host, none, &[after], &[], &[]);
        }
    }
}

fn word(texel: &[u8], index: usize) -> u32 {
    let at = 4 * index;
    u32::from_le_bytes([texel[at], texel[at + 1], texel[at + 2], texel[at + 3]])
}

fn half_texel(texel: &[u8]) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| half::f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32())
}

//! Textures and buffers of the render world as numbers.

use bevy::prelude::*;
use bevy::render::renderer::{RenderDevice, RenderQueue};

/// The bytes of a buffer with `COPY_SRC`.
pub fn buffer(world: &World, source: &wgpu::Buffer) -> Result<Vec<u8>, BevyError> {
    read(world, source.size(), |encoder, staging| encoder.copy_buffer_to_buffer(source, 0, staging, 0, source.size()))
}

/// The texels of a texture with `COPY_SRC`, row by row, tightly packed.
pub fn texture(world: &World, source: &wgpu::Texture) -> Result<Vec<u8>, BevyError> {
    let texel = source.format().block_copy_size(None).ok_or("a format without a size")?;
    let packed = source.width() * texel;
    let row = packed.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let bytes = read(world, u64::from(row * source.height()), |encoder, staging| {
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        let target = wgpu::TexelCopyBufferInfo { buffer: staging, layout };
        encoder.copy_texture_to_buffer(source.as_image_copy(), target, source.size());
    })?;
    Ok(bytes.chunks_exact(row as usize).flat_map(|row| &row[..packed as usize]).copied().collect())
}

/// RGB of a texture of four half floats.
pub fn radiance(world: &World, source: &wgpu::Texture) -> Result<Vec<[f32; 3]>, BevyError> {
    let half = |bytes: &[u8], i: usize| half::f16::from_le_bytes([bytes[2 * i], bytes[2 * i + 1]]).to_f32();
    Ok(texture(world, source)?.chunks_exact(8).map(|texel| [half(texel, 0), half(texel, 1), half(texel, 2)]).collect())
}

fn read(world: &World, size: u64, copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer)) -> Result<Vec<u8>, BevyError> {
    let (device, queue) = (world.resource::<RenderDevice>().wgpu_device(), world.resource::<RenderQueue>());
    let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
    let staging = device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let mut encoder = device.create_command_encoder(&default());
    copy(&mut encoder, &staging);
    queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |_| {});
    device.poll(wgpu::PollType::Wait { submission_index: None, timeout: None })?;
    let bytes = staging.get_mapped_range(..)?.to_vec();
    Ok(bytes)
}

//! The barriers between the passes, in the form that every Vulkan has.

use ash::vk;

use crate::gpu::{Image, WHOLE_IMAGE};

/// (stage, access) before and after.
pub type Scope = (vk::PipelineStageFlags, vk::AccessFlags);

/// A barrier on all memory.
pub fn memory_barrier(device: &ash::Device, cmd: vk::CommandBuffer, from: Scope, to: Scope) {
    let barrier = [vk::MemoryBarrier::default().src_access_mask(from.1).dst_access_mask(to.1)];
    // SAFETY: `cmd` is recording outside a render pass.
    unsafe { device.cmd_pipeline_barrier(cmd, from.0, to.0, vk::DependencyFlags::empty(), &barrier, &[], &[]) };
}

/// Waits for every earlier use and brings images to `GENERAL`, dropping what they held.
pub fn general_barrier(device: &ash::Device, cmd: vk::CommandBuffer, images: &[&Image]) {
    let barriers: Vec<_> = images
        .iter()
        .map(|image| {
            vk::ImageMemoryBarrier::default()
                .image(image.handle)
                .subresource_range(WHOLE_IMAGE)
                .old_layout(vk::ImageLayout::UNDEFINED)
                .new_layout(vk::ImageLayout::GENERAL)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .src_access_mask(vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE)
                .dst_access_mask(vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE)
        })
        .collect();
    let (all, compute) = (vk::PipelineStageFlags::ALL_COMMANDS, vk::PipelineStageFlags::COMPUTE_SHADER);
    // SAFETY: `cmd` is recording outside a render pass, and the images are alive.
    unsafe { device.cmd_pipeline_barrier(cmd, all, compute, vk::DependencyFlags::empty(), &[], &[], &barriers) };
}

//! The pass that encodes what was drawn, for formats that do not do it themselves.

use ash::vk;

use super::fullscreen;
use super::panes::ENCODE_FRAG;
use super::surface_format::{Encoding, SDR_WHITE_NITS};
use crate::error::{Doing, Result};
use crate::gpu::{Gpu, Image};

/// The pipeline for subpass 1 of a render pass, which reads what subpass 0 drew.
pub struct Encoder {
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    /// Push constants of glsl/window/encode.frag.
    constants: [f32; 2],
    gpu: Gpu,
}

impl Encoder {
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, render_pass: vk::RenderPass, encoding: Encoding) -> Result<Self> {
        let white_nits = if encoding == Encoding::Hdr10 { SDR_WHITE_NITS } else { 0.0 };
        let mut made = Self {
            set_layout: vk::DescriptorSetLayout::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
            pool: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
            constants: [white_nits, encoding.peak()],
            gpu: gpu.clone(),
        };
        made.make_layouts()?;
        made.pipeline = fullscreen::create_pipeline(gpu, made.layout, render_pass, 1, &ENCODE_FRAG)?;
        Ok(made)
    }

    fn make_layouts(&mut self) -> Result<()> {
        let device = self.gpu.device();
        let kind = vk::DescriptorType::INPUT_ATTACHMENT;
        let stage = vk::ShaderStageFlags::FRAGMENT;
        let bindings = [vk::DescriptorSetLayoutBinding::default().descriptor_type(kind).descriptor_count(1).stage_flags(stage)];
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive, and every info refers to locals or to what was just made.
        unsafe {
            self.set_layout = device.create_descriptor_set_layout(&info, None).doing("create a descriptor set layout")?;
            let sets = [self.set_layout];
            let ranges = [vk::PushConstantRange { stage_flags: stage, offset: 0, size: size_of_val(&self.constants) as u32 }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&ranges);
            self.layout = device.create_pipeline_layout(&info, None).doing("create a pipeline layout")?;
            let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: 1 }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
            self.pool = device.create_descriptor_pool(&info, None).doing("create a descriptor pool")?;
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.pool).set_layouts(&sets);
            self.set = device.allocate_descriptor_sets(&info).doing("allocate descriptor sets")?[0];
        }
        Ok(())
    }

    /// From now on this is what is encoded. No frame may be in flight.
    pub fn point_at(&mut self, canvas: &Image) {
        let layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let info = [vk::DescriptorImageInfo::default().image_view(canvas.view).image_layout(layout)];
        let kind = vk::DescriptorType::INPUT_ATTACHMENT;
        let write = vk::WriteDescriptorSet::default().dst_set(self.set).descriptor_type(kind).image_info(&info);
        // SAFETY: the set is not in use, says the caller; the view is alive.
        unsafe { self.gpu.device().update_descriptor_sets(&[write], &[]) };
    }

    /// Draws, in subpass 1.
    pub fn record(&self, cmd: vk::CommandBuffer, extent: vk::Extent2D) {
        let device = self.gpu.device();
        let scissor = vk::Rect2D { extent, ..Default::default() };
        // SAFETY: `cmd` is recording in this subpass; pipeline, layout and set belong together.
        unsafe {
            device.cmd_bind_pipeline(cmd, vk::PipelineBindPoint::GRAPHICS, self.pipeline);
            device.cmd_bind_descriptor_sets(cmd, vk::PipelineBindPoint::GRAPHICS, self.layout, 0, &[self.set], &[]);
            let constants = bytemuck::cast_slice(&self.constants);
            device.cmd_push_constants(cmd, self.layout, vk::ShaderStageFlags::FRAGMENT, 0, constants);
            fullscreen::draw(device, cmd, extent, scissor);
        }
    }
}

impl Drop for Encoder {
    fn drop(&mut self) {
        let device = self.gpu.device();
        // SAFETY: ours or null, and the owner waits for its frames first.
        unsafe {
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_descriptor_pool(self.pool, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

#[cfg(test)]
mod tests;

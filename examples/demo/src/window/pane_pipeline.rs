//! The graphics pipeline that draws the panes into the window.

use std::sync::Arc;

use ash::vk;
use bytemuck::{Pod, Zeroable};

use super::fullscreen;
use super::panes::{Panes, PRESENT_FRAG};
use crate::error::{Doing, Result};
use crate::gpu::Gpu;

/// Push constants of glsl/window/present.frag, which documents them.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Presented {
    pub rect: [f32; 4],
    pub extent: [f32; 2],
    pub lens: [f32; 2],
    pub lens_side: f32,
    pub lens_zoom: f32,
    pub divider: f32,
    pub exposure: f32,
    pub display_referred: u32,
    pub tone_curve: u32,
    pub peak: f32,
}

impl Presented {
    /// What there is to draw: the picture alone, unless the magnifier may lie over its border. The rest is cleared to the same colour.
    fn reach(&self, window: vk::Extent2D) -> vk::Rect2D {
        let whole = vk::Rect2D { extent: window, ..Default::default() };
        if self.lens[0] >= 0.0 {
            return whole;
        }
        let [x, y, width, height] = self.rect;
        let within = |from: f32, size: f32, limit: u32| {
            let (start, end) = (from.clamp(0.0, limit as f32) as u32, (from + size).clamp(0.0, limit as f32).ceil() as u32);
            (start as i32, end.saturating_sub(start))
        };
        let ((x, width), (y, height)) = (within(x, width, window.width), within(y, height, window.height));
        vk::Rect2D { offset: vk::Offset2D { x, y }, extent: vk::Extent2D { width, height } }
    }
}

/// The pipeline, with one descriptor set for each frame in flight.
pub struct PanePipeline {
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
    pool: vk::DescriptorPool,
    sets: Vec<vk::DescriptorSet>,
    /// What the sets point at: kept until the next frame of the slot.
    bound: Vec<Option<Arc<Panes>>>,
    gpu: Gpu,
}

impl PanePipeline {
    /// For targets of a render pass.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, render_pass: vk::RenderPass, slots: usize) -> Result<Self> {
        let mut made = Self {
            set_layout: vk::DescriptorSetLayout::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
            pool: vk::DescriptorPool::null(),
            sets: Vec::new(),
            bound: vec![None; slots],
            gpu: gpu.clone(),
        };
        made.make_layouts(slots as u32)?;
        made.make_pipeline(render_pass)?;
        Ok(made)
    }

    fn make_layouts(&mut self, slots: u32) -> Result<()> {
        let device = self.gpu.device();
        let kind = vk::DescriptorType::SAMPLED_IMAGE;
        let binding = |i| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(i)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::FRAGMENT)
        };
        let bindings = [binding(0), binding(1)];
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive, and every info refers to locals or to what was just made.
        unsafe {
            self.set_layout = device.create_descriptor_set_layout(&info, None).doing("create a descriptor set layout")?;
            let (sets, size) = ([self.set_layout], std::mem::size_of::<Presented>() as u32);
            let ranges = [vk::PushConstantRange { stage_flags: vk::ShaderStageFlags::FRAGMENT, offset: 0, size }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets).push_constant_ranges(&ranges);
            self.layout = device.create_pipeline_layout(&info, None).doing("create a pipeline layout")?;
            let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: 2 * slots }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(slots).pool_sizes(&sizes);
            self.pool = device.create_descriptor_pool(&info, None).doing("create a descriptor pool")?;
            let layouts = vec![self.set_layout; slots as usize];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(self.pool).set_layouts(&layouts);
            self.sets = device.allocate_descriptor_sets(&info).doing("allocate descriptor sets")?;
        }
        Ok(())
    }

    /// Makes the pipeline anew, for another format of the window. Nothing may be drawing with it.
    ///
    /// # Errors
    /// No memory.
    pub fn make_pipeline(&mut self, render_pass: vk::RenderPass) -> Result<()> {
        // SAFETY: ours or null, and not in use, says the caller.
        unsafe { self.gpu.device().destroy_pipeline(self.pipeline, None) };
        self.pipeline = vk::Pipeline::null();
        self.pipeline = fullscreen::create_pipeline(&self.gpu, self.layout, render_pass, 0, &PRESENT_FRAG)?;
        Ok(())
    }

    /// Draws, inside a render pass. The slot's last frame is complete.
    pub fn record(&mut self, cmd: vk::CommandBuffer, slot: usize, panes: &Arc<Panes>, extent: vk::Extent2D, presented: &Presented) {
        let device = self.gpu.device();
        if !self.bound[slot].as_ref().is_some_and(|bound| Arc::ptr_eq(bound, panes)) {
            for (binding, image) in (0..).zip(&panes.images) {
                let info = [vk::DescriptorImageInfo::default().image_view(image.view).image_layout(vk::ImageLayout::GENERAL)];
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(self.sets[slot])
                    .dst_binding(binding)
                    .descriptor_type(vk::DescriptorType::SAMPLED_IMAGE)
                    .image_info(&info);
                // SAFETY: the slot's last frame is complete, so the set is not in use; the view is alive.
                unsafe { device.update_descriptor_sets(&[write], &[]) };
            }
            self.bound[slot] = Some(panes.clone());
        }
        let scissor = presented.reach(extent);
        // SAFETY: `cmd` is recording inside a render pass; pipeline, layout and set belong together.
        unsafe {
            device.cmd_bind_pipeline(cmd, vk::PipelineBindPoint::GRAPHICS, self.pipeline);
            device.cmd_bind_descriptor_sets(cmd, vk::PipelineBindPoint::GRAPHICS, self.layout, 0, &[self.sets[slot]], &[]);
            device.cmd_push_constants(cmd, self.layout, vk::ShaderStageFlags::FRAGMENT, 0, bytemuck::bytes_of(presented));
            fullscreen::draw(device, cmd, extent, scissor);
        }
    }
}

impl Drop for PanePipeline {
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
mod tests {
    use super::*;

    #[test]
    fn nothing_is_drawn_outside_of_the_window() {
        let window = vk::Extent2D { width: 100, height: 50 };
        let presented = Presented { rect: [10.0, -5.0, 300.0, 20.0], lens: [-1.0; 2], ..Presented::zeroed() };
        let reach = presented.reach(window);
        assert_eq!((reach.offset.x, reach.offset.y, reach.extent.width, reach.extent.height), (10, 0, 90, 15));
        assert_eq!(Presented { lens: [3.0; 2], ..presented }.reach(window).extent, window);
        assert_eq!(Presented { rect: [200.0, 0.0, 5.0, 5.0], ..presented }.reach(window).extent.width, 0);
    }
}

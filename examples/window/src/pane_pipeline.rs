//! The graphics pipeline that draws the panes into the window.

use std::sync::Arc;

use ash::vk;
use bytemuck::{Pod, Zeroable};

use super::fullscreen::Fullscreen;
use super::panes::{Panes, PRESENT_FRAG};
use atrous_engine::gpu::Gpu;
use atrous_engine::Result;

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
    pub difference_range: f32,
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
    fullscreen: Fullscreen,
    /// What the sets point at: kept until the next frame of the slot.
    bound: Vec<Option<Arc<Panes>>>,
}

impl PanePipeline {
    /// For targets of a render pass.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, render_pass: vk::RenderPass, slots: usize) -> Result<Self> {
        let kind = vk::DescriptorType::SAMPLED_IMAGE;
        let fullscreen = Fullscreen::new(gpu, kind, 2, slots as u32, std::mem::size_of::<Presented>())?;
        let mut made = Self { fullscreen, bound: vec![None; slots] };
        made.make_pipeline(render_pass)?;
        Ok(made)
    }

    /// Makes the pipeline anew, for another format of the window. Nothing may be drawing with it.
    ///
    /// # Errors
    /// No memory.
    pub fn make_pipeline(&mut self, render_pass: vk::RenderPass) -> Result<()> {
        self.fullscreen.make_pipeline(render_pass, 0, &PRESENT_FRAG)
    }

    /// Draws, inside a render pass. The slot's last frame is complete.
    pub fn record(&mut self, cmd: vk::CommandBuffer, slot: usize, panes: &Arc<Panes>, extent: vk::Extent2D, presented: &Presented) {
        if !self.bound[slot].as_ref().is_some_and(|bound| Arc::ptr_eq(bound, panes)) {
            self.fullscreen.point_at(slot, &panes.images, vk::ImageLayout::GENERAL);
            self.bound[slot] = Some(panes.clone());
        }
        self.fullscreen.record(cmd, slot, bytemuck::bytes_of(presented), extent, presented.reach(extent));
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

//! The pass that encodes what was drawn, for formats that do not do it themselves.

use ash::vk;

use super::fullscreen::Fullscreen;
use super::panes::ENCODE_FRAG;
use super::surface_format::{Encoding, SDR_WHITE_NITS};
use atrous_engine::gpu::{Gpu, Image};
use atrous_engine::Result;

/// The pipeline for subpass 1 of a render pass, which reads what subpass 0 drew.
pub struct Encoder {
    fullscreen: Fullscreen,
    /// Push constants of glsl/window/encode.frag.
    constants: [f32; 2],
}

impl Encoder {
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, render_pass: vk::RenderPass, encoding: Encoding) -> Result<Self> {
        let white_nits = if encoding == Encoding::Hdr10 { SDR_WHITE_NITS } else { 0.0 };
        let constants = [white_nits, encoding.peak()];
        let mut fullscreen = Fullscreen::new(gpu, vk::DescriptorType::INPUT_ATTACHMENT, 1, 1, size_of_val(&constants))?;
        fullscreen.make_pipeline(render_pass, 1, &ENCODE_FRAG)?;
        Ok(Self { fullscreen, constants })
    }

    /// From now on this is what is encoded. No frame may be in flight.
    pub fn point_at(&mut self, canvas: &Image) {
        self.fullscreen.point_at(0, [canvas], vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    }

    /// Draws, in subpass 1.
    pub fn record(&self, cmd: vk::CommandBuffer, extent: vk::Extent2D) {
        let scissor = vk::Rect2D { extent, ..Default::default() };
        self.fullscreen.record(cmd, 0, bytemuck::cast_slice(&self.constants), extent, scissor);
    }
}

#[cfg(test)]
mod tests;

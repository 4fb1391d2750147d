//! What the window is drawn into: its format, with the render pass that ends in it.

use ash::vk;

use super::encode::Encoder;
use super::surface_format::Encoding;
use atrous_engine::gpu::{Gpu, Image};
use atrous_engine::Doing;
use atrous_engine::Result;

/// Of the canvas: as precise as the brightest display.
const CANVAS_FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

/// A render pass whose subpass 0 draws in linear light. Where the format does not encode that by itself, subpass 0 draws into a canvas, and
/// subpass 1 encodes from there, so that the panel is blended alike in every format.
pub struct Target {
    pub format: vk::SurfaceFormatKHR,
    pub encoding: Encoding,
    pub render_pass: vk::RenderPass,
    encoder: Option<Encoder>,
    gpu: Gpu,
}

impl Target {
    /// `layout`: of the image when it was drawn.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, format: vk::SurfaceFormatKHR, encoding: Encoding, layout: vk::ImageLayout) -> Result<Self> {
        let device = gpu.device();
        let render_pass = match encoding.is_in_shader() {
            false => create_render_pass(device, format.format, layout),
            true => create_encoding_render_pass(device, format.format, layout),
        }?;
        let mut made = Self { format, encoding, render_pass, encoder: None, gpu: gpu.clone() };
        if encoding.is_in_shader() {
            made.encoder = Some(Encoder::new(gpu, render_pass, encoding)?);
        }
        Ok(made)
    }

    /// What subpass 0 draws into instead of the image, where it does. One serves all frames in flight.
    ///
    /// # Errors
    /// No memory.
    pub fn canvas(&self, extent: vk::Extent2D) -> Result<Option<Image>> {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::INPUT_ATTACHMENT;
        let canvas = |_: &Encoder| Image::with_usage(&self.gpu, "canvas", CANVAS_FORMAT, extent, usage);
        self.encoder.as_ref().map(canvas).transpose()
    }

    /// From now on this canvas is encoded. No frame may be in flight.
    pub fn point_at(&mut self, canvas: Option<&Image>) {
        if let (Some(encoder), Some(canvas)) = (&mut self.encoder, canvas) {
            encoder.point_at(canvas);
        }
    }

    /// A framebuffer for an image of the window.
    ///
    /// # Errors
    /// No memory.
    pub fn framebuffer(&self, view: vk::ImageView, canvas: Option<&Image>, extent: vk::Extent2D) -> Result<vk::Framebuffer> {
        let attachments: Vec<_> = canvas.map(|canvas| canvas.view).into_iter().chain([view]).collect();
        let info = vk::FramebufferCreateInfo::default()
            .render_pass(self.render_pass)
            .attachments(&attachments)
            .width(extent.width)
            .height(extent.height)
            .layers(1);
        // SAFETY: views and render pass are alive and of the same formats.
        unsafe { self.gpu.device().create_framebuffer(&info, None) }.doing("create a framebuffer")
    }

    /// Begins the render pass; `ground` is what is under everything, linear.
    pub fn begin(&self, cmd: vk::CommandBuffer, framebuffer: vk::Framebuffer, extent: vk::Extent2D, ground: f32) {
        let clear = [vk::ClearValue { color: vk::ClearColorValue { float32: [ground, ground, ground, 1.0] } }];
        let pass = vk::RenderPassBeginInfo::default()
            .render_pass(self.render_pass)
            .framebuffer(framebuffer)
            .render_area(vk::Rect2D { extent, ..Default::default() })
            .clear_values(&clear);
        // SAFETY: `cmd` is recording; render pass and framebuffer belong together.
        unsafe { self.gpu.device().cmd_begin_render_pass(cmd, &pass, vk::SubpassContents::INLINE) };
    }

    /// Encodes what was drawn, and ends the render pass.
    pub fn end(&self, cmd: vk::CommandBuffer, extent: vk::Extent2D) {
        let device = self.gpu.device();
        if let Some(encoder) = &self.encoder {
            // SAFETY: `cmd` is recording in subpass 0.
            unsafe { device.cmd_next_subpass(cmd, vk::SubpassContents::INLINE) };
            encoder.record(cmd, extent);
        }
        // SAFETY: `cmd` is recording in the last subpass.
        unsafe { device.cmd_end_render_pass(cmd) };
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        // SAFETY: ours, and the owner waits for its frames first.
        unsafe { self.gpu.device().destroy_render_pass(self.render_pass, None) };
    }
}

fn attachment(format: vk::Format) -> vk::AttachmentDescription {
    vk::AttachmentDescription::default()
        .format(format)
        .samples(vk::SampleCountFlags::TYPE_1)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
}

const DRAWN: vk::PipelineStageFlags = vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT;

fn create_render_pass(device: &ash::Device, format: vk::Format, layout: vk::ImageLayout) -> Result<vk::RenderPass> {
    let attachments = [attachment(format).load_op(vk::AttachmentLoadOp::CLEAR).final_layout(layout)];
    let colour = [vk::AttachmentReference { attachment: 0, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL }];
    let subpasses = [vk::SubpassDescription::default().color_attachments(&colour)];
    // The transition comes after the semaphore of the acquired image.
    let dependencies = [vk::SubpassDependency::default()
        .src_subpass(vk::SUBPASS_EXTERNAL)
        .src_stage_mask(DRAWN)
        .dst_stage_mask(DRAWN)
        .dst_access_mask(vk::AccessFlags::COLOR_ATTACHMENT_WRITE)];
    let info = vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(&subpasses).dependencies(&dependencies);
    // SAFETY: the device is alive.
    unsafe { device.create_render_pass(&info, None) }.doing("create a render pass")
}

/// Attachment 0 is the canvas, 1 the image of the window.
fn create_encoding_render_pass(device: &ash::Device, format: vk::Format, layout: vk::ImageLayout) -> Result<vk::RenderPass> {
    let canvas = attachment(CANVAS_FORMAT)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::DONT_CARE)
        .final_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    let attachments = [canvas, attachment(format).load_op(vk::AttachmentLoadOp::DONT_CARE).final_layout(layout)];
    let drawn = [vk::AttachmentReference { attachment: 0, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL }];
    let read = [vk::AttachmentReference { attachment: 0, layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL }];
    let encoded = [vk::AttachmentReference { attachment: 1, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL }];
    let subpasses = [
        vk::SubpassDescription::default().color_attachments(&drawn),
        vk::SubpassDescription::default().input_attachments(&read).color_attachments(&encoded),
    ];
    let (write, shader) = (vk::AccessFlags::COLOR_ATTACHMENT_WRITE, vk::PipelineStageFlags::FRAGMENT_SHADER);
    let dependency = |from, to| vk::SubpassDependency::default().src_subpass(from).dst_subpass(to).dst_stage_mask(DRAWN);
    let dependencies = [
        // The frame before has encoded from the canvas.
        dependency(vk::SUBPASS_EXTERNAL, 0).src_stage_mask(DRAWN | shader).src_access_mask(write).dst_access_mask(write),
        // As in the render pass without a canvas.
        dependency(vk::SUBPASS_EXTERNAL, 1).src_stage_mask(DRAWN).dst_access_mask(write),
        dependency(0, 1)
            .src_stage_mask(DRAWN)
            .src_access_mask(write)
            .dst_stage_mask(shader)
            .dst_access_mask(vk::AccessFlags::INPUT_ATTACHMENT_READ)
            .dependency_flags(vk::DependencyFlags::BY_REGION),
    ];
    let info = vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(&subpasses).dependencies(&dependencies);
    // SAFETY: the device is alive.
    unsafe { device.create_render_pass(&info, None) }.doing("create a render pass")
}

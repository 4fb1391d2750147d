//! Graphics pipelines that draw one triangle over the whole target.

use ash::vk;

use super::panes::{shader_module, PRESENT_VERT};
use crate::error::{Doing, Result};
use crate::gpu::{Gpu, Shader};

/// A pipeline for a subpass with one colour attachment and no blending; viewport and scissor are dynamic.
///
/// # Errors
/// No memory.
pub fn create_pipeline(
    gpu: &Gpu,
    layout: vk::PipelineLayout,
    render_pass: vk::RenderPass,
    subpass: u32,
    fragment: &Shader,
) -> Result<vk::Pipeline> {
    let vertex = shader_module(gpu, PRESENT_VERT.spirv)?;
    let made = shader_module(gpu, fragment.spirv).and_then(|fragment| {
        let made = from_modules(gpu.device(), layout, render_pass, subpass, [vertex, fragment]);
        // SAFETY: ours, and a pipeline does not need it once it is made.
        unsafe { gpu.device().destroy_shader_module(fragment, None) };
        made
    });
    // SAFETY: as above.
    unsafe { gpu.device().destroy_shader_module(vertex, None) };
    made
}

fn from_modules(
    device: &ash::Device,
    layout: vk::PipelineLayout,
    render_pass: vk::RenderPass,
    subpass: u32,
    [vertex, fragment]: [vk::ShaderModule; 2],
) -> Result<vk::Pipeline> {
    let stage = |stage, module| vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main");
    let stages = [stage(vk::ShaderStageFlags::VERTEX, vertex), stage(vk::ShaderStageFlags::FRAGMENT, fragment)];
    let input = vk::PipelineVertexInputStateCreateInfo::default();
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
    let samples = vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let target = [vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA)];
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&target);
    let dynamic =
        vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR]);
    let info = vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&samples)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(layout)
        .render_pass(render_pass)
        .subpass(subpass);
    // SAFETY: modules, layout and render pass are alive and fit each other.
    let made = unsafe { device.create_graphics_pipelines(vk::PipelineCache::null(), &[info], None) };
    made.map_err(|(_, result)| result).doing("create a graphics pipeline").map(|pipelines| pipelines[0])
}

/// Draws it, with pipeline and descriptors bound.
///
/// # Safety
/// `cmd` is recording inside the render pass of the pipeline that is bound.
pub unsafe fn draw(device: &ash::Device, cmd: vk::CommandBuffer, extent: vk::Extent2D, scissor: vk::Rect2D) {
    let viewport = vk::Viewport { width: extent.width as f32, height: extent.height as f32, max_depth: 1.0, ..Default::default() };
    // SAFETY: says the caller.
    unsafe {
        device.cmd_set_viewport(cmd, 0, &[viewport]);
        device.cmd_set_scissor(cmd, 0, &[scissor]);
        device.cmd_draw(cmd, 3, 1, 0, 0);
    }
}

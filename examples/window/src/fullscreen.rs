//! Graphics pipelines that draw one triangle over the whole target, with the images that their fragment shader reads.

use ash::vk;

use super::panes::{shader_module, PRESENT_VERT};
use atrous_engine::gpu::{Gpu, Image, Shader};
use atrous_engine::Doing;
use atrous_engine::Result;

/// A pipeline with a fragment shader that reads some images of one kind, and push constants. Viewport and scissor are dynamic; nothing is blended.
pub struct Fullscreen {
    kind: vk::DescriptorType,
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
    pool: vk::DescriptorPool,
    sets: Vec<vk::DescriptorSet>,
    gpu: Gpu,
}

impl Fullscreen {
    /// Layouts and `sets` descriptor sets of `images` images each. Nothing can be drawn before [`Self::make_pipeline`].
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, kind: vk::DescriptorType, images: u32, sets: u32, constants: usize) -> Result<Self> {
        let mut made = Self {
            kind,
            set_layout: vk::DescriptorSetLayout::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
            pool: vk::DescriptorPool::null(),
            sets: Vec::new(),
            gpu: gpu.clone(),
        };
        let (device, stage_flags) = (gpu.device(), vk::ShaderStageFlags::FRAGMENT);
        let binding = |i| {
            vk::DescriptorSetLayoutBinding::default().binding(i).descriptor_type(kind).descriptor_count(1).stage_flags(stage_flags)
        };
        let bindings: Vec<_> = (0..images).map(binding).collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive, and every info refers to locals or to what was just made.
        unsafe {
            made.set_layout = device.create_descriptor_set_layout(&info, None).doing("create a descriptor set layout")?;
            let layouts = vec![made.set_layout; sets as usize];
            let ranges = [vk::PushConstantRange { stage_flags, offset: 0, size: constants as u32 }];
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts[..1]).push_constant_ranges(&ranges);
            made.layout = device.create_pipeline_layout(&info, None).doing("create a pipeline layout")?;
            let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: images * sets }];
            let info = vk::DescriptorPoolCreateInfo::default().max_sets(sets).pool_sizes(&sizes);
            made.pool = device.create_descriptor_pool(&info, None).doing("create a descriptor pool")?;
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(made.pool).set_layouts(&layouts);
            made.sets = device.allocate_descriptor_sets(&info).doing("allocate descriptor sets")?;
        }
        Ok(made)
    }

    /// Makes the pipeline, or makes it anew for another target. Nothing may be drawing with it.
    ///
    /// # Errors
    /// No memory.
    pub fn make_pipeline(&mut self, render_pass: vk::RenderPass, subpass: u32, fragment: &Shader) -> Result<()> {
        // SAFETY: the pipeline is ours or null, and the presenter waits for its frames before it changes the format.
        unsafe { self.gpu.device().destroy_pipeline(self.pipeline, None) };
        self.pipeline = vk::Pipeline::null();
        self.pipeline = create_pipeline(&self.gpu, self.layout, render_pass, subpass, fragment)?;
        Ok(())
    }

    /// From now on a set reads these images. It is not in use.
    pub fn point_at<'a>(&self, set: usize, images: impl IntoIterator<Item = &'a Image>, layout: vk::ImageLayout) {
        for (binding, image) in (0..).zip(images) {
            let info = [vk::DescriptorImageInfo::default().image_view(image.view).image_layout(layout)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(self.sets[set])
                .dst_binding(binding)
                .descriptor_type(self.kind)
                .image_info(&info);
            // SAFETY: the frame that read the set last is complete: its slot came round, or all were waited for. The view is alive.
            unsafe { self.gpu.device().update_descriptor_sets(&[write], &[]) };
        }
    }

    /// Draws with a set, inside the subpass of the pipeline, within `scissor`.
    pub fn record(&self, cmd: vk::CommandBuffer, set: usize, constants: &[u8], extent: vk::Extent2D, scissor: vk::Rect2D) {
        let device = self.gpu.device();
        let viewport =
            vk::Viewport { width: extent.width as f32, height: extent.height as f32, max_depth: 1.0, ..Default::default() };
        // SAFETY: `cmd` is recording inside the render pass; pipeline, layout and set belong together.
        unsafe {
            device.cmd_bind_pipeline(cmd, vk::PipelineBindPoint::GRAPHICS, self.pipeline);
            device.cmd_bind_descriptor_sets(cmd, vk::PipelineBindPoint::GRAPHICS, self.layout, 0, &[self.sets[set]], &[]);
            device.cmd_push_constants(cmd, self.layout, vk::ShaderStageFlags::FRAGMENT, 0, constants);
            device.cmd_set_viewport(cmd, 0, &[viewport]);
            device.cmd_set_scissor(cmd, 0, &[scissor]);
            device.cmd_draw(cmd, 3, 1, 0, 0);
        }
    }
}

impl Drop for Fullscreen {
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

fn create_pipeline(
    gpu: &Gpu,
    layout: vk::PipelineLayout,
    render_pass: vk::RenderPass,
    subpass: u32,
    fragment: &Shader,
) -> Result<vk::Pipeline> {
    let vertex = shader_module(gpu, PRESENT_VERT.spirv)?;
    let made = shader_module(gpu, fragment.spirv).and_then(|fragment| {
        let made = from_modules(gpu, layout, render_pass, subpass, [vertex, fragment]);
        // SAFETY: ours, and a pipeline does not need it once it is made.
        unsafe { gpu.device().destroy_shader_module(fragment, None) };
        made
    });
    // SAFETY: the module is ours, and a pipeline does not need it once it is made.
    unsafe { gpu.device().destroy_shader_module(vertex, None) };
    made
}

fn from_modules(
    gpu: &Gpu,
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
    let made = unsafe { gpu.device().create_graphics_pipelines(gpu.pipeline_cache(), &[info], None) };
    made.map_err(|(_, result)| result).doing("create a graphics pipeline").map(|pipelines| pipelines[0])
}

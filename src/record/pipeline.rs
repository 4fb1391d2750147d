//! One module with its constants, ready to dispatch. Its objects are destroyed on drop.

use super::names::Names;
use crate::contract::Dispatch;
use crate::error::Error;
use crate::shaders::{descriptor_type, Shader, ShaderBinding};
use ash::vk;
use std::sync::Arc;

/// A descriptor as templates read it; by the kind of the binding, one or the other.
#[derive(Clone, Copy)]
#[repr(C)]
pub(crate) union Descriptor {
    pub image: vk::DescriptorImageInfo,
    pub buffer: vk::DescriptorBufferInfo,
}

impl Descriptor {
    /// Null handles.
    pub(crate) const NULL: Self = Self { buffer: vk::DescriptorBufferInfo { buffer: vk::Buffer::null(), offset: 0, range: 0 } };
}

/// The objects that follow from the interface of a module.
pub(super) struct Layouts {
    device: Arc<ash::Device>,
    pub set_layout: vk::DescriptorSetLayout,
    /// Writes a set from one [`Descriptor`] for each binding, in their order.
    pub template: vk::DescriptorUpdateTemplate,
    pub layout: vk::PipelineLayout,
}

/// A pipeline with its layouts.
pub(super) struct Pipeline {
    pub layouts: Arc<Layouts>,
    pub pipeline: vk::Pipeline,
}

impl Pipeline {
    /// # Safety
    /// `device` is live and outlives the result; `cache` is null or a cache of it that is synchronised internally.
    pub(super) unsafe fn new(device: &Arc<ash::Device>, cache: vk::PipelineCache, dispatch: &Dispatch) -> Result<Self, Error> {
        let code = ash::util::read_spv(&mut std::io::Cursor::new(&*dispatch.shader.spirv))
            .map_err(|_| Error::Vulkan { call: "read_spv", result: vk::Result::ERROR_INVALID_SHADER_NV })?;
        // SAFETY: the device is live, and the layouts are those of the module.
        unsafe {
            let layouts = Arc::new(Layouts::new(device, &dispatch.shader)?);
            let pipeline = create_pipeline(device, cache, layouts.layout, &code, &dispatch.constants)?;
            Ok(Self { layouts, pipeline })
        }
    }

    /// The same layouts with other code, which is made without a cache.
    ///
    /// # Safety
    /// The code is valid, and its interface is that of the layouts.
    #[cfg(feature = "hot-reload")]
    pub(super) unsafe fn with_code(&self, code: &[u32], constants: &[(u32, u32)]) -> Result<Self, Error> {
        let layouts = self.layouts.clone();
        // SAFETY: the device outlives the layouts, and by the caller's promise the code fits them.
        let pipeline = unsafe { create_pipeline(&layouts.device, vk::PipelineCache::null(), layouts.layout, code, constants)? };
        Ok(Self { layouts, pipeline })
    }

    /// # Safety
    /// The names are those of the device, and no other thread names or destroys the objects.
    pub(super) unsafe fn name(&self, names: &Names, shader: &str) {
        // SAFETY: ours, and live.
        unsafe {
            names.set(self.pipeline, shader);
            names.set(self.layouts.layout, shader);
            names.set(self.layouts.set_layout, shader);
        }
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: ours, and unused: a denoiser outlives its work, and its device outlives the denoiser (Denoiser's contract).
        unsafe { self.layouts.device.destroy_pipeline(self.pipeline, None) };
    }
}

impl Layouts {
    unsafe fn new(device: &Arc<ash::Device>, shader: &Shader) -> Result<Self, Error> {
        let mut this = Self {
            device: device.clone(),
            set_layout: vk::DescriptorSetLayout::null(),
            template: vk::DescriptorUpdateTemplate::null(),
            layout: vk::PipelineLayout::null(),
        };
        let binding = |b: &ShaderBinding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(b.number)
                .descriptor_type(descriptor_type(b.kind))
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        };
        let bindings: Vec<_> = shader.bindings.iter().map(binding).collect();
        // SAFETY: the device is live, and every info refers to what was just made or to locals. What was made before a failure is
        // destroyed with `this`.
        unsafe {
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            this.set_layout =
                device.create_descriptor_set_layout(&info, None).map_err(Error::vulkan("vkCreateDescriptorSetLayout"))?;
            this.template = create_template(device, this.set_layout, shader)?;
            let layouts = [this.set_layout];
            let size = shader.push_bytes();
            let range = vk::PushConstantRange { stage_flags: vk::ShaderStageFlags::COMPUTE, offset: 0, size };
            let ranges = if size > 0 { vec![range] } else { Vec::new() };
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(&ranges);
            this.layout = device.create_pipeline_layout(&info, None).map_err(Error::vulkan("vkCreatePipelineLayout"))?;
        }
        Ok(this)
    }
}

impl Drop for Layouts {
    fn drop(&mut self) {
        // SAFETY: ours, unused as the pipelines are, and null handles are ignored.
        unsafe {
            self.device.destroy_pipeline_layout(self.layout, None);
            self.device.destroy_descriptor_update_template(self.template, None);
            self.device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// # Safety
/// The device is live, and the layout is that of the shader's bindings.
unsafe fn create_template(
    device: &ash::Device,
    set_layout: vk::DescriptorSetLayout,
    shader: &Shader,
) -> Result<vk::DescriptorUpdateTemplate, Error> {
    let entry = |(i, binding): (usize, &ShaderBinding)| {
        vk::DescriptorUpdateTemplateEntry::default()
            .dst_binding(binding.number)
            .descriptor_type(descriptor_type(binding.kind))
            .descriptor_count(1)
            .offset(i * size_of::<Descriptor>())
    };
    let entries: Vec<_> = shader.bindings.iter().enumerate().map(entry).collect();
    let info = vk::DescriptorUpdateTemplateCreateInfo::default()
        .template_type(vk::DescriptorUpdateTemplateType::DESCRIPTOR_SET)
        .descriptor_set_layout(set_layout)
        .descriptor_update_entries(&entries);
    // SAFETY: the device is live, and every entry is a binding of the layout.
    unsafe { device.create_descriptor_update_template(&info, None) }.map_err(Error::vulkan("vkCreateDescriptorUpdateTemplate"))
}

/// # Safety
/// The device is live; the cache is null or one of its own; the code is valid, and its interface is that of the layout.
unsafe fn create_pipeline(
    device: &ash::Device,
    cache: vk::PipelineCache,
    layout: vk::PipelineLayout,
    code: &[u32],
    constants: &[(u32, u32)],
) -> Result<vk::Pipeline, Error> {
    let entry =
        |(i, &(constant_id, _)): (usize, &(u32, u32))| vk::SpecializationMapEntry { constant_id, offset: 4 * i as u32, size: 4 };
    let entries: Vec<_> = constants.iter().enumerate().map(entry).collect();
    let values: Vec<u32> = constants.iter().map(|constant| constant.1).collect();
    let specialisation = vk::SpecializationInfo::default().map_entries(&entries).data(bytemuck::cast_slice(&values));
    let info = vk::ShaderModuleCreateInfo::default().code(code);
    // SAFETY: the device is live, the code is valid, and every info refers to locals.
    unsafe {
        let module = device.create_shader_module(&info, None).map_err(Error::vulkan("vkCreateShaderModule"))?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main")
            .specialization_info(&specialisation);
        let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
        let pipelines = device.create_compute_pipelines(cache, &[info], None);
        device.destroy_shader_module(module, None);
        let pipelines = pipelines.map_err(|(_, result)| Error::Vulkan { call: "vkCreateComputePipelines", result })?;
        Ok(pipelines.first().copied().unwrap_or_default())
    }
}

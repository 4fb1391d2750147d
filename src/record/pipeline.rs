//! The Vulkan objects that we own: pipelines and descriptor sets. All are destroyed on drop; no memory is allocated.

use super::names::Names;
use crate::contract::{Declaration, Dispatch};
use crate::error::Error;
use crate::parallel;
use crate::shaders::{descriptor_type, Shader, ShaderBinding};
use ash::vk;
use std::collections::BTreeMap;

/// A module, and the bits of its specialisation constants by their identifiers.
type Key = (String, Vec<(u32, u32)>);

/// One module with its constants, ready to dispatch.
struct Pipeline {
    set_layout: vk::DescriptorSetLayout,
    template: vk::DescriptorUpdateTemplate,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
}

/// The objects that a dispatch binds.
#[derive(Clone, Copy)]
pub(crate) struct Bindable {
    pub layout: vk::PipelineLayout,
    pub pipeline: vk::Pipeline,
    pub set: vk::DescriptorSet,
    /// Writes the set from one [`Descriptor`] for each binding, in their order.
    pub template: vk::DescriptorUpdateTemplate,
}

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

/// Pipelines of every shader that a declaration uses, and one descriptor set per pass and frame slot.
pub(crate) struct Pipelines {
    device: ash::Device,
    pipelines: BTreeMap<Key, Pipeline>,
    pools: Vec<vk::DescriptorPool>,
    /// Objects by slot, then pass.
    bindables: Vec<Vec<Option<Bindable>>>,
}

impl Pipelines {
    /// Creates pipelines on as many threads as there are cores.
    ///
    /// # Safety
    /// `device` is live and outlives the result; `cache` is null or a cache of it that is synchronised internally.
    pub(crate) unsafe fn new(device: &ash::Device, cache: vk::PipelineCache, declaration: &Declaration) -> Result<Self, Error> {
        let dispatches = declaration.passes().iter().filter_map(|pass| pass.dispatch());
        let jobs: Vec<_> = dispatches.map(|d| (key(d), d)).collect::<BTreeMap<_, _>>().into_iter().collect();
        // SAFETY: the device is live and outlives the pipeline. Creating takes no lock: the device may be used by several threads,
        // what a call creates is its own, and the cache is synchronised internally.
        let create = |(key, dispatch): &(Key, &Dispatch)| unsafe { Ok((key.clone(), Pipeline::new(device, cache, dispatch)?)) };
        let (created, error) = parallel::run(&jobs, parallel::cores(), create);
        let (device, pipelines) = (device.clone(), created.into_iter().collect());
        let mut this = Self { device, pipelines, pools: Vec::new(), bindables: Vec::new() };
        if let Some(error) = error {
            // What was created before the failure is destroyed with `this`.
            return Err(error);
        }
        for _ in 0..declaration.setup().frames_in_flight {
            // SAFETY: the device is live, and the pipelines are its own.
            unsafe { this.add_slot(declaration)? };
        }
        Ok(this)
    }

    /// Names what messages of a validation layer are about.
    ///
    /// # Safety
    /// The names are those of the device, and no other thread uses the objects.
    pub(crate) unsafe fn name(&self, names: &Names, declaration: &Declaration) {
        for ((shader, _), pipeline) in &self.pipelines {
            // SAFETY: ours, and live.
            unsafe {
                names.set(pipeline.pipeline, shader);
                names.set(pipeline.layout, shader);
                names.set(pipeline.set_layout, shader);
            }
        }
        for (slot, (pool, bindables)) in self.pools.iter().zip(&self.bindables).enumerate() {
            // SAFETY: ours, and live.
            unsafe { names.set(*pool, &format!("sets of slot {slot}")) };
            for (pass, bindable) in declaration.passes().iter().zip(bindables) {
                // SAFETY: ours, and live.
                bindable.map(|bindable| unsafe { names.set(bindable.set, &format!("{}, slot {slot}", pass.name)) });
            }
        }
    }

    /// The objects to bind for a pass; `None` for a pass that is no dispatch.
    pub(crate) fn bindable(&self, slot: u32, pass: usize) -> Option<Bindable> {
        *self.bindables.get(slot as usize)?.get(pass)?
    }

    /// Gives a shader other code with the same interface. The old pipeline stays where that fails. Whether there is such a shader.
    ///
    /// # Safety
    /// The words are valid SPIR-V, and no work that uses the shader is pending or recorded.
    #[cfg(feature = "hot-reload")]
    pub(crate) unsafe fn replace(&mut self, name: &str, code: &[u32]) -> Result<bool, Error> {
        let mut new = Vec::new();
        for (key, pipeline) in self.pipelines.iter().filter(|(key, _)| key.0 == name) {
            // SAFETY: the device is live, and the interface is that of the layout.
            match unsafe { create_pipeline(&self.device, vk::PipelineCache::null(), pipeline.layout, code, &key.1) } {
                Ok(pipeline) => new.push(pipeline),
                Err(error) => {
                    // SAFETY: just made, and used by nothing.
                    new.iter().for_each(|&pipeline| unsafe { self.device.destroy_pipeline(pipeline, None) });
                    return Err(error);
                }
            }
        }
        let any = !new.is_empty();
        let replaced = self.pipelines.iter_mut().filter(|(key, _)| key.0 == name);
        for (pipeline, new) in replaced.map(|(_, pipeline)| pipeline).zip(new) {
            let old = std::mem::replace(&mut pipeline.pipeline, new);
            for bindable in self.bindables.iter_mut().flatten().flatten().filter(|b| b.pipeline == old) {
                bindable.pipeline = new;
            }
            // SAFETY: ours, and not in use: no work that uses the shader is pending or recorded.
            unsafe { self.device.destroy_pipeline(old, None) };
        }
        Ok(any)
    }

    unsafe fn add_slot(&mut self, declaration: &Declaration) -> Result<(), Error> {
        let dispatches: Vec<Option<&Dispatch>> = declaration.passes().iter().map(|p| p.dispatch()).collect();
        let mut sizes: BTreeMap<i32, vk::DescriptorPoolSize> = BTreeMap::new();
        for binding in dispatches.iter().flatten().flat_map(|d| d.shader.bindings.iter()) {
            let ty = descriptor_type(binding.kind);
            let size = sizes.entry(ty.as_raw()).or_insert(vk::DescriptorPoolSize { ty, descriptor_count: 0 });
            size.descriptor_count += 1;
        }
        let sizes: Vec<_> = sizes.into_values().collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(dispatches.len() as u32).pool_sizes(&sizes);
        // SAFETY: the device is live.
        let pool = unsafe { self.device.create_descriptor_pool(&info, None) }.map_err(Error::vulkan("vkCreateDescriptorPool"))?;
        self.pools.push(pool);
        let mut bindables = Vec::new();
        for dispatch in dispatches {
            let Some(pipeline) = dispatch.and_then(|d| self.pipelines.get(&key(d))) else {
                bindables.push(None);
                continue;
            };
            let layouts = [pipeline.set_layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            // SAFETY: pool and layout are live and of this device.
            let sets = unsafe { self.device.allocate_descriptor_sets(&info) }.map_err(Error::vulkan("vkAllocateDescriptorSets"))?;
            let &Pipeline { layout, pipeline, template, .. } = pipeline;
            bindables.push(sets.first().map(|&set| Bindable { layout, pipeline, set, template }));
        }
        self.bindables.push(bindables);
        Ok(())
    }
}

impl Drop for Pipelines {
    fn drop(&mut self) {
        // SAFETY: we created all of them on this device, and the owner waits for the GPU before it drops us (Denoiser's contract).
        unsafe {
            for &pool in &self.pools {
                self.device.destroy_descriptor_pool(pool, None);
            }
            for pipeline in self.pipelines.values() {
                pipeline.destroy(&self.device);
            }
        }
    }
}

impl Pipeline {
    unsafe fn new(device: &ash::Device, cache: vk::PipelineCache, dispatch: &Dispatch) -> Result<Self, Error> {
        let mut this = Self {
            set_layout: vk::DescriptorSetLayout::null(),
            template: vk::DescriptorUpdateTemplate::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
        };
        // SAFETY: the device is live; what was created before a failure is destroyed below.
        let result = unsafe { this.create(device, cache, &dispatch.shader, &dispatch.constants) };
        match result {
            Ok(()) => Ok(this),
            Err(error) => {
                // SAFETY: the handles are ours or null, and unused.
                unsafe { this.destroy(device) };
                Err(error)
            }
        }
    }

    unsafe fn create(
        &mut self,
        device: &ash::Device,
        cache: vk::PipelineCache,
        shader: &Shader,
        constants: &[(u32, u32)],
    ) -> Result<(), Error> {
        let bindings: Vec<_> = shader
            .bindings
            .iter()
            .map(|b| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(b.number)
                    .descriptor_type(descriptor_type(b.kind))
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let code = ash::util::read_spv(&mut std::io::Cursor::new(&*shader.spirv))
            .map_err(|_| Error::Vulkan { call: "read_spv", result: vk::Result::ERROR_INVALID_SHADER_NV })?;
        // SAFETY: the device is live, and every info refers to what was just made or to locals.
        unsafe {
            let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            self.set_layout =
                device.create_descriptor_set_layout(&info, None).map_err(Error::vulkan("vkCreateDescriptorSetLayout"))?;
            self.template = create_template(device, self.set_layout, shader)?;
            let layouts = [self.set_layout];
            let size = shader.push_bytes();
            let range = vk::PushConstantRange { stage_flags: vk::ShaderStageFlags::COMPUTE, offset: 0, size };
            let ranges = if size > 0 { vec![range] } else { Vec::new() };
            let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(&ranges);
            self.layout = device.create_pipeline_layout(&info, None).map_err(Error::vulkan("vkCreatePipelineLayout"))?;
            self.pipeline = create_pipeline(device, cache, self.layout, &code, constants)?;
        }
        Ok(())
    }

    unsafe fn destroy(&self, device: &ash::Device) {
        // SAFETY: ours, unused, and null handles are ignored.
        unsafe {
            device.destroy_pipeline(self.pipeline, None);
            device.destroy_pipeline_layout(self.layout, None);
            device.destroy_descriptor_update_template(self.template, None);
            device.destroy_descriptor_set_layout(self.set_layout, None);
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

fn key(dispatch: &Dispatch) -> Key {
    (dispatch.shader.name.clone().into_owned(), dispatch.constants.clone())
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

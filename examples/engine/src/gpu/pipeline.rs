//! Compute pipelines with two descriptor sets: the scene, and the images of the pass.

use std::sync::Arc;

use ash::vk;

use super::{Gpu, Shared};
use crate::error::{Doing, Result};

/// A descriptor set layout that destroys itself.
pub struct SetLayout {
    /// Handle.
    pub handle: vk::DescriptorSetLayout,
    kinds: Vec<vk::DescriptorType>,
    shared: Arc<Shared>,
}

impl SetLayout {
    /// Binding `i` has type `kinds[i]`.
    pub fn new(gpu: &Gpu, kinds: &[vk::DescriptorType]) -> Result<Self> {
        let bindings: Vec<_> = kinds
            .iter()
            .enumerate()
            .map(|(index, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(index as u32)
                    .descriptor_type(*kind)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is alive, `bindings` outlives the call.
        let handle = unsafe { gpu.device().create_descriptor_set_layout(&info, None) }.doing("create a descriptor set layout")?;
        Ok(Self { handle, kinds: kinds.to_vec(), shared: gpu.shared.clone() })
    }
}

impl Drop for SetLayout {
    fn drop(&mut self) {
        // SAFETY: made by this device; pipelines do not need it once they are made.
        unsafe { self.shared.device.destroy_descriptor_set_layout(self.handle, None) };
    }
}

/// `count` storage images.
pub fn storage_images(count: usize) -> Vec<vk::DescriptorType> {
    vec![vk::DescriptorType::STORAGE_IMAGE; count]
}

/// A buffer in a descriptor set.
#[derive(Clone, Copy)]
pub enum Bound {
    /// A storage buffer.
    Storage(vk::Buffer),
    /// A buffer of texels.
    Texels(vk::BufferView),
}

impl Bound {
    /// Its descriptor type.
    pub fn kind(self) -> vk::DescriptorType {
        match self {
            Self::Storage(_) => vk::DescriptorType::STORAGE_BUFFER,
            Self::Texels(_) => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
        }
    }
}

/// One descriptor set in a pool of its own.
pub struct DescriptorSet {
    /// Handle.
    pub handle: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    shared: Arc<Shared>,
}

impl DescriptorSet {
    fn new(gpu: &Gpu, layout: &SetLayout) -> Result<Self> {
        let sizes: Vec<_> =
            layout.kinds.iter().map(|kind| vk::DescriptorPoolSize::default().ty(*kind).descriptor_count(1)).collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: the device is alive, `sizes` outlives the call.
        let pool = unsafe { gpu.device().create_descriptor_pool(&info, None) }.doing("create a descriptor pool")?;
        let mut set = Self { handle: vk::DescriptorSet::null(), pool, shared: gpu.shared.clone() };
        let layouts = [layout.handle];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        // SAFETY: the pool has room for exactly this set.
        set.handle = unsafe { gpu.device().allocate_descriptor_sets(&info) }.doing("allocate a descriptor set")?[0];
        Ok(set)
    }

    /// A set of buffers, in the order of the bindings.
    pub fn of_buffers(gpu: &Gpu, layout: &SetLayout, bound: &[Bound]) -> Result<Self> {
        let set = Self::new(gpu, layout)?;
        for (index, bound) in bound.iter().enumerate() {
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set.handle)
                .dst_binding(index as u32)
                .descriptor_type(bound.kind())
                .descriptor_count(1);
            let (views, buffers);
            let write = match bound {
                Bound::Texels(view) => {
                    views = [*view];
                    write.texel_buffer_view(&views)
                }
                Bound::Storage(buffer) => {
                    buffers = [vk::DescriptorBufferInfo::default().buffer(*buffer).range(vk::WHOLE_SIZE)];
                    write.buffer_info(&buffers)
                }
            };
            // SAFETY: the set is new, so no work uses it; who makes the set keeps buffers and views as long.
            unsafe { gpu.device().update_descriptor_sets(&[write], &[]) };
        }
        Ok(set)
    }

    /// A set of images in layout `GENERAL`, in the order of the bindings.
    pub fn of_images(gpu: &Gpu, layout: &SetLayout, views: &[vk::ImageView]) -> Result<Self> {
        let set = Self::new(gpu, layout)?;
        set.point_at(layout, views);
        Ok(set)
    }

    /// Points at other images. The set is not in use.
    pub fn point_at(&self, layout: &SetLayout, views: &[vk::ImageView]) {
        for (index, (view, kind)) in views.iter().zip(&layout.kinds).enumerate() {
            let info = [vk::DescriptorImageInfo::default().image_view(*view).image_layout(vk::ImageLayout::GENERAL)];
            let write = vk::WriteDescriptorSet::default()
                .dst_set(self.handle)
                .dst_binding(index as u32)
                .descriptor_type(*kind)
                .image_info(&info);
            // SAFETY: the views are of live images, and no work uses the set, since every submission here is waited for.
            unsafe { self.shared.device.update_descriptor_sets(&[write], &[]) };
        }
    }
}

impl Drop for DescriptorSet {
    fn drop(&mut self) {
        // SAFETY: every submit here waits, so no pending work uses the set; the pool frees it.
        unsafe { self.shared.device.destroy_descriptor_pool(self.pool, None) };
    }
}

/// A shader as it was built.
#[derive(Debug)]
pub struct Shader {
    /// Its file without `.comp`, and the macros of its variant.
    pub name: &'static str,
    /// The module.
    pub spirv: &'static [u8],
    /// What the program assumes of it: see `atrous::hot_reload::check_interface`.
    pub interface: &'static [(&'static str, &'static str)],
}

/// A compute pipeline and its layout.
pub struct Pipeline {
    #[cfg(feature = "hot-reload")]
    shader: &'static Shader,
    handle: vk::Pipeline,
    layout: vk::PipelineLayout,
    shared: Arc<Shared>,
}

impl Pipeline {
    /// Entry point `main`; `push_constant_bytes` may be 0.
    pub fn new(gpu: &Gpu, shader: &'static Shader, sets: &[&SetLayout], push_constant_bytes: u32) -> Result<Self> {
        let device = gpu.device();
        let layouts: Vec<_> = sets.iter().map(|set| set.handle).collect();
        let ranges = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::COMPUTE).size(push_constant_bytes)];
        let ranges = if push_constant_bytes > 0 { &ranges[..] } else { &[] };
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts).push_constant_ranges(ranges);
        // SAFETY: the set layouts are alive.
        let layout = unsafe { device.create_pipeline_layout(&info, None) }.doing("create a pipeline layout")?;
        let mut pipeline = Self {
            #[cfg(feature = "hot-reload")]
            shader,
            handle: vk::Pipeline::null(),
            layout,
            shared: gpu.shared.clone(),
        };
        pipeline.handle = pipeline.create(&bytemuck::pod_collect_to_vec(shader.spirv))?;
        Ok(pipeline)
    }

    /// Takes other code, if it is of its shader; whether it is. No work that uses the pipeline is pending. The old code stays where this fails.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        if shader.owner() != crate::hot_reload::Owner::Engine || shader.name() != self.shader.name {
            return Ok(false);
        }
        let new = self.create(shader.spirv())?;
        let old = std::mem::replace(&mut self.handle, new);
        // SAFETY: every submit here waits, so no pending work uses it.
        unsafe { self.shared.device.destroy_pipeline(old, None) };
        Ok(true)
    }

    fn create(&self, words: &[u32]) -> Result<vk::Pipeline> {
        let device = &self.shared.device;
        // SAFETY: the words are SPIR-V that shaderc made for Vulkan 1.1.
        let module = unsafe { device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(words), None) }
            .doing("create a shader module")?;
        let stage = vk::PipelineShaderStageCreateInfo::default().stage(vk::ShaderStageFlags::COMPUTE).module(module).name(c"main");
        let info = vk::ComputePipelineCreateInfo::default().stage(stage).layout(self.layout);
        // SAFETY: module and layout are alive, and the module's bindings are those of the layout.
        let made = unsafe { device.create_compute_pipelines(self.shared.pipeline_cache, &[info], None) };
        // SAFETY: a pipeline does not need its module once it is made.
        unsafe { device.destroy_shader_module(module, None) };
        Ok(made.map_err(|(_, result)| result).doing("create a compute pipeline")?[0])
    }

    /// Records one dispatch of 8x8 groups over `extent`. Clobbers the compute bindings.
    pub fn record(&self, cmd: vk::CommandBuffer, sets: &[&DescriptorSet], constants: &[u8], extent: vk::Extent2D) {
        let device = &self.shared.device;
        let sets: Vec<_> = sets.iter().map(|set| set.handle).collect();
        let point = vk::PipelineBindPoint::COMPUTE;
        // SAFETY: `cmd` is recording outside a render pass, the sets match the pipeline's layout, and the constants
        // have the size of its range (0 where it has none).
        unsafe {
            device.cmd_bind_pipeline(cmd, point, self.handle);
            device.cmd_bind_descriptor_sets(cmd, point, self.layout, 0, &sets, &[]);
            if !constants.is_empty() {
                device.cmd_push_constants(cmd, self.layout, vk::ShaderStageFlags::COMPUTE, 0, constants);
            }
            device.cmd_dispatch(cmd, extent.width.div_ceil(8), extent.height.div_ceil(8), 1);
        }
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: every submit here waits, so no pending work uses the pipeline.
        unsafe {
            self.shared.device.destroy_pipeline(self.handle, None);
            self.shared.device.destroy_pipeline_layout(self.layout, None);
        }
    }
}

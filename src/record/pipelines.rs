//! Pipelines and descriptor sets of the passes of a declaration. No memory is allocated.

use super::names::Names;
use super::pipeline::Layouts;
use super::shared_pipelines::{Key, Made, SharedPipelines};
use crate::contract::{Declaration, Dispatch};
use crate::error::Error;
use crate::shaders::descriptor_type;
use ash::vk;
use std::collections::BTreeMap;

/// The objects that a dispatch binds.
#[derive(Clone, Copy)]
pub(crate) struct Bindable {
    pub layout: vk::PipelineLayout,
    pub pipeline: vk::Pipeline,
    pub set: vk::DescriptorSet,
    /// Writes the set from one [`Descriptor`](super::pipeline::Descriptor) for each binding, in their order.
    pub template: vk::DescriptorUpdateTemplate,
}

/// Pipelines of every shader that a declaration uses, and one descriptor set per pass and frame slot.
pub(crate) struct Pipelines {
    device: ash::Device,
    shared: SharedPipelines,
    pipelines: Made,
    pools: Vec<vk::DescriptorPool>,
    /// Objects by slot, then pass.
    bindables: Vec<Vec<Option<Bindable>>>,
}

impl Pipelines {
    /// # Safety
    /// `device` is live, the only one of `shared`, and outlives it and the result; `cache` is null or a cache of it that is synchronised
    /// internally.
    pub(crate) unsafe fn new(
        device: &ash::Device,
        cache: vk::PipelineCache,
        shared: SharedPipelines,
        declaration: &Declaration,
    ) -> Result<Self, Error> {
        // SAFETY: the obligations are the same.
        let pipelines = unsafe { shared.get(device, cache, declaration.passes().iter().filter_map(|pass| pass.dispatch()))? };
        let mut this = Self { device: device.clone(), shared, pipelines, pools: Vec::new(), bindables: Vec::new() };
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
        // SAFETY: the names are those of the device.
        unsafe { self.shared.name(names, &self.pipelines) };
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
        let replaced = self.pipelines.iter_mut().filter(|(key, _)| key.shader == name);
        // SAFETY: the code is valid, and its interface is that of the layouts.
        let made = replaced.map(|(key, old)| unsafe { old.with_code(code, &key.constants).map(|new| (old, new)) });
        let made = made.collect::<Result<Vec<_>, _>>()?;
        let any = !made.is_empty();
        for (pipeline, new) in made {
            for bindable in self.bindables.iter_mut().flatten().flatten().filter(|b| b.pipeline == pipeline.pipeline) {
                bindable.pipeline = new.pipeline;
            }
            *pipeline = new.into();
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
            let Some(made) = dispatch.and_then(|d| self.pipelines.get(&Key::new(d))) else {
                bindables.push(None);
                continue;
            };
            let layouts = [made.layouts.set_layout];
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            // SAFETY: pool and layout are live and of this device.
            let sets = unsafe { self.device.allocate_descriptor_sets(&info) }.map_err(Error::vulkan("vkAllocateDescriptorSets"))?;
            let Layouts { layout, template, .. } = *made.layouts;
            bindables.push(sets.first().map(|&set| Bindable { layout, pipeline: made.pipeline, set, template }));
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
        }
    }
}

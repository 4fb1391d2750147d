//! A preset, flattened into one resource table and one pass list, with the Vulkan objects to record it.

use crate::binding::{absent_gradients, check_bindings, present, substitute, Binding};
use crate::config::Config;
use crate::contract::{Declaration, FrameContext, FrameParams, FrameState, Grid, PassDecl, Tuning, Work};
use crate::error::Error;
use crate::pipeline::{Bindable, Pipelines, MAX_BINDINGS};
use crate::requirements::{Requirements, WORKGROUP_SIDE};
use crate::shaders::{BindingKind, PushConstants, Shader};
use ash::vk;

impl PassDecl {
    pub(crate) fn shader(&self) -> Option<&'static Shader> {
        match self.work {
            Work::Dispatch { shader, .. } | Work::DebugView { shader, .. } => Some(shader),
            Work::StartFrame | Work::Clear => None,
        }
    }

    /// The SPIR-V that a dispatch was built with, `None` for the pass that starts a frame: for tools that reflect or profile it.
    pub fn spirv(&self) -> Option<&'static [u8]> {
        self.shader().map(|s| s.spirv)
    }
}

/// The host's device. Handles stay the host's: they are used, never destroyed.
#[derive(Clone, Copy)]
pub struct Device<'a> {
    /// Instance.
    pub instance: &'a ash::Instance,
    /// Physical device.
    pub physical_device: vk::PhysicalDevice,
    /// Device.
    pub device: &'a ash::Device,
}

/// Records the passes of a preset. It owns pipelines and descriptor pools, and nothing else: no image, no buffer, no memory.
///
/// Drop it only after the GPU work that was recorded with it is complete.
pub struct Denoiser {
    config: Config,
    declaration: Declaration,
    state: FrameState,
    device: ash::Device,
    pipelines: Pipelines,
    /// Whether it was said that gradients are missing.
    warned: bool,
}

impl Denoiser {
    /// Creates pipelines and descriptor pools.
    ///
    /// # Errors
    /// As [`Config::validate`] and [`Requirements::check`]; [`Error::Vulkan`] where a call fails.
    ///
    /// # Safety
    /// The handles are live, belong together and outlive the result.
    pub unsafe fn new(host: Device<'_>, config: &Config) -> Result<Self, Error> {
        // SAFETY: the caller's.
        unsafe { Requirements::new(config)?.check(host.instance, host.physical_device)? };
        let declaration = config.declare()?;
        // SAFETY: the caller's.
        let pipelines = unsafe { Pipelines::new(host.device, &declaration, config.frames_in_flight)? };
        Ok(Self {
            config: *config,
            declaration,
            state: FrameState::default(),
            device: host.device.clone(),
            pipelines,
            warned: false,
        })
    }

    /// Structural configuration.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// Resources and passes.
    pub fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    /// Starts a frame.
    ///
    /// # Errors
    /// As [`FrameState::begin`].
    pub fn begin_frame(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        let frame = self.state.begin(&self.config, params, tuning)?;
        if self.config.reshades() && !params.reshaded && frame.reset.is_none() {
            self.warn_of_missing_gradients("FrameParams::reshaded is false: the host does not re-shade `gradient_samples`");
        }
        Ok(frame)
    }

    /// Once: a host that leaves them out does so in every frame.
    fn warn_of_missing_gradients(&mut self, why: &str) {
        if !std::mem::replace(&mut self.warned, true) {
            log::warn!("atrous: {why}. Without gradients the preset {:?} behaves as Svgf", self.config.preset);
        }
    }

    /// The next frame drops all history: after the host re-created images.
    pub fn invalidate(&mut self) {
        self.state.invalidate();
    }

    /// Gives the passes that run a shader other code, and keeps the history. Whether there are such passes. The old code stays where this fails.
    ///
    /// # Errors
    /// As [`hot_reload::check`](crate::hot_reload::check); [`Error::Vulkan`] where the pipeline cannot be made.
    ///
    /// # Safety
    /// - `spirv` is valid for Vulkan 1.1: what a compiler made, not what a stranger sent.
    /// - GPU work that was recorded with this denoiser is complete, in every frame slot, and none is recorded that has yet to be submitted: the
    ///   old pipeline is destroyed. A host with frames in flight waits for all of them, for example with `vkDeviceWaitIdle`.
    #[cfg(feature = "hot-reload")]
    pub unsafe fn replace_shader(&mut self, name: &str, spirv: &[u32]) -> Result<bool, Error> {
        crate::hot_reload::check(name, spirv)?;
        // SAFETY: the interface is that of the build; the rest is the caller's.
        unsafe { self.pipelines.replace(name, spirv) }
    }

    /// Records one pass: no barrier, no allocation of memory, no submission.
    ///
    /// `bindings` stand in the order of the pass's `uses`. Clobbers: compute pipeline, compute descriptor set 0, push constants (and thereby
    /// the state of `VK_EXT_descriptor_heap`).
    ///
    /// # Errors
    /// [`Error::Bindings`] or [`Error::NotBound`] when `bindings` do not fit the pass; nothing is recorded then.
    ///
    /// # Safety
    /// - `cmd` is recording, outside a render pass, for a queue family with `COMPUTE`, on the device of [`Denoiser::new`].
    /// - Every binding honours its use: the view has the declared format and the allocated extent (an input: at least the render extent), its
    ///   layout is reached, earlier writes are visible, it is not written concurrently, and it outlives the execution of `cmd`.
    /// - GPU work recorded earlier with the same `frame_slot` is complete.
    pub unsafe fn record(
        &mut self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        bindings: &[Binding],
    ) -> Result<(), Error> {
        let Some(decl) = self.declaration.passes.get(pass) else {
            return Err(Error::Bindings { pass: format!("index {pass}"), given: bindings.len(), needed: 0 });
        };
        check_bindings(&self.declaration, decl, bindings)?;
        match decl.work {
            // SAFETY: the caller's; the bindings were checked.
            Work::StartFrame => unsafe { self.start_frame(cmd, frame, bindings) },
            // SAFETY: as above.
            Work::Clear => unsafe { self.clear(cmd, bindings) },
            Work::Dispatch { level, grid, .. } => {
                let push = PushConstants { level, present: present(bindings) };
                // SAFETY: the caller's; the bindings were checked.
                unsafe { self.record_dispatch(cmd, frame, pass, bindings, dispatched_extent(frame, grid), push)? };
            }
            Work::DebugView { available, .. } => {
                let push =
                    PushConstants { level: frame.debug_view.unwrap_or_default() as u32, present: present(bindings) & available };
                // SAFETY: as above.
                unsafe { self.record_dispatch(cmd, frame, pass, bindings, frame.render_extent, push)? };
            }
        }
        if let Some(name) = absent_gradients(&self.declaration, pass, bindings) {
            self.warn_of_missing_gradients(&format!("nothing is bound to `{name}`"));
        }
        Ok(())
    }

    unsafe fn record_dispatch(
        &self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        bindings: &[Binding],
        extent: [u32; 2],
        push: PushConstants,
    ) -> Result<(), Error> {
        let (Some(bindable), Some(shader)) = (self.pipelines.bindable(frame.slot, pass), self.declaration.passes[pass].shader())
        else {
            return Err(Error::FrameSlot { given: frame.slot, frames_in_flight: self.config.frames_in_flight });
        };
        // SAFETY: the set is not in use, since earlier work of the slot is complete; the rest is the caller's.
        unsafe {
            self.write_set(bindable.set, shader, bindings);
            self.dispatch(cmd, extent, bindable, push);
        }
        Ok(())
    }

    unsafe fn start_frame(&self, cmd: vk::CommandBuffer, frame: &FrameContext, bindings: &[Binding]) {
        let [Binding::Buffer { buffer: constants, offset: constants_offset, .. }, Binding::Buffer { buffer: statistics, offset, .. }] =
            *bindings
        else {
            return;
        };
        let bytes = crate::nodes::STATISTICS_COUNT * 4;
        // SAFETY: the caller's; both buffers have the declared sizes.
        unsafe {
            self.device.cmd_update_buffer(cmd, constants, constants_offset, bytemuck::bytes_of(&frame.constants));
            self.device.cmd_fill_buffer(cmd, statistics, offset, bytes, 0);
        }
    }

    unsafe fn clear(&self, cmd: vk::CommandBuffer, bindings: &[Binding]) {
        let [Binding::ClearedImage { image, layout }] = *bindings else { return };
        let range = vk::ImageSubresourceRange {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            base_mip_level: 0,
            level_count: 1,
            base_array_layer: 0,
            layer_count: 1,
        };
        // SAFETY: the caller's.
        unsafe { self.device.cmd_clear_color_image(cmd, image, layout, &vk::ClearColorValue { uint32: [0; 4] }, &[range]) };
    }

    /// Points the set at the bindings. An absent one is pointed at another binding of its kind, which the shader then does not read.
    unsafe fn write_set(&self, set: vk::DescriptorSet, shader: &Shader, bindings: &[Binding]) {
        let mut images = [vk::DescriptorImageInfo::default(); MAX_BINDINGS];
        let mut buffers = [vk::DescriptorBufferInfo::default(); MAX_BINDINGS];
        for (i, binding) in bindings.iter().enumerate() {
            match substitute(shader, bindings, i, *binding) {
                Binding::Image { view, layout } => {
                    images[i] = vk::DescriptorImageInfo::default().image_view(view).image_layout(layout)
                }
                Binding::Buffer { buffer, offset, range } => buffers[i] = vk::DescriptorBufferInfo { buffer, offset, range },
                Binding::Absent | Binding::ClearedImage { .. } => {}
            }
        }
        let mut writes = [vk::WriteDescriptorSet::default(); MAX_BINDINGS];
        for (i, binding) in shader.bindings.iter().enumerate() {
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(i as u32)
                .descriptor_type(binding.kind.descriptor_type());
            writes[i] = match binding.kind {
                BindingKind::UniformBuffer | BindingKind::StorageBuffer(_) => write.buffer_info(std::slice::from_ref(&buffers[i])),
                _ => write.image_info(std::slice::from_ref(&images[i])),
            };
        }
        // SAFETY: the set is ours and not in use; views and buffers are the caller's.
        unsafe { self.device.update_descriptor_sets(&writes[..shader.bindings.len()], &[]) };
    }

    unsafe fn dispatch(&self, cmd: vk::CommandBuffer, extent: [u32; 2], bindable: Bindable, push: PushConstants) {
        let groups = extent.map(|side| side.div_ceil(WORKGROUP_SIDE));
        let point = vk::PipelineBindPoint::COMPUTE;
        // SAFETY: the caller's; pipeline, layout and set belong together.
        unsafe {
            self.device.cmd_bind_pipeline(cmd, point, bindable.pipeline);
            self.device.cmd_bind_descriptor_sets(cmd, point, bindable.layout, 0, &[bindable.set], &[]);
            self.device.cmd_push_constants(cmd, bindable.layout, vk::ShaderStageFlags::COMPUTE, 0, bytemuck::bytes_of(&push));
            self.device.cmd_dispatch(cmd, groups[0], groups[1], 1);
        }
    }
}

/// Invocations of a dispatch.
fn dispatched_extent(frame: &FrameContext, grid: Grid) -> [u32; 2] {
    let (now, before) = (frame.render_extent, frame.constants.previous_render_extent);
    match grid {
        Grid::Pixels => now,
        Grid::Strata(side) => [0, 1].map(|i| now[i].max(before[i]).div_ceil(side)),
    }
}

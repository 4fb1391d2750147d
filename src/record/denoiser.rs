//! Records a declaration into your command buffers: the Vulkan objects of its passes, and nothing
//! else.

use super::binding::{absent_gradients, check_bindings, descriptor, present};
use super::checks::{self, Checks, Histories};
use super::device::Device;
use super::frame_life::{check_slot, FrameLife};
use super::names::Names;
use super::pipeline::Descriptor;
use super::pipelines::{Bindable, Pipelines};
use super::requirements::Requirements;
use crate::contract::{Binding, Declaration, Dispatch, FrameContext, FrameParams, GridExtents, Parameter, Tuning, Work};
use crate::error::Error;
use crate::shaders::{MAX_BINDINGS, MAX_PUSH_BYTES};
use ash::vk;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Records the passes of a declaration. It owns pipelines and descriptor pools, and nothing else: no image, no buffer, no memory.
///
/// Drop it only after the GPU work that was recorded with it is complete.
pub struct Denoiser {
    /// Checks of your bindings and frames.
    pub checks: Checks,
    histories: Histories,
    declaration: Declaration,
    life: FrameLife,
    device: ash::Device,
    pipelines: Pipelines,
    /// Limits of the physical device, which a new extent has to keep as well.
    limits: vk::PhysicalDeviceLimits,
    /// Whether the warning about missing gradients was logged.
    warned: AtomicBool,
}

impl Denoiser {
    /// Creates pipelines and descriptor pools for a declaration: of a preset ([`crate::Config::declare`]), or of a graph
    /// ([`crate::graph::Graph::finish`]). Pipelines are created on as many threads as there are cores, and looked up in
    /// [`Device::pipeline_cache`]; those that [`Device::pipelines`] has are not created again.
    ///
    /// # Errors
    /// Errors of [`Requirements::check_device`]; [`Error::Vulkan`] if a call fails.
    ///
    /// # Safety
    /// - Instance, physical device and device are live, belong together and outlive the result.
    /// - The pipeline cache is null or a live one of the device, and not externally synchronised. Nothing else is merged into it
    ///   meanwhile.
    /// - Shared pipelines are of this device alone. The device outlives them.
    pub unsafe fn new(host: Device<'_>, declaration: Declaration) -> Result<Self, Error> {
        let Device { instance, physical_device, device, pipeline_cache, pipelines } = host;
        // SAFETY: instance, physical device and device are live and belong together, as the caller promised.
        let properties = unsafe {
            Requirements::new(&declaration).check_device(host)?;
            instance.get_physical_device_properties(physical_device)
        };
        // SAFETY: the device is live, the only one of the shared pipelines, and outlives all of them, and the cache is one of its own
        // that synchronises itself, as the caller promised.
        let pipelines = unsafe { Pipelines::new(device, pipeline_cache, pipelines.cloned().unwrap_or_default(), &declaration)? };
        let (device, limits) = (device.clone(), properties.limits);
        Ok(Self {
            checks: Checks::default(),
            histories: Histories::default(),
            life: FrameLife::new(&declaration),
            declaration,
            device,
            pipelines,
            limits,
            warned: AtomicBool::new(false),
        })
    }

    /// Declares everything for images of a different extent, and keeps every pipeline and
    /// descriptor set: the passes are the same. Allocate your images anew, by
    /// [`Self::declaration`]. All else is as after creation: frames count from 0, and the first one
    /// drops all history, for [`ResetReason::Resize`](crate::ResetReason::Resize). Work that was
    /// recorded before may still be in flight, as long as its images live.
    ///
    /// # Errors
    /// [`Error::Extent`], as [`Config::declare`](crate::Config::declare) gives it; [`Error::Unsupported`] for an extent beyond the
    /// limits of the device. Nothing is changed then.
    pub fn resize(&mut self, allocated_extent: [u32; 2]) -> Result<(), Error> {
        let declaration = self.resized(allocated_extent)?;
        self.adopt(declaration);
        Ok(())
    }

    /// The declaration for a different extent, if the device is large enough for it.
    pub(crate) fn resized(&self, allocated_extent: [u32; 2]) -> Result<Declaration, Error> {
        let declaration = self.declaration.with_extent(allocated_extent)?;
        Requirements::new(&declaration).check_limits(&self.limits)?;
        Ok(declaration)
    }

    /// Continues with the declaration of [`Self::resized`].
    pub(crate) fn adopt(&mut self, declaration: Declaration) {
        self.declaration = declaration;
        self.life.resize();
        self.histories.forget();
    }

    /// Names pipelines and descriptor sets by their shaders and passes, for messages of validation layers and for debuggers.
    ///
    /// # Safety
    /// `host` is that of [`Self::new`], with `VK_EXT_debug_utils` enabled on the instance.
    pub unsafe fn name_objects(&self, host: Device<'_>) {
        // SAFETY: the handles are live and have the extension, and the objects are not used by other threads, since they are ours.
        unsafe { self.pipelines.name(&Names::new(host, true), &self.declaration) };
    }

    /// Resources and passes.
    pub fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    /// Starts a frame. Record each frame before you begin the next: a frame drops all history, for
    /// [`ResetReason::Created`](crate::ResetReason::Created), if the previous one was not recorded
    /// up to its last write to a history.
    ///
    /// # Errors
    /// Errors of [`FrameState::begin`](crate::FrameState::begin). With [`Self::checks`], [`Error::LeftOut`] if passes in front of
    /// recorded ones are missing in the previous frame, whose history the next call then drops, and [`Error::InFlight`] as
    /// [`FrameParams::complete_frames`] says.
    pub fn begin_frame(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        if self.checks.on {
            self.life.check_slot_is_free(params)?;
            self.life.check_whole(&self.declaration)?;
        }
        let frame = self.life.begin(&self.declaration, params, tuning)?;
        if self.declaration.reshades() && !params.reshaded && frame.reset.is_none() {
            self.warn_of_missing_gradients("FrameParams::reshaded is false: the host does not re-shade `gradient_samples`");
        }
        Ok(frame)
    }

    /// Warns once, since gradients are usually missing in every frame or in none.
    fn warn_of_missing_gradients(&self, why: &str) {
        if !self.declaration.has_other_confidence() && !self.warned.swap(true, Relaxed) {
            let what = self.declaration.config().map_or("the graph".to_owned(), |config| format!("the preset {:?}", config.preset));
            log::warn!("atrous: {why}. Without gradients {what} behaves as Svgf");
        }
    }

    /// Makes the next frame drop all history. Call it after you re-created images.
    pub fn invalidate(&mut self) {
        self.life.invalidate();
        self.histories.forget();
    }

    /// The next frame counts as `index`, and drops all history: see [`crate::FrameState::restart_at`].
    pub fn restart_at(&mut self, index: u64) {
        self.life.restart_at(index);
    }

    /// Replaces the code of a shader in all passes that run it, and keeps the history. Returns
    /// whether there are such passes. The old code stays if this fails.
    ///
    /// # Errors
    /// Errors of [`hot_reload::check`](crate::hot_reload::check); [`Error::Vulkan`] where the pipeline cannot be made.
    ///
    /// # Safety
    /// - `spirv` is valid for Vulkan 1.1: the output of a compiler, not bytes from a stranger.
    /// - All GPU work recorded with this denoiser is complete, in every frame slot, and no recorded
    ///   work is left to submit, since the old pipeline is destroyed. With frames in flight, wait
    ///   for all of them, for example with `vkDeviceWaitIdle`.
    #[cfg(feature = "hot-reload")]
    pub unsafe fn replace_shader(&mut self, name: &str, spirv: &[u32]) -> Result<bool, Error> {
        crate::hot_reload::check(name, spirv)?;
        // SAFETY: `check` compared the interface. By the contract above, the SPIR-V is valid and no GPU work uses the old code.
        unsafe { self.pipelines.replace(name, spirv) }
    }

    /// Records one pass: no barrier, no allocation of memory, no submission.
    ///
    /// `bindings` stand in the order of the pass's `uses`. Clobbers: compute pipeline, compute descriptor set 0, push constants
    /// (and thereby the state of `VK_EXT_descriptor_heap`).
    ///
    /// It takes `&self`, so that the closures of a frame graph can share a denoiser in an [`Arc`](std::sync::Arc): several threads
    /// may record different passes, or the same pass in different slots, at once. Each pass has a descriptor set for each slot.
    ///
    /// # Errors
    /// [`Error::Bindings`], [`Error::NotBound`] or [`Error::WrongKind`] when `bindings` do not fit the pass, [`Error::FrameSlot`] when the frame has a slot
    /// beyond the last; with [`Self::checks`], [`Error::Binding`]. Nothing is recorded then.
    ///
    /// # Safety
    /// - `cmd` is recording, outside a render pass, for a queue family with `COMPUTE`, on the device of [`Denoiser::new`].
    /// - Every binding honours its use: the view has the declared format and the allocated extent (an input: at least the render
    ///   extent), its layout is reached, earlier writes are visible, it is not written concurrently, and it outlives the execution
    ///   of `cmd`.
    /// - GPU work recorded earlier with the same `frame_slot` is complete.
    /// - `frame` was begun by this denoiser, and since its last [`Self::resize`].
    /// - No other thread records the same pass with the same `frame_slot` meanwhile.
    pub unsafe fn record(
        &self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        bindings: &[Binding],
    ) -> Result<(), Error> {
        // SAFETY: the obligations are the same, and no pipeline is said to be bound.
        unsafe { self.record_after(cmd, frame, pass, bindings, &mut vk::Pipeline::null()) }
    }

    /// Records one pass behind others of ours: `bound` is the compute pipeline that they left bound, or null, and becomes that of
    /// this pass.
    ///
    /// # Errors
    /// Errors of [`Self::record`].
    ///
    /// # Safety
    /// Obligations of [`Self::record`]; nothing else bound a compute pipeline since `bound` was set.
    pub(crate) unsafe fn record_after(
        &self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        bindings: &[Binding],
        bound: &mut vk::Pipeline,
    ) -> Result<(), Error> {
        let Some(decl) = self.declaration.passes.get(pass) else {
            return Err(Error::Bindings { pass: format!("index {pass}"), given: bindings.len(), needed: 0 });
        };
        check_slot(&self.declaration, frame)?;
        check_bindings(&self.declaration, decl, bindings)?;
        if self.checks.on {
            checks::check(&self.checks, &self.histories, &self.declaration, frame, decl, bindings)?;
        }
        match &decl.work {
            // SAFETY: `cmd` is recording outside a render pass, and every binding honours its use; their kinds were checked.
            Work::StartFrame => unsafe { self.start_frame(cmd, frame, bindings) },
            // SAFETY: `cmd` is recording, and the bindings honour their uses, as for the pass above.
            Work::Dispatch(dispatch) => unsafe { self.dispatch(cmd, frame, pass, dispatch, bindings, bound)? },
        }
        self.life.recorded(pass);
        if let Some(name) = absent_gradients(&self.declaration, pass, bindings) {
            self.warn_of_missing_gradients(&format!("nothing is bound to `{name}`"));
        }
        Ok(())
    }

    unsafe fn dispatch(
        &self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        dispatch: &Dispatch,
        bindings: &[Binding],
        bound: &mut vk::Pipeline,
    ) -> Result<(), Error> {
        let Some(bindable) = self.pipelines.bindable(frame.slot, pass) else {
            return Err(Error::FrameSlot { given: frame.slot, frames_in_flight: self.declaration.setup().frames_in_flight });
        };
        let push = push_constants(dispatch, frame, bindings);
        let push = &bytemuck::bytes_of(&push)[..dispatch.shader.push_bytes() as usize];
        let extents = GridExtents {
            light: frame.constants.render_extent,
            previous_light: frame.constants.previous_render_extent,
            rendered: frame.render_extent,
            output: frame.output_extent,
        };
        let [x, y] = dispatch.workgroups(&extents);
        let point = vk::PipelineBindPoint::COMPUTE;
        // SAFETY: `cmd` is recording outside a render pass; pipeline, layout and set belong together, and the set is not in use,
        // since earlier work of the slot is complete. Where `bound` is the pipeline, it still is bound to `cmd`.
        unsafe {
            self.write_set(&bindable, dispatch, bindings);
            if std::mem::replace(bound, bindable.pipeline) != bindable.pipeline {
                self.device.cmd_bind_pipeline(cmd, point, bindable.pipeline);
            }
            // With null for no offsets, where ash would pass a pointer: Mesa allocates a copy of what it points to.
            let bind = self.device.fp_v1_0().cmd_bind_descriptor_sets;
            bind(cmd, point, bindable.layout, 0, 1, &bindable.set, 0, std::ptr::null());
            if !push.is_empty() {
                self.device.cmd_push_constants(cmd, bindable.layout, vk::ShaderStageFlags::COMPUTE, 0, push);
            }
            self.device.cmd_dispatch(cmd, x, y, 1);
        }
        Ok(())
    }

    unsafe fn start_frame(&self, cmd: vk::CommandBuffer, frame: &FrameContext, bindings: &[Binding]) {
        let [Binding::Buffer { buffer: constants, offset: constants_offset, .. }, Binding::Buffer { buffer: statistics, offset, .. }] =
            *bindings
        else {
            return;
        };
        let bytes = crate::contract::STATISTICS_BYTES;
        // SAFETY: `cmd` is recording outside a render pass; both buffers are live and have the declared sizes.
        unsafe {
            self.device.cmd_update_buffer(cmd, constants, constants_offset, bytemuck::bytes_of(&frame.constants));
            self.device.cmd_fill_buffer(cmd, statistics, offset, bytes, 0);
        }
    }

    /// Points the set at the bindings. An absent one is pointed at a different binding of its kind,
    /// which the shader then does not read.
    unsafe fn write_set(&self, bindable: &Bindable, dispatch: &Dispatch, bindings: &[Binding]) {
        let mut descriptors = [Descriptor::NULL; MAX_BINDINGS];
        for (to, slot) in descriptors.iter_mut().zip(&dispatch.slots) {
            match descriptor(*slot, bindings) {
                Binding::Image { view, layout } => {
                    to.image = vk::DescriptorImageInfo::default().image_view(view).image_layout(layout)
                }
                Binding::Buffer { buffer, offset, range } => to.buffer = vk::DescriptorBufferInfo { buffer, offset, range },
                Binding::Absent => {}
            }
        }
        // SAFETY: the set is ours and not in use; views and buffers are live, as the host promised to `record`. The template is
        // that of the set, and reads as many descriptors as the shader has bindings: at most MAX_BINDINGS.
        unsafe {
            self.device.update_descriptor_set_with_template(bindable.set, bindable.template, descriptors.as_ptr().cast());
        }
    }
}

/// The block that a shader reads.
fn push_constants(dispatch: &Dispatch, frame: &FrameContext, bindings: &[Binding]) -> [u32; MAX_PUSH_BYTES as usize / 4] {
    let mut block = [0; MAX_PUSH_BYTES as usize / 4];
    for (member, parameter) in dispatch.shader.members.iter().zip(&dispatch.parameters) {
        block[member.offset as usize / 4] = match *parameter {
            Parameter::Fixed(bits) => bits,
            Parameter::Tuning(index) => frame.tuning.bits(index),
            Parameter::Present => present(dispatch, bindings),
            Parameter::View => frame.debug_view.unwrap_or_default() as u32,
        };
    }
    block
}

//! An executor on a device of wgpu.

use crate::texture::{make_output, Bound, Seen};
use crate::Error;
use ash::vk;
use atrous::executor::{Executor, ExecutorOptions};
use atrous::{Declaration, Device, FrameContext, FrameParams, Lifetime, Phase, Shape, Tuning};
use std::collections::BTreeMap;
use std::mem::ManuallyDrop;
use std::sync::Arc;
use wgpu::hal::api::Vulkan;

/// A denoiser with textures of wgpu as inputs and outputs. Histories and transients are its own.
pub struct WgpuDenoiser {
    pub(crate) executor: ManuallyDrop<Executor>,
    device: wgpu::Device,
    pub(crate) bound: BTreeMap<String, Arc<Bound>>,
    seen: Seen,
    /// A token that the command buffers of each slot hold until they ran or were dropped.
    slots: Vec<Arc<()>>,
    frames: u64,
}

impl WgpuDenoiser {
    /// Creates pipelines, histories, transients, and a texture for each output. The declaration is that of a preset
    /// (`Config::declare`) or of a graph (`Graph::finish`).
    ///
    /// # Errors
    /// [`Error::NotVulkan`] for a device of a different backend; errors of [`Executor::new`].
    pub fn new(device: &wgpu::Device, declaration: Declaration) -> Result<Self, Error> {
        let (instance, physical_device, raw) = {
            // SAFETY: nothing is destroyed through the guard, which goes before the next is asked for.
            let hal = unsafe { device.as_hal::<Vulkan>() }.ok_or(Error::NotVulkan)?;
            (hal.shared_instance().raw_instance().clone(), hal.raw_physical_device(), hal.raw_device().clone())
        };
        let host = Device {
            instance: &instance,
            physical_device,
            device: &raw,
            pipeline_cache: vk::PipelineCache::null(),
            pipelines: None,
        };
        // wgpu does not enable synchronization2.
        let options = ExecutorOptions { legacy_barriers: true, ..Default::default() };
        let slots = (0..declaration.setup().frames_in_flight).map(|_| Arc::new(())).collect();
        // SAFETY: the handles are live and belong together; the device is kept as long as the executor.
        let executor = ManuallyDrop::new(unsafe { Executor::new(host, declaration, options)? });
        let seen = Seen::new(device);
        let mut this = Self { executor, device: device.clone(), bound: BTreeMap::new(), seen, slots, frames: 0 };
        this.make_outputs()?;
        Ok(this)
    }

    fn make_outputs(&mut self) -> Result<(), Error> {
        let declaration = self.declaration().clone();
        for resource in declaration.resources() {
            if resource.lifetime == Lifetime::Output && matches!(resource.shape, Shape::Image { .. }) {
                let texture = make_output(&self.device, &declaration, resource)?;
                self.bind(&resource.name, &texture, false)?;
            }
        }
        Ok(())
    }

    /// Resources and passes.
    pub fn declaration(&self) -> &Declaration {
        self.executor.denoiser().declaration()
    }

    /// Takes your texture as an input, until you give a new one. It needs `TEXTURE_BINDING` usage,
    /// two dimensions, one level, layer and sample, at least the allocated extent, and content that
    /// wgpu knows of: for example from a pass, a copy or `Queue::write_texture`. It belongs to the
    /// device of the denoiser.
    ///
    /// # Errors
    /// [`Error::Texture`] names the mismatch; errors of [`Executor::bind_image`].
    pub fn set_input(&mut self, name: &str, texture: &wgpu::Texture) -> Result<(), Error> {
        if self.has_output(name) {
            let problem = "it is no input but an output; give the texture to `WgpuDenoiser::set_output`".to_owned();
            return Err(Error::Texture { name: name.to_owned(), problem });
        }
        self.bind(name, texture, true)
    }

    /// Takes your texture for an output instead of the denoiser's own, until you give a new one or
    /// call [`Self::resize`]. It has the format of the declaration, at least the allocated extent,
    /// `STORAGE_BINDING`, `TEXTURE_BINDING` and `COPY_SRC` usage, two dimensions, one level, layer
    /// and sample, and belongs to the device of the denoiser. Its old content is lost; wgpu
    /// considers it written after the phase, also in the first frame.
    ///
    /// # Errors
    /// [`Error::Texture`] names the mismatch; errors of [`Executor::bind_image`].
    pub fn set_output(&mut self, name: &str, texture: &wgpu::Texture) -> Result<(), Error> {
        if self.declaration().find(name).is_some() && !self.has_output(name) {
            let problem =
                "it is no output; an input is given to `WgpuDenoiser::set_input`, all else is the denoiser's own".to_owned();
            return Err(Error::Texture { name: name.to_owned(), problem });
        }
        self.bind(name, texture, true)
    }

    fn has_output(&self, name: &str) -> bool {
        self.declaration().find(name).is_some_and(|id| self.declaration().resource(id).lifetime == Lifetime::Output)
    }

    /// Leaves an optional input out from now on.
    ///
    /// # Errors
    /// Errors of [`Executor::unbind`].
    pub fn leave_out(&mut self, name: &str) -> Result<(), Error> {
        self.executor.unbind(name)?;
        self.bound.remove(name);
        Ok(())
    }

    fn bind(&mut self, name: &str, texture: &wgpu::Texture, is_of_host: bool) -> Result<(), Error> {
        let declaration = self.declaration();
        let id = declaration.find(name).ok_or_else(|| atrous::Error::UnknownResource {
            given: name.to_owned(),
            known: declaration.resources().iter().map(|r| r.name.as_str()).collect::<Vec<_>>().join(", "),
        })?;
        let bound = Bound::new(name, declaration.resource(id), texture, is_of_host)?;
        let is_shared = |other: &Bound| other.texture == *texture && (other.is_output || bound.is_output);
        if let Some((other, _)) = self.bound.iter().find(|(other, known)| *other != name && is_shared(known)) {
            let problem = format!("it is bound to `{other}` already; an output needs a texture of its own");
            return Err(Error::Texture { name: name.to_owned(), problem });
        }
        #[cfg(feature = "capture")]
        if self.executor.frames_to_capture() > 0 {
            crate::capture::check(name, &bound)?;
        }
        self.executor.bind_image(name, bound.image)?;
        self.bound.insert(name.to_owned(), Arc::new(bound));
        Ok(())
    }

    /// The texture of an output, for your passes after the phase that writes it: yours, or the
    /// denoiser's own with `TEXTURE_BINDING`, `STORAGE_BINDING`, `COPY_SRC` and `COPY_DST`. `None`
    /// if there is no such output.
    pub fn output(&self, name: &str) -> Option<&wgpu::Texture> {
        self.bound.get(name).filter(|bound| bound.is_output).map(|bound| &bound.texture)
    }

    /// Starts a frame. The frame slot is the denoiser's own: this waits while the GPU still works
    /// on the last frame of the slot.
    ///
    /// # Errors
    /// [`Error::NotSubmitted`] if command buffers of the slot were neither submitted nor dropped;
    /// errors of [`Executor::begin_frame`].
    pub fn begin_frame(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        let slot = (self.frames % self.slots.len() as u64) as u32;
        self.wait_for(slot)?;
        let frame = self.executor.begin_frame(&FrameParams { frame_slot: slot, ..*params }, tuning)?;
        self.frames += 1;
        Ok(frame)
    }

    pub(crate) fn wait_for_all(&self) -> Result<(), Error> {
        (0..self.slots.len() as u32).try_for_each(|slot| self.wait_for(slot))
    }

    fn wait_for(&self, slot: u32) -> Result<(), Error> {
        let is_held = || self.slots.get(slot as usize).is_some_and(|held| Arc::strong_count(held) > 1);
        if is_held() {
            self.device.poll(wgpu::PollType::Poll)?;
        }
        if is_held() {
            self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: None })?;
        }
        if is_held() {
            return Err(Error::NotSubmitted { slot });
        }
        Ok(())
    }

    /// Records a phase into two command buffers: the transitions of its textures, by wgpu, and its
    /// passes, as raw commands. One encoder of wgpu cannot hold both.
    ///
    /// # Errors
    /// Errors of [`Executor::record`].
    ///
    /// # Safety
    /// Submit both once, in this order, after the work that writes the inputs of the phase, and
    /// before command buffers of later phases and frames. The frame was begun since the last
    /// [`Self::resize`].
    pub unsafe fn encode(&mut self, frame: &FrameContext, phase: Phase) -> Result<[wgpu::CommandBuffer; 2], Error> {
        let declaration = self.executor.denoiser().declaration();
        let touched = declaration.boundary(phase);
        let names = touched.iter().map(|use_| declaration.resource(use_.resource).name.as_str());
        let bound: Vec<Arc<Bound>> = names.filter_map(|name| self.bound.get(name).cloned()).collect();
        let describe = |label| wgpu::CommandEncoderDescriptor { label: Some(label) };
        let mut transitions = self.device.create_command_encoder(&describe("atrous: transitions"));
        bound.iter().filter(|b| b.is_output && b.is_of_host).for_each(|b| self.seen.mark(&mut transitions, &b.texture));
        transitions.transition_resources(
            std::iter::empty(),
            bound.iter().map(|b| wgpu::TextureTransition { texture: &b.texture, selector: None, state: b.state }),
        );
        let mut passes = self.device.create_command_encoder(&describe("atrous"));
        let executor = &mut self.executor;
        // SAFETY: the command buffer is recording outside a render pass, and nothing else is recorded into it; the slot's earlier
        // work is complete, since its frame was begun; the transitions bring the textures to the states they were bound in.
        unsafe {
            passes.as_hal_mut::<Vulkan, _, _>(|encoder| {
                let encoder = encoder.ok_or(Error::NotVulkan)?;
                Ok::<_, Error>(executor.record(encoder.raw_handle(), frame, phase)?)
            })?;
        }
        let passes = passes.finish();
        let held = (self.slots.get(frame.slot as usize).cloned(), bound);
        passes.on_submitted_work_done(move || drop(held));
        Ok([transitions.finish(), passes])
    }

    /// Runs the same passes for a new extent: waits for the GPU, and makes outputs, histories and
    /// transients anew. Give your inputs and outputs again. The first frame drops all history.
    ///
    /// # Errors
    /// [`Error::NotSubmitted`]; errors of [`Executor::resize`].
    pub fn resize(&mut self, allocated_extent: [u32; 2]) -> Result<(), Error> {
        self.wait_for_all()?;
        // SAFETY: no command buffer of any slot is left.
        unsafe { self.executor.resize(allocated_extent)? };
        self.bound.clear();
        self.make_outputs()
    }
}

impl Drop for WgpuDenoiser {
    fn drop(&mut self) {
        match self.wait_for_all() {
            // SAFETY: no command buffer of any slot is left, and the executor is not used again.
            Ok(()) => unsafe { ManuallyDrop::drop(&mut self.executor) },
            Err(error) => log::error!("atrous-wgpu: a denoiser is leaked, since the GPU may still use it: {error}"),
        }
    }
}

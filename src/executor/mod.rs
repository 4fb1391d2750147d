//! The built-in frame graph: for engines without one, for tools and for tests.
//!
//! It allocates the resources of a declaration, aliases transients by lifetime, keeps history
//! pairs, derives every barrier from the declared uses, and times passes. If you have a frame
//! graph, you need none of this.

mod barriers;
mod bound;
#[cfg(feature = "capture")]
mod capture;
mod counters;
mod headless;
mod input_set;
mod memory;
mod one_call;
mod profiler;
mod readback;
mod resize;
mod session;
mod session_inputs;
mod session_objects;
mod storage;
mod transfer;

pub use bound::HostImage;
#[cfg(feature = "capture")]
pub use capture::{GuideCheck, GuideVerdict};
pub use headless::{HeadlessDevice, HeadlessOptions, Validation};
pub use input_set::InputSet;
pub use one_call::LentImage;
pub use profiler::PassTime;
pub use readback::Readback;
pub use session::{Session, SessionOptions, Trace};

use crate::contract::{Binding, Declaration, FrameContext, FrameParams, Lifetime, Phase, ResourceId, Tuning};
use crate::error::Error;
use crate::record::{check_slot, Denoiser, Device, Requirements};
use ash::vk;
use barriers::Barriers;
use memory::Memory;
use profiler::Profiler;

/// Options of an executor beyond the declaration.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExecutorOptions {
    /// Additional usage of every image, for example `TRANSFER_SRC` to read results back.
    pub extra_image_usage: vk::ImageUsageFlags,
    /// Fills every transient, and every copy that is about to be written, with NaN before a frame:
    /// for tests.
    pub poison: bool,
    /// Bytes of the largest block of memory to ask the device for. `None`: as much as it gives at once, so that everything lies in one
    /// block for each type of memory, as large as what lies in it.
    pub largest_block: Option<u64>,
    /// Gives every transient memory of its own: to look at intermediate images.
    pub no_aliasing: bool,
    /// Times every pass by timestamps. Needs a queue family with `timestampValidBits`.
    pub timestamps: bool,
    /// Places barriers by `vkCmdPipelineBarrier`, for devices without synchronization2.
    pub legacy_barriers: bool,
    /// [`Tracker::stay_in_general`](crate::Tracker::stay_in_general), for engines with one layout.
    pub stay_in_general: bool,
    /// Labels every pass, and names every object. `VK_EXT_debug_utils` is enabled on the instance.
    pub debug_labels: bool,
    /// Switches [`Denoiser::checks`] on or off. `None`: on in debug builds.
    pub checks: Option<bool>,
    /// Checks the guides of the first frames, and logs its findings once: `atrous_conventions::check_frames`. It takes a good part of
    /// a second a frame, and ends with the first answer. The images of your guides need the usage `TRANSFER_SRC`. A capture ends it.
    #[cfg(feature = "capture")]
    pub check_guides: Option<GuideCheck>,
    /// Leaves out the barriers before the pass of this index. Breaks it on purpose, to prove that validation is listening.
    #[doc(hidden)]
    pub omit_barriers_before: Option<usize>,
}

/// Bytes that were allocated, as the device counts them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AllocatedMemory {
    /// Survives the frame.
    pub history: u64,
    /// Transients, after aliasing.
    pub transient: u64,
    /// Outputs without an image of yours.
    pub output: u64,
    /// Bytes of the blocks that the device gave for all of these: what is between them is for alignment.
    pub device: u64,
}

/// Runs a denoiser on your command buffers.
pub struct Executor {
    denoiser: Denoiser,
    device: ash::Device,
    memory: Memory,
    barriers: Barriers,
    profiler: Option<Profiler>,
    labels: Option<ash::ext::debug_utils::Device>,
    options: ExecutorOptions,
    bindings: Vec<Binding>,
    counters: counters::Counters,
    #[cfg(feature = "capture")]
    capture: capture::Capturing,
}

impl Executor {
    /// Creates the denoiser, and allocates histories, transients and outputs.
    ///
    /// # Errors
    /// Errors of [`Denoiser::new`] and, unless [`ExecutorOptions::legacy_barriers`] is set,
    /// [`Requirements::check_executor_device`]; [`Error::OutOfMemory`].
    ///
    /// # Safety
    /// Obligations of [`Denoiser::new`]; the device has `synchronization2` enabled, or `legacy_barriers` is set. Drop the executor only after its GPU work is
    /// complete.
    pub unsafe fn new(host: Device<'_>, declaration: Declaration, options: ExecutorOptions) -> Result<Self, Error> {
        // SAFETY: instance, physical device and device are live, belong together and outlive the executor; the device has
        // synchronization2, and its formats and limits were checked first.
        unsafe {
            if !options.legacy_barriers {
                Requirements::new(&declaration).check_executor_device(host)?;
            }
            let mut denoiser = Denoiser::new(host, declaration)?;
            denoiser.checks.on = options.checks.unwrap_or(denoiser.checks.on);
            if options.debug_labels {
                denoiser.name_objects(host);
            }
            let memory = Memory::new(host, denoiser.declaration(), &options)?;
            let passes = denoiser.declaration().passes().len();
            let profiler = if options.timestamps {
                Some(Profiler::new(host, denoiser.declaration().setup().frames_in_flight, passes, options.legacy_barriers)?)
            } else {
                None
            };
            let counters = counters::Counters::new(host, denoiser.declaration().setup().frames_in_flight)?;
            #[cfg(feature = "capture")]
            let capture = capture::Capturing::new(host, options.check_guides, denoiser.declaration());
            let labels = options.debug_labels.then(|| ash::ext::debug_utils::Device::new(host.instance, host.device));
            Ok(Self {
                denoiser,
                device: host.device.clone(),
                memory,
                barriers: Barriers::new(options.legacy_barriers),
                profiler,
                labels,
                options,
                bindings: Vec::new(),
                counters,
                #[cfg(feature = "capture")]
                capture,
            })
        }
    }

    /// The denoiser that is driven.
    pub fn denoiser(&self) -> &Denoiser {
        &self.denoiser
    }

    /// Bytes that were allocated.
    pub fn allocated(&self) -> AllocatedMemory {
        self.memory.allocated()
    }

    /// Starts a frame, and collects the timestamps of its slot.
    ///
    /// # Errors
    /// Errors of [`crate::FrameState::begin`]; [`Error::NotBound`] names a required input without
    /// an image, and an image that you did not bind again after [`Self::resize`].
    pub fn begin_frame(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        let (declaration, storages) = (self.denoiser.declaration(), &self.memory.storages);
        let is_required = |id| declaration.resource(id).lifetime != Lifetime::Input { optional: true };
        let mut ids = (0..declaration.resources().len() as u32).map(ResourceId);
        let missing = ids.find(|&id| storages.is_lost(id) || is_required(id) && storages.object(id, 0).is_none());
        if let Some(id) = missing {
            return Err(Error::NotBound(declaration.resource(id).name.to_owned()));
        }
        let frame = self.denoiser.begin_frame(params, tuning)?;
        if let Some(profiler) = &mut self.profiler {
            profiler.collect(frame.slot)?;
        }
        #[cfg(feature = "capture")]
        self.capture.begin_frame(&frame, params, tuning);
        Ok(frame)
    }

    /// Makes the next frame drop all history.
    pub fn invalidate(&mut self) {
        self.denoiser.invalidate();
    }

    /// Forgets recorded work that will never run, for example because a submission failed or you
    /// threw its command buffer away. The next frame drops all history; outputs hold nothing until
    /// then, and a capture that waits for a frame ends.
    pub fn forget_recorded(&mut self) {
        self.denoiser.invalidate();
        self.memory.storages.forget();
        self.counters.forget();
        #[cfg(feature = "capture")]
        self.capture.forget();
    }

    /// Makes the next frame count as `index` and drop all history: see
    /// [`crate::FrameState::restart_at`]. Not during a capture.
    pub fn restart_at(&mut self, index: u64) {
        self.denoiser.restart_at(index);
    }

    /// Replaces the code of a shader in all passes that run it, and keeps the history: see
    /// [`Denoiser::replace_shader`].
    ///
    /// # Errors
    /// Errors of [`Denoiser::replace_shader`].
    ///
    /// # Safety
    /// Obligations of [`Denoiser::replace_shader`].
    #[cfg(feature = "hot-reload")]
    pub unsafe fn replace_shader(&mut self, name: &str, spirv: &[u32]) -> Result<bool, Error> {
        // SAFETY: no GPU work that is not complete uses the pipelines that are replaced, and `spirv` is valid for Vulkan 1.1.
        unsafe { self.denoiser.replace_shader(name, spirv) }
    }

    /// Records every pass of a phase with its barriers; `debug_view` in frames with a view.
    ///
    /// # Errors
    /// Errors of [`Denoiser::record`].
    ///
    /// # Safety
    /// `cmd` is recording, outside a render pass, on a queue with `COMPUTE`; work recorded earlier with the frame's slot is
    /// complete; bound images and buffers are live, and in the state that they were bound with. Phases of a frame are recorded in
    /// order. The frame was begun since the last [`Self::resize`].
    pub unsafe fn record(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) -> Result<(), Error> {
        // SAFETY: the obligations are the same.
        unsafe { self.record_passes(cmd, frame, phase)? };
        // SAFETY: `cmd` is recording outside a render pass, and what the host bound is live.
        unsafe { self.barriers.hand_back(&self.device, cmd, &mut self.memory.storages) };
        Ok(())
    }

    /// Records a phase, and leaves lent images in the states in which the passes left them.
    ///
    /// # Safety
    /// Obligations of [`Self::record`].
    unsafe fn record_passes(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext, phase: Phase) -> Result<(), Error> {
        check_slot(self.denoiser.declaration(), frame)?;
        #[cfg(feature = "capture")]
        // SAFETY: work recorded earlier with the frame's slot is complete, so that nothing writes to the buffers of its capture.
        unsafe {
            self.capture.collect(frame)
        };
        let mut bound = vk::Pipeline::null();
        for pass in 0..self.denoiser.declaration().passes().len() {
            if self.denoiser.declaration().passes()[pass].phase != phase {
                continue;
            }
            if !self.is_left_out(frame, pass) {
                // SAFETY: `cmd` is recording outside a render pass on a compute queue; bound images and buffers are live and in the
                // state they were bound with; the slot's earlier work is complete. Barriers and timestamps bind no pipeline.
                unsafe { self.record_pass(cmd, frame, pass, &mut bound)? };
            } else if let Some(profiler) = &self.profiler {
                // Times of a frame are read together, so there has to be one.
                // SAFETY: `cmd` is recording, and the first pass, which was recorded before, has reset the queries of the slot.
                unsafe {
                    profiler.before_pass(cmd, frame.slot, pass);
                    profiler.after_pass(cmd, frame.slot, pass);
                }
            }
        }
        #[cfg(feature = "capture")]
        // SAFETY: `cmd` is recording; the inputs are live with usage `TRANSFER_SRC`, and the slot's earlier work is complete.
        unsafe {
            self.record_capture(cmd, frame, phase)
        };
        Ok(())
    }

    /// Records the pass `debug_view` again, with a different view, for a submission after that of
    /// the frame. Does nothing without [`crate::Config::debug_view`] or a view.
    ///
    /// # Errors
    /// Errors of [`Denoiser::record`].
    ///
    /// # Safety
    /// Obligations of [`Self::record`].
    pub unsafe fn record_debug_view(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext) -> Result<(), Error> {
        let passes = self.denoiser.declaration().passes();
        let Some(pass) = passes.iter().position(|p| p.draws_view()) else { return Ok(()) };
        if self.is_left_out(frame, pass) {
            return Ok(());
        }
        // The time of the first one counts.
        let profiler = self.profiler.take();
        // SAFETY: `cmd` is recording outside a render pass on a compute queue; bound images and buffers are live and in the state
        // they were bound with; the slot's earlier work is complete.
        let result = unsafe { self.record_pass(cmd, frame, pass, &mut vk::Pipeline::null()) };
        self.profiler = profiler;
        result?;
        // SAFETY: `cmd` is recording outside a render pass, and what the host bound is live.
        unsafe { self.barriers.hand_back(&self.device, cmd, &mut self.memory.storages) };
        Ok(())
    }

    fn is_left_out(&self, frame: &FrameContext, pass: usize) -> bool {
        frame.debug_view.is_none() && self.denoiser.declaration().passes()[pass].draws_view()
    }

    /// `bound` as in [`Denoiser::record_after`].
    pub(crate) unsafe fn record_pass(
        &mut self,
        cmd: vk::CommandBuffer,
        frame: &FrameContext,
        pass: usize,
        bound: &mut vk::Pipeline,
    ) -> Result<(), Error> {
        // SAFETY: `cmd` is recording outside a render pass on a compute queue; ours and the host's images and buffers are live, the
        // barriers bring them to the declared states, and the slot's earlier work is complete.
        unsafe {
            if pass == 0 {
                self.copy_counters(cmd, frame)?;
                if let Some(profiler) = &mut self.profiler {
                    profiler.start(cmd, frame.slot);
                }
                if self.options.poison {
                    self.barriers.poison(&self.device, cmd, self.denoiser.declaration(), frame, &mut self.memory.storages);
                }
            }
            let omit = self.options.omit_barriers_before == Some(pass);
            self.barriers.before_pass(&self.device, cmd, frame, pass, omit, &mut self.memory.storages);
            self.memory.storages.bindings(pass, frame, &mut self.bindings);
            if let Some(labels) = &self.labels {
                labels.cmd_begin_debug_utils_label(cmd, &vk::DebugUtilsLabelEXT::default().label_name(self.memory.label(pass)));
            }
            if let Some(profiler) = &self.profiler {
                profiler.before_pass(cmd, frame.slot, pass);
            }
            self.denoiser.record_after(cmd, frame, pass, &self.bindings, bound)?;
            if let Some(profiler) = &self.profiler {
                profiler.after_pass(cmd, frame.slot, pass);
            }
            if let Some(labels) = &self.labels {
                labels.cmd_end_debug_utils_label(cmd);
            }
        }
        Ok(())
    }

    /// Times of the newest frame whose timestamps were collected; empty before that, and without [`ExecutorOptions::timestamps`].
    pub fn times(&self) -> Vec<PassTime> {
        let names = self.denoiser.declaration().passes().iter().map(|p| p.name.as_str());
        self.profiler.as_ref().map_or(Vec::new(), |p| p.times(names))
    }
}

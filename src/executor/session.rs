//! Frames from slices to slices, one after the other: for tools, tests, and programs without an
//! engine.

use super::barriers::Barriers;
use super::headless::HeadlessDevice;
use super::session_objects::{Commands, OwnedImage};
use super::transfer::Staging;
use super::{Executor, ExecutorOptions, PassTime, Readback};
use crate::contract::{DebugView, Declaration, FrameContext, FrameParams, Statistics, Tuning, UseFrame};
use crate::error::Error;
use ash::vk;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Options of a session.
#[derive(Clone, Copy, Debug, Default)]
pub struct SessionOptions {
    /// See [`ExecutorOptions::poison`].
    pub poison: bool,
    /// See [`ExecutorOptions::timestamps`]; ignored where the queue has none.
    pub timestamps: bool,
    /// Keeps every transient readable after the frame, at the price of memory.
    pub keep_transients: bool,
    /// See [`ExecutorOptions::omit_barriers_before`].
    #[doc(hidden)]
    pub omit_barriers_before: Option<usize>,
}

/// An executor with a command buffer, a staging buffer and images for the inputs. Every frame is waited for.
///
/// A failed call of Vulkan is returned by the method that makes it, and the session stays usable
/// unless the device is lost. If commands did not run, the next frame drops all history, and you
/// can download nothing until then.
pub struct Session {
    // Declared before `gpu`, so that it is dropped first.
    pub(super) executor: Executor,
    pub(super) inputs: BTreeMap<String, Arc<OwnedImage>>,
    pub(super) buffers: BTreeMap<String, Staging>,
    pub(super) staging: Option<Staging>,
    commands: Commands,
    pub(super) barriers: Barriers,
    pub(super) frame: Option<FrameContext>,
    /// Whether a submission may still run, since waiting for it failed.
    is_pending: bool,
    pub(super) gpu: Arc<HeadlessDevice>,
}

/// The function that [`Session::run_traced`] calls before (`false`) and after (`true`) each pass, with its index.
pub type Trace<'a> = dyn FnMut(&mut Session, &FrameContext, usize, bool) -> Result<(), Error> + 'a;

impl Session {
    /// Opens a session on a device.
    ///
    /// # Errors
    /// Errors of [`Executor::new`].
    pub fn new(gpu: Arc<HeadlessDevice>, declaration: Declaration, options: SessionOptions) -> Result<Self, Error> {
        let executor_options = ExecutorOptions {
            extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC,
            poison: options.poison,
            no_aliasing: options.keep_transients,
            timestamps: options.timestamps && gpu.has_timestamps(),
            legacy_barriers: !gpu.has_synchronization2(),
            debug_labels: gpu.validates(),
            omit_barriers_before: options.omit_barriers_before,
            ..ExecutorOptions::default()
        };
        // SAFETY: the device is live, has synchronization2 where it is used, and is kept alive by `gpu`, which is dropped last.
        let (executor, commands) = unsafe {
            (Executor::new(gpu.host(), declaration, executor_options)?, Commands::new(gpu.device(), gpu.queue_family())?)
        };
        Ok(Self {
            executor,
            inputs: BTreeMap::new(),
            buffers: BTreeMap::new(),
            staging: None,
            commands,
            barriers: Barriers::new(!gpu.has_synchronization2()),
            frame: None,
            is_pending: false,
            gpu,
        })
    }

    /// The executor.
    pub fn executor(&self) -> &Executor {
        &self.executor
    }

    /// Makes the next frame drop all history.
    pub fn invalidate(&mut self) {
        self.executor.invalidate();
    }

    /// Makes the next frame count as `index` and drop all history: see
    /// [`crate::FrameState::restart_at`]. Not during a capture.
    pub fn restart_at(&mut self, index: u64) {
        self.executor.restart_at(index);
    }

    /// Replaces the code of a shader in all passes that run it, and keeps the history: see
    /// [`Denoiser::replace_shader`](crate::Denoiser::replace_shader).
    ///
    /// # Errors
    /// Errors of [`Denoiser::replace_shader`](crate::Denoiser::replace_shader).
    ///
    /// # Safety
    /// `spirv` is valid for Vulkan 1.1.
    #[cfg(feature = "hot-reload")]
    pub unsafe fn replace_shader(&mut self, name: &str, spirv: &[u32]) -> Result<bool, Error> {
        self.settle()?;
        // SAFETY: every frame was waited for, so that no work uses the old pipeline, and `spirv` is valid for Vulkan 1.1.
        unsafe { self.executor.replace_shader(name, spirv) }
    }

    /// Runs one frame with all its phases, and waits for it.
    ///
    /// # Errors
    /// Errors of [`Executor::begin_frame`] and [`Executor::record`].
    pub fn run(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        let frame = self.executor.begin_frame(params, tuning)?;
        self.frame = None;
        self.submit(|session, cmd| {
            for phase in crate::Phase::ALL {
                // SAFETY: the command buffer is recording, and every earlier frame was waited for.
                unsafe { session.executor.record(cmd, &frame, phase)? };
            }
            Ok(())
        })?;
        self.frame = Some(frame);
        Ok(frame)
    }

    /// Runs one frame as [`Self::run`] does, with every pass submitted and waited for on its own, and a call of `trace` before and
    /// after each.
    ///
    /// # Errors
    /// Errors of [`Self::run`], and whatever `trace` returns.
    pub fn run_traced(&mut self, params: &FrameParams, tuning: &Tuning, trace: &mut Trace<'_>) -> Result<FrameContext, Error> {
        let frame = self.executor.begin_frame(params, tuning)?;
        self.frame = Some(frame);
        for pass in 0..self.executor.denoiser().declaration().passes().len() {
            trace(self, &frame, pass, false)?;
            // SAFETY: `submit` hands over a command buffer that is recording, and waits for each submission before the next.
            self.submit(|session, cmd| unsafe { session.executor.record_pass(cmd, &frame, pass, &mut vk::Pipeline::null()) })?;
            trace(self, &frame, pass, true)?;
        }
        Ok(frame)
    }

    /// Texels of the output `debug_view` for the last frame, with any view. You may call it once
    /// for each view. rgb: display-referred, linear; alpha: the number behind it.
    ///
    /// # Errors
    /// Errors of [`Self::download`]: [`Error::UnknownResource`] without [`crate::Config::debug_view`].
    pub fn debug_view(&mut self, view: DebugView) -> Result<Vec<[f32; 4]>, Error> {
        let frame = self.frame.ok_or_else(|| Error::NoFrame("debug_view".into()))?;
        let frame = FrameContext { debug_view: Some(view), ..frame };
        // SAFETY: the command buffer is recording, and the frame was waited for.
        self.submit(|session, cmd| unsafe { session.executor.record_debug_view(cmd, &frame) })?;
        self.download("debug_view")
    }

    /// Texels of an output or a history of the last frame as floats; with [`SessionOptions::keep_transients`] of transients, too.
    ///
    /// # Errors
    /// [`Error::UnknownResource`]; [`Error::NoFrame`] before the first frame; [`Error::NotBound`] where nothing is bound.
    pub fn download(&mut self, name: &str) -> Result<Vec<[f32; 4]>, Error> {
        self.download_copy(name, UseFrame::Current).map(|(copy, bytes)| copy.to_floats(&bytes))
    }

    /// Counters of the last frame.
    ///
    /// # Errors
    /// [`Error::NoFrame`] before the first frame.
    pub fn statistics(&mut self) -> Result<Statistics, Error> {
        Statistics::from_bytes(&self.download_bytes("statistics", UseFrame::Current)?)
    }

    /// Raw texels of an output, a history or a transient, of either copy of a history: the bytes that [`Self::download`] makes
    /// floats of.
    ///
    /// # Errors
    /// Errors of [`Self::download`].
    pub fn download_bytes(&mut self, name: &str, frame: UseFrame) -> Result<Vec<u8>, Error> {
        self.download_copy(name, frame).map(|(_, bytes)| bytes)
    }

    fn download_copy(&mut self, name: &str, which: UseFrame) -> Result<(Readback, Vec<u8>), Error> {
        let frame = self.frame.ok_or_else(|| Error::NoFrame(name.to_owned()))?;
        let copy = self.executor.readback(name, &frame, which)?;
        self.stage(copy.bytes)?;
        self.submit(|session, cmd| {
            let buffer = session.staging.as_ref().map_or(vk::Buffer::null(), |s| s.buffer);
            // SAFETY: the command buffer is recording; the staging buffer is live and large enough.
            unsafe { session.executor.record_copy(cmd, &frame, name, which, buffer) }
        })?;
        Ok((copy, self.stage(copy.bytes)?.bytes()[..copy.bytes as usize].to_vec()))
    }

    /// Captures the next `frames` frames: see [`Executor::capture`]. Frames of [`Self::run_traced`] are not captured.
    ///
    /// # Errors
    /// Errors of [`Executor::capture`].
    #[cfg(feature = "capture")]
    pub fn capture(&mut self, folder: impl AsRef<std::path::Path>, frames: u32) -> Result<(), Error> {
        self.executor.capture(folder, frames)
    }

    /// Writes the captured frames that are not yet written, and ends the capture: see
    /// [`Executor::finish_capture`].
    ///
    /// # Errors
    /// Errors of [`Executor::finish_capture`].
    #[cfg(feature = "capture")]
    pub fn finish_capture(&mut self) -> Result<u32, Error> {
        self.settle()?;
        // SAFETY: every frame was waited for.
        unsafe { self.executor.finish_capture() }
    }

    /// GPU time per pass of the previous frame the last: see [`Executor::times`].
    pub fn times(&self) -> Vec<PassTime> {
        self.executor.times()
    }

    /// The staging buffer, at least `size` bytes.
    pub(super) fn stage(&mut self, size: u64) -> Result<&mut Staging, Error> {
        self.settle()?;
        if self.staging.as_ref().is_none_or(|s| s.size < size) {
            // SAFETY: the device outlives the session; every earlier use of the old one was waited for.
            self.staging = Some(unsafe { Staging::new(self.gpu.host(), size)? });
        }
        self.staging.as_mut().ok_or(Error::OutOfMemory { what: "a staging buffer".into(), bytes: size })
    }

    /// Records, submits and waits. If that fails, the commands may have run only in part: the next
    /// frame drops all history, and there is no frame to look at until then.
    pub(super) fn submit(&mut self, record: impl FnOnce(&mut Self, vk::CommandBuffer) -> Result<(), Error>) -> Result<(), Error> {
        self.submit_and_wait(record).inspect_err(|_| {
            self.executor.forget_recorded();
            self.frame = None;
        })
    }

    fn submit_and_wait(&mut self, record: impl FnOnce(&mut Self, vk::CommandBuffer) -> Result<(), Error>) -> Result<(), Error> {
        self.settle()?;
        let Commands { cmd, fence, .. } = self.commands;
        let gpu = self.gpu.clone();
        let device = gpu.device();
        // SAFETY: command buffer and fence are ours and idle, since every submission is waited for.
        unsafe {
            let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            device.begin_command_buffer(cmd, &begin).map_err(Error::vulkan("vkBeginCommandBuffer"))?;
            let recorded = record(self, cmd);
            device.end_command_buffer(cmd).map_err(Error::vulkan("vkEndCommandBuffer"))?;
            recorded?;
            // Before the submission, where a failure leaves nothing running.
            device.reset_fences(&[fence]).map_err(Error::vulkan("vkResetFences"))?;
            let commands = [cmd];
            let submit = vk::SubmitInfo::default().command_buffers(&commands);
            device.queue_submit(*gpu.queue(), &[submit], fence).map_err(Error::vulkan("vkQueueSubmit"))?;
            let waited = device.wait_for_fences(&[fence], true, u64::MAX).map_err(Error::vulkan("vkWaitForFences"));
            self.is_pending = waited.is_err();
            // A second call may do what the first could not; where it does not, whoever comes next tries again.
            waited.inspect_err(|_| _ = self.settle())
        }
    }

    /// Waits for work that an earlier call could not wait for: its resources may be neither written
    /// nor destroyed before. A lost device uses nothing.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        if !self.is_pending {
            return Ok(());
        }
        let idle = {
            let queue = self.gpu.queue();
            // SAFETY: the queue is that of the device, and locked.
            unsafe { self.gpu.device().queue_wait_idle(*queue) }
        };
        self.is_pending = idle.is_err_and(|result| result != vk::Result::ERROR_DEVICE_LOST);
        idle.map_err(Error::vulkan("vkQueueWaitIdle"))
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // Waiting for a device uses its queues.
        let _queue = self.gpu.queue();
        // SAFETY: the device is live. A failure means that it is lost, and then nothing runs on it.
        let _ = unsafe { self.gpu.device().device_wait_idle() };
    }
}

//! Captures frames on their way through the executor: copies of the inputs are recorded behind the passes that read them, and
//! written when the frame slot comes round again. See [`crate::capture`].

use super::storage::Object;
use super::transfer::Staging;
use super::Executor;
use crate::capture::{InputFrame, InputImage, SequenceWriter};
use crate::contract::{Declaration, FrameContext, FrameParams, Lifetime, ResourceId, Tuning};
use crate::error::Error;
use crate::reference::InstanceTransform;
use ash::vk;
use std::collections::BTreeMap;
use std::path::Path;

mod guides;
mod recording;

pub use guides::{GuideCheck, GuideVerdict};

/// The state of a capture, if there is one.
pub(super) struct Capturing {
    device: ash::Device,
    memory_types: vk::PhysicalDeviceMemoryProperties,
    writer: Option<SequenceWriter>,
    /// Takes the frames instead of a writer: the guides alone.
    checker: Option<guides::Checker>,
    /// Frames that are still to begin.
    remaining: u32,
    /// The frame that the sequence starts with.
    first_index: Option<u64>,
    /// The frame that was begun last, until it is recorded.
    begun: Option<Frame>,
    /// Copies in flight, by frame slot.
    slots: BTreeMap<u32, Slot>,
    /// The error that ended the capture, for [`Executor::finish_capture`].
    failure: Option<Error>,
}

/// The facts that are known of a frame when it begins.
#[derive(Clone, Copy)]
struct Frame {
    index: u64,
    params: FrameParams,
    tuning: Tuning,
}

/// Buffers of a frame slot. They are kept from frame to frame.
#[derive(Default)]
struct Slot {
    /// The frame that is to be written.
    frame: Option<Frame>,
    /// The last frame that was recorded with the buffers.
    last_index: u64,
    /// Whether every phase with inputs was recorded.
    complete: bool,
    buffers: BTreeMap<String, Staging>,
    copies: Vec<Copied>,
}

/// An input that was copied into the buffer of its name.
struct Copied {
    name: String,
    /// Format of the texels; undefined for a buffer.
    format: vk::Format,
    bytes: usize,
}

/// Bytes of an entry of `instance_transforms`.
const TRANSFORM_BYTES: usize = size_of::<InstanceTransform>();

impl Capturing {
    pub(crate) fn new(host: crate::Device<'_>, check: Option<GuideCheck>, declaration: &Declaration) -> Self {
        // SAFETY: the handles are live, as `Executor::new` demands.
        let memory_types = unsafe { host.instance.get_physical_device_memory_properties(host.physical_device) };
        Self {
            device: host.device.clone(),
            memory_types,
            writer: None,
            checker: check.map(|check| guides::Checker::new(check, declaration.setup().conventions)),
            remaining: check.map_or(0, |_| guides::CHECKED_FRAMES),
            first_index: None,
            begun: None,
            slots: BTreeMap::new(),
            failure: None,
        }
    }

    /// Frames that were asked for and are not written yet.
    fn outstanding(&self) -> u32 {
        if self.checker.is_some() {
            return 0;
        }
        self.remaining + u32::from(self.begun.is_some()) + self.slots.values().filter(|s| s.frame.is_some()).count() as u32
    }

    pub(crate) fn begin_frame(&mut self, frame: &FrameContext, params: &FrameParams, tuning: &Tuning) {
        // One that was begun and never recorded does not count.
        self.remaining += u32::from(self.begun.take().is_some());
        if self.remaining == 0 {
            return;
        }
        self.remaining -= 1;
        // A reset that the denoiser forced is one for the replay, too.
        let params = FrameParams { reset: frame.reset, ..*params };
        self.begun = Some(Frame { index: frame.index, params, tuning: *tuning });
    }

    /// Writes the frame that was recorded with this slot before, and makes the slot that of this frame.
    ///
    /// # Safety
    /// GPU work recorded with the slot for earlier frames is complete.
    pub(crate) unsafe fn collect(&mut self, frame: &FrameContext) {
        if self.slots.get(&frame.slot).and_then(|s| s.frame).is_some_and(|f| f.index != frame.index) {
            // SAFETY: GPU work recorded with the slot for earlier frames is complete, so that nothing writes to its buffers.
            unsafe { self.write(frame.slot) };
        }
        match self.begun.take_if(|f| f.index == frame.index) {
            Some(begun) => {
                self.first_index.get_or_insert(frame.index);
                let slot = self.slots.entry(frame.slot).or_default();
                (slot.frame, slot.last_index) = (Some(begun), frame.index);
            }
            // The capture is over as far as this slot goes: its buffers are idle, unless an earlier phase of this very frame uses
            // them.
            None if self.remaining == 0 && self.begun.is_none() => {
                self.slots.retain(|slot, s| *slot != frame.slot || s.frame.is_some() || s.last_index == frame.index);
            }
            None => {}
        }
    }

    /// # Safety
    /// GPU work recorded with the slot is complete.
    unsafe fn write(&mut self, slot: u32) {
        if self.checker.is_some() {
            return self.check_guides(slot);
        }
        let (Some(slot), Some(writer)) = (self.slots.get_mut(&slot), &mut self.writer) else { return };
        let Some(frame) = slot.frame.take() else { return };
        let copies = std::mem::take(&mut slot.copies);
        let number = frame.index.wrapping_sub(self.first_index.unwrap_or(frame.index));
        let result = if std::mem::take(&mut slot.complete) {
            let inputs = slot.buffers.iter_mut().filter_map(|(name, buffer)| {
                let Copied { format, bytes, .. } = copies.iter().find(|c| c.name == *name)?;
                Some(InputImage { name, format: *format, texels: &buffer.bytes()[..*bytes] })
            });
            let (buffers, images): (Vec<_>, Vec<_>) = inputs.partition(|input| input.format == vk::Format::UNDEFINED);
            let transforms: Option<Vec<_>> = buffers.first().map(|b| bytemuck::allocation::pod_collect_to_vec(b.texels));
            let (params, tuning, instance_transforms) = (&frame.params, &frame.tuning, transforms.as_deref());
            writer.write_numbered(number, &InputFrame { index: frame.index, params, tuning, images: &images, instance_transforms })
        } else {
            let problem =
                format!("frame {number} was begun, and not all of its phases were recorded; record each phase of each frame");
            Err(writer.error(problem))
        };
        if let Err(error) = result {
            self.fail(error);
        }
    }

    /// Ends the capture where the copies of a frame may never run.
    pub(crate) fn forget(&mut self) {
        if let Some(checker) = &mut self.checker {
            checker.forget();
            return self.drop_frames();
        }
        let waiting = self.slots.values().find_map(|slot| slot.frame);
        if let Some((frame, writer)) = waiting.zip(self.writer.as_ref()) {
            let number = frame.index.wrapping_sub(self.first_index.unwrap_or(frame.index));
            self.fail(writer.error(format!("frame {number} was recorded and never ran; start another capture")));
        }
    }

    /// Ends the capture. What the GPU may still write to is kept until its slot comes round.
    fn fail(&mut self, error: Error) {
        if self.checker.take().is_some() {
            log::warn!("atrous: the guides are not checked: {error}");
        } else {
            log::error!("atrous: the capture ends early: {error}");
            self.failure.get_or_insert(error);
        }
        self.remaining = 0;
        self.begun = None;
        self.drop_frames();
    }

    /// Forgets what was copied. The buffers stay, since the GPU may still write to them.
    fn drop_frames(&mut self) {
        for slot in self.slots.values_mut() {
            slot.frame = None;
            slot.copies.clear();
        }
    }

    /// Writes the frames of all slots.
    ///
    /// # Safety
    /// All GPU work that was recorded is complete.
    unsafe fn write_all(&mut self) {
        let mut slots: Vec<_> = self.slots.iter().filter_map(|(slot, s)| Some((s.frame?.index, *slot))).collect();
        slots.sort_unstable();
        for (_, slot) in slots {
            // SAFETY: all GPU work that was recorded is complete, so that nothing writes to the buffers of any slot.
            unsafe { self.write(slot) };
        }
        self.slots.clear();
    }

    /// Writes the recorded frames. Frames of a different extent do not belong to the sequence.
    ///
    /// # Safety
    /// All GPU work that was recorded is complete.
    pub(crate) unsafe fn end_before_resize(&mut self) {
        // SAFETY: all GPU work that was recorded is complete.
        unsafe { self.write_all() };
        if let Some(checker) = &mut self.checker {
            checker.forget();
        }
        let lacking = self.outstanding();
        if let Some(writer) = self.writer.as_ref().filter(|_| lacking > 0) {
            let problem = format!("{lacking} frames are lacking, since the images were resized; start another capture behind that");
            self.fail(writer.error(problem));
        }
    }

    /// # Safety
    /// All GPU work that was recorded is complete.
    unsafe fn finish(&mut self) -> Result<u32, Error> {
        if self.checker.is_some() {
            return Ok(0);
        }
        // SAFETY: all GPU work that was recorded is complete.
        unsafe { self.write_all() };
        self.begun = None;
        (self.remaining, self.first_index) = (0, None);
        let written = self.writer.take().map_or(0, |w| w.frames_written());
        self.failure.take().map_or(Ok(written), Err)
    }
}

impl Drop for Capturing {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            // SAFETY: an executor is dropped only after its GPU work is complete. What goes wrong was logged.
            let _ = unsafe { self.finish() };
        }
    }
}

impl Executor {
    /// Captures the inputs of the next `frames` frames as a sequence in `folder`, which `atrous-denoise` can replay: see
    /// [`crate::capture`].
    ///
    /// Copies are recorded at the end of the phase that uses an input last. A frame is written, in [`Self::record`], when its slot
    /// comes round again, which takes as long as compressing it does; the last ones when recording goes on, in
    /// [`Self::finish_capture`], or when the executor is dropped. An error on the way ends the capture and never a frame: it is
    /// logged, and [`Self::finish_capture`] returns it.
    ///
    /// Every bound input needs `TRANSFER_SRC` usage, and every frame the same inputs and render extent.
    ///
    /// # Errors
    /// [`Error::Capture`] for 0 frames, while a capture is in progress, for a folder that cannot be
    /// written or that holds a sequence; [`Error::Format`] for a bound image that cannot be
    /// captured.
    pub fn capture(&mut self, folder: impl AsRef<Path>, frames: u32) -> Result<(), Error> {
        let folder = folder.as_ref();
        let refused = |problem: String| Err(Error::Capture { path: folder.to_owned(), problem });
        if frames == 0 {
            return refused("0 frames were asked for; ask for 1 or more".to_owned());
        }
        let outstanding = self.capture.outstanding();
        if outstanding > 0 {
            let to = self.capture.writer.as_ref().map_or(String::new(), |w| w.folder().display().to_string());
            return refused(format!("a capture to {to} lacks {outstanding} frames; wait for them, or call finish_capture first"));
        }
        let declaration = self.denoiser.declaration();
        for (id, name) in inputs(declaration) {
            if let Some(image) = self.memory.storages.object(id, 0).and_then(Object::image) {
                image.texel_bytes(name)?;
            }
        }
        let writer = SequenceWriter::new(folder, self.denoiser.declaration())?;
        if self.capture.checker.take().is_some() {
            self.capture.begun = None;
            self.capture.drop_frames();
        }
        self.capture.failure = None;
        (self.capture.first_index, self.capture.writer, self.capture.remaining) = (None, Some(writer), frames);
        Ok(())
    }

    /// Frames of the capture that are not written yet; 0 if none is in progress, and after it
    /// failed.
    pub fn frames_to_capture(&self) -> u32 {
        self.capture.outstanding()
    }

    /// Writes the recorded frames that are not yet written, and ends the capture, even if frames
    /// are missing. Returns the number of written frames; 0 without a capture.
    ///
    /// # Errors
    /// [`Error::Capture`], [`Error::Format`] and others that ended the capture early. Frames that were written before stay, and can
    /// be replayed.
    ///
    /// # Safety
    /// GPU work recorded with this executor is complete.
    pub unsafe fn finish_capture(&mut self) -> Result<u32, Error> {
        // SAFETY: all GPU work that was recorded with this executor is complete, so that nothing writes to its buffers.
        unsafe { self.capture.finish() }
    }
}

/// Every input.
fn inputs(declaration: &Declaration) -> impl Iterator<Item = (ResourceId, &str)> + '_ {
    (0..)
        .map(ResourceId)
        .zip(declaration.resources())
        .filter_map(|(id, r)| matches!(r.lifetime, Lifetime::Input { .. }).then_some((id, r.name.as_str())))
}

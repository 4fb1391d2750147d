//! The counters of frames, read when a frame slot comes round again, so that nothing waits. A
//! warning tells of lost history, or of noise that repeats.

use super::transfer::Staging;
use super::Executor;
use crate::contract::{FrameContext, Statistics, StatisticsWatch, UseFrame, STATISTICS_BYTES};
use crate::error::Error;
use crate::record::Device;
use ash::vk;

/// Name of the buffer.
const STATISTICS: &str = "statistics";

/// Copies of the counters, by frame slot.
pub(super) struct Counters {
    slots: Vec<Slot>,
    /// Whether the buffer holds counters of a frame.
    is_filled: bool,
    newest: Option<Statistics>,
    watch: StatisticsWatch,
}

struct Slot {
    staging: Staging,
    is_recorded: bool,
}

impl Counters {
    /// # Safety
    /// Obligations of `Executor::new`.
    pub(crate) unsafe fn new(host: Device<'_>, slots: u32) -> Result<Self, Error> {
        // SAFETY: instance, physical device and device are live, belong together and outlive the executor.
        let slot = |_| unsafe { Staging::new(host, STATISTICS_BYTES) }.map(|staging| Slot { staging, is_recorded: false });
        Ok(Self {
            slots: (0..slots).map(slot).collect::<Result<_, Error>>()?,
            is_filled: false,
            newest: None,
            watch: StatisticsWatch::default(),
        })
    }

    /// Forgets the content of the buffer, which is a new one now.
    pub(crate) fn resize(&mut self) {
        self.is_filled = false;
    }

    /// Forgets recorded work that will never run: the buffer and its copies keep their old content.
    pub(crate) fn forget(&mut self) {
        self.is_filled = false;
        self.slots.iter_mut().for_each(|slot| slot.is_recorded = false);
    }

    /// Reads the last copy of this slot.
    fn collect(&mut self, slot: u32) {
        let slot = &mut self.slots[slot as usize];
        if !std::mem::take(&mut slot.is_recorded) {
            return;
        }
        let Ok(statistics) = Statistics::from_bytes(slot.staging.bytes()) else { return };
        self.newest = Some(statistics);
        if let Some(finding) = self.watch.look(&statistics) {
            log::warn!("atrous: {finding}");
        }
    }
}

impl Executor {
    /// Counters of the newest frame that was read: the one before the last with this frame's slot.
    /// `None` until then, and if you bound the buffer `statistics` yourself.
    pub fn statistics(&self) -> Option<Statistics> {
        self.counters.newest
    }

    /// Copies the counters of the previous frame, which the first pass clears.
    ///
    /// # Safety
    /// Obligations of [`Self::record`].
    pub(super) unsafe fn copy_counters(&mut self, cmd: vk::CommandBuffer, frame: &FrameContext) -> Result<(), Error> {
        self.counters.collect(frame.slot);
        let is_lent = self.memory.storages.is_lent(self.denoiser.declaration().named(STATISTICS)?);
        // What this frame writes into a buffer of the host is not in ours.
        let was_filled = std::mem::replace(&mut self.counters.is_filled, !is_lent);
        if is_lent || !was_filled {
            return Ok(());
        }
        let slot = &mut self.counters.slots[frame.slot as usize];
        slot.is_recorded = true;
        let buffer = slot.staging.buffer;
        // SAFETY: `cmd` is recording outside a render pass; both buffers are ours and have the size of the counters, and the slot's
        // earlier work is complete.
        unsafe { self.record_copy(cmd, frame, STATISTICS, UseFrame::Current, buffer) }
    }
}

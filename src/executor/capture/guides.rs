//! A check of the guides of the first frames, while a host is being integrated.

use super::{Capturing, Frame};
use crate::capture::{InputFrame, InputImage};
use crate::config::Conventions;
use ash::vk;

/// Guides, by the names of their resources.
pub(super) const NAMES: [&str; 4] = ["depth", "normal", "motion", "surface_id"];

/// Frames after which a check ends that found nothing.
pub(super) const CHECKED_FRAMES: u32 = 16;

/// Compares the guides of two consecutive frames with your conventions: `atrous_conventions::check_frames`.
pub type GuideCheck = fn(&Conventions, &InputFrame<'_>, &InputFrame<'_>) -> GuideVerdict;

/// The answer of a [`GuideCheck`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GuideVerdict {
    /// The two frames cannot tell, for example because the camera stands still.
    Inconclusive,
    /// The guides are as declared.
    Sound,
    /// The mistakes and their remedies, for the log.
    Mistaken(String),
}

/// A frame whose guides were read back.
struct Guides {
    frame: Frame,
    /// Name, format and texels.
    images: Vec<(String, vk::Format, Vec<u8>)>,
}

impl Guides {
    /// Hands the frame out as checks take it.
    fn with<T>(&self, body: impl FnOnce(&InputFrame<'_>) -> T) -> T {
        let images = self.images.iter().map(|(name, format, texels)| InputImage { name, format: *format, texels });
        let images: Vec<_> = images.collect();
        let Frame { index, params, tuning } = &self.frame;
        body(&InputFrame { index: *index, params, tuning, images: &images, instance_transforms: None })
    }
}

/// A check in progress.
pub(super) struct Checker {
    check: GuideCheck,
    conventions: Conventions,
    previous: Option<Guides>,
    frames: u32,
}

impl Checker {
    pub(super) fn new(check: GuideCheck, conventions: Conventions) -> Self {
        Self { check, conventions, previous: None, frames: 0 }
    }

    /// The frame before is not that of the next one.
    pub(super) fn forget(&mut self) {
        self.previous = None;
    }

    /// Takes a frame; whether the check is over. What it found stands in the log then.
    fn take(&mut self, current: Guides) -> bool {
        let previous = self.previous.take().filter(|previous| previous.frame.index.wrapping_add(1) == current.frame.index);
        let verdict = previous.filter(|_| current.frame.params.reset.is_none()).map_or(GuideVerdict::Inconclusive, |previous| {
            previous.with(|previous| current.with(|current| (self.check)(&self.conventions, previous, current)))
        });
        self.frames += 1;
        let is_last = self.frames >= CHECKED_FRAMES;
        match &verdict {
            GuideVerdict::Inconclusive if is_last => log::info!(
                "atrous: {CHECKED_FRAMES} frames could not tell whether the guides are as declared; move and turn the camera from the start"
            ),
            GuideVerdict::Inconclusive => {}
            GuideVerdict::Sound => log::info!("atrous: the guides are as declared"),
            GuideVerdict::Mistaken(text) => {
                log::warn!("atrous: the guides of frame {} are not as declared:\n{text}", current.frame.index);
            }
        }
        self.previous = Some(current);
        is_last || verdict != GuideVerdict::Inconclusive
    }
}

impl Capturing {
    /// Gives the guides of a slot to the check, if all were copied.
    pub(super) fn check_guides(&mut self, slot: u32) {
        let (Some(slot), Some(checker)) = (self.slots.get_mut(&slot), &mut self.checker) else { return };
        let (copies, is_complete) = (std::mem::take(&mut slot.copies), std::mem::take(&mut slot.complete));
        let Some(frame) = slot.frame.take().filter(|_| is_complete) else { return };
        let images = copies.into_iter().filter_map(|copied| {
            let buffer = slot.buffers.get_mut(&copied.name)?;
            let texels = buffer.bytes().get(..copied.bytes)?.to_vec();
            Some((copied.name, copied.format, texels))
        });
        if checker.take(Guides { frame, images: images.collect() }) {
            (self.checker, self.remaining, self.begun) = (None, 0, None);
            self.drop_frames();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::{FrameParams, ResetReason, Tuning};
    use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

    fn guides(index: u64, reset: Option<ResetReason>) -> Guides {
        let params = FrameParams { reset, ..FrameParams::new([4, 4]) };
        Guides { frame: Frame { index, params, tuning: Tuning::default() }, images: Vec::new() }
    }

    #[test]
    fn consecutive_frames_are_compared_until_there_is_an_answer() {
        static CALLS: AtomicU32 = AtomicU32::new(0);
        let check: GuideCheck = |_, previous, current| {
            CALLS.fetch_add(1, Relaxed);
            assert_eq!(previous.index + 1, current.index);
            if current.index == 6 {
                GuideVerdict::Sound
            } else {
                GuideVerdict::Inconclusive
            }
        };
        let mut checker = Checker::new(check, Conventions::default());
        let is_over = |checker: &mut Checker, index, reset| checker.take(guides(index, reset));
        assert!(!is_over(&mut checker, 0, Some(ResetReason::Created)));
        assert!(!is_over(&mut checker, 1, None));
        assert_eq!(CALLS.load(Relaxed), 1);
        assert!(!is_over(&mut checker, 3, None), "a frame is missing between them");
        assert!(!is_over(&mut checker, 4, Some(ResetReason::CameraCut)), "its previous frame is another shot");
        assert_eq!(CALLS.load(Relaxed), 1);
        assert!(!is_over(&mut checker, 5, None));
        assert!(is_over(&mut checker, 6, None));
        assert_eq!(CALLS.load(Relaxed), 3);
    }

    #[test]
    fn a_check_without_an_answer_ends() {
        let mut checker = Checker::new(|_, _, _| GuideVerdict::Inconclusive, Conventions::default());
        let over: Vec<_> = (0..CHECKED_FRAMES).map(|index| checker.take(guides(index.into(), None))).collect();
        assert_eq!(over.iter().position(|over| *over), Some(CHECKED_FRAMES as usize - 1));
    }
}

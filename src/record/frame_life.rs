//! The life of the frames of a denoiser: one is the history of the next where it was recorded, and not where it was only begun.

use crate::contract::{Declaration, FrameContext, FrameParams, FrameState, PassDecl, Tuning};
use crate::error::Error;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The memory of the previous frame, and how far the frame that was begun last has come.
pub(crate) struct FrameLife {
    state: FrameState,
    /// Passes of which each has to be recorded before the frame can be history: all up to the last that writes one.
    needed: Vec<bool>,
    /// Passes of the frame that was begun last that are still to be recorded: by any thread, since recording shares the denoiser.
    missing: Vec<AtomicBool>,
    warned: bool,
}

impl FrameLife {
    pub(crate) fn new(declaration: &Declaration) -> Self {
        let is_history = |u: &crate::Use| u.access.writes() && declaration.resource(u.resource).lifetime.is_history();
        let passes = declaration.passes();
        let end = passes.iter().rposition(|pass| pass.uses.iter().any(is_history)).map_or(0, |last| last + 1);
        // A host may leave a view out of a frame; nothing reads it.
        let is_needed = |(index, pass): (usize, &PassDecl)| index < end && !pass.draws_view();
        let needed: Vec<bool> = passes.iter().enumerate().map(is_needed).collect();
        Self {
            state: FrameState::default(),
            missing: needed.iter().map(|_| AtomicBool::new(false)).collect(),
            needed,
            warned: false,
        }
    }

    /// Starts a frame, which drops all history where the previous frame was not recorded.
    pub(crate) fn begin(
        &mut self,
        declaration: &Declaration,
        params: &FrameParams,
        tuning: &Tuning,
    ) -> Result<FrameContext, Error> {
        let mut state = self.state.clone();
        let is_whole = !self.missing.iter().any(|missing| missing.load(Relaxed));
        if !is_whole {
            state.invalidate();
        }
        let frame = state.begin(declaration.setup(), params, tuning)?;
        if !is_whole && !std::mem::replace(&mut self.warned, true) {
            log::warn!(
                "atrous: frame {} drops all history, since passes of the frame before were not recorded; record each frame whole before the \
                 next is begun",
                frame.index
            );
        }
        self.state = state;
        self.missing.iter_mut().zip(&self.needed).for_each(|(missing, needed)| *missing.get_mut() = *needed);
        Ok(frame)
    }

    /// Notes that a pass was recorded.
    pub(crate) fn recorded(&self, pass: usize) {
        self.missing[pass].store(false, Relaxed);
    }

    pub(crate) fn invalidate(&mut self) {
        self.state.invalidate();
    }

    pub(crate) fn restart_at(&mut self, index: u64) {
        self.state.restart_at(index);
        self.missing.iter_mut().for_each(|missing| *missing.get_mut() = false);
    }

    pub(crate) fn resize(&mut self) {
        self.state.resize();
        self.missing.iter_mut().for_each(|missing| *missing.get_mut() = false);
    }
}

/// The slot of a frame is below `frames_in_flight`.
pub(crate) fn check_slot(declaration: &Declaration, frame: &FrameContext) -> Result<(), Error> {
    let frames_in_flight = declaration.setup().frames_in_flight;
    let given = frame.slot;
    (given < frames_in_flight).then_some(()).ok_or(Error::FrameSlot { given, frames_in_flight })
}

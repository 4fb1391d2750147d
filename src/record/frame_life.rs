//! The life of the frames of a denoiser: one is the history of the next where it was recorded, and not where it was only begun.

use crate::contract::{Declaration, FrameContext, FrameParams, FrameState, PassDecl, Tuning};
use crate::error::Error;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The memory of the previous frame, and how far the frame that was begun last has come.
pub(crate) struct FrameLife {
    state: FrameState,
    /// Passes of which each has to be recorded before the frame can be history: all up to the last that writes one.
    needed: Vec<bool>,
    /// Whether a frame was begun, and its number.
    begun: Option<u64>,
    /// Passes of that frame that were recorded: by any thread, since recording shares the denoiser.
    recorded: Vec<AtomicBool>,
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
            begun: None,
            recorded: needed.iter().map(|_| AtomicBool::new(false)).collect(),
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
        let is_done = |(needed, recorded): (&bool, &AtomicBool)| !needed || recorded.load(Relaxed);
        let is_whole = self.begun.is_none() || self.needed.iter().zip(&self.recorded).all(is_done);
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
        self.begun = Some(frame.index);
        self.recorded.iter_mut().for_each(|recorded| *recorded.get_mut() = false);
        Ok(frame)
    }

    /// Whether the frame that was begun last has all its passes, or was given up: not begun, or not recorded from some pass on.
    pub(crate) fn check_whole(&mut self, declaration: &Declaration) -> Result<(), Error> {
        let Some(frame) = self.begun else { return Ok(()) };
        let last = self.recorded.iter().rposition(|recorded| recorded.load(Relaxed));
        let passes = declaration.passes().iter().zip(&self.recorded).take(last.unwrap_or(0));
        let is_missing = |(pass, recorded): &(&PassDecl, &AtomicBool)| !recorded.load(Relaxed) && !pass.draws_view();
        let passes: Vec<_> = passes.filter(is_missing).map(|(pass, _)| format!("`{}`", pass.name)).collect();
        if passes.is_empty() {
            return Ok(());
        }
        self.invalidate();
        Err(Error::LeftOut { frame, passes })
    }

    /// Notes that a pass was recorded.
    pub(crate) fn recorded(&self, pass: usize) {
        self.recorded[pass].store(true, Relaxed);
    }

    pub(crate) fn invalidate(&mut self) {
        self.state.invalidate();
        self.begun = None;
    }

    pub(crate) fn restart_at(&mut self, index: u64) {
        self.state.restart_at(index);
        self.begun = None;
    }

    pub(crate) fn resize(&mut self) {
        self.state.resize();
        self.begun = None;
    }
}

/// The slot of a frame is below `frames_in_flight`.
pub(crate) fn check_slot(declaration: &Declaration, frame: &FrameContext) -> Result<(), Error> {
    let frames_in_flight = declaration.setup().frames_in_flight;
    let given = frame.slot;
    (given < frames_in_flight).then_some(()).ok_or(Error::FrameSlot { given, frames_in_flight })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use crate::contract::ResetReason;

    /// Begins two frames, and records these passes of the first.
    fn second(recorded: impl Fn(usize, usize) -> bool) -> (Result<(), Error>, Option<ResetReason>) {
        let declaration = Config { debug_view: true, ..Config::new([64, 36]) }.declare().expect("valid");
        let (params, tuning) = (FrameParams::new([64, 36]), Tuning::default());
        let mut life = FrameLife::new(&declaration);
        life.begin(&declaration, &params, &tuning).expect("a frame");
        let count = declaration.passes().len();
        (0..count).filter(|&pass| recorded(pass, count)).for_each(|pass| life.recorded(pass));
        (life.check_whole(&declaration), life.begin(&declaration, &params, &tuning).expect("a frame").reset)
    }

    #[test]
    fn passes_in_front_of_recorded_ones_are_missed() {
        let declaration = Config { debug_view: true, ..Config::new([64, 36]) }.declare().expect("valid");
        let view = declaration.passes().iter().position(PassDecl::draws_view).expect("a view");
        assert_eq!(second(|_, _| true), (Ok(()), None));
        assert_eq!(second(|pass, _| pass != view), (Ok(()), None), "a view may be left out");
        assert_eq!(second(|_, _| false), (Ok(()), Some(ResetReason::Created)), "it was given up");
        assert_eq!(second(|pass, _| pass < 5), (Ok(()), Some(ResetReason::Created)), "it was given up");
        let (told, reset) = second(|pass, _| pass != 2 && pass != 5);
        let name = |pass: usize| format!("`{}`", declaration.passes()[pass].name);
        assert_eq!(told, Err(Error::LeftOut { frame: 0, passes: vec![name(2), name(5)] }));
        assert_eq!(reset, Some(ResetReason::Created));
    }
}

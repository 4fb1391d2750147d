//! The life of the frames of a denoiser: one is the history of the next where it was recorded, and not where it was only begun.

use crate::contract::{Declaration, FrameContext, FrameParams, FrameState, PassDecl, Tuning, MAX_FRAMES_IN_FLIGHT};
use crate::error::Error;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// The memory of the previous frame, and how far the frame that was begun last has come.
pub(crate) struct FrameLife {
    state: FrameState,
    /// Passes of which each has to be recorded before the frame can be history: all up to the last that writes one.
    needed: Vec<bool>,
    /// Whether a frame was begun, and its number.
    begun: Option<u64>,
    /// The slot of that frame.
    slot: u32,
    /// The last frame of each slot that has recorded work, as far as it was followed by another.
    in_slot: [Option<u64>; MAX_FRAMES_IN_FLIGHT as usize],
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
            slot: 0,
            in_slot: Default::default(),
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
        if let (Some(last), Some(in_slot)) = (self.with_work(), self.in_slot.get_mut(self.slot as usize)) {
            *in_slot = Some(last);
        }
        (self.begun, self.slot) = (Some(frame.index), frame.slot);
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

    /// The frame that was begun last, if passes of it were recorded.
    fn with_work(&self) -> Option<u64> {
        self.begun.filter(|_| self.recorded.iter().any(|recorded| recorded.load(Relaxed)))
    }

    /// Whether the GPU is done with a slot, as far as the host says.
    pub(crate) fn check_slot_is_free(&self, params: &FrameParams) -> Result<(), Error> {
        let slot = params.frame_slot;
        let newest = self.with_work().filter(|_| self.slot == slot);
        match (newest.or_else(|| self.in_slot.get(slot as usize).copied().flatten()), params.complete_frames) {
            (Some(frame), Some(complete)) if frame >= complete => Err(Error::InFlight { slot, frame, complete }),
            _ => Ok(()),
        }
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
        self.in_slot = Default::default();
    }

    pub(crate) fn resize(&mut self) {
        self.state.resize();
        self.begun = None;
        self.in_slot = Default::default();
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
    /// Begins frames in two slots, of which so many are complete, and records a pass of each.
    fn last_of(complete: &[Option<u64>]) -> Result<(), Error> {
        let declaration = Config::new([64, 36]).declare().expect("valid");
        let mut life = FrameLife::new(&declaration);
        for (index, complete_frames) in (0..).zip(complete) {
            let frame_slot = index % 2;
            let params = FrameParams { frame_slot, complete_frames: *complete_frames, ..FrameParams::new([64, 36]) };
            life.check_slot_is_free(&params)?;
            life.begin(&declaration, &params, &Tuning::default()).expect("a frame");
            life.recorded(0);
        }
        Ok(())
    }

    #[test]
    fn a_slot_in_flight_is_told() {
        let in_flight = |slot, frame, complete| Err(Error::InFlight { slot, frame, complete });
        assert_eq!(last_of(&[Some(0), Some(0), Some(1), Some(2), Some(3)]), Ok(()));
        assert_eq!(last_of(&[None; 5]), Ok(()), "the host does not say");
        assert_eq!(last_of(&[Some(0), Some(0), Some(0)]), in_flight(0, 0, 0));
        assert_eq!(last_of(&[Some(0), Some(0), Some(1), Some(1)]), in_flight(1, 1, 1));
        assert_eq!(last_of(&[Some(0), Some(0), Some(2), Some(2), Some(2)]), in_flight(0, 2, 2));
    }

    #[test]
    fn a_frame_that_was_only_begun_is_not_in_flight() {
        let declaration = Config::new([64, 36]).declare().expect("valid");
        let params = FrameParams { complete_frames: Some(0), ..FrameParams::new([64, 36]) };
        let mut life = FrameLife::new(&declaration);
        life.begin(&declaration, &params, &Tuning::default()).expect("a frame");
        assert_eq!(life.check_slot_is_free(&params), Ok(()));
        life.recorded(0);
        assert_eq!(life.check_slot_is_free(&params), Err(Error::InFlight { slot: 0, frame: 0, complete: 0 }));
        life.resize();
        assert_eq!(life.check_slot_is_free(&params), Ok(()), "numbers start over");
    }
}

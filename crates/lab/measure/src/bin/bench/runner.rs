//! One graph that runs: its session, the frames of its inputs, and the times of its passes so far.

use super::clock::Clock;
use super::content::{Content, FRAMES};
use super::inputs;
use atrous::executor::{HeadlessDevice, InputSet, Session, SessionOptions};
use atrous::{Declaration, FrameParams, Tuning};
use cpu_time::ProcessTime;
use std::error::Error;
use std::sync::Arc;

/// The inputs of every frame of a content, which all graphs of a size share.
pub type Frames = [InputSet; FRAMES as usize];

pub struct Runner {
    session: Session,
    frames: Frames,
    content: Content,
    tuning: Tuning,
    clock: Clock,
    index: u32,
    /// Milliseconds by pass, then frame.
    pub samples: Vec<Vec<f64>>,
}

impl Runner {
    /// Opens a session, and adds to the inputs what this graph needs beyond them.
    pub fn new(
        gpu: &Arc<HeadlessDevice>,
        declaration: Declaration,
        tuning: Tuning,
        content: Content,
        clock: Clock,
        frames: &mut Frames,
    ) -> Result<Self, Box<dyn Error>> {
        let options = SessionOptions { timestamps: clock == Clock::GpuTimestamps, ..Default::default() };
        let samples = vec![Vec::new(); declaration.passes().len()];
        let mut session = Session::new(gpu.clone(), declaration, options)?;
        for (frame, set) in frames.iter_mut().enumerate() {
            inputs::complete(set, &mut session, content, frame as u32)?;
        }
        Ok(Self { session, frames: frames.clone(), content, tuning, clock, index: 0, samples })
    }

    pub fn declaration(&self) -> &Declaration {
        self.session.executor().denoiser().declaration()
    }

    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Runs frames whose times do not count: shaders are compiled, and histories fill.
    pub fn warm_up(&mut self, frames: u32) -> Result<(), atrous::Error> {
        (0..frames).try_for_each(|_| self.frame().map(|_| ()))
    }

    /// Runs frames and notes the times of their passes.
    pub fn round(&mut self, frames: u32) -> Result<(), atrous::Error> {
        // Timestamps are those of the frame before, in the same slot. One more, since other graphs had the caches meanwhile.
        let untimed = 1 + if self.clock == Clock::GpuTimestamps { self.declaration().setup().frames_in_flight } else { 0 };
        for i in 0..untimed + frames {
            let times = self.frame()?;
            if i >= untimed {
                self.samples.iter_mut().zip(times).for_each(|(samples, time)| samples.push(time));
            }
        }
        Ok(())
    }

    /// Runs one frame. Milliseconds of each pass: of this frame, or, by timestamps, of the last one of its slot.
    fn frame(&mut self) -> Result<Vec<f64>, atrous::Error> {
        let size = self.declaration().allocated_extent();
        let frame = self.index % FRAMES;
        let frame_slot = self.index % self.declaration().setup().frames_in_flight;
        let params = FrameParams { frame_slot, reshaded: true, ..self.content.params(size, frame) };
        self.session.bind_inputs(&self.frames[frame as usize])?;
        self.index += 1;
        match self.clock {
            Clock::GpuTimestamps => {
                self.session.run(&params, &self.tuning)?;
                Ok(self.session.times().iter().map(|t| t.milliseconds).collect())
            }
            Clock::ProcessCpuTime => {
                let mut times = Vec::with_capacity(self.samples.len());
                let mut start = ProcessTime::now();
                self.session.run_traced(&params, &self.tuning, &mut |_, _, _, done| {
                    if done {
                        times.push(start.elapsed().as_secs_f64() * 1e3);
                    }
                    start = ProcessTime::now();
                    Ok(())
                })?;
                Ok(times)
            }
        }
    }
}

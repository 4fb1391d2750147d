//! Loading, filtering and saving at the same time, each on a thread, with short queues between them: memory does not grow with the
//! number of frames.

use crate::backend::{Backend, FrameOutputs};
use crate::error::{Result, ToolError};
use crate::frame::{self, FrameInputs};
use crate::loader::Loader;
use crate::plan::{Action, Step};
use crate::setup::Setup;
use std::sync::mpsc::{sync_channel, Receiver, SyncSender};

/// A frame that was filtered, or that is finished already (`None`).
pub struct Finished {
    /// The step of the plan.
    pub step: Step,
    /// Inputs.
    pub inputs: FrameInputs,
    /// Result, unless it is on disk already.
    pub outputs: Option<FrameOutputs>,
}

/// Takes finished frames, on a thread of its own.
pub trait Sink: Send {
    /// Takes the next frame.
    fn take(&mut self, finished: Finished) -> Result<()>;
}

/// Runs all steps, with at most `queue` frames waiting between two threads. The first error ends the run after what was filtered
/// before it is saved.
pub fn run(steps: &[Step], setup: &Setup, backend: &mut dyn Backend, views: bool, queue: usize, sink: &mut dyn Sink) -> Result<()> {
    std::thread::scope(|scope| {
        let (loaded_in, loaded) = sync_channel(queue);
        let (finished_in, finished) = sync_channel(queue);
        let loader = scope.spawn(move || load(steps, setup, &loaded_in));
        let saver = scope.spawn(move || save(finished, sink));
        let filtered = filter(loaded, setup, backend, views, finished_in);
        let loaded = loader.join().map_err(|_| ToolError::Thread("loading"));
        let saved = saver.join().map_err(|_| ToolError::Thread("saving")).and_then(|r| r);
        // An error of the saver ended the others, so it comes first.
        saved.and(filtered).and(loaded)
    })
}

type Loaded = (Step, Result<FrameInputs>);

fn load(steps: &[Step], setup: &Setup, queue: &SyncSender<Loaded>) {
    let mut loader = Loader::new(setup);
    for step in steps {
        let inputs = loader.load(&step.files);
        let failed = inputs.is_err();
        // A closed queue means that another thread failed, and says why.
        if queue.send((step.clone(), inputs)).is_err() || failed {
            return;
        }
    }
}

fn filter(
    queue: Receiver<Loaded>,
    setup: &Setup,
    backend: &mut dyn Backend,
    views: bool,
    done: SyncSender<Finished>,
) -> Result<()> {
    for (step, inputs) in queue {
        let inputs = inputs?;
        let outputs = match step.action {
            Action::Read => None,
            Action::Write | Action::KeepHistory => {
                let mut outputs = backend.denoise(&inputs, views && step.action == Action::Write)?;
                frame::finish(&inputs, setup, &mut outputs.radiance);
                Some(outputs)
            }
        };
        if done.send(Finished { step, inputs, outputs }).is_err() {
            return Ok(());
        }
    }
    Ok(())
}

fn save(queue: Receiver<Finished>, sink: &mut dyn Sink) -> Result<()> {
    queue.into_iter().try_for_each(|finished| sink.take(finished))
}

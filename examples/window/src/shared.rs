//! What the window's thread and the engine's thread tell each other. Neither waits for the other's work.

use std::path::PathBuf;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};

use atrous::config::Preset;
use atrous::executor::PassTime;
use atrous::DebugView;

use super::panes::Panes;
use super::settings::Settings;
use atrous_engine::scene::View;

/// Bars of the histogram of history lengths: 0 to 31, and longer.
pub const HISTOGRAM_BARS: usize = 33;

/// What the window wants.
#[derive(Clone, Default)]
pub struct Wanted {
    /// What the panel says.
    pub settings: Settings,
    /// The camera, where it is steered.
    pub view: Option<View>,
    /// Frames to step while paused.
    pub steps: u32,
    /// History is to be dropped.
    pub reset: bool,
    /// The pixel under the magnifier.
    pub probe: Option<[u32; 2]>,
    /// Files to write and camera paths to fly.
    pub requests: Vec<Request>,
    /// Shaders that were saved, to be put in place together.
    #[cfg(feature = "hot-reload")]
    pub recompiled: Vec<Arc<atrous_engine::hot_reload::Recompiled>>,
    /// Counts changes, so that the engine sees them while paused.
    pub version: u64,
    /// The window is closed.
    pub quit: bool,
}

/// Something to do once.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Both halves and each by itself, at the picture's own size.
    Screenshot(PathBuf),
    /// From now on every frame into a folder; at the second time no longer.
    Record(PathBuf),
    /// From now on the camera's way; at the second time it is written.
    RecordPath(PathBuf),
    /// Flies a recorded way.
    ReplayPath(PathBuf),
    /// Reads the file of the scene again.
    Reload,
}

/// What a pixel says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Probe {
    /// Which pixel.
    pub pixel: [u32; 2],
    /// The filter that says so, where one runs.
    pub preset: Option<Preset>,
    /// The number of each debug view that it has.
    pub numbers: [Option<f32>; DebugView::ALL.len()],
    /// Radiance left and right of the divider.
    pub colours: [[f32; 3]; 2],
}

/// How far a filter is from the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorReport {
    /// Which filter.
    pub preset: Preset,
    /// Of linear radiance.
    pub rmse: f64,
    /// Mean over the pixels.
    pub flip: f64,
    /// Paths of each pixel in the reference then.
    pub paths: u32,
}

/// Memory of a filter, bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilterMemory {
    /// Survives the frame.
    pub history: u64,
    /// Transients.
    pub transient: u64,
    /// Outputs.
    pub output: u64,
}

/// A filter that runs.
#[derive(Clone, Debug, Default)]
pub struct FilterReport {
    /// Which.
    pub preset: Preset,
    /// Its passes.
    pub times: Vec<PassTime>,
    /// Its memory.
    pub memory: FilterMemory,
    /// What it can show.
    pub views: Vec<DebugView>,
    /// Names of the tunables that its passes read.
    pub tunables: Vec<&'static str>,
}

/// What the engine has done.
#[derive(Clone, Default)]
pub struct Report {
    /// Frames since the start.
    pub frames: u64,
    /// What is shown: images that the engine writes and the window reads, in the order of the queue.
    pub panes: Option<Arc<Panes>>,
    /// What the halves show since the last frame.
    pub shown: Option<[super::Content; 2]>,
    /// Wall time of the last frame.
    pub milliseconds: f32,
    /// Filters that run.
    pub filters: Vec<FilterReport>,
    /// Pixels by history length, of the filter right of the divider, else left.
    pub histogram: Option<[u32; HISTOGRAM_BARS]>,
    /// The pixel under the magnifier.
    pub probe: Option<Probe>,
    /// Paths of each pixel in the reference.
    pub reference_samples: u32,
    /// Errors that are shown and were measured.
    pub errors: Vec<ErrorReport>,
    /// Where the camera is.
    pub view: Option<View>,
    /// Name of the scene.
    pub scene: String,
    /// As it was asked for: a name, or a file.
    pub loaded: Option<String>,
    /// What went wrong or was written, newest last.
    pub messages: Vec<Message>,
    /// How many there were, with those that are no longer kept.
    pub message_count: usize,
    /// What is wrong with saved shaders, for as long as it is.
    pub shader_errors: Vec<String>,
    /// What was put in place last.
    pub reloaded: Option<String>,
    /// Bit 0: the left half is display-referred, bit 1: the right one.
    pub display_referred: u32,
    /// A frame sequence is being written.
    pub recording: bool,
    /// A camera path is being recorded, or flown.
    pub path: Option<&'static str>,
    /// The engine has stopped.
    pub stopped: bool,
}

/// One line for people.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Whether something went wrong.
    pub is_error: bool,
    /// What.
    pub text: String,
}

/// The two halves of the conversation.
#[derive(Default)]
pub struct Shared {
    wanted: Mutex<Wanted>,
    changed: Condvar,
    report: Mutex<Report>,
}

impl Shared {
    /// Changes what is wanted, and wakes the engine.
    pub fn want(&self, change: impl FnOnce(&mut Wanted)) {
        let mut wanted = lock(&self.wanted);
        change(&mut wanted);
        wanted.version += 1;
        self.changed.notify_one();
    }

    /// The same for a change that may be none: `change` says so.
    pub fn want_if_changed(&self, change: impl FnOnce(&mut Wanted) -> bool) {
        let mut wanted = lock(&self.wanted);
        if change(&mut wanted) {
            wanted.version += 1;
            self.changed.notify_one();
        }
    }

    /// The settings now.
    pub fn settings(&self) -> Settings {
        lock(&self.wanted).settings.clone()
    }

    /// What is wanted now; what is to be done once is taken out. Waits while `idle` says so.
    pub fn take(&self, idle: impl Fn(&Wanted) -> bool) -> Wanted {
        let mut wanted = lock(&self.wanted);
        while idle(&wanted) && !wanted.quit {
            wanted = self.changed.wait(wanted).unwrap_or_else(|poisoned| poisoned.into_inner());
        }
        let taken = wanted.clone();
        wanted.steps = wanted.steps.saturating_sub(1);
        wanted.reset = false;
        wanted.requests.clear();
        #[cfg(feature = "hot-reload")]
        wanted.recompiled.clear();
        taken
    }

    /// The report, locked.
    pub fn report(&self) -> MutexGuard<'_, Report> {
        lock(&self.report)
    }

    /// Adds a line for people.
    pub fn notify(&self, is_error: bool, text: String) {
        let mut report = self.report();
        report.messages.push(Message { is_error, text });
        report.message_count += 1;
        let surplus = report.messages.len().saturating_sub(MESSAGES_KEPT);
        report.messages.drain(..surplus);
    }
}

const MESSAGES_KEPT: usize = 50;

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A panic elsewhere leaves plain values behind.
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

//! What the window did, line by line into a file: for tests, which wait for lines instead of times.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use atrous::DebugView;

use super::layout::Place;
use super::overlay::Over;
use super::settings::Settings;
use super::shared::{ErrorReport, Probe, Report};
use atrous_engine::Result;

/// A log, or none.
#[derive(Default)]
pub struct Log {
    file: Option<File>,
    frames: u64,
    drawn: u64,
    message_count: usize,
    shader_errors: Vec<String>,
    place: Place,
    state: String,
    probe: Option<Probe>,
    errors: Vec<ErrorReport>,
}

impl Log {
    /// Starts a file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn create(path: Option<&Path>) -> Result<Self> {
        let create = |path: &Path| {
            File::create(path).map_err(|e| atrous_engine::Error::Folder { path: path.to_owned(), problem: e.to_string() })
        };
        Ok(Self { file: path.map(create).transpose()?, ..Self::default() })
    }

    /// One line. A full disk ends the log, not the program.
    pub fn line(&mut self, text: &str) {
        if let Some(file) = &mut self.file {
            if writeln!(file, "{text}").is_err() {
                self.file = None;
            }
        }
    }

    /// What changed since the last turn of the window.
    pub fn turned(&mut self, window: [u32; 2], over: &Over, settings: &Settings, help: bool, report: &Report) {
        if self.file.is_none() {
            return;
        }
        let place = over.place;
        if place != self.place {
            self.place = place;
            let Place { x, y, width, height } = place;
            self.line(&format!("picture {x} {y} {width} {height} window {} {}", window[0], window[1]));
        }
        let state = format!(
            "state left={} right={} divider={:.3} paused={} speed={} magnifier={} panel={} camera={} recording={} help={help} \
             difference={} scaling={} panel_width={:.0} held={}",
            settings.left,
            settings.right,
            settings.divider,
            settings.paused,
            settings.speed,
            settings.magnifier,
            settings.panel,
            if settings.animate_camera { "path" } else { "free" },
            report.recording,
            settings.difference,
            settings.scaling.name(),
            over.panel_width,
            over.holds_divider,
        );
        if state != self.state {
            self.line(&state);
            self.state = state;
        }
        if let Some(probe) = report.probe.filter(|probe| Some(*probe) != self.probe) {
            let number = |view: DebugView| probe.numbers[view as usize].map_or("-".into(), |n| n.to_string());
            let [x, y] = probe.pixel;
            let (history, reason) = (number(DebugView::HistoryLength), number(DebugView::Disocclusion));
            self.line(&format!("probe {x} {y} history={history} alpha={} reason={reason}", number(DebugView::Alpha)));
        }
        self.probe = report.probe;
        if report.errors != self.errors {
            for ErrorReport { preset, rmse, flip, paths } in &report.errors {
                self.line(&format!("measured {preset} rmse={rmse:.5} flip={flip:.5} paths={paths}"));
            }
            self.errors.clone_from(&report.errors);
        }
        let kept = report.messages.len();
        for message in &report.messages[kept - (report.message_count - self.message_count).min(kept)..] {
            let kind = if message.is_error { "error" } else { "message" };
            self.line(&format!("{kind} {}", message.text));
        }
        self.message_count = report.message_count;
        let before = std::mem::replace(&mut self.shader_errors, report.shader_errors.clone());
        for error in report.shader_errors.iter().filter(|error| !before.contains(error)) {
            self.line(&format!("error {}", error.replace('\n', " | ")));
        }
    }

    /// A frame of the window, with the engine's last one in it.
    pub fn drawn(&mut self, report: &Report) {
        self.drawn += 1;
        if report.frames != self.frames {
            self.frames = report.frames;
            let [left, right] = report.shown.map_or([String::new(), String::new()], |shown| shown.map(|c| c.to_string()));
            let (ms, samples) = (report.milliseconds, report.reference_samples);
            self.line(&format!(
                "frame {} left={left} right={right} ms={ms:.1} reference={samples} scene={} drawn={}",
                report.frames, report.scene, self.drawn
            ));
        }
    }
}

//! Progress on stderr: a bar on a terminal, a line every few seconds in a file.

use crate::terminal::tell;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Time between two lines.
const PAUSE: Duration = Duration::from_secs(5);

/// Progress of a run.
pub struct Progress {
    bar: ProgressBar,
    lines: Option<Lines>,
}

impl Progress {
    /// Of so many frames; nothing is shown where it is `quiet`.
    pub fn new(frames: usize, quiet: bool) -> Self {
        let shows_bar = !quiet && std::io::stderr().is_terminal();
        let bar = if shows_bar { ProgressBar::new(frames as u64) } else { ProgressBar::hidden() };
        let style = ProgressStyle::with_template("{bar:32} {pos}/{len} frames, {per_sec}, {eta} left");
        let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let lines = (!quiet && !shows_bar).then(|| Lines::new(frames, Instant::now()));
        Self { bar, lines }
    }

    /// A frame is finished.
    pub fn advance(&mut self) {
        self.bar.inc(1);
        if let Some(line) = self.lines.as_mut().and_then(|lines| lines.advance(Instant::now())) {
            tell(&line);
        }
    }

    /// Prints something beside the bar.
    pub fn suspend(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

struct Lines {
    frames: usize,
    done: usize,
    start: Instant,
    told: Instant,
}

impl Lines {
    fn new(frames: usize, now: Instant) -> Self {
        Self { frames, done: 0, start: now, told: now }
    }

    /// The line that is due, if one is.
    fn advance(&mut self, now: Instant) -> Option<String> {
        self.done += 1;
        if now - self.told < PAUSE || self.done == self.frames {
            return None;
        }
        self.told = now;
        let rate = self.done as f64 / (now - self.start).as_secs_f64();
        let left = (self.frames - self.done.min(self.frames)) as f64 / rate;
        Some(format!("{} of {} frames, {rate:.1} a second, {left:.0} s left", self.done, self.frames))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_gets_a_line_every_few_seconds() {
        let start = Instant::now();
        let mut lines = Lines::new(40, start);
        let told: Vec<String> = (1..=40).filter_map(|second| lines.advance(start + Duration::from_secs(second))).collect();
        assert_eq!((told.len(), told[0].as_str()), (7, "5 of 40 frames, 1.0 a second, 35 s left"));
    }
}

//! Detects that nearly every surface loses its history, frame after frame. The usual cause is a
//! guide whose encoding differs from the declared one.

use super::{Counter, Statistics};
use std::fmt::{Display, Formatter};

/// Frames in a row that count. A camera that turns loses as much in one frame, and not in this many.
const FRAMES: u32 = 8;

/// The share of surfaces without history above which a frame counts, in percent.
const PERCENT: u64 = 90;

/// A watch over the [`Statistics`] of consecutive frames. `executor::Executor` has one and logs its
/// reports. If you schedule the passes yourself, read `statistics` back and do the same.
#[derive(Clone, Debug, Default)]
pub struct HistoryWatch {
    frames: u32,
    reported: bool,
}

impl HistoryWatch {
    /// Looks at the counters of the next frame. Returns `Some` once, in the eighth frame in a row
    /// in which more than 90 % of the surfaces lost their history. A frame with a reset, or without
    /// a surface, starts the count over.
    pub fn look(&mut self, statistics: &Statistics) -> Option<HistoryLoss> {
        let (lost, sought) = (statistics.history_lost(), statistics.history_sought());
        self.frames = if 100 * lost > PERCENT * sought { self.frames.saturating_add(1) } else { 0 };
        if self.frames < FRAMES || std::mem::replace(&mut self.reported, true) {
            return None;
        }
        let reason = Counter::LOSSES.into_iter().rev().max_by_key(|&reason| statistics[reason])?;
        Some(HistoryLoss { lost, sought, reason, with_reason: statistics[reason].into() })
    }
}

/// A report that nearly every surface loses its history. [`Display`]ed as a sentence for a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct HistoryLoss {
    /// Surfaces without history in the last frame.
    pub lost: u64,
    /// Surfaces in that frame.
    pub sought: u64,
    /// The most frequent reason: one of [`Counter::LOSSES`].
    pub reason: Counter,
    /// Surfaces that lost it for this reason.
    pub with_reason: u64,
}

impl Display for HistoryLoss {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let (why, look_at) = match self.reason {
            Counter::LostOffScreen => ("motion leads out of the picture", "unit, direction and axes of `motion`"),
            Counter::LostSurfaceId => {
                ("another surface id is where motion leads", "ids that change from frame to frame, unit and direction of `motion`")
            }
            Counter::LostDepth => ("the depth is another where motion leads", "encoding of `depth`, matrices, motion depth"),
            _ => ("the normal is another where motion leads", "space and encoding of `normal`"),
        };
        write!(
            f,
            "{} % of the surfaces lost their history in frame after frame ({FRAMES} in a row), {} % since {why}, so that noise is filtered in \
             space alone. Likely the guides are not encoded as `Conventions` declares: look at {look_at}; `atrous_conventions::check` \
             on two frames names the mistake",
            100 * self.lost / self.sought.max(1),
            100 * self.with_reason / self.sought.max(1),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(counts: &[(Counter, u32)]) -> Statistics {
        let mut statistics = Statistics::default();
        counts.iter().for_each(|&(counter, count)| statistics[counter] = count);
        statistics
    }

    fn lost(count: u32) -> Statistics {
        frame(&[(Counter::HistoryKept, 1000 - count), (Counter::LostOffScreen, count - 10), (Counter::LostDepth, 10)])
    }

    /// The number of the look that reported something.
    fn reported(frames: impl IntoIterator<Item = Statistics>) -> Vec<usize> {
        let mut watch = HistoryWatch::default();
        frames.into_iter().enumerate().filter_map(|(i, statistics)| watch.look(&statistics).map(|_| i)).collect()
    }

    #[test]
    fn a_lasting_loss_is_reported_once() {
        assert_eq!(reported(vec![lost(901); 30]), [7]);
        assert_eq!(reported(vec![lost(900); 30]), [0; 0], "not more than 90 %");
    }

    #[test]
    fn a_frame_that_keeps_history_or_has_none_begins_the_row_anew() {
        for between in [lost(500), Statistics::default()] {
            let mut frames = vec![lost(1000); 7];
            frames.push(between);
            assert_eq!(reported([frames.clone(), frames.clone()].concat()), [0; 0]);
            assert_eq!(reported([frames, vec![lost(1000); 8]].concat()), [15]);
        }
    }

    #[test]
    fn the_report_names_share_reason_and_check() {
        for (reason, wanted) in Counter::LOSSES.into_iter().zip(["out of the picture", "surface id", "the depth", "the normal"]) {
            let statistics = frame(&[(Counter::HistoryKept, 30), (Counter::LostDepth, 100), (reason, 900)]);
            let mut watch = HistoryWatch::default();
            let report = (0..8).find_map(|_| watch.look(&statistics)).expect("a loss").to_string();
            let share = if reason == Counter::LostDepth { "96 %" } else { "97 %" };
            assert!(report.starts_with(share) && report.contains(wanted), "{report}");
            assert!(report.contains("atrous_conventions::check"), "{report}");
        }
    }

    #[test]
    fn counts_of_large_pictures_do_not_overflow() {
        let statistics = frame(&Counter::LOSSES.map(|reason| (reason, u32::MAX)));
        assert_eq!(reported(vec![statistics; 8]), [7]);
    }
}

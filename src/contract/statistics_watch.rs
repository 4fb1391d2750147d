//! Detects, from the counters of frames in a row, that nearly every surface loses its history, and that noise repeats. The usual causes
//! are a guide whose encoding differs from the declared one, and a seed or a reservoir that lives for many frames.

use super::{Counter, Statistics};
use std::fmt::{Display, Formatter};

/// Frames in a row that count. A camera that turns loses as much in one frame, and not in this many.
const FRAMES: u32 = 8;

/// The share of surfaces without history above which a frame counts, in percent.
const LOST_PERCENT: u64 = 90;

/// The share of surfaces with a history whose noise repeats above which a frame counts, in percent.
const REPEATED_PERCENT: u64 = 50;

/// A watch over the [`Statistics`] of consecutive frames. `executor::Executor` has one and logs its
/// reports. If you schedule the passes yourself, read `statistics` back and do the same.
#[derive(Clone, Debug, Default)]
pub struct StatisticsWatch {
    lost: Row,
    repeated: Row,
}

/// Frames in a row in which something is wrong.
#[derive(Clone, Debug, Default)]
struct Row {
    frames: u32,
    reported: bool,
}

impl Row {
    /// Counts a frame; whether it is time to report.
    fn is_due(&mut self, is_wrong: bool) -> bool {
        self.frames = if is_wrong { self.frames.saturating_add(1) } else { 0 };
        self.frames >= FRAMES && !std::mem::replace(&mut self.reported, true)
    }
}

impl StatisticsWatch {
    /// Looks at the counters of the next frame. Returns `Some` once for each finding: in the eighth frame in a row in which more than
    /// 90 % of the surfaces lost their history, or the noise of more than half of those that kept it repeats. A frame with a reset, or
    /// without a surface, starts the count over, and so does a graph that counts no [`Counter::HistoryKept`], as of `Signals::Mixed`.
    pub fn look(&mut self, statistics: &Statistics) -> Option<Finding> {
        let (lost, sought) = (statistics.history_lost(), statistics.history_sought());
        let (repeated, kept) = (statistics[Counter::RepeatedSample].into(), statistics[Counter::HistoryKept].into());
        if self.repeated.is_due(kept > 0 && 100 * repeated > REPEATED_PERCENT * kept) {
            return Some(Finding::RepeatedNoise(RepeatedNoise { repeated, kept }));
        }
        if self.lost.is_due(100 * lost > LOST_PERCENT * sought) {
            let reason = Counter::LOSSES.into_iter().rev().max_by_key(|&reason| statistics[reason])?;
            return Some(Finding::HistoryLoss(HistoryLoss { lost, sought, reason, with_reason: statistics[reason].into() }));
        }
        None
    }
}

/// A finding of a [`StatisticsWatch`]. [`Display`]ed as a sentence for a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Finding {
    /// Nearly every surface loses its history.
    HistoryLoss(HistoryLoss),
    /// Noise comes again from frame to frame.
    RepeatedNoise(RepeatedNoise),
}

impl Display for Finding {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::HistoryLoss(loss) => loss.fmt(f),
            Self::RepeatedNoise(noise) => noise.fmt(f),
        }
    }
}

/// A report that noise comes again from frame to frame. [`Display`]ed as a sentence for a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RepeatedNoise {
    /// [`Counter::RepeatedSample`] of the last frame: once for every signal.
    pub repeated: u64,
    /// Surfaces with a history in that frame; once for every signal.
    pub kept: u64,
}

impl Display for RepeatedNoise {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "on {} % of the surfaces noise came again in frame after frame ({FRAMES} in a row), so that no history averages it. Likely the \
             seed of your samples is the same in each frame: add the number of the frame to it. With temporal reuse of samples (ReSTIR), lower \
             the age of a reservoir, or set `Tuning::sample_frames` to the frames that a sample lives",
            (100 * self.repeated / self.kept.max(1)).min(100),
        )
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
        let mut watch = StatisticsWatch::default();
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
            let mut watch = StatisticsWatch::default();
            let report = (0..8).find_map(|_| watch.look(&statistics)).expect("a loss").to_string();
            let share = if reason == Counter::LostDepth { "96 %" } else { "97 %" };
            assert!(report.starts_with(share) && report.contains(wanted), "{report}");
            assert!(report.contains("atrous_conventions::check"), "{report}");
        }
    }

    #[test]
    fn noise_that_repeats_is_reported_once_and_beside_a_loss() {
        let noisy = |repeated| frame(&[(Counter::HistoryKept, 1000), (Counter::RepeatedSample, repeated)]);
        assert_eq!(reported(vec![noisy(501); 30]), [7]);
        assert_eq!(reported(vec![noisy(500); 30]), [0; 0], "not more than half");
        assert_eq!(reported(vec![frame(&[(Counter::RepeatedSample, 900)]); 30]), [0; 0], "of nothing known");
        assert_eq!(reported([vec![noisy(900); 8], vec![lost(950); 8], vec![noisy(900); 8]].concat()), [7, 15]);
        let mut watch = StatisticsWatch::default();
        let report = (0..8).find_map(|_| watch.look(&noisy(1900))).expect("a finding").to_string();
        assert!(report.starts_with("on 100 %") && report.contains("seed") && report.contains("Tuning::sample_frames"), "{report}");
    }

    #[test]
    fn counts_of_large_pictures_do_not_overflow() {
        let statistics = frame(&Counter::LOSSES.map(|reason| (reason, u32::MAX)));
        assert_eq!(reported(vec![statistics; 8]), [7]);
    }
}

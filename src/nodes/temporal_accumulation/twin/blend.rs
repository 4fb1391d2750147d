//! A pixel blended with its past \[SVGF 4.1\].

use crate::reference::binary16::{signed_half_range, store, store_signed, LARGEST_HALF};
use crate::reference::holes::sample_worth;
use crate::reference::luminance::{luminance, texel_luminance};
use crate::reference::luminance_history::{LuminanceHistory, Reason};
use crate::reference::range::Range;
use crate::{FrameConstants, Tuning};

/// Smallest weights of the new sample, and the longest history that goes with them.
#[derive(Clone, Copy)]
pub(crate) struct AlphaBounds {
    alpha: f32,
    alpha_moments: f32,
    change: f32,
    history_length: f32,
}

impl AlphaBounds {
    /// `change`: 0, light is as it was, to 1 \[ASVGF 3.5\].
    pub(crate) fn new(tuning: &Tuning, is_adaptive: bool, repair: bool, change: f32) -> Self {
        // What alpha forgets is gone from the length, too, so that the variance is estimated from the neighbourhood.
        let longest = match (is_adaptive, repair) {
            (_, true) => 1.0 / change.max(1e-6),
            (true, false) => 1.0 / adapted(tuning.alpha, change).max(1e-6),
            (false, false) => f32::INFINITY,
        };
        let history_length = longest.min(tuning.max_history_length);
        Self { alpha: tuning.alpha, alpha_moments: tuning.alpha_moments, change, history_length }
    }
}

/// The smallest weight of the new sample where light changed.
fn adapted(alpha: f32, change: f32) -> f32 {
    alpha + change * (1.0 - alpha)
}

/// A pixel without a past; one without a sample either has none for the next frame.
pub(crate) fn fresh(c: [f32; 4], reason: Reason) -> ([f32; 4], LuminanceHistory) {
    let (history_length, reason) = if sample_worth(c) > 0.0 { (1.0, reason) } else { (0.0, Reason::None) };
    let luminance_history =
        LuminanceHistory { mean: texel_luminance(c), deviation: 0.0, history_length, reason: reason as u16, outside: None };
    ([store(c[0]), store(c[1]), store(c[2]), 0.0], luminance_history)
}

/// Up to here, a history is one of this frame alone.
const ONE_FRAME: f32 = 1.05;

/// Even noise lies outside of four samples of itself by this part of its deviation.
const OUTSIDE_OF_FOUR: f32 = 0.535;

/// Irradiance `c` with its past: irradiance, moments and the range of luminance of its pixels, of which `ratio` says by how much light is brighter now.
pub(crate) fn blend(
    frame: &FrameConstants,
    c: [f32; 4],
    past: [f32; 3],
    (before, range): (&LuminanceHistory, Range),
    bounds: AlphaBounds,
    ratio: [f32; 3],
) -> ([f32; 4], LuminanceHistory) {
    // A ratio may be as large as a float: the clamp keeps ∞ − ∞ away.
    let scaled = |x: f32| (x * (frame.exposure_ratio * luminance(ratio)).min(1e38)).min(LARGEST_HALF);
    let worth = sample_worth(c);
    let history_length = (before.history_length + worth).min(bounds.history_length);
    let weight = |alpha: f32| match worth {
        0.0 => 0.0,
        _ => adapted(alpha * worth, bounds.change).max(worth / history_length),
    };
    let (alpha, alpha_moments) = (weight(bounds.alpha), weight(bounds.alpha_moments));
    let [r, g, b] = [0, 1, 2].map(|i| {
        let before = signed_half_range(past[i] * ratio[i] * frame.exposure_ratio);
        // What is dropped leaves no rounding error behind.
        store_signed(if alpha < 1.0 { before + alpha * (c[i] - before) } else { c[i] })
    });
    let (mean, deviation) = (scaled(before.mean), scaled(before.deviation));
    let now = texel_luminance(c);
    let difference = now - mean;
    // A past that moved was resampled: what lies between its pixels is no noise.
    let range: Range = [range.least, range.most].into_iter().map(scaled).collect();
    let outside = (worth > 0.0 && history_length < ONE_FRAME).then(|| range.outside(now) / OUTSIDE_OF_FOUR);
    let variance = (1.0 - alpha_moments) * (deviation * deviation + alpha_moments * difference * difference);
    let mean = mean + alpha_moments * difference;
    let deviation = if outside.is_some() { 0.0 } else { variance.sqrt() };
    let luminance_history = LuminanceHistory { mean, deviation, history_length, reason: Reason::None as u16, outside };
    ([r, g, b, 0.0], luminance_history)
}

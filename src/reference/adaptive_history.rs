//! The stage `adaptive_history`: how far the history of a pixel is still true, from statistics of blocks alone \[PSVGF\].

use super::block_difference::unpack_difference;
use super::block_percentiles::{unpack_percentiles, Percentiles};
use super::blocks::Blocks;
use super::luminance::texel_luminance;
use super::nearest_history::HistoryGuides;
use super::Image;
use crate::{FrameConstants, Tuning};
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Share of a block's upper percentile that counts as usual, however narrow its range is.
pub const RANGE_EPSILON: f32 = 0.01;

/// Share of the mean luminance below which a change is not worth the history, however certain it is.
pub const CHANGE_EPSILON: f32 = 0.01;

/// `lin` of \[PSVGF\]: 0 at `a`, 1 at `b`.
fn lin(a: f32, b: f32, x: f32) -> f32 {
    ((x - a) / (b - a)).clamp(0.0, 1.0)
}

/// Inputs of [`percentile_rule`].
#[derive(Clone, Copy, Debug)]
pub struct PercentileRuleInputs<'a> {
    /// Of both frames.
    pub guides: HistoryGuides<'a>,
    /// For every signal `block_percentiles` and the irradiance of the previous frame, which is not read in a reset frame.
    pub signals: &'a [(&'a Image<u32>, &'a Image<[f32; 4]>)],
}

/// The published rule. 1, keep the history, to 0, drop it; the least of the signals.
pub fn percentile_rule(frame: &FrameConstants, tuning: &Tuning, inputs: &PercentileRuleInputs) -> Image<f32> {
    let blocks = Blocks::new(frame.render_extent);
    Image::compute(inputs.guides.guide.extent(), frame.render_extent, |p| {
        let Some(tap) = inputs.guides.nearest(frame, tuning, p) else { return 1.0 };
        let kept = |&(percentiles, history): &(&Image<u32>, &Image<[f32; 4]>)| {
            let l = texel_luminance(history.at(tap)) * frame.exposure_ratio;
            weight_of_history(tuning, &interpolated(blocks, percentiles, p), l)
        };
        inputs.signals.iter().map(kept).fold(1.0, f32::min)
    })
}

fn interpolated(blocks: Blocks, percentiles: &Image<u32>, p: IVec2) -> Percentiles {
    blocks.around(p).iter().fold(Percentiles::default(), |sum, &(block, weight)| {
        let Percentiles { low, up } = unpack_percentiles(percentiles.at(block));
        Percentiles { low: sum.low + weight * low, up: sum.up + weight * up }
    })
}

/// A \[PSVGF\].
fn weight_of_history(tuning: &Tuning, percentiles: &Percentiles, l: f32) -> f32 {
    let range = percentiles.range(tuning) + RANGE_EPSILON * percentiles.up + 1e-4;
    let too_bright = lin(percentiles.up, percentiles.up + range, l);
    let too_dark = 1.0 - lin(percentiles.low - range, percentiles.low, l);
    (1.0 - tuning.adaptivity * too_bright) * (1.0 - tuning.adaptivity * too_dark)
}

/// The test in both directions, on `block_difference` of every signal. Values as those of [`percentile_rule`]; `extent` is the allocated one.
pub fn change_test(frame: &FrameConstants, tuning: &Tuning, extent: [u32; 2], block_difference: &[&Image<[u16; 4]>]) -> Image<f32> {
    let blocks = Blocks::new(frame.render_extent);
    let changes = Image::compute(blocks.extent(), blocks.extent(), |block| {
        block_difference.iter().map(|differences| change_of(tuning, blocks, differences, block)).fold(0.0, f32::max)
    });
    Image::compute(extent, frame.render_extent, |p| {
        let change: f32 = blocks.around(p).iter().map(|&(block, weight)| weight * changes.at(block)).sum();
        1.0 - tuning.adaptivity * change
    })
}

/// 0 to 1: the mean difference over 3×3 blocks, in standard errors, against the threshold.
fn change_of(tuning: &Tuning, blocks: Blocks, differences: &Image<[u16; 4]>, block: IVec2) -> f32 {
    let (mut sum, mut variance, mut brighter) = (0.0, 0.0, 0.0);
    for (_, q) in blocks.rect().window(block, 1, 1) {
        let difference = unpack_difference(differences.at(q));
        sum += difference.count * difference.mean;
        variance += difference.count * difference.deviation * difference.deviation;
        brighter += difference.count * difference.brighter;
    }
    let least = CHANGE_EPSILON * brighter;
    let errors = sum.abs() / (variance + least * least).sqrt().max(1e-6);
    lin(tuning.change_threshold, 2.0 * tuning.change_threshold, errors)
}

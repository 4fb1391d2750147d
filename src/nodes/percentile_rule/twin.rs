//! The stage `percentile_rule`: how far the history of a pixel is still true, by the percentiles of the blocks around \[PSVGF\].

use crate::nodes::block_percentiles::twin::{unpack_percentiles, Percentiles};
use crate::reference::bindings::Bindings;
use crate::reference::blocks::Blocks;
use crate::reference::compare::Rule;
use crate::reference::luminance::texel_luminance;
use crate::reference::nearest_history::HistoryGuides;
use crate::reference::rules::{pixels, STEEP};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;

/// Share of a block's upper percentile that counts as usual, however narrow its range is.
pub(crate) const RANGE_EPSILON: f32 = 0.01;

/// `lin` of \[PSVGF\]: 0 at `a`, 1 at `b`.
pub(crate) fn lin(a: f32, b: f32, x: f32) -> f32 {
    ((x - a) / (b - a)).clamp(0.0, 1.0)
}

/// Inputs of [`percentile_rule`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct PercentileRuleInputs<'a> {
    /// Guides of both frames.
    pub guides: HistoryGuides<'a>,
    /// Percentiles of every signal, and its irradiance of the previous frame, which is not read in a reset frame.
    pub signals: &'a [(&'a Image<u32>, &'a Image<[f32; 4]>)],
}

/// The published rule. 1, keep the history, to 0, drop it; the least of the signals.
pub(crate) fn percentile_rule(frame: &FrameConstants, tuning: &Tuning, inputs: &PercentileRuleInputs) -> Image<f32> {
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
        let Percentiles { low, up, .. } = unpack_percentiles(percentiles.at(block));
        Percentiles { low: sum.low + weight * low, up: sum.up + weight * up, ..sum }
    })
}

/// A \[PSVGF\].
pub(crate) fn weight_of_history(tuning: &Tuning, percentiles: &Percentiles, l: f32) -> f32 {
    let range = percentiles.range(tuning) + RANGE_EPSILON * percentiles.up + 1e-4;
    let too_bright = lin(percentiles.up, percentiles.up + range, l);
    let too_dark = 1.0 - lin(percentiles.low - range, percentiles.low, l);
    (1.0 - tuning.adaptivity * too_bright) * (1.0 - tuning.adaptivity * too_dark)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("history_confidence", STEEP)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guides = HistoryGuides::of(b)?;
    let signals: Vec<_> = b.uints("block_percentiles")?.into_iter().zip(b.colours("history")?).collect();
    let confidence = percentile_rule(b.frame, b.tuning, &PercentileRuleInputs { guides, signals: &signals });
    b.write("history_confidence", confidence)
}

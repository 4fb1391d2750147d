//! The stage `change_test`: how far the history of a pixel is still true, by the mean difference of the blocks around and its
//! standard error.

use crate::nodes::block_difference::twin::unpack_difference;
use crate::nodes::percentile_rule::twin::lin;
use crate::reference::bindings::Bindings;
use crate::reference::blocks::Blocks;
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;

/// Share of the mean luminance below which a change is not worth the history, however certain it is.
pub const CHANGE_EPSILON: f32 = 0.01;

/// The test in both directions, on `block_difference` of every signal. 1, keep the history, to 0, drop it; `extent` is the
/// allocated one.
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

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let extent = b.extent_of("history_confidence")?;
    let confidence = change_test(b.frame, b.tuning, extent, &b.packed_signals("block_difference")?);
    b.write("history_confidence", confidence)
}

//! The stage `block_difference`: how far the light of a frame departs from its own history, block by block.

use crate::reference::binary16::{from_half_bits, half_bits, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{allocated_blocks, Blocks};
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::luminance::texel_luminance;
use crate::reference::moments::unpack_moments;
use crate::reference::nearest_history::HistoryGuides;
use crate::reference::nearest_history::SignalHistory;
use crate::reference::rules::{rule, HALF};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};

/// Statistics that a block holds of the differences of luminance between its pixels and their history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Difference {
    /// Mean of the differences, this frame minus the history.
    pub mean: f32,
    /// Standard deviation of one difference, that of the history's own noise included.
    pub deviation: f32,
    /// Pixels with a history.
    pub count: f32,
    /// The larger of the mean luminances of both sides.
    pub brighter: f32,
}

/// A texel of `block_difference*`.
pub(crate) fn pack_difference(difference: &Difference) -> [u16; 4] {
    let limited = |x: f32| half_bits(x.clamp(-LARGEST_HALF, LARGEST_HALF));
    [limited(difference.mean), limited(difference.deviation), limited(difference.count), limited(difference.brighter)]
}

/// The content of a texel of `block_difference*`.
pub(crate) fn unpack_difference(texel: [u16; 4]) -> Difference {
    let [mean, deviation, count, brighter] = texel.map(from_half_bits);
    Difference { mean, deviation, count, brighter }
}

/// Inputs of [`block_difference`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockDifferenceInputs<'a> {
    /// Guides of both frames.
    pub guides: HistoryGuides<'a>,
    /// rgb: irradiance of one signal, as left by `firefly` or `fill_holes`; a negative alpha marks a pixel without a sample.
    pub irradiance: &'a Image<[f32; 4]>,
    /// History of this signal. Not read in a reset frame.
    pub history: SignalHistory<'a>,
}

/// One texel a block; see [`unpack_difference`].
pub(crate) fn block_difference(frame: &FrameConstants, tuning: &Tuning, inputs: &BlockDifferenceInputs) -> Image<[u16; 4]> {
    let blocks = Blocks::new(frame.render_extent);
    Image::compute(allocated_blocks(inputs.guides.guide), blocks.extent(), |block| {
        let pairs = Blocks::pixels(block, frame.render_extent).filter_map(|p| {
            let tap = inputs.guides.nearest(frame, tuning, p).filter(|_| inputs.irradiance.at(p)[3] >= 0.0)?;
            let before = (texel_luminance(inputs.history.irradiance.at(tap)) * frame.exposure_ratio).min(LARGEST_HALF);
            let history_length = unpack_moments(inputs.history.moments.at(tap)).history_length.max(1.0);
            Some((texel_luminance(inputs.irradiance.at(p)), before, 1.0 / history_length))
        });
        pack_difference(&difference_of(&pairs.collect::<Vec<_>>()))
    })
}

/// The difference of triples (this frame, history, variance of the history relative to that of one sample).
fn difference_of(pairs: &[(f32, f32, f32)]) -> Difference {
    if pairs.is_empty() {
        return Difference::default();
    }
    let mean = |value: &dyn Fn(&(f32, f32, f32)) -> f32| pairs.iter().map(value).sum::<f32>() / pairs.len() as f32;
    let (now, before) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
    let variance = mean(&|pair| (pair.0 - pair.1 - (now - before)).powi(2)) * (1.0 + mean(&|pair| pair.2));
    Difference { mean: now - before, deviation: variance.sqrt(), count: pairs.len() as f32, brighter: now.max(before) }
}

/// A pixel whose position or depth lies on its threshold may count on one side alone.
pub(crate) const RULES: &[Rule] =
    &[rule("block_difference", Unit::Block, Reading::Halves, Tolerance { absolute: 2e-3, outliers: 2e-2, ..HALF })];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = BlockDifferenceInputs {
        guides: HistoryGuides::of(b)?,
        irradiance: b.colour("irradiance")?,
        history: SignalHistory { irradiance: b.colour("history")?, moments: b.packed("previous_moments")? },
    };
    let differences = block_difference(b.frame, b.tuning, &inputs);
    b.write("block_difference", differences)
}

//! The stage `change_test`: how far the history of a pixel is still true, by the mean difference of the blocks around and its
//! standard error.

use crate::nodes::block_difference::twin::{unpack_difference, Difference, LOUD, RARE};
use crate::nodes::percentile_rule::twin::lin;
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{block_of, Blocks, BLOCK_SIZE};
use crate::reference::both_confidences::both_confidences;
use crate::reference::compare::{Condition, Reading, Rule, Unit};
use crate::reference::light_ratio::{floor_of_ratio, LARGEST_RATIO};
use crate::reference::luminance::{luminance, PARTS};
use crate::reference::rules::{pixels, rule, STEEP};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;

/// Share of the mean luminance below which a change is not worth the history, however certain it is.
pub(crate) const CHANGE_EPSILON: f32 = 0.01;

/// Noise up to here, as a share of the light, hides no change.
const QUIET: f32 = 0.1;
/// Samples of the past that spread by more than this share of the light were rare. A shadow that moves spreads them by less.
const SPREAD: f32 = 1.0;

/// Shares of the threshold between which steadiness falls from 1 to 0: of the mean difference over 3×3 blocks.
const STEADY_MEAN: [f32; 2] = [0.6, 1.2];
/// The same of the worst of the nine blocks, whose noise is larger.
const STEADY_BLOCK: [f32; 2] = [1.0, 1.6];

/// Times the threshold from which a block counts alone where it became darker: old light that stays is a ghost.
const ALONE_DARKER: f32 = 1.5;
/// The same where it became brighter: new light may be a cluster of outliers.
const ALONE_BRIGHTER: f32 = 2.0;
/// Fewer pixels tell nothing of their noise.
const ALONE_PIXELS: f32 = 8.0;

/// Shares of the noise that count where it is usual, of that of single pixels and of that which blocks have in common: neither were samples
/// of the past rare, nor is there new light, which may be a cluster of outliers.
const USUAL: [f32; 2] = [0.6, 0.85];
/// The brightest block of this frame over that of the history: up to the first, light is not new.
const NEW_LIGHT: [f32; 2] = [1.05, 1.3];

/// A change of a component is worth the history from this share on of a change of the mean that is.
const WORTH_OF_PART: f32 = 0.5;

/// Errors of the mean, as shares of the light, between which a ratio of light is no longer known.
const KNOWN: [f32; 2] = [0.1, 0.2];

/// Outputs of [`change_test`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ChangeTestOutputs {
    /// 1, keep the history, to 0, drop it.
    pub history_confidence: Image<f32>,
    /// One texel a block: 1 where neither the mean nor one of its blocks departs by what could be more than noise, to −1 where they changed for
    /// sure.
    pub steadiness: Image<f32>,
    /// One texel a block: by which the light of each component changed, of all signals; alpha: 1, −1 where there is no history.
    pub light_ratio: Image<[f32; 4]>,
}

/// The test in both directions, on `block_difference` of every signal; `extent` is the allocated one. `is_alone`: no gradients are
/// known besides. Then it takes less to drop a history.
pub(crate) fn change_test(
    frame: &FrameConstants,
    tuning: &Tuning,
    extent: [u32; 2],
    block_difference: &[&Image<[u32; 4]>],
    is_alone: bool,
) -> ChangeTestOutputs {
    let blocks = Blocks::new(frame.render_extent);
    let changes = Image::compute(extent.map(|side| side.div_ceil(BLOCK_SIZE)), blocks.extent(), |block| {
        let of_signals = block_difference.iter().map(|differences| change_of(tuning, blocks, differences, block, is_alone));
        of_signals.fold(Change::default(), |worst, change| Change {
            of_mean: worst.of_mean.max(change.of_mean),
            of_pixels: worst.of_pixels.max(change.of_pixels),
            unsteadiness: worst.unsteadiness.max(change.unsteadiness),
            now: [0, 1, 2].map(|c| worst.now[c] + change.now[c]),
            before: [0, 1, 2].map(|c| worst.before[c] + change.before[c]),
            power: worst.power.max(change.power),
        })
    });
    // An edge that moves is about to leave its own block.
    let departure = |block| blocks.rect().window(block, 1, 1).map(|(_, q)| changes.at(q).of_pixels).fold(0.0, f32::max);
    let confidence = |p| {
        let change = blocks.interpolated(p, |block| changes.at(block).of_mean).max(departure(block_of(p)));
        1.0 - tuning.adaptivity * change
    };
    ChangeTestOutputs {
        history_confidence: Image::compute(extent, frame.render_extent, confidence),
        steadiness: changes.map(|change| 1.0 - change.unsteadiness - tuning.adaptivity * change.of_mean),
        light_ratio: changes.map(|change| ratio_of(tuning, change)),
    }
}

fn ratio_of(tuning: &Tuning, change: &Change) -> [f32; 4] {
    let [now, before] = [change.now, change.before].map(|light| light.map(|c| c.max(0.0)));
    let least = floor_of_ratio(before);
    let ratio = |c: usize| ((now[c] + least) / (before[c] + least)).clamp(1.0 / LARGEST_RATIO, LARGEST_RATIO);
    let power = tuning.adaptivity * change.power.max(0.0);
    let [r, g, b] = [0, 1, 2].map(|c| ratio(c).powf(power));
    [r, g, b, if change.power < 0.0 { -1.0 } else { 1.0 }]
}

/// Changes of a block, 0 to 1.
#[derive(Clone, Copy, Debug)]
struct Change {
    /// Of the mean over 3×3 blocks or the one in the middle, in standard errors, against the threshold.
    of_mean: f32,
    /// Of the pixels of the block, where the noise explains none.
    of_pixels: f32,
    unsteadiness: f32,
    /// Mean light of this frame, for the ratio.
    now: [f32; 3],
    /// That of the history.
    before: [f32; 3],
    /// How far the ratio is applied, 0 to 1; −1: there is no history.
    power: f32,
}

impl Default for Change {
    fn default() -> Self {
        Self { of_mean: 0.0, of_pixels: 0.0, unsteadiness: 0.0, now: [0.0; 3], before: [0.0; 3], power: -1.0 }
    }
}

/// Standard deviation of normal noise over the median of its sizes.
const DEVIATION_BY_MEDIAN: f32 = 1.4826;

fn median_of(mut values: [f32; 9]) -> f32 {
    values.sort_by(f32::total_cmp);
    values[4]
}

/// Of the means of nine blocks. Medians, so that an edge that moves through three of them is no noise of all.
fn spread_of(means: [f32; 9]) -> f32 {
    let middle = median_of(means);
    DEVIATION_BY_MEDIAN * median_of(means.map(|mean| (mean - middle).abs()))
}

fn change_of(tuning: &Tuning, blocks: Blocks, differences: &Image<[u32; 4]>, block: IVec2, is_alone: bool) -> Change {
    let (mut pixels, mut sum, mut variance, mut brighter, mut noise) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let (mut past_noise, mut worst) = (0.0_f32, 0.0_f32);
    let (mut means, mut squares, mut brightest) = (Vec::new(), 0.0, [0.0_f32; 2]);
    let (mut now, mut before) = ([0.0; 3], [0.0; 3]);
    for (_, q) in blocks.rect().window(block, 1, 1) {
        let difference = unpack_difference(differences.at(q));
        let of_block =
            [difference.mean(), difference.deviation * difference.deviation, difference.brighter()].map(|v| difference.count * v);
        let luminances = difference.luminances();
        brightest = [0, 1].map(|side| brightest[side].max(luminances[side]));
        now = [0, 1, 2].map(|c| now[c] + difference.count * difference.now[c]);
        before = [0, 1, 2].map(|c| before[c] + difference.count * difference.before[c]);
        if difference.count > 0.0 {
            means.push(difference.mean());
            squares += difference.count * difference.count;
        }
        pixels += difference.count;
        sum += of_block[0];
        variance += of_block[1];
        brighter += of_block[2];
        noise += difference.count * difference.noise * difference.noise;
        past_noise = past_noise.max(difference.past_noise);
        worst = worst.max(errors(of_block));
    }
    // Noise that neighbours share is not averaged within a block.
    let spread = <[f32; 9]>::try_from(means).map_or(0.0, spread_of);
    let shared_variance = squares * spread * spread;
    let whole_variance = variance.max(shared_variance);
    let (k, of_luminance) = (tuning.change_threshold, errors([sum, whole_variance, brighter]));
    let steady = |shares: [f32; 2], errors| 1.0 - lin(shares[0] * k, shares[1] * k, errors);
    let steadiness = if pixels == 0.0 { 0.0 } else { steady(STEADY_MEAN, of_luminance) * steady(STEADY_BLOCK, worst) };
    let (own, noise) = (unpack_difference(differences.at(block)), (noise / pixels.max(1.0)).sqrt());
    let explained = own.brighter() * noise.max(CHANGE_EPSILON * k);
    let square = own.mean() * own.mean() + own.deviation * own.deviation;
    let is_quiet = (1.0 - lin(QUIET, LOUD, noise)) * (1.0 - lin(SPREAD, RARE, past_noise));
    let of_pixels = is_quiet * lin(1.0, 2.0, square / (explained * explained).max(1e-12));
    let is_known = 1.0 - lin(KNOWN[0], KNOWN[1], whole_variance.sqrt() / luminance(now).max(1e-6));
    let is_new = lin(NEW_LIGHT[0], NEW_LIGHT[1], brightest[0] / brightest[1].max(1e-6));
    let is_unusual = is_new.max(lin(SPREAD, RARE, past_noise));
    let counted = USUAL.map(|share| (share + is_unusual * (1.0 - share)).powi(2));
    let variance = (counted[0] * variance).max(counted[1] * shared_variance);
    let alone = || errors([sum, variance, brighter]).max(errors_of_parts([now, before], variance, brighter));
    let largest = if is_alone { alone() } else { of_luminance };
    let of_mean = lin(k, 2.0 * k, largest).max(change_alone(k, &own, spread));
    let power = match own.count {
        0.0 => -1.0,
        count if count < ALONE_PIXELS => 0.0,
        _ => of_mean * is_known,
    };
    Change { of_mean, of_pixels, unsteadiness: 1.0 - steadiness, now: own.now, before: own.before, power }
}

/// Of the component of light that changed most; it has noise as far as it has part in the luminance.
fn errors_of_parts([now, before]: [[f32; 3]; 2], variance: f32, brighter: f32) -> f32 {
    let whole = luminance(now).max(luminance(before)).max(1e-6);
    let of_part = |c: usize| {
        let share = PARTS[c] * now[c].max(before[c]) / whole;
        errors([PARTS[c] * (now[c] - before[c]), variance * share * share, WORTH_OF_PART * brighter])
    };
    of_part(0).max(of_part(2))
}

/// What moves takes from one block as much as it gives to the next. `spread`: of the means of the blocks around.
fn change_alone(k: f32, block: &Difference, spread: f32) -> f32 {
    if block.count < ALONE_PIXELS {
        return 0.0;
    }
    let variance = (block.count * block.deviation * block.deviation).max((block.count * spread).powi(2));
    let errors = errors([block.count * block.mean(), variance, block.count * block.brighter()]);
    let least = k * if block.mean() < 0.0 { ALONE_DARKER } else { ALONE_BRIGHTER };
    lin(least, 2.0 * least, errors)
}

/// A difference in standard errors.
fn errors([sum, variance, brighter]: [f32; 3]) -> f32 {
    let least = CHANGE_EPSILON * brighter;
    sum.abs() / (variance + least * least).sqrt().max(1e-6)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    pixels("history_confidence", STEEP),
    Rule { when: Condition::Is("BOTH", 1), ..rule("history_confidence", Unit::Pixel, Reading::SpecularConfidence, STEEP) },
    rule("steadiness", Unit::Block, Reading::Plain, STEEP),
    rule("light_ratio", Unit::Block, Reading::Plain, STEEP),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let extent = b.extent_of("history_confidence")?;
    let (differences, is_of_both, is_alone) = (b.wides("block_difference")?, b.is_on("BOTH")?, !b.has("steadiness"));
    let of_signals = |signals: &[&Image<[u32; 4]>]| change_test(b.frame, b.tuning, extent, signals, is_alone);
    let mut outputs = of_signals(if is_of_both { &differences[..1] } else { &differences });
    if is_of_both {
        // Of light that is mixed there is one difference.
        let specular = of_signals(&differences[differences.len() - 1..]).history_confidence;
        let both = |p| both_confidences(outputs.history_confidence.at(p), specular.at(p));
        outputs.history_confidence = Image::compute(extent, b.frame.render_extent, both);
    }
    b.write("history_confidence", outputs.history_confidence)?;
    if b.has("light_ratio") {
        b.write("light_ratio", outputs.light_ratio)?;
    }
    if b.has("steadiness") {
        b.write("steadiness", outputs.steadiness)?;
    }
    Ok(())
}

//! The stage `block_difference`: how far the light of a frame departs from its own history, block by block.

use crate::reference::binary16::{from_half_bits, half_bits, round_to_half, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{allocated_blocks, Blocks};
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::luminance::luminance;
use crate::reference::luminance_history::luminance_history_of;
use crate::reference::nearest_history::HistoryGuides;
use crate::reference::nearest_history::SignalHistory;
use crate::reference::range::Range;
use crate::reference::rules::{rule, HALF};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use std::collections::BTreeMap;

/// Statistics that a block holds of its light and of that of its history.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Difference {
    /// Mean light of this frame.
    pub now: [f32; 3],
    /// Mean light of the history.
    pub before: [f32; 3],
    /// Standard deviation of one difference of luminance, that of the history's own noise included.
    pub deviation: f32,
    /// Pixels with a history.
    pub count: f32,
    /// Deviation of a pixel from those above and below, as a share of the brighter side; [`LOUD`] and more are one.
    pub noise: f32,
    /// The same of samples up to the previous frame, which knows of rare light; [`RARE`] and more are one.
    pub past_noise: f32,
}

/// The largest share of the light that noise is told as.
pub(crate) const LOUD: f32 = 0.2;
/// The largest share of the light that noise of the past is told as.
pub(crate) const RARE: f32 = 1.5;
/// A change is told from noise a little earlier than even noise would allow.
const NOISE_THAT_HIDES: f32 = 0.7;
const NOISE_STEPS: f32 = 31.0;
const PAST_NOISE_STEPS: f32 = 15.0;

impl Difference {
    /// Mean luminances of this frame and of the history.
    pub(crate) fn luminances(&self) -> [f32; 2] {
        [self.now, self.before].map(luminance)
    }

    /// Mean of the differences of luminance, this frame minus the history.
    pub(crate) fn mean(&self) -> f32 {
        let [now, before] = self.luminances();
        now - before
    }

    /// The larger of the mean luminances of both sides.
    pub(crate) fn brighter(&self) -> f32 {
        let [now, before] = self.luminances();
        now.max(before)
    }
}

/// A texel of `block_difference*`.
pub(crate) fn pack_difference(difference: &Difference) -> [u32; 4] {
    let half = |x: f32| u32::from(half_bits(x.clamp(-LARGEST_HALF, LARGEST_HALF)));
    let steps = |noise: f32, most: f32, steps: f32| (noise.min(most) / most * steps + 0.5).floor() as u32;
    let (noise, past) = (steps(difference.noise, LOUD, NOISE_STEPS), steps(difference.past_noise, RARE, PAST_NOISE_STEPS));
    let packed = difference.count as u32 | noise << 7 | past << 12;
    let ([r, g, b], [before_r, before_g, before_b]) = (difference.now.map(half), difference.before.map(half));
    [r | g << 16, b | before_r << 16, before_g | before_b << 16, half(difference.deviation) | packed << 16]
}

/// The content of a texel of `block_difference*`.
pub(crate) fn unpack_difference(texel: [u32; 4]) -> Difference {
    let [[r, g], [b, before_r], [before_g, before_b], [deviation, _]] =
        texel.map(|word| [word as u16, (word >> 16) as u16].map(from_half_bits));
    let packed = (texel[3] >> 16) as u16;
    let [count, noise, past] = [packed & 127, packed >> 7 & 31, packed >> 12].map(f32::from);
    let (noise, past_noise) = (noise * (LOUD / NOISE_STEPS), past * (RARE / PAST_NOISE_STEPS));
    Difference { now: [r, g, b], before: [before_r, before_g, before_b], deviation, count, noise, past_noise }
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
pub(crate) fn block_difference(frame: &FrameConstants, tuning: &Tuning, inputs: &BlockDifferenceInputs) -> Image<[u32; 4]> {
    let blocks = Blocks::new(frame.render_extent);
    Image::compute(allocated_blocks(inputs.guides.guide), blocks.extent(), |block| {
        let pairs = Blocks::pixels(block, frame.render_extent).filter_map(|p| {
            let tap = inputs.guides.nearest(frame, tuning, p).filter(|_| inputs.irradiance.at(p)[3] >= 0.0)?;
            let before = rgb(inputs.history.irradiance.at(tap)).map(|x| (x * frame.exposure_ratio).min(LARGEST_HALF));
            let luminance_history = inputs.history.luminance_history.at(tap);
            let deviation = luminance_history.deviation * frame.exposure_ratio;
            let now = rgb(inputs.irradiance.at(p));
            Some((
                (p.y, p.x),
                Pair { now, before, uncertainty: 1.0 / luminance_history.history_length.max(1.0), variance: deviation * deviation },
            ))
        });
        pack_difference(&difference_of(&pairs.collect()))
    })
}

fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b]
}

/// A pixel and its history.
#[derive(Clone, Copy, Debug)]
struct Pair {
    now: [f32; 3],
    before: [f32; 3],
    /// Variance of the history relative to that of one sample.
    uncertainty: f32,
    /// Of samples, up to the previous frame.
    variance: f32,
}

/// Of pixels by row and column.
fn difference_of(pairs: &BTreeMap<(i32, i32), Pair>) -> Difference {
    if pairs.is_empty() {
        return Difference { noise: LOUD, past_noise: RARE, ..Difference::default() };
    }
    let mean = |value: &dyn Fn(&Pair) -> f32| pairs.values().map(value).sum::<f32>() / pairs.len() as f32;
    let now = [0, 1, 2].map(|c| mean(&|pair| pair.now[c]));
    let before = [0, 1, 2].map(|c| mean(&|pair| pair.before[c]));
    let whole = Difference { now, before, count: pairs.len() as f32, ..Difference::default() };
    let spread = mean(&|pair| (luminance(pair.now) - luminance(pair.before) - whole.mean()).powi(2));
    let (variance, brighter) = (spread * (1.0 + mean(&|pair| pair.uncertainty)), whole.brighter());
    // Of white noise, a second difference has six times its variance. Without one, nothing is known of it. An edge bends as noise does, and
    // stays in the range of its past.
    let at = |y, x| pairs.get(&(y, x)).map(|pair| luminance(pair.now));
    let curves = pairs.keys().filter_map(|&(y, x)| Some(at(y - 1, x)? - 2.0 * at(y, x)? + at(y + 1, x)?));
    let (curved, curvature) = curves.fold((0.0, 0.0), |(count, sum), curve: f32| (count + 1.0, sum + curve * curve));
    let [noise, past_noise] = match curved > 0.0 && brighter > 0.0 {
        true => {
            let outside = NOISE_THAT_HIDES * pairs.keys().map(|at| outside_at(pairs, *at)).sum::<f32>() / pairs.len() as f32;
            let noise = (curvature / (6.0 * curved)).min(outside);
            [noise, mean(&|pair| pair.variance)].map(|variance: f32| variance.sqrt() / brighter)
        }
        false => [LOUD, RARE],
    };
    Difference { deviation: variance.sqrt(), noise, past_noise, ..whole }
}

/// The luminance now, or before.
type Side = fn(&Pair) -> f32;

/// How far each side of a pixel lies outside of the range of the other there and beside it, in the same block, squared. Light that was
/// resampled, and an edge that lies between two pixels, do not. Noise does: by its variance over n − ½, of n pixels.
fn outside_at(pairs: &BTreeMap<(i32, i32), Pair>, (y, x): (i32, i32)) -> f32 {
    let places = [(y, x), (y, x - 1), (y, x + 1), (y - 1, x), (y + 1, x)];
    let beside: Vec<&Pair> = places.iter().filter_map(|at| pairs.get(at)).collect();
    let outside = |of: Side, other: Side| beside.iter().map(|pair| other(pair)).collect::<Range>().outside(of(beside[0]));
    let (now, before): (Side, Side) = (|pair| round_to_half(luminance(pair.now)), |pair| round_to_half(luminance(pair.before)));
    let (now, before) = (outside(now, before), outside(before, now));
    (beside.len() as f32 - 0.5) * 0.5 * (now * now + before * before)
}

/// A pixel whose position or depth lies on its threshold may count on one side alone.
pub(crate) const DIFFERENCE: Rule =
    rule("block_difference", Unit::Block, Reading::BlockDifference, Tolerance { absolute: 2e-3, outliers: 2e-2, ..HALF });

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[DIFFERENCE];

/// The departure of an irradiance from the history that a pass binds.
pub(crate) fn difference_from_history(b: &Bindings, irradiance: &Image<[f32; 4]>) -> Result<Image<[u32; 4]>, Error> {
    let luminance_history = luminance_history_of(b.uint("previous_luminance_history")?);
    let history = SignalHistory { irradiance: b.colour("history")?, luminance_history: &luminance_history };
    Ok(block_difference(b.frame, b.tuning, &BlockDifferenceInputs { guides: HistoryGuides::of(b)?, irradiance, history }))
}

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let differences = difference_from_history(b, b.colour("irradiance")?)?;
    b.write("block_difference", differences)
}

//! How many frames a past is worth by the light of now around a pixel.

use super::past::{of_light, Past};
use super::{Centre, Scene};
use crate::reference::binary16::{signed_half_range, LARGEST_HALF};
use crate::reference::render_rect::RenderRect;
use glam::{IVec2, Vec2};

/// Standard errors by which the light of now may differ from a past that counts in full; twice as many, and it does not count. The widest lobe
/// mirrors no place, so that chance would cost more than what moves.
pub(super) const AGREES: f32 = 2.0;
pub(super) const AGREES_WIDEST: f32 = 4.0;
/// Of the light, how far half precision and taps between pixels may be off.
const ROUNDED: f32 = 1e-3;
/// Pixels to each side, and the fewest that tell a change.
const AGREEMENT_REACH: i32 = 2;
const FEWEST_AGREEING: f32 = 9.0;
/// Of the light of a past: logarithms of less are next to equal.
pub(super) const DARK: f32 = 0.02;
/// Of the pixels around the 3×3 nearest ones, beside those.
const RING_WEIGHT: f32 = 0.25;
/// By how much the mean of a logarithm to base 2 may lie below the logarithm of a mean, of the variance: four times that of a log-normal
/// distribution, since rare light is skewed more.
const LOG_BIAS: f32 = 1.386;
/// Smallest variances of logarithms to base 2: of a mean of pixels, and of a sample.
pub(super) const LOG_ROUNDED: f32 = 1e-3;
const LOG_NOISE: f32 = 1e-2;
/// Pixels that rare light should have hit by the past, of those compared: up to the first, that it hit none is chance, from the second on it
/// is a change.
const FEW_HITS: f32 = 2.0;
const ENOUGH_HITS: f32 = 4.0;
/// Three in a row that tell how white noise is.
const FEWEST_ROWS: f32 = 6.0;

/// What the light of now tells of a past.
#[derive(Clone, Copy)]
pub(super) struct ByLight {
    /// That it is worth.
    pub frames: f32,
    /// Variance of a sample of now, as a ratio of light to base 2; `None`: untold.
    pub noise: Option<f32>,
}

/// Variance of a sample by how much three in a row bend. `logs`: by offset, of now and of the past.
fn noise_of(logs: &[(IVec2, [f32; 2])]) -> Option<f32> {
    let now_at = |at: IVec2| logs.iter().find(|(offset, _)| *offset == at).map(|(_, [now, _])| *now);
    let rows = logs.iter().filter_map(|(offset, [now, _])| {
        let [beside, beyond] = [1, 2].map(|left| now_at(*offset - IVec2::X * left));
        Some((now - 2.0 * beside? + beyond?).powi(2))
    });
    let rows: Vec<f32> = rows.collect();
    (rows.len() as f32 >= FEWEST_ROWS).then(|| rows.iter().sum::<f32>() / (6.0 * rows.len() as f32))
}

/// Frames until the error of a past is as large as the `noise` of a sample, both as ratios of light. Rare light has noise without bounds by
/// this measure, and a highlight, which is smooth as a ratio, next to none. `hits`: the share of samples that brought the light of the past.
fn frames_by_logs(logs: &[(IVec2, [f32; 2])], noise: f32, hits: f32) -> f32 {
    let weight = |offset: IVec2| if offset.abs().max_element() < AGREEMENT_REACH { 1.0 } else { RING_WEIGHT };
    let (mut sum, mut squares, mut difference) = (0.0, 0.0, 0.0);
    for (offset, [now, then]) in logs {
        let weight = weight(*offset);
        sum += weight;
        squares += weight * weight;
        difference += weight * (now - then);
    }
    let difference = difference / sum;
    let pixels = sum * sum / squares;
    let missed = ((hits * pixels - FEW_HITS) / (ENOUGH_HITS - FEW_HITS)).clamp(0.0, 1.0);
    let outside = difference.max(-(difference + LOG_BIAS * noise) * missed).max(0.0);
    let error = (outside - (noise / pixels + LOG_ROUNDED).sqrt()).max(0.0);
    (noise + LOG_NOISE) / (error * error).max(1e-9)
}

impl Scene<'_> {
    /// A past by the light of now around a position: by the mean difference over 5×5 pixels in standard errors, of the
    /// channel that differs most; where nobody knows the place of what is seen (`by_logs`), by logarithms as well.
    pub(super) fn by_light(&self, c: &Centre, position: Vec2, past: &Past, agrees: f32, by_logs: bool) -> ByLight {
        let in_light = |i: usize, value: f32| signed_half_range(value * c.ratio[i] * self.frame.exposure_ratio);
        let (id, before) = (c.mirror.surface.id, RenderRect::new(self.frame.previous_render_extent));
        let shift = (position + 0.5).floor().as_ivec2() - c.mirror.p;
        let counts = |q: IVec2| {
            let surface = self.motion.surfaces.at(q);
            before.contains(q + shift) && self.inputs.noisy.at(q)[3] >= 0.0 && !surface.is_background() && surface.id == id
        };
        let pairs: Vec<(IVec2, [f32; 3], [f32; 3])> = self
            .rect
            .window(c.mirror.p, AGREEMENT_REACH, 1)
            .filter(|(_, q)| counts(*q))
            .map(|(offset, q)| {
                let (now, then) = (self.inputs.noisy.at(q), self.inputs.previous.history.at(q + shift));
                (offset, [now[0], now[1], now[2]], [0, 1, 2].map(|i| in_light(i, then[i])))
            })
            .collect();
        let count = pairs.len() as f32;
        if count < FEWEST_AGREEING {
            return ByLight { frames: past.frames, noise: None };
        }
        let known = self.deviation_of(c, past).powi(2);
        let irradiance = [0, 1, 2].map(|i| in_light(i, past.irradiance[i]));
        let errors = [0, 1, 2].map(|i| {
            let differences = pairs.iter().map(|(_, now, then)| now[i] - then[i]);
            let mean = differences.clone().sum::<f32>() / count;
            let variance = differences.map(|d| (d - mean).powi(2)).sum::<f32>() / count;
            let rounded = ROUNDED * irradiance[i];
            mean.abs() / (variance.max(known) / count + rounded * rounded + 1e-20).sqrt()
        });
        let agreement = (2.0 - errors.into_iter().fold(0.0, f32::max) / agrees).clamp(0.0, 1.0);
        if !by_logs {
            return ByLight { frames: past.frames * agreement, noise: None };
        }
        let dark = DARK * of_light(irradiance).max(0.0) + 1e-6;
        let logs: Vec<_> = pairs
            .iter()
            .map(|(offset, now, then)| (*offset, [now, then].map(|light| (of_light(*light).max(0.0) + dark).log2())))
            .collect();
        let mean = (past.mean * self.light_scale(c)).min(LARGEST_HALF);
        let hits = mean * mean / (mean * mean + known).max(1e-20);
        let noise = noise_of(&logs);
        let frames = noise.map_or(f32::INFINITY, |noise| frames_by_logs(&logs, noise, hits));
        ByLight { frames: frames.min(past.frames * agreement), noise }
    }
}

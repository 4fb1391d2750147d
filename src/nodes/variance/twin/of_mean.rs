//! The deviation of the accumulated mean, from the past of a pixel and from 5×5 pixels around it.

use super::{Estimated, LuminanceHistory, FADING_RADIUS};
use crate::reference::geometry_weights::Geometry;
use crate::reference::rare_light::few_have_it;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{FrameConstants, Tuning};
use glam::IVec2;

#[cfg(test)]
mod tests;

/// How much wider a variance is that is in doubt, and that of rare light: a window that has a single pixel of it says next to nothing.
const DOUBT: f32 = 3.0;
const RARE_DOUBT: f32 = 24.0;

/// Of the noise that neighbouring means still show: noise that repeats is not averaged away, and few neighbours show too little of it.
const SEEN_NOISE: f32 = 1.75;

/// Where neighbours repeat each other they differ by less than their noise.
const FILLED_NOISE: f32 = 2.0;

/// White noise bends by six times its variance: `(l₊ − 2l + l₋)²`.
const BEND_OF_NOISE: f32 = 6.0;
/// The least weight of all bends together that tell something: on a small ball the normals of three pixels differ, and its shading is no noise.
const LEAST_BENDS: f32 = 0.05;

/// Samples vary by no more than so many times their variance against their own pasts.
const MOST_OF_PAST: f32 = 2.0;

/// Shares of a spread of logarithms that bends as noise does: up to the first it is an edge, a texture or a highlight that no guide knows,
/// from the second on it is noise.
const STRUCTURE: f32 = 0.6;
const WHITE_NOISE: f32 = 0.8;

/// The same shares: a window between them is a picture with some noise, and of a deviation there, or below them, at least a part counts.
const PICTURE: f32 = 0.15;
const MIXTURE: f32 = 0.45;
const NARROWEST: f32 = 0.2;

/// Of the mean: logarithms of less are next to equal.
const DARK: f32 = 0.1;

/// Variances of logarithms to base 2: from the first to the second, a picture or noise counts as one. It spans a factor of 1.6, and 2.7.
const FAINT: f32 = 0.5;
const CLEAR: f32 = 2.0;

/// Estimates from 5×5 pixels of how the luminance of one of them varies.
struct Surroundings {
    /// Variance of the samples that a mean was made of; less where a picture is.
    within: f32,
    /// Variance of the means, without what is smooth, and less likewise.
    noise: f32,
    /// Of that noise, without edges and textures.
    seen: f32,
    /// Relative standard error of a variance that was seen in so few pixels.
    error: f32,
    /// Variance of the logarithms of means that bends.
    log_noise: f32,
    /// Variance of the samples against their own pasts.
    past: f32,
    /// Few pixels have its light.
    rare: bool,
}

impl Surroundings {
    /// How much wider the variance is, as a share of it, since few pixels tell it.
    fn doubt(&self) -> f32 {
        let rare = self.error.min(1.0) * smoothstep(FAINT, CLEAR, self.log_noise);
        DOUBT * self.error + RARE_DOUBT * rare.powi(8)
    }
}

/// Of a history of so many frames, noise that is seen beyond so many times its variance came again from frame to frame.
const SETTLED_FRAMES: f32 = 8.0;
const REPEATED_NOISE: f32 = 8.0;

/// Standard deviation of the accumulated mean: never below the noise of neighbouring means.
pub(super) fn deviation_of_mean(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
) -> Estimated {
    let rect = RenderRect::new(frame.render_extent);
    let around = surroundings(frame, geometry, luminance_history, p);
    let mean_at = |q: IVec2| luminance_history.at(q).mean;
    let bends = noise_of(rect, geometry, &mean_at, p);
    let noise = around.noise.min(bends.unwrap_or(f32::INFINITY));
    let white = Whiteness::new(rect, geometry, &mean_at, p);
    let centre = luminance_history.at(p);
    let told = if centre.outside.is_some() { (MOST_OF_PAST * around.past / noise.max(1e-20)).min(1.0) } else { 1.0 };
    let detail =
        bends.and(centre.outside).map(|_| (1.0 - around.past / noise.max(1e-20)).max(-1.0)).filter(|detail| *detail > -1.0);
    let (counted, whole) = (white.counted * told, white.whole * told);
    let within = around.within * counted;
    deviation(
        tuning,
        centre,
        Surroundings { within, noise: noise * counted, seen: noise * whole, log_noise: white.log_noise, ..around },
        detail,
    )
}

/// How far neighbours differ as noise does and not as a picture, 0 to 1. Told by logarithms, in which a highlight is as smooth as its foot,
/// and rare light is not.
struct Whiteness {
    whole: f32,
    /// The part of a variance that counts: less in a picture, and none in a clear one.
    counted: f32,
    log_noise: f32,
}

impl Whiteness {
    fn new(rect: RenderRect, geometry: &Geometry, luminance: &dyn Fn(IVec2) -> f32, p: IVec2) -> Self {
        let window: Vec<(f32, IVec2)> = rect.window(p, FADING_RADIUS, 1).map(|(_, q)| (geometry.weight(p, q), q)).collect();
        let sum: f32 = window.iter().map(|(weight, _)| weight).sum();
        let mean = |value: &dyn Fn(IVec2) -> f32| window.iter().map(|(weight, q)| weight * value(*q)).sum::<f32>() / sum;
        let dark = (DARK * mean(luminance)).max(0.0) + 1e-12;
        let log = |q: IVec2| (luminance(q).max(0.0) + dark).log2();
        let middle = mean(&log);
        let spread = mean(&|q| (log(q) - middle).powi(2));
        match noise_of(rect, geometry, &log, p) {
            None => Self { whole: 1.0, counted: 1.0, log_noise: 0.0 },
            Some(noise) => {
                let share = noise / spread.max(1e-20);
                let whole = smoothstep(STRUCTURE, WHITE_NOISE, share);
                // From the end, where next to nothing is left: one less what is next to one would be rounding.
                let unclear = smoothstep(-CLEAR, -FAINT, noise - spread);
                let narrowed = NARROWEST + (1.0 - NARROWEST) * smoothstep(PICTURE, MIXTURE, share);
                Self { whole, counted: (whole + unclear * (1.0 - whole)) * narrowed * narrowed, log_noise: noise }
            }
        }
    }
}

fn smoothstep(from: f32, to: f32, value: f32) -> f32 {
    let x = ((value - from) / (to - from)).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The same where pixels were filled in: they repeat their neighbours, so that what is smooth may be noise as well.
pub(super) fn deviation_of_filled_mean(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
) -> Estimated {
    let around = surroundings(frame, geometry, luminance_history, p);
    let noise = FILLED_NOISE * around.noise;
    deviation(tuning, luminance_history.at(p), Surroundings { noise, seen: noise, ..around }, None)
}

fn deviation(tuning: &Tuning, centre: LuminanceHistory, around: Surroundings, detail: Option<f32>) -> Estimated {
    let frames = (centre.history_length / tuning.sample_frames).max(1.0);
    let share = (tuning.spatial_variance_frames / frames).min(1.0);
    let spatial = (around.within + around.noise) * share * (1.0 + around.doubt() / frames);
    let of_sample = share * spatial + (1.0 - share) * centre.deviation * centre.deviation;
    let averaging = (1.0 / frames).max(tuning.sample_frames * tuning.alpha / (2.0 - tuning.alpha)).min(1.0);
    let (known, seen) = (of_sample * averaging, SEEN_NOISE * around.seen);
    let is_repeated = centre.history_length >= SETTLED_FRAMES && seen > REPEATED_NOISE * known;
    Estimated { deviation: known.max(seen).sqrt(), is_repeated, rare: around.rare, detail }
}

/// With the structure that they show.
fn surroundings(
    frame: &FrameConstants,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
) -> Surroundings {
    let rect = RenderRect::new(frame.render_extent);
    let window: Vec<(f32, LuminanceHistory)> =
        rect.window(p, FADING_RADIUS, 1).map(|(_, q)| (geometry.weight(p, q), luminance_history.at(q))).collect();
    let sum: f32 = window.iter().map(|(weight, _)| weight).sum();
    let mean_of = |value: &dyn Fn(&LuminanceHistory) -> f32| window.iter().map(|(weight, m)| weight * value(m)).sum::<f32>() / sum;
    let past = mean_of(&|m| m.outside.unwrap_or(m.deviation).powi(2));
    // The mean of one frame is its sample: what it varies by is seen in its neighbours already.
    let within = if luminance_history.at(p).outside.is_some() { 0.0 } else { past };
    let mean = mean_of(&|m| m.mean);
    let spread = mean_of(&|m| (m.mean - mean).powi(2));
    let kurtosis = mean_of(&|m| (m.mean - mean).powi(4)) / (spread * spread).max(1e-36);
    let error = ((kurtosis - 1.0).max(0.0) / sum).sqrt();
    let rare = few_have_it(window.iter().map(|(weight, m)| (*weight, m.mean)));
    Surroundings { within, noise: spread, seen: spread, error, log_noise: 0.0, past, rare }
}

/// Variance that bends, by the squared second differences of neighbours along x and y, all of the surface of the centre; none where there
/// are too few.
fn noise_of(rect: RenderRect, geometry: &Geometry, value: &dyn Fn(IVec2) -> f32, p: IVec2) -> Option<f32> {
    let (mut sum, mut count) = (0.0, 0.0);
    let middles = rect.window(p, FADING_RADIUS, 1).flat_map(|(offset, q)| [(offset, q, IVec2::X), (offset, q, IVec2::Y)]);
    for (offset, q, axis) in middles {
        let (before, behind) = (q - axis, q + axis);
        let in_window = (offset * axis).abs().element_sum() < FADING_RADIUS;
        if !in_window || !rect.contains(before) || !rect.contains(behind) {
            continue;
        }
        let weight = geometry.weight(p, before) * geometry.weight(p, q) * geometry.weight(p, behind);
        let bend = value(before) - 2.0 * value(q) + value(behind);
        sum += weight * bend * bend;
        count += weight;
    }
    (count > LEAST_BENDS).then(|| sum / count / BEND_OF_NOISE)
}

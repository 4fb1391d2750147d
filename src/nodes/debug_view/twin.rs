//! The stage `debug_view`: what the denoiser knows of a pixel, as a picture.

use super::legend::{
    false_colour, from_srgb, gradient_colour, motion_colour, past_colour, LARGE_MOTION, LONG_HISTORY, MIDDLE_DEVIATION,
    REASON_COLOURS, WIDEST_LOBE, WIDE_PENUMBRA,
};
use crate::nodes::block_percentiles::twin::unpack_percentiles;
use crate::nodes::demodulate::twin::divisor;
use crate::nodes::firefly_limits::twin::limit_at;
use crate::reference::binary16::round_image_to_half;
use crate::reference::binary16::LARGEST_HALF;
use crate::reference::blocks::block_of;
use crate::reference::both_confidences::change_by;
use crate::reference::guide::{pcg, unpack_guide};
use crate::reference::kept_radiance::exposed;
use crate::reference::luminance::texel_luminance;
use crate::reference::projection::pixel_size;
use crate::reference::reflection::{lobe_width, nearness, unpack_image_share, unpack_reflection, SeenReflection};
use crate::reference::scenery::Instances;
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::virtual_motion::VirtualMotion;
use crate::reference::visibility::VisibilityHistory;
use crate::reference::{Image, LuminanceHistory};
use crate::{Counter, DebugView, FrameConstants, Statistics, Tuning};
use glam::{IVec2, Vec2};

mod adapter;
#[cfg(test)]
mod tests;

pub(crate) use adapter::{twin, RULES};

/// Kinds of input that are counted.
const BAD_KINDS: u32 = 12;

/// Inputs of [`debug_view`]; what the preset lacks is empty or `None`. Images have the allocated extent, but for those of blocks
/// and strata.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DebugViewInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// Counters of the frame.
    pub statistics: &'a Statistics,
    /// `luminance_history*` of every signal.
    pub luminance_history: &'a [&'a Image<LuminanceHistory>],
    /// `irradiance_history*` of every signal; alpha: standard deviation.
    pub irradiance_history: &'a [&'a Image<[f32; 4]>],
    /// Share of the history that is kept.
    pub history_confidence: Option<&'a Image<f32>>,
    /// x: δ, y: Δ, one texel a stratum.
    pub gradient: Option<&'a Image<[f32; 4]>>,
    /// Pixels a side of a stratum.
    pub stratum_size: u32,
    /// `block_percentiles*` of every signal, one texel a block.
    pub block_percentiles: &'a [&'a Image<u32>],
    /// `firefly_limits*` of every signal, one texel a cell.
    pub firefly_limits: &'a [&'a Image<u32>],
    /// Noisy radiance of every signal.
    pub noisy: &'a [&'a Image<[f32; 4]>],
    /// What is seen in the surfaces, where specular light is filtered.
    pub reflection: Option<&'a Image<u32>>,
    /// Visibility of a light over its history.
    pub visibility_history: Option<&'a Image<VisibilityHistory>>,
    /// Albedo of the host.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// By which instances mirrors and the things in them move.
    pub instances: Instances<'a>,
}

/// rgb: display-referred, linear 0 to 1; alpha: the number behind the colour. Half precision.
pub(crate) fn debug_view(frame: &FrameConstants, tuning: &Tuning, inputs: &DebugViewInputs, view: DebugView) -> Image<[f32; 4]> {
    let extent = inputs.guide.extent();
    let virtual_motion = (view == DebugView::VirtualMotion).then(|| VirtualMotion::new(frame, inputs.guide));
    let image = Image::compute(extent, frame.render_extent, |p| {
        let (rgb, value) = if !inputs.has(view) {
            ([if (p.x / 8 + p.y / 8) % 2 == 0 { 0.02 } else { 0.05 }; 3], 0.0)
        } else if view == DebugView::BadValues {
            bad_values(frame, inputs.statistics, p)
        } else if unpack_guide(inputs.guide.at(p)).is_background() {
            ([0.0; 3], 0.0)
        } else if let Some(of) = &virtual_motion {
            motion(inputs.virtual_motion(frame, of, p))
        } else {
            inputs.shown(frame, tuning, view, p)
        };
        let [r, g, b] = rgb.map(|c| c.clamp(0.0, 1.0));
        [r, g, b, value.clamp(-LARGEST_HALF, LARGEST_HALF)]
    });
    round_image_to_half(&image)
}

impl DebugViewInputs<'_> {
    fn has(&self, view: DebugView) -> bool {
        match view {
            DebugView::HistoryLength | DebugView::MeanAndDeviation | DebugView::Alpha | DebugView::Disocclusion => {
                !self.luminance_history.is_empty()
            }
            DebugView::Deviation => !self.irradiance_history.is_empty(),
            DebugView::Gradient => self.gradient.is_some(),
            DebugView::Lambda => self.history_confidence.is_some(),
            DebugView::HitDistance | DebugView::LobeAngle | DebugView::VirtualMotion | DebugView::ReflectionHistory => {
                self.reflection.is_some()
            }
            DebugView::Visibility | DebugView::Penumbra => self.visibility_history.is_some(),
            DebugView::Percentiles => !self.block_percentiles.is_empty(),
            DebugView::Fireflies => !self.firefly_limits.is_empty(),
            DebugView::Motion | DebugView::Normal | DebugView::Depth | DebugView::SurfaceId | DebugView::BadValues => true,
        }
    }

    fn shown(&self, frame: &FrameConstants, tuning: &Tuning, view: DebugView, p: IVec2) -> ([f32; 3], f32) {
        let coloured = |t: f32, value: f32| (false_colour(t), value);
        let surface = unpack_guide(self.guide.at(p));
        let change = self.history_confidence.map_or(0.0, |confidence| change_by(confidence.at(p)));
        let seen = self.reflection.map_or(SeenReflection::default(), |reflection| unpack_reflection(reflection.at(p)));
        match view {
            DebugView::HitDistance if seen.hit_distance == 0.0 => ([0.0; 3], 0.0),
            DebugView::HitDistance => coloured(nearness(surface.linear_depth, seen.hit_distance), seen.hit_distance),
            DebugView::LobeAngle => {
                let angle = lobe_width(seen.roughness).atan().to_degrees();
                coloured(angle / WIDEST_LOBE, angle)
            }
            DebugView::ReflectionHistory => match self.reflection.and_then(|reflection| unpack_image_share(reflection.at(p))) {
                Some(share) => (past_colour(share), share),
                None => (from_srgb(REASON_COLOURS[5].map(f32::from)), -1.0),
            },
            DebugView::Visibility => coloured(self.visibility(p).mean[0], self.visibility(p).mean[0]),
            DebugView::Penumbra if self.visibility(p).occluder_distance == 0.0 => ([0.0; 3], 0.0),
            DebugView::Penumbra => {
                let radius = tuning.light_radius * self.visibility(p).occluder_distance;
                let pixels = radius / pixel_size(frame, surface.linear_depth).max_element();
                coloured(pixels / WIDE_PENUMBRA, pixels)
            }
            DebugView::HistoryLength => {
                let frames = self.luminance_history_at(0, p).history_length;
                coloured(frames / LONG_HISTORY, frames)
            }
            DebugView::Deviation => {
                let deviation = root_of_squares(self.irradiance_history.iter().map(|image| image.at(p)[3].max(0.0)));
                coloured(deviation / (MIDDLE_DEVIATION + deviation), deviation)
            }
            DebugView::MeanAndDeviation => {
                let each = || (0..self.luminance_history.len()).map(|i| self.luminance_history_at(i, p));
                let (mean, deviation) = (each().map(|m| m.mean).sum(), root_of_squares(each().map(|m| m.deviation)));
                ([compressed(mean), compressed(deviation), 0.0], mean)
            }
            DebugView::Gradient => self.gradient_at(p),
            DebugView::Lambda => coloured(change, change),
            DebugView::Alpha => {
                let alpha =
                    (tuning.alpha + change * (1.0 - tuning.alpha)).max(1.0 / self.luminance_history_at(0, p).history_length);
                coloured(alpha, alpha)
            }
            DebugView::Percentiles => {
                let at =
                    |i: usize| self.block_percentiles.get(i).map(|b| unpack_percentiles(b.at(block_of(p)))).unwrap_or_default();
                (([at(0).low, at(0).up, at(1).up]).map(compressed), at(0).up)
            }
            DebugView::Fireflies => {
                let share = (0..self.firefly_limits.len()).map(|i| self.excess(frame, i, p)).fold(0.0, f32::max);
                coloured(share, share)
            }
            DebugView::Disocclusion => {
                let reason = self.luminance_history_at(0, p).reason.min(5);
                (from_srgb(REASON_COLOURS[usize::from(reason)].map(f32::from)), f32::from(reason))
            }
            DebugView::Motion | DebugView::VirtualMotion => motion(self.surface_motion_at(p)),
            DebugView::Normal => (surface.unit_normal().to_array().map(|c| c * 0.5 + 0.5), 0.0),
            DebugView::Depth => coloured(compressed(surface.linear_depth), surface.linear_depth),
            DebugView::SurfaceId | DebugView::BadValues => {
                let [r, g, b, _] = pcg(surface.id.into()).to_le_bytes();
                ([r, g, b].map(|c| f32::from(c) / 255.0), surface.id.into())
            }
        }
    }

    fn surface_motion_at(&self, p: IVec2) -> [f32; 2] {
        unpack_surface_motion(self.surface_motion.at(p)).motion
    }

    /// Of the image behind a surface; of the surface, where nothing is known of it.
    fn virtual_motion(&self, frame: &FrameConstants, of: &VirtualMotion, p: IVec2) -> [f32; 2] {
        let surface = self.surface_motion_at(p);
        let seen = self.reflection.map(|reflection| unpack_reflection(reflection.at(p))).filter(|seen| seen.hit_distance > 0.0);
        let mirror = of.mirror(p, surface);
        let curvature = of.curvature(&mirror);
        let position = seen.and_then(|seen| {
            let before = self.instances.scenery_before(frame, &mirror, &curvature, seen);
            of.image_position(&mirror, &curvature, &before.mirror, before.image, seen.roughness)
        });
        position.map_or(surface, |position| (position - mirror.surface_position + Vec2::from(surface)).into())
    }

    fn visibility(&self, p: IVec2) -> VisibilityHistory {
        self.visibility_history.map_or(VisibilityHistory::default(), |history| history.at(p))
    }

    fn luminance_history_at(&self, signal: usize, p: IVec2) -> LuminanceHistory {
        self.luminance_history[signal].at(p)
    }

    fn gradient_at(&self, p: IVec2) -> ([f32; 3], f32) {
        let [change, brightest, ..] = self.gradient.map_or([0.0; 4], |g| g.at(p / self.stratum_size as i32));
        let t = if brightest > 0.0 { (change / brightest).clamp(-1.0, 1.0) } else { 0.0 };
        (gradient_colour(t), change)
    }

    /// The share of a signal's luminance that is above the firefly filter's limit.
    fn excess(&self, frame: &FrameConstants, signal: usize, p: IVec2) -> f32 {
        let Some(texel) = self.noisy.get(signal).map(|noisy| noisy.at(p)) else { return 0.0 };
        if texel[..3].iter().any(|c| !c.is_finite()) {
            return 0.0;
        }
        let (divisor, _) = divisor(self.albedo.map(|a| a.at(frame.guide_pixel(p))));
        let texel = exposed(frame, texel);
        let l = texel_luminance([0, 1, 2, 3].map(|i| (texel[i] / divisor.get(i).unwrap_or(&1.0)).clamp(0.0, LARGEST_HALF)));
        let limit = limit_at(self.firefly_limits[signal], p).limit;
        if limit > 0.0 && l > limit {
            1.0 - limit / l
        } else {
            0.0
        }
    }
}

fn bad_values(frame: &FrameConstants, statistics: &Statistics, p: IVec2) -> ([f32; 3], f32) {
    let [width, height] = frame.render_extent;
    let kind = (p.y as u32 * BAD_KINDS / height).min(BAD_KINDS - 1);
    let count = statistics[Counter::ALL[kind as usize]] as f32;
    let length = (1.0 + count).log2() / (1.0 + width as f32 * height as f32).log2();
    if (p.x as f32 + 0.5) / (width as f32) < length {
        (from_srgb(REASON_COLOURS[5].map(f32::from)), count)
    } else {
        ([if kind.is_multiple_of(2) { 0.02 } else { 0.04 }; 3], count)
    }
}

fn motion(motion: [f32; 2]) -> ([f32; 3], f32) {
    let motion = Vec2::from(motion);
    let pixels = motion.length();
    let t = ((1.0 + pixels).log2() / (1.0 + LARGE_MOTION).log2()).min(1.0);
    (motion_colour(motion.normalize_or_zero().to_array(), t), pixels)
}

fn compressed(x: f32) -> f32 {
    x / (1.0 + x)
}

fn root_of_squares(values: impl Iterator<Item = f32>) -> f32 {
    values.map(|v| v * v).sum::<f32>().sqrt()
}

//! The stage `temporal_accumulation` \[SVGF 4.1\]: irradiance and moments of luminance accumulated along the motion of the surface.

use crate::reference::both_confidences::change_by;
use crate::reference::conventions::is_reset;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::luminance_history::{LuminanceHistory, Reason};
use crate::reference::material::{classes_beyond, tuning_at};
use crate::reference::nearest_history::SignalHistory;
use crate::reference::octahedral::octahedral10_to_normal;
use crate::reference::projection::extent_ratio;
use crate::reference::surface_motion::{unpack_surface_motion, SurfaceMotion};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, FrameConstants, Statistics, Tuning};
use glam::{IVec2, Vec2, Vec3};

mod adapter;
mod blend;
#[cfg(test)]
mod history_tests;
mod light;
mod taps;
#[cfg(test)]
mod tests;
mod volume;

pub(crate) use adapter::{twin, RULES};
pub(crate) use blend::{blend, fresh, AlphaBounds};
pub(crate) use light::ratio_at;
pub(crate) use taps::{cubic_taps, SMALLEST_WEIGHT_SUM};
pub(crate) use volume::{volume_accumulation, VolumeAccumulationInputs};

/// Guide and histories that the previous frame left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreviousFrame<'a> {
    /// The guide of the previous frame.
    pub guide: &'a Image<[u16; 4]>,
    /// One for every signal.
    pub signals: &'a [SignalHistory<'a>],
}

/// Object-space normals of both frames, packed by [`crate::reference::octahedral10`]: they replace the world normals in the history test.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectNormals<'a> {
    /// Object normals of this frame, packed by the stage `import`.
    pub current: &'a Image<u32>,
    /// Object normals of the previous frame, packed by the stage `import`.
    pub previous: &'a Image<u32>,
}

/// The image `light_ratio`, from the last iteration of `gradient_atrous`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StrataRatio<'a> {
    /// rgb: ratio; alpha: negative in the background.
    pub image: &'a Image<[f32; 4]>,
    /// Pixels a side of a stratum.
    pub stratum_size: u32,
}

/// Inputs of [`temporal_accumulation`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TemporalAccumulationInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// rgb: irradiance of every signal, as written by `demodulate` or `fill_holes`; a negative alpha marks pixels without a sample of
    /// their own.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// Object normals, where the host gives them.
    pub object_normals: Option<ObjectNormals<'a>>,
    /// Classes of materials, where the host gives them.
    pub material_class: Option<&'a Image<u32>>,
    /// Confidence from `history_confidence`, `percentile_rule` or `change_test`: alpha rises where it is below 1 \[ASVGF 3.5\].
    pub history_confidence: Option<&'a Image<f32>>,
    /// Repair of disocclusions, and a history as long as the confidence says \[PSVGF\].
    pub repair: bool,
    /// Whether irradiance is looked up by a cubic, where 4×4 pixels show the surface, and taps count as far as their normals agree.
    pub sharp: bool,
    /// The ratio of light by which the history is scaled.
    pub light_ratio: Option<StrataRatio<'a>>,
    /// The previous frame, which is not read in a reset frame; `None` is treated as one.
    pub previous: Option<PreviousFrame<'a>>,
}

/// Outputs of [`temporal_accumulation`], one of each for every signal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TemporalAccumulationOutputs {
    /// rgb: accumulated irradiance, half precision; alpha 0.
    pub irradiance: Vec<Image<[f32; 4]>>,
    /// Rounded to halves.
    pub luminance_history: Vec<Image<LuminanceHistory>>,
    /// Surfaces with a history of their own, and those without by reason.
    pub statistics: Statistics,
}

/// The history of a pixel: the taps, shared by all signals.
#[derive(Clone, Copy, Default)]
enum History {
    #[default]
    Background,
    Disoccluded(Reason),
    /// Pixels with weights that sum to 1; those beyond the valid ones have weight 0.
    Taps([(IVec2, f32); 9]),
    /// Such pixels for the moments, and for the irradiance 4×4 with the weights of a cubic.
    Sharp([(IVec2, f32); 9], [(IVec2, f32); 16]),
    /// Pixels that may show the same surface, with such weights, and why there is no history of its own \[PSVGF\].
    Repaired([(IVec2, f32); 9], Reason),
}

impl History {
    /// The counter of a surface with this history; none in the background and in a reset frame.
    fn counter(&self) -> Option<Counter> {
        match self {
            Self::Taps(_) | Self::Sharp(..) => Some(Counter::HistoryKept),
            Self::Disoccluded(reason) | Self::Repaired(_, reason) => match reason {
                Reason::OffScreen => Some(Counter::LostOffScreen),
                Reason::Id => Some(Counter::LostSurfaceId),
                Reason::Depth => Some(Counter::LostDepth),
                Reason::Normal => Some(Counter::LostNormal),
                Reason::None | Reason::Reset => None,
            },
            Self::Background => None,
        }
    }
}

/// Frames that the history of a neighbour is worth: it soon gives way to what the pixel sees itself.
const REPAIRED_HISTORY_LENGTH: f32 = 4.0;

/// What a tap is worth at least that passed the test of normals.
const SMALLEST_LIKENESS: f32 = 0.02;
/// Share of the tolerance beyond which normals that rounding sets apart are alike.
const FULL_LIKENESS: f32 = 0.95;

/// Accumulates every signal; they share taps, and the history length but for holes.
pub(crate) fn temporal_accumulation(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &TemporalAccumulationInputs,
) -> TemporalAccumulationOutputs {
    let extent = inputs.guide.extent();
    let previous = inputs.previous.filter(|_| !is_reset(frame));
    let surfaces = previous.map(|previous| {
        Image::compute(previous.guide.extent(), frame.previous_render_extent, |p| {
            let surface = unpack_guide(previous.guide.at(p));
            inputs.object_normals.map_or(surface, |n| Surface { normal: octahedral10_to_normal(n.previous.at(p)), ..surface })
        })
    });
    let tuning_of = |p| tuning_at(frame, tuning, inputs.material_class, p);
    let histories = Image::compute(extent, frame.render_extent, |p| {
        let surface = unpack_guide(inputs.guide.at(p));
        match &surfaces {
            _ if surface.is_background() => (History::Background, 1.0),
            Some(surfaces) => {
                let reprojected = reprojected(frame, &tuning_of(p), inputs, surface, p);
                match reprojected.history(surfaces, inputs.repair, inputs.sharp) {
                    history if inputs.sharp => reprojected.by_likeness(history, surfaces),
                    history => (history, 1.0),
                }
            }
            None => (History::Disoccluded(Reason::Reset), 1.0),
        }
    });
    let mut outputs =
        TemporalAccumulationOutputs { irradiance: Vec::new(), luminance_history: Vec::new(), statistics: Statistics::default() };
    histories.texels().iter().filter_map(|(history, _)| history.counter()).for_each(|counter| outputs.statistics[counter] += 1);
    if let Some(classes) = inputs.material_class {
        outputs.statistics[Counter::MaterialClass] = classes_beyond(frame, classes, inputs.guide);
    }
    for (i, irradiance) in inputs.irradiance.iter().enumerate() {
        let signal = previous.and_then(|previous| previous.signals.get(i));
        let texels = Image::compute(extent, frame.render_extent, |p| {
            let change = inputs.history_confidence.map_or(0.0, |confidence| change_by(confidence.at(p)));
            let bounds = AlphaBounds::new(&tuning_of(p), inputs.history_confidence.is_some(), inputs.repair, change);
            let ratio = inputs.light_ratio.map_or([1.0; 3], |ratio| ratio_at(frame, ratio, p));
            let (c, luminance_history) = accumulate(frame, irradiance.at(p), histories.at(p), bounds, signal, ratio);
            (c, luminance_history.in_halves())
        });
        outputs.irradiance.push(texels.map(|t| t.0));
        outputs.luminance_history.push(texels.map(|t| t.1));
    }
    outputs
}

/// The surface of a pixel, by object-space normals where there are any.
fn reprojected(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &TemporalAccumulationInputs,
    surface: Surface,
    p: IVec2,
) -> Reprojected {
    let motion = unpack_surface_motion(inputs.surface_motion.at(p));
    let normal = inputs.object_normals.map_or(motion.previous_normal, |n| octahedral10_to_normal(n.current.at(p)));
    let motion = SurfaceMotion { previous_normal: normal, ..motion };
    Reprojected::new(frame, tuning, (surface, p), &motion)
}

/// ChangeTest pixels with their weights, and those of a cubic.
type Taps = ([(IVec2, f32); 9], Option<[(IVec2, f32); 16]>);

/// A surface with what is expected of it in the previous frame.
#[derive(Clone, Copy)]
pub(crate) struct Reprojected {
    /// Position in the previous image; pixel centres are whole numbers.
    pub s: Vec2,
    /// Position that it would have without motion.
    start: Vec2,
    linear_depth: f32,
    depth_tolerance: f32,
    /// Scene units per pixel.
    depth_gradient: Vec2,
    normal: Vec3,
    normal_tolerance: f32,
    is_apart: bool,
    id: u8,
    rect: RenderRect,
}

impl Reprojected {
    /// The surface of the pixel `p`.
    pub(crate) fn new(frame: &FrameConstants, tuning: &Tuning, (surface, p): (Surface, IVec2), motion: &SurfaceMotion) -> Self {
        let depth_gradient = Vec2::from(surface.gradient);
        let linear_depth = surface.linear_depth * (1.0 + motion.depth_ratio);
        let start = (p.as_vec2() + 0.5) * extent_ratio(frame) - 0.5;
        Self {
            s: (p.as_vec2() + 0.5) * extent_ratio(frame) + Vec2::from(motion.motion) - 0.5,
            start,
            linear_depth,
            depth_tolerance: tuning.depth_tolerance * linear_depth + depth_gradient.abs().element_sum(),
            depth_gradient,
            normal: motion.previous_normal.into(),
            normal_tolerance: tuning.normal_tolerance,
            id: surface.id,
            is_apart: surface.is_apart,
            rect: RenderRect::new(frame.previous_render_extent),
        }
    }

    /// Of the surface in the previous frame.
    pub(crate) fn linear_depth(&self) -> f32 {
        self.linear_depth
    }

    /// The surface at another place of its plane.
    pub(crate) fn at(self, s: Vec2, linear_depth: f32) -> Self {
        Self { s, linear_depth, ..self }
    }

    /// Pixels that show this surface, with weights that sum to 1, those beyond the valid ones have weight 0; and 4×4 with the weights
    /// of a cubic, where all show it.
    pub(crate) fn taps(&self, surfaces: &Image<Surface>) -> Option<Taps> {
        match self.history(surfaces, false, true) {
            History::Taps(taps) => Some((taps, None)),
            History::Sharp(taps, cubic) => Some((taps, Some(cubic))),
            _ => None,
        }
    }

    /// The reason why the pixel `q` of the previous frame is not this surface.
    fn refusal(&self, surfaces: &Image<Surface>, q: IVec2) -> Reason {
        self.refusal_aside(surfaces, q, 0.0)
    }

    /// The reason why a pixel that lies aside is not this surface; the depth may have changed by `slack`.
    fn refusal_aside(&self, surfaces: &Image<Surface>, q: IVec2, slack: f32) -> Reason {
        let Some(tap) = surfaces.get(q.x, q.y).filter(|_| self.rect.contains(q)) else { return Reason::OffScreen };
        if tap.is_background() || tap.id != self.id || tap.is_apart != self.is_apart {
            Reason::Id
        } else if (tap.linear_depth - self.linear_depth).abs() > self.depth_tolerance + slack {
            Reason::Depth
        } else if tap.unit_normal().dot(self.normal) < self.normal_tolerance {
            Reason::Normal
        } else {
            Reason::None
        }
    }

    /// Whether a pixel that may lie far from `s` is this surface, whose plane goes on there; its slope may be a tenth off.
    pub(crate) fn is_on_plane(&self, surfaces: &Image<Surface>, q: IVec2) -> bool {
        let aside = q.as_vec2() - self.s;
        let there = Self { linear_depth: self.linear_depth + self.depth_gradient.dot(aside), ..*self };
        there.refusal_aside(surfaces, q, 0.1 * aside.length() * self.depth_gradient.abs().element_sum()) == Reason::None
    }

    /// How alike the normal of a tap is to that which is expected: 1, to nearly 0 at the tolerance.
    pub(crate) fn likeness(&self, tap: &Surface) -> f32 {
        let spare = tap.unit_normal().dot(self.normal) - self.normal_tolerance;
        (spare / (FULL_LIKENESS * (1.0 - self.normal_tolerance).max(1e-3))).clamp(SMALLEST_LIKENESS, 1.0)
    }

    /// With taps that weigh as much as they are alike, and their likeness as a whole.
    fn by_likeness(&self, mut history: History, surfaces: &Image<Surface>) -> (History, f32) {
        let (History::Taps(taps) | History::Sharp(taps, _) | History::Repaired(taps, _)) = &mut history else {
            return (history, 1.0);
        };
        taps.iter_mut().filter(|tap| tap.1 > 0.0).for_each(|(q, weight)| *weight *= self.likeness(&surfaces.at(*q)));
        let sum: f32 = taps.iter().map(|tap| tap.1).sum();
        taps.iter_mut().for_each(|tap| tap.1 /= sum);
        (history, sum)
    }

    fn history(&self, surfaces: &Image<Surface>, repair: bool, sharp: bool) -> History {
        let slack = 2.0 * self.depth_gradient.abs().element_sum();
        taps::find(self.s, |q| self.refusal(surfaces, q))
            .map(|found| if sharp { taps::sharpened(self.s, found, |q| self.refusal_aside(surfaces, q, slack)) } else { found })
            .unwrap_or_else(|| {
                let reason = self.refusal(surfaces, taps::nearest(self.s));
                let repaired = if repair { self.repaired(surfaces, reason) } else { None };
                repaired.unwrap_or(History::Disoccluded(reason))
            })
    }

    /// Disocclusion repair \[PSVGF\]: around the end of the motion 3×3 pixels, then rings of eight, 2 and 4 pixels away, until one
    /// has a pixel that may be the same surface.
    fn repaired(&self, surfaces: &Image<Surface>, reason: Reason) -> Option<History> {
        let nearest = (self.cut_at_border() + 0.5).floor().as_ivec2();
        [1, 2, 4].into_iter().find_map(|ring| {
            let mut taps = [(IVec2::ZERO, 0.0); 9];
            for (i, tap) in taps.iter_mut().enumerate().filter(|(i, _)| ring == 1 || *i != 4) {
                let q = nearest + IVec2::new(i as i32 % 3 - 1, i as i32 / 3 - 1) * ring;
                let slack = self.depth_gradient.abs().dot((q.as_vec2() - self.s).abs());
                *tap = (q, f32::from(self.refusal_aside(surfaces, q, slack) == Reason::None));
            }
            let sum: f32 = taps.iter().map(|tap| tap.1).sum();
            taps.iter_mut().for_each(|tap| tap.1 /= sum);
            (sum > 0.0).then_some(History::Repaired(taps, reason))
        })
    }

    /// The point where the way from `start` to `s` leaves the image; `s` itself where it does not.
    fn cut_at_border(&self) -> Vec2 {
        let last = self.rect.last().as_vec2();
        let (start, way) = (self.start.clamp(Vec2::ZERO, last), self.s - self.start);
        let border = self.s.clamp(Vec2::ZERO, last);
        let part = |i: usize| match way[i] {
            _ if border[i] == self.s[i] => 1.0,
            0.0 => 0.0,
            way => (border[i] - start[i]) / way,
        };
        start + part(0).min(part(1)).clamp(0.0, 1.0) * way
    }
}

/// Blends one signal of one pixel with its history \[SVGF 4.1\].
fn accumulate(
    frame: &FrameConstants,
    c: [f32; 4],
    (history, likeness): (History, f32),
    bounds: AlphaBounds,
    signal: Option<&SignalHistory>,
    ratio: [f32; 3],
) -> ([f32; 4], LuminanceHistory) {
    let (taps, longest, signal) = match (history, signal) {
        (History::Background, _) => return fresh(c, Reason::None),
        (History::Disoccluded(reason), _) => return fresh(c, reason),
        (_, None) => return fresh(c, Reason::Reset),
        (History::Taps(taps) | History::Sharp(taps, _), Some(signal)) => (taps, f32::INFINITY, signal),
        (History::Repaired(taps, _), Some(signal)) => (taps, REPAIRED_HISTORY_LENGTH, signal),
    };
    let (mut irradiance, before) = weighted_history(&taps, signal);
    if let History::Sharp(_, cubic) = history {
        irradiance = [0, 1, 2].map(|i| cubic.iter().map(|(q, weight)| weight * signal.irradiance.at(*q)[i]).sum());
    }
    let before = LuminanceHistory { history_length: (before.history_length * likeness).min(longest), ..before };
    let means = taps.iter().filter(|tap| tap.1 > 0.0).map(|(q, _)| signal.luminance_history.at(*q).mean);
    blend(frame, c, irradiance, (&before, means.collect()), bounds, ratio)
}

/// The weighted mean of irradiance and of μ1, σ² + μ1² and N. The second moment is taken about the mean, which is the same and does
/// not cancel.
fn weighted_history(taps: &[(IVec2, f32); 9], signal: &SignalHistory) -> ([f32; 3], LuminanceHistory) {
    let valid = || taps.iter().filter(|tap| tap.1 > 0.0);
    let (mut irradiance, mut mean, mut history_length) = ([0.0; 3], 0.0, 0.0);
    for &(q, weight) in valid() {
        let (c, luminance_history) = (signal.irradiance.at(q), signal.luminance_history.at(q));
        (0..3).for_each(|i| irradiance[i] += weight * c[i]);
        mean += weight * luminance_history.mean;
        history_length += weight * luminance_history.history_length;
    }
    let mut variance = 0.0;
    for &(q, weight) in valid() {
        let luminance_history = signal.luminance_history.at(q);
        variance += weight
            * (luminance_history.deviation * luminance_history.deviation
                + (luminance_history.mean - mean) * (luminance_history.mean - mean));
    }
    (irradiance, LuminanceHistory { mean, deviation: variance.sqrt(), history_length, ..LuminanceHistory::default() })
}

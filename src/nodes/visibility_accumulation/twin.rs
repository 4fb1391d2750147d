//! The stage `visibility_accumulation` \[Mehta et al. 2012\], \[SVGF 4.1\]: visibility blended with its past, and the distance of
//! what casts the shadow.

use crate::nodes::temporal_accumulation::twin::Reprojected;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::conventions::is_reset;
use crate::reference::geometry_weights::Geometry;
use crate::reference::guide::unpack_guide;
use crate::reference::projection::Projections;
use crate::reference::rules::{rule, STATISTICS};
use crate::reference::shadow_motion::{Occluders, Receiver};
use crate::reference::statistics::count;
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::visibility::{
    each, halves_of, histories_of, largest, lights_of, of_light, pack_visibility, write_words, Ruler, VisibilityHistory, Visible,
    LONGEST_HISTORY,
};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Error, FrameConstants, Statistics, Tuning};
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Sums of weights up to this are nothing.
const NOTHING: f32 = 1e-3;
/// Of weights of samples that may be equal but for rounding: the first one counts.
const CLEARLY: f32 = 1.001;
/// Pixels that the search reaches to each side.
const SEARCH_REACH: i32 = 6;
/// Pixels that always count as near.
const NEAR: f32 = 1.5;
/// Standard deviations of the interval that the history is clamped to, by the radius of the penumbra in pixels.
const CONFIDENCE_Z: [f32; 2] = [1.0, 2.0];
/// The same of the visibility of all directions.
const CONFIDENCE_Z_OF_AMBIENT: f32 = 3.0;
/// Frames up to which the deviation is at least that of the surroundings. No whole number, which rounding would make a matter of the driver.
const SHORT_HISTORY: f32 = 7.5;
/// Variance of a look by the cubic, as a share of that by 2×2 pixels.
const CUBIC_BLUR: f32 = 0.2;
/// Variance by which motion may blur an edge, as a share of the squared radius of the penumbra.
const TOLERATED_BLUR: f32 = 0.5;
/// Variance by which motion may blur any edge, squared pixels.
const TOLERATED_BLUR_OF_ANY: f32 = 0.15;
/// Smallest weight of this frame in the distance of the occluder.
const DISTANCE_ALPHA: f32 = 0.25;

/// Inputs of [`visibility_accumulation`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisibilityAccumulationInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// Samples of a light, from the stage `visibility_samples`: visibility and distance of the occluder, whose signs tell what the block has.
    pub samples: &'a Image<(Visible, f32)>,
    /// By what occluders move.
    pub occluders: Occluders<'a>,
    /// Whether the visibility is that of all directions, and of no light.
    pub ambient: bool,
    /// Guide and output of this stage of the previous frame; not read in a reset frame, and `None` is treated as one.
    pub previous: Option<(&'a Image<[u16; 4]>, &'a Image<VisibilityHistory>)>,
}

/// A sample of the host; [`None`] has no visibility.
#[derive(Clone, Copy, Default)]
struct Sample {
    visibility: Option<Visible>,
    distance: f32,
    /// Whether its block of 8×8 pixels has lit samples, and occluded ones.
    block: [bool; 2],
}

impl Sample {
    fn new(&(visibility, distance): &(Visible, f32)) -> Self {
        let block = [visibility[0], distance].map(f32::is_sign_negative);
        let visibility = visibility.map(f32::abs);
        Self { visibility: (visibility[0] <= 1.0).then_some(visibility), distance: distance.abs(), block }
    }
}

/// A sample beside a pixel: its squared distance on the surface, and its weight by geometry.
struct Tap {
    q: IVec2,
    squared: f32,
    weight: f32,
    visibility: Visible,
    distance: f32,
}

/// Everything that is around a pixel.
struct Surroundings<'a> {
    geometry: &'a Geometry,
    samples: &'a Image<Sample>,
    rect: RenderRect,
    ruler: Ruler,
    light_radius: f32,
    ambient: bool,
    p: IVec2,
}

/// What is around a pixel: the distance of the occluders whose penumbra reaches it, weights of occluded and of lit samples, and the occluded
/// sample that weighs most, of which the occluder is known.
struct Search {
    distance: f32,
    occluded: Visible,
    lit: Visible,
    nearest: Option<IVec2>,
}

/// Mean, deviation and history length of the visibility of a light; with the counters of occluders that have no motion that can be used.
pub(crate) fn visibility_accumulation(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &VisibilityAccumulationInputs,
) -> (Image<VisibilityHistory>, Statistics) {
    let geometry = Geometry::new(frame, tuning, inputs.guide);
    let light_radius = tuning.light_radii()[inputs.occluders.light];
    let samples = inputs.samples.map(Sample::new);
    let previous = inputs.previous.filter(|_| !is_reset(frame));
    let before =
        previous.map(|(guide, _)| Image::compute(guide.extent(), frame.previous_render_extent, |p| unpack_guide(guide.at(p))));
    let (projections, occluders) = (Projections::new(frame), &inputs.occluders);
    let texels = Image::compute(inputs.guide.extent(), frame.render_extent, |p| {
        let surface = unpack_guide(inputs.guide.at(p));
        if surface.is_background() {
            return (VisibilityHistory { mean: [1.0; 3], history_length: 1.0, ..Default::default() }, false, false);
        }
        let ruler = Ruler::new(frame, &surface);
        let rect = RenderRect::new(frame.render_extent);
        let around = Surroundings { geometry: &geometry, samples: &samples, rect, ruler, light_radius, ambient: inputs.ambient, p };
        let uniform = around.uniform();
        let search = uniform.map_or_else(|| around.search(), Search::of_one_kind);
        let past = previous.zip(before.as_ref()).and_then(|((_, history), surfaces)| {
            let motion = unpack_surface_motion(inputs.surface_motion.at(p));
            let reprojected = Reprojected::new(frame, tuning, (surface, p), &motion);
            let past_at = |at: Reprojected| {
                let (taps, cubic) = at.taps(surfaces)?;
                let (past, blur) = (weighted_history(&taps, history), ruler.blur(at.s - at.s.floor()));
                if uniform.is_some() {
                    return Some((past, 0.0));
                }
                let Some(cubic) = cubic else { return Some((past, blur)) };
                let mean = each(|c| cubic.iter().map(|(q, weight)| weight * history.at(*q).mean[c]).sum::<f32>().clamp(0.0, 1.0));
                Some((VisibilityHistory { mean, ..past }, CUBIC_BLUR * blur))
            };
            let receiver = Receiver::new(frame, &projections, &surface, p, &motion, reprojected.s);
            let shadow = search
                .nearest
                .filter(|_| !inputs.ambient)
                .and_then(|nearest| occluders.shadow_before(frame, &projections, &receiver, nearest));
            shadow.and_then(|at| past_at(reprojected.at(at.position, at.linear_depth))).or_else(|| past_at(reprojected))
        });
        let Sample { visibility, distance, .. } = samples.at(p);
        let is_followed = previous.is_some() && visibility.is_some_and(|v| v.iter().any(|v| *v < 1.0)) && distance > 0.0;
        let bad = [occluders.lacks_transform(p), occluders.has_bad_motion(p)].map(|bad| bad && is_followed);
        (around.accumulate(tuning, uniform, &search, past), bad[0], bad[1])
    });
    let mut statistics = Statistics::default();
    statistics[Counter::OccluderId] = count(texels.texels().iter().map(|t| t.1));
    statistics[Counter::OccluderMotion] = count(texels.texels().iter().map(|t| t.2));
    (texels.map(|t| t.0), statistics)
}

/// The mean over taps with weights that sum to 1; of the distance the largest.
fn weighted_history(taps: &[(IVec2, f32); 9], history: &Image<VisibilityHistory>) -> VisibilityHistory {
    let valid = || taps.iter().filter(|tap| tap.1 > 0.0).map(|(q, weight)| (history.at(*q), *weight));
    let mean = each(|c| valid().map(|(h, weight)| weight * h.mean[c]).sum());
    let variance = |c: usize| -> f32 {
        valid().map(|(h, weight)| weight * (h.deviation * h.deviation + (h.mean[c] - mean[c]) * (h.mean[c] - mean[c]))).sum()
    };
    VisibilityHistory {
        mean,
        deviation: largest(each(variance)).sqrt(),
        history_length: valid().map(|(h, weight)| weight * h.history_length).sum(),
        occluder_distance: valid().map(|(h, _)| h.occluder_distance).fold(0.0, f32::max),
    }
}

/// 1 at the pixel itself, falling to 0 at a distance.
fn reach(squared: f32, radius: f32) -> f32 {
    (1.0 - squared / (radius * radius)).max(0.0)
}

impl Search {
    /// Around a pixel beside which all samples are alike.
    fn of_one_kind(visibility: Visible) -> Self {
        Self { distance: 0.0, occluded: visibility.map(|v| 1.0 - v), lit: visibility, nearest: None }
    }
}

impl Surroundings<'_> {
    /// The visibility of all samples that the search may reach, where the blocks of nine pixels say that they are alike.
    fn uniform(&self) -> Option<Visible> {
        let block = |i: i32| self.samples.at(self.rect.clamp(self.p + SEARCH_REACH * IVec2::new(i % 3 - 1, i / 3 - 1))).block;
        let is_mixed = (0..2).all(|kind| (0..9).any(|i| block(i)[kind]));
        self.samples.at(self.p).visibility.filter(|_| !self.ambient && !is_mixed)
    }

    /// Samples of 5×5 pixels, `step` apart, that lie on the surface.
    fn taps(&self, step: i32) -> impl Iterator<Item = Tap> + '_ {
        self.rect.window(self.p, 2, step).filter(|(_, q)| !self.geometry.is_background(*q)).filter_map(move |(offset, q)| {
            let Sample { visibility, distance, .. } = self.samples.at(q);
            let squared = self.ruler.squared((offset * step).as_vec2());
            Some(Tap { q, squared, weight: self.geometry.weight_of_shape(self.p, q), visibility: visibility?, distance })
        })
    }

    fn search(&self) -> Search {
        let near = NEAR * self.ruler.longer();
        let own = self.samples.at(self.p);
        let own_distance = if largest(own.visibility.unwrap_or_default().map(|v| 1.0 - v)) > 0.0 { own.distance } else { 0.0 };
        let mut found = Search { distance: 0.0, occluded: [0.0; 3], lit: [0.0; 3], nearest: None };
        let (mut distance_sum, mut known, mut nearest) = (0.0, 0.0, 0.0);
        let apart = self.taps(3).filter(|tap| tap.squared > 0.0);
        for Tap { q, squared, weight, visibility, distance } in self.taps(1).chain(apart) {
            let reached = weight * reach(squared, 2.0 * self.light_radius * distance + near);
            let within = weight * reach(squared, 2.0 * self.light_radius * own_distance + near);
            let most = reached * largest(visibility.map(|v| 1.0 - v));
            found.occluded = each(|c| found.occluded[c] + reached * (1.0 - visibility[c]));
            found.lit = each(|c| found.lit[c] + within * visibility[c]);
            if distance > 0.0 {
                distance_sum += most * distance;
                known += most;
                if most > CLEARLY * nearest {
                    (nearest, found.nearest) = (most, Some(q));
                }
            }
        }
        found.distance = if known > 0.0 { distance_sum / known } else { 0.0 };
        found
    }

    /// Weight of the samples within the penumbra, and of the lit ones.
    fn window(&self, radius: f32) -> (f32, Visible) {
        let longer = self.ruler.longer();
        self.taps(1).fold((0.0, [0.0; 3]), |(sum, lit), tap| {
            let weight = tap.weight * reach(tap.squared, radius + NEAR * longer);
            (sum + weight, each(|c| lit[c] + weight * tap.visibility[c]))
        })
    }

    /// The variance that a profile of a shadow's edge may gain, squared scene units.
    fn tolerated_blur(&self, radius: f32) -> f32 {
        TOLERATED_BLUR * radius * radius + TOLERATED_BLUR_OF_ANY * self.ruler.squared_lengths().element_sum() / 2.0
    }

    fn accumulate(
        &self,
        tuning: &Tuning,
        uniform: Option<Visible>,
        search: &Search,
        past: Option<(VisibilityHistory, f32)>,
    ) -> VisibilityHistory {
        let &Search { distance: searched, occluded, lit, .. } = search;
        let known = past.map_or(0.0, |(h, _)| h.occluder_distance);
        let distance = if known > 0.0 && searched > 0.0 { known + DISTANCE_ALPHA * (searched - known) } else { searched };
        let radius = self.light_radius * distance;
        let (sum, of_lit) = uniform.map_or_else(|| self.window(radius), |visibility| (1.0, visibility));
        let share = if sum > NOTHING { of_lit.map(|lit| lit / sum) } else { [1.0; 3] };
        let v = self.samples.at(self.p).visibility.unwrap_or(share);
        let fresh = VisibilityHistory { mean: v, deviation: 0.0, history_length: 1.0, occluder_distance: distance };
        let result = past.map_or(fresh, |(before, blur)| {
            let pixels = radius / self.ruler.squared_lengths().max_element().sqrt();
            let z = if self.ambient { CONFIDENCE_Z_OF_AMBIENT } else { pixels.clamp(CONFIDENCE_Z[0], CONFIDENCE_Z[1]) };
            let bounded = each(|c| {
                let kinds = (!self.ambient).then_some([occluded[c], lit[c]]);
                let [from, to] = bounds(kinds, [sum, of_lit[c]], z);
                before.mean[c].clamp(from, to)
            });
            let before = VisibilityHistory { occluder_distance: distance, ..before };
            blend(tuning, v, &before, bounded, blur / self.tolerated_blur(radius))
        });
        // A few samples may be equal by chance.
        let spread = largest(share.map(|share| share * (1.0 - share))).max(0.0).sqrt();
        match result.history_length < SHORT_HISTORY {
            true => VisibilityHistory { deviation: result.deviation.max(spread), ..result },
            false => result,
        }
    }
}

/// The range of the mean that the samples of this frame allow: only lit, only occluded, where their kinds count, or the interval of
/// \[Wilson 1927\].
fn bounds(kinds: Option<[f32; 2]>, [n, of_lit]: [f32; 2], z: f32) -> [f32; 2] {
    match kinds {
        Some([occluded, lit]) if occluded <= NOTHING && lit > NOTHING => return [1.0; 2],
        Some([occluded, lit]) if lit <= NOTHING && occluded > NOTHING => return [0.0; 2],
        _ => {}
    }
    if n <= NOTHING {
        return [0.0, 1.0];
    }
    let squared = z * z;
    let middle = (of_lit + squared / 2.0) / (n + squared);
    let half_width = z / (n + squared) * (of_lit * (n - of_lit) / n + squared / 4.0).max(0.0).sqrt();
    [middle - half_width, middle + half_width].map(|x| x.clamp(0.0, 1.0))
}

/// `mean`: that of before, within its bounds. `blur`: the variance by which the look at the history blurred it, as a share of what is
/// tolerated.
fn blend(tuning: &Tuning, v: Visible, before: &VisibilityHistory, mean: Visible, blur: f32) -> VisibilityHistory {
    let history_length = (before.history_length + 1.0).min(LONGEST_HISTORY);
    // With the weight alpha, blur adds up to blur / alpha.
    let alpha = tuning.visibility_alpha.max(1.0 / history_length).max(blur.min(1.0));
    let difference = largest(each(|c| (v[c] - before.mean[c]).abs()));
    let variance = (1.0 - alpha) * (before.deviation * before.deviation + alpha * difference * difference);
    VisibilityHistory {
        mean: if alpha < 1.0 { each(|c| mean[c] + alpha * (v[c] - mean[c])) } else { v },
        deviation: variance.sqrt(),
        history_length: history_length.min(1.0 / alpha),
        occluder_distance: before.occluder_distance,
    }
}

/// A step of the packing, next to a test that may fall the other way: whether a penumbra reaches a pixel.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    rule("visibility_history", Unit::Pixel, Reading::Visibility, STEP_OF_MEAN),
    rule("history_colours", Unit::Pixel, Reading::VisibilityColours, STEP_OF_MEAN),
    rule("visibility_history", Unit::Pixel, Reading::VisibilitySteps, Tolerance { relative: 0.0, absolute: 1.0, outliers: 2e-3 }),
];

const STEP_OF_MEAN: Tolerance = Tolerance { relative: 0.0, absolute: 1e-3, outliers: 2e-3 };

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let transforms = b.instance_transforms()?;
    let (mut words, mut sum) = (Vec::new(), Statistics::default());
    for light in 0..lights_of(b) {
        let history = histories_of(b, ["previous_visibility_history", "previous_history_colours"], light)?;
        let inputs = VisibilityAccumulationInputs {
            guide: b.packed("guide")?,
            surface_motion: b.packed("surface_motion")?,
            samples: &halves_of(b, ["visibility_samples", "sample_colours"], light)?,
            occluders: Occluders {
                distance: Some(b.colour(&of_light("occluder_distance", light))?),
                id: b.optional_uint(&of_light("occluder_id", light))?,
                motion: b.optional_colour(&of_light("occluder_motion", light))?,
                transforms: transforms.as_deref(),
                light,
            },
            ambient: b.is_on("AMBIENT")?,
            previous: Some((b.packed("previous_guide")?, &history)),
        };
        let (history, statistics) = visibility_accumulation(b.frame, b.tuning, &inputs);
        sum = sum.plus(&statistics);
        words.push(history.map(pack_visibility));
    }
    b.count(&sum)?;
    write_words(b, ["visibility_history", "history_colours"], &words)
}

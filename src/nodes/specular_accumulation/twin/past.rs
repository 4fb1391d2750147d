//! The past of a reflection: where the surface was, where the image behind it was, and how much each is worth.

use super::agreement::{AGREES, AGREES_WIDEST};
use super::evidence::{CHANCE_AT_FIRST, UNLIKELY};
use super::{Centre, Scene};
use crate::nodes::temporal_accumulation::twin::{cubic_taps, SMALLEST_WEIGHT_SUM};
use crate::reference::binary16::{signed_half_range, LARGEST_HALF};
use crate::reference::forward_projection::previous_world_position;
use crate::reference::luminance::{luminance, texel_luminance};
use crate::reference::projection::{extent_ratio, previous_surface};
use crate::reference::range::Range;
use crate::reference::reflection::{
    hit_distance_of, lobe_radius, lobe_width, mirror_image_distance, mirror_share, nearness, reach, unpack_image_share,
    unpack_reflection, SeenReflection,
};
use crate::reference::render_rect::RenderRect;
use crate::reference::virtual_motion::image_at_rest;
use glam::{IVec2, Vec2, Vec3, Vec4Swizzles};

/// Pixels: a picture that moves by as much from frame to frame does not stand still.
const STILL: f32 = 0.01;
/// Radians: seen from a side that turns by as much from frame to frame, what a lobe gathers does not stand still.
const TURNED: f32 = 1e-3;

/// Pixels that a past may be off in each frame where no lobe blurs it.
const SHARPEST: f32 = 0.5;
/// Pixels that a past may be off: a lobe of four and more blurs what it shows by more than bilinear taps do.
const BLURRED_ANYWAY: f32 = 2.5;

/// Of a pixel, to which a position is rounded before 4×4 taps are looked up: which of them count is then no matter of the last bit.
const LOOKUP_STEPS: f32 = 256.0;
/// Nor is then which of 2×2 taps are in the range of a past.
const LEAST_IN_RANGE: f32 = 0.5 / LOOKUP_STEPS;

/// Depths to a thing whose hit distance nobody knows: what is far away, or in a curved mirror, is seen next to where this is.
const UNKNOWN_REACH: f32 = 1e4;

/// The same of the nearest thing that a surface may show.
const NEAREST_REACH: f32 = 0.125;

/// Of the difference between the reach of a past and that of a pixel, whose own may be chance at an edge.
const OWN_DIFFERENCE: f32 = 0.35;
/// The least that a tap counts which shows another thing.
const LEAST_LIKE: f32 = 1e-3;
/// Standard deviations of a past that are noise; twice as many are another thing.
const NOISE_OF_PAST: f32 = 2.0;
/// By noise alone, the variance of the means of taps over that of a sample, as a ratio of light to base 2: ln(2)² for the base, and a third.
const NOISE_OF_MEANS: f32 = 0.16;

/// Mean of what the tested taps hold.
#[derive(Clone, Copy, Default)]
pub(super) struct Past {
    /// Frames that it is worth.
    pub frames: f32,
    /// Hit distance as a share of the way from the eye.
    pub nearness: f32,
    /// The same, 1 where the hit distance is unknown.
    pub reach: f32,
    pub roughness: f32,
    /// See [`unpack_image_share`]; of no past, [`CHANCE_AT_FIRST`].
    pub image_share: f32,
    pub irradiance: [f32; 3],
    /// Of luminance.
    pub mean: f32,
    /// That of samples.
    pub variance: f32,
    /// Variance of the means of its taps, of one tap its square about the origin of the pixel.
    pub contrast: f32,
    /// Of the mean luminances of its taps.
    pub range: Range,
}

/// The past that a pixel is blended with.
#[derive(Clone, Copy)]
pub(super) struct BestPast {
    pub past: Past,
    /// How much of it comes from where the image was; how likely that is where nobody knows the distance.
    pub image_share: f32,
    /// How sure it is that it shows what is seen now.
    pub steadiness: f32,
}

/// What is seen in a surface.
#[derive(Clone, Copy)]
struct Thing {
    reach: f32,
    /// Per squared difference of reach, in powers of e; 0: all things are alike.
    sharpness: f32,
}

impl Thing {
    const ANY: Self = Self { reach: 0.0, sharpness: 0.0 };

    /// `roughness` of the surface, where the distance is known.
    fn new(reach: f32, roughness: Option<f32>) -> Self {
        let sharpness = |roughness| 2.0 * mirror_share(roughness) / (0.05 + lobe_width(roughness)).powi(2);
        Self { reach, sharpness: roughness.map_or(0.0, sharpness) }
    }

    /// Of what a tap shows, to this.
    fn likeness(self, reach: f32) -> f32 {
        let other = reach - self.reach;
        (-other * other * self.sharpness).exp().max(LEAST_LIKE)
    }
}

impl Past {
    fn add(&mut self, tap: &Self, weight: f32) {
        self.frames += weight * tap.frames;
        self.nearness += weight * tap.nearness;
        self.reach += weight * tap.reach;
        self.roughness += weight * tap.roughness;
        self.image_share += weight * tap.image_share;
        (0..3).for_each(|i| self.irradiance[i] += weight * tap.irradiance[i]);
        self.mean += weight * tap.mean;
        self.variance += weight * tap.variance;
        self.contrast += weight * tap.contrast;
        self.range = self.range.with(tap.range);
    }

    fn blend(&self, other: &Self, share: f32) -> Self {
        let mut sum = Self::default();
        sum.add(self, 1.0 - share);
        sum.add(other, share);
        sum
    }
}

/// Frames that a past is worth whose content is `error` pixels off in each of them.
fn worth(frames: f32, error: f32, tolerance: f32) -> f32 {
    frames.min(tolerance / error.max(1e-4))
}

/// How much of a blend comes from the image's past: by the squares of what both are worth.
fn image_share(surface: Option<Past>, image: Option<Past>) -> f32 {
    match (surface, image) {
        (Some(surface), Some(image)) => {
            let [a, b] = [surface, image].map(|past| past.frames * past.frames);
            b / (a + b).max(1e-20)
        }
        (Some(_), None) => 0.0,
        (None, _) => 1.0,
    }
}

pub(super) fn of_light([r, g, b]: [f32; 3]) -> f32 {
    texel_luminance([r, g, b, 0.0])
}

impl Scene<'_> {
    /// The better of two pasts, or a blend of both. `seen` is of this frame, then with its past. `unknown`: the roughness with which
    /// an unknown distance is tried. `explained`: share of the light that its lobe explains. `reaches`: the least and the greatest around.
    pub(super) fn best_past(
        &self,
        c: &Centre,
        seen: &mut SeenReflection,
        unknown: f32,
        reaches: [f32; 2],
        explained: f32,
    ) -> Option<BestPast> {
        let depth = c.mirror.surface.linear_depth;
        let here = reach(depth, seen.hit_distance);
        let roughness = seen.roughness;
        let is_known = seen.hit_distance > 0.0;
        let thing = Thing::new(here, (is_known && !self.inputs.is_mixed).then_some(roughness));
        let mut surface = self.past_at(c, c.mirror.surface_position, thing);
        let radius = lobe_radius(self.frame, depth, *seen);
        if let Some(past) = surface.filter(|past| past.nearness > 0.0 && is_known) {
            let share = radius * radius / (1.0 + radius * radius) * past.frames / (1.0 + past.frames);
            let now = nearness(depth, seen.hit_distance);
            seen.hit_distance = hit_distance_of(depth, now + share * (past.nearness - now));
        }
        // What nobody knows is tried as a mirror, and the light of now tells.
        let is_mixed = self.inputs.is_mixed;
        let tried = match is_known {
            true => *seen,
            false => SeenReflection { hit_distance: UNKNOWN_REACH * depth, roughness: unknown },
        };
        let (curvature, share) = (self.motion.curvature(&c.mirror), mirror_share(tried.roughness));
        let curved = SeenReflection { hit_distance: mirror_image_distance(tried.hit_distance, curvature.mean), ..tried };
        let tolerance = SHARPEST + 0.5 * lobe_radius(self.frame, depth, curved);
        let mut before = self.inputs.instances.scenery_before(self.frame, &c.mirror, &curvature, *seen);
        if !is_known {
            before.image = image_at_rest(tried.hit_distance);
            before.mirror.position = previous_surface(self.frame, c.mirror.surface_position, c.reprojected.linear_depth());
        }
        let position_of = |image| self.motion.image_position(&c.mirror, &curvature, &before.mirror, image, tried.roughness);
        let position = position_of(before.image);
        let moved = position.map_or(0.0, |position| position.distance(c.mirror.surface_position));
        let by_light = !is_mixed && !is_known;
        // The part of the light that moves as an image does.
        let mirrored = if is_mixed { explained * share } else { 1.0 };
        let steadiness =
            position.filter(|_| !is_mixed && !by_light).map_or(0.0, |position| share * self.steadiness(c, radius, position));
        let chance = match surface.filter(|_| by_light) {
            Some(past) => self.image_chance(c, position.filter(|_| moved > STILL), &past),
            None => CHANCE_AT_FIRST,
        };
        let image = position
            .filter(|position| !is_known || self.is_in_lobe(*position, before.thing, tried.roughness))
            // Of mixed light a lookup at the same place would blur the sharp one beside it.
            .filter(|_| (!is_mixed && is_known) || moved > STILL)
            .filter(|_| !by_light || surface.is_none() || chance > UNLIKELY);
        let mut image = image.and_then(|position| self.past_at(c, position, if before.followed { Thing::ANY } else { thing }));
        if by_light {
            let shares = if surface.is_some() && image.is_some() { [1.0 - chance, chance] } else { [1.0; 2] };
            let places = [Some(c.mirror.surface_position), position];
            for ((past, place), share) in [&mut surface, &mut image].into_iter().zip(places).zip(shares) {
                if let (Some(past), Some(place)) = (past, place) {
                    self.count_by_light(c, place, share, past);
                }
            }
        } else {
            // The thing may be anywhere from there on.
            let near = position.filter(|_| !is_known).and_then(|_| position_of(image_at_rest(NEAREST_REACH * depth))).or(position);
            let from_near = |to: Vec2| near.map_or(0.0, |near| near.distance(to));
            // Of mixed light, each past is off for the part of the other, and no lobe blurs what is diffuse.
            if let Some(past) = &mut surface {
                past.frames = worth(past.frames, mirrored * moved.min(from_near(c.mirror.surface_position)), tolerance);
            }
            if let (Some(past), Some(position), true) = (&mut image, position, is_mixed) {
                let off = (1.0 - mirrored) * moved / SHARPEST + mirrored * from_near(position) / tolerance;
                past.frames = worth(past.frames, off, 1.0);
            }
        }
        for past in surface.iter_mut().filter(|_| !is_mixed).chain(image.iter_mut().filter(|_| by_light)) {
            past.frames = worth(past.frames, self.other_thing(c, past, here, reaches, roughness), 2.0);
        }
        if is_known {
            if let (Some(past), Some(position)) = (&mut image, position) {
                let remembered = position_of(before.image.with_z(hit_distance_of(depth, past.nearness))).unwrap_or(position);
                past.frames = worth(past.frames, position.distance(remembered), tolerance);
                // Of light that is mixed the roughness goes with the hit distance.
                let mut change = if is_mixed { 0.0 } else { (tried.roughness - past.roughness).abs() * 8.0 };
                // Of a thing that was followed, lobes and outlines change the distance.
                if !before.followed {
                    let distance = (nearness(depth, before.image.z) - past.nearness).abs();
                    change += distance * share / (0.05 + lobe_width(tried.roughness));
                }
                past.frames = worth(past.frames, change, 2.0);
            }
        }
        let image_share = image_share(surface, image);
        if self.inputs.is_sharp && (is_mixed || tolerance < BLURRED_ANYWAY) {
            // The image where both count the same.
            let counts_more = match image_share > 0.49 {
                true => (&mut image, position),
                false => (&mut surface, Some(c.mirror.surface_position)),
            };
            if let (Some(past), Some(position)) = counts_more {
                self.sharpen(c, past, position);
            }
        }
        let mut past = match (surface, image) {
            (Some(surface), Some(image)) => surface.blend(&image, image_share),
            (surface, image) => surface.or(image)?,
        };
        if !by_light && (!is_mixed || share > 0.0) {
            let chosen = if image_share > 0.49 { position } else { None };
            let agrees = if share > 0.0 { AGREES } else { AGREES_WIDEST };
            let agreeing = self.by_light(c, chosen.unwrap_or(c.mirror.surface_position), &past, agrees, false).frames;
            past.frames += mirrored * (agreeing - past.frames);
        }
        if by_light {
            return Some(BestPast { past, image_share: chance, steadiness });
        }
        past.variance += past.contrast * (1.0 - share * explained);
        Some(BestPast { past, image_share, steadiness })
    }

    /// A past that counts by the light of now, as `chance` tells how likely it is.
    fn count_by_light(&self, c: &Centre, position: Vec2, chance: f32, past: &mut Past) {
        let told = self.by_light(c, position, past, AGREES_WIDEST, true);
        past.frames = chance * told.frames;
        let noise = told.noise.map_or(f32::INFINITY, |noise| NOISE_OF_MEANS * noise * past.mean.powi(2));
        past.variance += past.contrast.min(noise);
    }

    /// How sure it is that a past shows what is seen now, at most 1: of a mirror, whose image was followed, and of a picture that stands
    /// still before an eye that does. Where the eye moves around what stands still, light may change that a wide lobe gathers: half as
    /// much, as where history is filtered: what is kept longer there is blurred more often.
    fn steadiness(&self, c: &Centre, radius: f32, image_position: Vec2) -> f32 {
        let still = (c.mirror.p.as_vec2() + 0.5) * extent_ratio(self.frame) - 0.5;
        let moved = image_position.distance(still).max(c.mirror.surface_position.distance(still));
        let sight = -self.motion.previous_eye_from(c.mirror.position).0.normalize();
        let turned = (sight.distance(c.mirror.sight) / TURNED).min(1.0);
        let turned = if self.inputs.is_filtered { 1.0 } else { turned };
        (1.0 - radius).max((1.0 - moved / STILL) * (1.0 - 0.5 * turned)).max(0.0)
    }

    /// Standard deviation of a sample of the past, in the light of this frame.
    pub(super) fn deviation_of(&self, c: &Centre, past: &Past) -> f32 {
        (past.variance.sqrt() * self.light_scale(c)).min(LARGEST_HALF)
    }

    /// The factor of luminance by which light changed.
    pub(super) fn light_scale(&self, c: &Centre) -> f32 {
        (self.frame.exposure_ratio * luminance(c.ratio)).min(1e38)
    }

    /// How sure it is by the light of a pixel that it shows another thing than its past: what differs by little does no harm, and what differs
    /// by more than the noise of the past is no chance. Between the two a sample may have met the other side of an outline.
    fn sureness_of_own(&self, c: &Centre, past: &Past) -> f32 {
        let value = self.inputs.noisy.at(c.mirror.p);
        if value[3] < 0.0 {
            return 1.0;
        }
        let ratio = self.frame.exposure_ratio;
        let then = of_light(past.irradiance.map(|value| signed_half_range(value * ratio))).max(0.0);
        let now = of_light([value[0], value[1], value[2]]);
        let difference = (now - then).abs();
        let beyond = difference / self.deviation_of(c, past).max(1e-6) / NOISE_OF_PAST - 1.0;
        (1.0 - difference / (now + then).max(1e-6)).max(beyond.clamp(0.0, 1.0))
    }

    /// By how much the reach of a past lies outside of what is seen now, or a part of how much it differs from that of the pixel alone, beside
    /// what is small for the lobe: another thing is seen there.
    fn other_thing(&self, c: &Centre, past: &Past, here: f32, reaches: [f32; 2], roughness: f32) -> f32 {
        let own = OWN_DIFFERENCE * self.sureness_of_own(c, past) * (here - past.reach).abs();
        let outside = (reaches[0] - past.reach).max(past.reach - reaches[1]).max(own);
        outside * mirror_share(roughness) / (0.05 + lobe_width(roughness))
    }

    /// The mean of the tested 2×2 taps around a position.
    fn past_at(&self, c: &Centre, position: Vec2, thing: Thing) -> Option<Past> {
        let corner = position.floor();
        let f = position - corner;
        // Of taps; as far as they show the same thing; and the same surface.
        let (mut sum, mut whole, mut alike, mut weights) = (Past::default(), 0.0, 0.0, 0.0);
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let q = corner.as_ivec2() + IVec2::new(x, y);
            let weight = (if x == 0 { 1.0 - f.x } else { f.x }) * (if y == 0 { 1.0 - f.y } else { f.y });
            if weight > 0.0 && c.reprojected.is_on_plane(&self.previous_surfaces, q) {
                let likeness = if self.inputs.is_sharp { c.reprojected.likeness(&self.previous_surfaces.at(q)) } else { 1.0 };
                let tap = self.tap(c, q);
                let of_thing = weight * thing.likeness(tap.reach);
                let range = if weight >= LEAST_IN_RANGE { tap.range } else { Range::default() };
                sum.add(&Past { range, ..tap }, of_thing * likeness);
                whole += weight;
                alike += of_thing;
                weights += of_thing * likeness;
            }
        }
        (whole >= SMALLEST_WEIGHT_SUM).then(|| {
            let mut mean = Past::default();
            mean.add(&sum, 1.0 / weights);
            let contrast = (mean.contrast - (mean.mean - c.origin).powi(2)).max(0.0);
            Past { frames: sum.frames / alike, contrast, ..mean }
        })
    }

    fn tap(&self, c: &Centre, q: IVec2) -> Past {
        let previous = &self.inputs.previous;
        let (luminance_history, reflection) = (previous.luminance_history.at(q), previous.reflection.at(q));
        let seen = unpack_reflection(reflection);
        let [r, g, b, _] = previous.history.at(q);
        Past {
            frames: luminance_history.history_length,
            nearness: nearness(c.mirror.surface.linear_depth, seen.hit_distance),
            reach: reach(c.mirror.surface.linear_depth, seen.hit_distance),
            roughness: seen.roughness,
            image_share: unpack_image_share(reflection).unwrap_or(CHANCE_AT_FIRST),
            irradiance: [r, g, b],
            mean: luminance_history.mean,
            variance: luminance_history.deviation.powi(2),
            contrast: (luminance_history.mean - c.origin).powi(2),
            range: [luminance_history.mean].into_iter().collect(),
        }
    }

    /// Replaces the irradiance of a past by that of 4×4 taps, unless one of them that counts is refused or the position lies on a pixel.
    fn sharpen(&self, c: &Centre, past: &mut Past, position: Vec2) {
        let is_same = |q: IVec2| c.reprojected.is_on_plane(&self.previous_surfaces, q);
        let cubic = cubic_taps((position * LOOKUP_STEPS + 0.5).floor() / LOOKUP_STEPS);
        if let Some(taps) = cubic.filter(|taps| taps.iter().all(|(q, weight)| *weight == 0.0 || is_same(*q))) {
            let history = |q: IVec2| self.inputs.previous.history.at(RenderRect::new(self.frame.previous_render_extent).clamp(q));
            let sum = |i: usize| taps.iter().map(|(q, weight)| weight * history(*q)[i]).sum::<f32>();
            past.irradiance = [0, 1, 2].map(sum);
        }
    }

    /// Whether the surface at a pixel of the previous frame mirrored the same thing: its lobe holds the direction to it.
    fn is_in_lobe(&self, position: Vec2, thing: Vec3, roughness: f32) -> bool {
        let q = (position + 0.5).floor().as_ivec2();
        if !RenderRect::new(self.frame.previous_render_extent).contains(q) {
            return false;
        }
        let tap = self.previous_surfaces.at(q);
        if tap.is_background() {
            return false;
        }
        let at = |depth| previous_world_position(self.frame, q, depth).xyz();
        let position = at(tap.linear_depth);
        let sight = (at(2.0 * tap.linear_depth) - position).normalize();
        let difference = sight.reflect(tap.unit_normal()) - (thing - position).normalize();
        // Normals of the guide are rounded to half a degree, and a mirror doubles that.
        let tolerance = 0.06 + 2.0 * lobe_width(roughness);
        difference.length_squared() <= tolerance * tolerance
    }
}

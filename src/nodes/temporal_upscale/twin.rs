//! The stage `temporal_upscale`: jittered frames of the past and this one, gathered at the size of the output.

use crate::nodes::demodulate::twin::divisor;
use crate::nodes::import::twin::rendered_guide;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::conventions::is_reset;
use crate::reference::guide::{unpack_guide, Surface};
use crate::reference::luminance::luminance;
use crate::reference::outgoing::Outgoing;
use crate::reference::projection::{extent, sample_offset, Projections};
use crate::reference::reprojection::{reproject, transform_of, HostMotion, InstanceTransform, Reprojection};
use crate::reference::rules::{pixels, rule, STATISTICS};
use crate::reference::statistics::count;
use crate::reference::surface_motion::unpack_surface_motion;
use crate::reference::upscale_history::{pack_upscale_history, ratio_of, unpack_upscale_history, Kept};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Error, FrameConstants, Statistics, ToneCurve, Tuning};
use glam::{IVec2, Vec2, Vec3, Vec4};

#[cfg(test)]
mod tests;

/// Sharpness of the Gaussian of samples of a first picture, by squared rendered pixels.
const SHARPNESS: f32 = 2.29;
/// That of one with a past, by the product of distances in rendered pixels and in those of the output.
const LATER_SHARPNESS: f32 = 4.58;
/// Sharpness of that of the light around and of the box which clips the past, by squared rendered pixels.
const BOX_SHARPNESS: f32 = 0.5;
/// Share of the first picture in every later one.
const LEAST_SHARE: f32 = 1e-3;
/// Weight of a frame without any sample close by.
const LEAST_WEIGHT: f32 = 0.02;
/// Light that is as good as none, in the filter's exposure.
const DARKNESS: f32 = 0.01;
/// The longest past of what stands still, over that of what moves.
const STILL_PAST: f32 = 4.0;
/// Sharpness of the fall to what moves, by squared pixels of the output.
const STILL_SHARPNESS: f32 = 200.0;
/// Largest difference of depth to a past of the same surface, as a share.
const DEPTH_TOLERANCE: f32 = 0.05;
/// Beyond any light, so that sums and quotients are finite.
const BRIGHTEST_SAMPLE: f32 = 1e30;
/// The curve of ACES is so much steeper in the dark than x/(1 + x).
const ACES_STEEPNESS: f32 = 4.0;
/// The box where the history was divided by light, over that where it was not.
const SHOWN_BOX: f32 = 3.0;
/// The widest box, in deviations, where the past lies beside another surface: what was just uncovered would keep that one's colour.
const WIDEST_BESIDE: f32 = 1.5;
/// The smallest half side of the box that history is clipped to, over the mean luma: half a step of an 8-bit display in the middle.
const SMALLEST_BOX: f32 = 1.0 / 512.0;

/// What follows, and so the means that are taken.
#[derive(Clone, Copy, Debug)]
struct Shown {
    /// The luminance that counts half is 1 over it, in the filter's exposure.
    steepness: f32,
    /// The brightest component that counts.
    brightest: f32,
    /// Whether the history is divided by the light around.
    divides: bool,
}

impl Shown {
    fn new(frame: &FrameConstants, tuning: &Tuning, tone_mapped: bool) -> Self {
        let exposure = tuning.exposure * frame.inverse_filter_exposure;
        match (tone_mapped, tuning.tone_curve) {
            (false, _) => Self { steepness: 1.0, brightest: BRIGHTEST_SAMPLE, divides: true },
            (true, ToneCurve::Aces) => Self { steepness: ACES_STEEPNESS * exposure, brightest: BRIGHTEST_SAMPLE, divides: false },
            (true, ToneCurve::Reinhard) => Self { steepness: exposure, brightest: BRIGHTEST_SAMPLE, divides: false },
            (true, ToneCurve::Linear) => Self { steepness: 0.0, brightest: (1.0 / exposure).min(BRIGHTEST_SAMPLE), divides: false },
        }
    }

    /// A bright sample counts less \[Karis 2014\]: means are taken of `c·evenness(c)`, which is below 1.
    fn evenness(self, c: Vec3) -> f32 {
        1.0 / (1.0 + self.steepness * luminance(c.to_array()))
    }

    /// What a colour counts in means: of radiance they are those of the pixel, or edges of lamps would lose their light.
    fn share(self, c: Vec3) -> f32 {
        if self.divides {
            1.0
        } else {
            self.evenness(c)
        }
    }
}

/// Motion of every rendered pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Motion<'a> {
    /// The image `surface_motion`, from the stage `import`.
    Stored(&'a Image<[u16; 4]>),
    /// That of the host, where `import` has the pixels with light alone.
    Host {
        /// The host's image.
        motion: Option<&'a Image<[f32; 4]>>,
        /// The host's ids.
        surface_id: Option<&'a Image<u32>>,
        /// The transforms of its instances.
        transforms: Option<&'a [InstanceTransform]>,
    },
}

impl Motion<'_> {
    /// Of a surface, or of the background at depth 0.
    fn at(&self, frame: &FrameConstants, p: IVec2, depth: f32) -> Reprojection {
        match *self {
            Self::Stored(motion) => {
                let moved = unpack_surface_motion(motion.at(p));
                Reprojection { motion: moved.motion.into(), depth_ratio: moved.depth_ratio, is_bad: false }
            }
            Self::Host { motion, surface_id, transforms } => {
                let transform = surface_id.and_then(|ids| transform_of(transforms?, ids.at(p)));
                let host = HostMotion { texel: motion.map(|m| m.at(p)), transform: transform.filter(|_| depth > 0.0) };
                reproject(frame, &Projections::new(frame), p, depth, host)
            }
        }
    }
}

/// Inputs of [`temporal_upscale`]; images have the allocated extent, but for the history, which has that of the output.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UpscaleInputs<'a> {
    /// Radiance of surfaces, of a volume, or of both.
    pub radiance: &'a [&'a Image<[f32; 4]>],
    /// The host's albedo.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// Guides of every rendered pixel.
    pub guide: &'a Image<[u16; 4]>,
    /// Motion of every rendered pixel.
    pub motion: Motion<'a>,
    /// Whether a tone map follows.
    pub tone_mapped: bool,
    /// The history of the previous frame. Not read in a reset frame; `None` is treated as one.
    pub previous: Option<&'a Image<Kept>>,
}

/// Outputs of [`temporal_upscale`], with the extent of the output.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Upscaled {
    /// For the next frame, as its image holds it.
    pub history: Image<Kept>,
    /// Radiance.
    pub picture: Image<[f32; 4]>,
    /// Motion of the host that was not finite.
    pub statistics: Statistics,
}

/// A rendered pixel, in the filter's exposure.
#[derive(Clone, Copy, Debug)]
struct Sample {
    radiance: Vec3,
    irradiance: Vec3,
    surface: Surface,
}

/// Sums over the samples around a pixel of the output.
#[derive(Clone, Copy, Debug)]
struct Neighbourhood {
    /// Colour of a first picture times its share, with the share.
    first: Vec4,
    /// That of one with a past.
    later: Vec4,
    /// Of the samples of the later picture.
    weight: f32,
    light: Vec3,
    mean: Vec3,
    deviation: Vec3,
    nearest: IVec2,
    depth: f32,
}

struct Scene<'a> {
    frame: &'a FrameConstants,
    tuning: &'a Tuning,
    shown: Shown,
    motion: Motion<'a>,
    samples: Image<Option<Sample>>,
    previous: Option<&'a Image<Kept>>,
}

/// Gathers the samples of this frame and of the past at the size of the output, whose allocated extent is `allocated`.
pub(crate) fn temporal_upscale(
    frame: &FrameConstants,
    tuning: &Tuning,
    allocated: [u32; 2],
    outgoing: Outgoing,
    inputs: &UpscaleInputs,
) -> Upscaled {
    let scene = Scene::new(frame, tuning, inputs);
    let gathered = Image::compute(allocated, frame.output_extent, |p| Some(scene.gathered(p)));
    let picture = |g: &Gathered| {
        let [r, g, b] = (g.colour * frame.inverse_filter_exposure).to_array().map(|c| outgoing.store(c));
        [r, g, b, 1.0]
    };
    let mut statistics = Statistics::default();
    statistics[Counter::Motion] = count(gathered.texels().iter().map(|g| g.as_ref().is_some_and(|g| g.is_motion_bad)));
    Upscaled {
        statistics,
        history: gathered.map(|g| g.as_ref().map_or(Kept::default(), Gathered::kept)),
        picture: gathered.map(|g| g.as_ref().map_or([0.0; 4], picture)),
    }
}

/// A pixel of the output, in the filter's exposure.
#[derive(Clone, Copy, Debug)]
struct Gathered {
    colour: Vec3,
    light: Vec3,
    weight: f32,
    depth: f32,
    is_motion_bad: bool,
}

impl Gathered {
    fn kept(&self) -> Kept {
        let exact = Kept::new(self.colour / self.light, self.weight, self.depth);
        unpack_upscale_history(pack_upscale_history(&exact))
    }
}

impl<'a> Scene<'a> {
    fn new(frame: &'a FrameConstants, tuning: &'a Tuning, inputs: &UpscaleInputs<'a>) -> Self {
        let shown = Shown::new(frame, tuning, inputs.tone_mapped);
        let samples = Image::compute(inputs.guide.extent(), frame.render_extent, |p| Some(sample(frame, shown, inputs, p)));
        let previous = inputs.previous.filter(|_| !is_reset(frame));
        Self { frame, tuning, shown, motion: inputs.motion, samples, previous }
    }

    fn gathered(&self, p: IVec2) -> Gathered {
        let around = self.neighbourhood(p);
        let is_motion_bad = self.previous.is_some() && self.motion.at(self.frame, around.nearest, around.depth).is_bad;
        let (past, weight) = match self.past(p, &around) {
            Some((history, past)) => (history.extend(1.0) * self.shown.share(history) * past, past),
            None => (Vec4::ZERO, 0.0),
        };
        // Only a picture with a past can be made of samples that are close by.
        let now = match weight > 0.0 {
            true => around.first.lerp(around.later, weight.min(1.0)) * (around.weight + LEAST_WEIGHT),
            false => around.first,
        };
        let sum = now + past;
        Gathered {
            colour: sum.truncate() / sum.w,
            light: around.light,
            weight: weight + around.weight,
            depth: around.depth,
            is_motion_bad,
        }
    }

    /// Sums over the samples of the 3×3 pixels around the nearest one.
    fn neighbourhood(&self, p: IVec2) -> Neighbourhood {
        let rect = RenderRect::new(self.frame.render_extent);
        let scale = quotient(self.frame.output_extent, self.frame.render_extent);
        let centre = (p.as_vec2() + 0.5) * quotient(self.frame.render_extent, self.frame.output_extent);
        let middle = (centre - sample_offset(self.frame)).floor().as_ivec2();
        let (mut first, mut later, mut weight, mut total) = (Vec4::ZERO, Vec4::ZERO, 0.0, 0.0);
        let (mut nearest, mut depth) = (rect.clamp(middle), f32::INFINITY);
        let taps = || {
            rect.window(middle, 1, 1).filter_map(|(_, q)| {
                let distance = q.as_vec2() + 0.5 + sample_offset(self.frame) - centre;
                Some((q, distance, self.samples.at(q)?))
            })
        };
        for (q, distance, s) in taps() {
            let shared = s.radiance.extend(1.0) * self.shown.share(s.radiance);
            let wide = (-SHARPNESS * distance.length_squared()).exp();
            first += wide * shared;
            total += wide;
            if q == middle || !self.shown.divides {
                let narrow = (-LATER_SHARPNESS * distance.dot(distance * scale)).exp();
                later += narrow * shared;
                weight += narrow;
            }
            if !s.surface.is_background() && s.surface.linear_depth < depth {
                (nearest, depth) = (q, s.surface.linear_depth);
            }
        }
        first /= total;
        let colours = || {
            taps().map(|(_, d, s)| {
                ((-BOX_SHARPNESS * d.length_squared()).exp(), to_ycocg(s.radiance * self.shown.evenness(s.radiance)))
            })
        };
        let light = taps().map(|(_, d, s)| {
            let even = 1.0 / (1.0 + luminance(s.irradiance.to_array()));
            (-BOX_SHARPNESS * d.length_squared()).exp() * even * s.irradiance.extend(1.0)
        });
        let light = light.sum::<Vec4>();
        let box_total = colours().map(|(w, _)| w).sum::<f32>();
        let mean = colours().map(|(w, c)| w * c).sum::<Vec3>() / box_total;
        let variance = colours().map(|(w, c)| w * (c - mean) * (c - mean)).sum::<Vec3>() / box_total;
        Neighbourhood {
            first,
            later: (later + LEAST_SHARE * first) / (weight + LEAST_SHARE),
            weight,
            light: if self.shown.divides { light.truncate() / light.w + DARKNESS } else { Vec3::ONE },
            mean,
            deviation: Vec3::new(variance.x.sqrt(), variance.y.sqrt(), variance.z.sqrt()),
            nearest,
            depth: if depth.is_finite() { depth } else { 0.0 },
        }
    }

    /// Colour of the past and its weight, where it is of this surface.
    fn past(&self, p: IVec2, around: &Neighbourhood) -> Option<(Vec3, f32)> {
        let history = self.previous?;
        let frame = self.frame;
        let moved = self.motion.at(frame, around.nearest, around.depth);
        let motion = moved.motion * quotient(frame.previous_output_extent, frame.previous_render_extent);
        let position = (p.as_vec2() + 0.5) * quotient(frame.previous_output_extent, frame.output_extent) + motion;
        let rect = RenderRect::new(frame.previous_output_extent);
        if !rect.contains_position(position) {
            return None;
        }
        let is_whole = was_whole(rect, history, position, around.depth * (1.0 + moved.depth_ratio))?;
        let gamma = self.tuning.taa_gamma / if self.shown.divides { 1.0 } else { SHOWN_BOX };
        let gamma = if is_whole { gamma } else { gamma.min(WIDEST_BESIDE) };
        let before = history_at(rect, history, position, around.light);
        let wider = quotient(frame.previous_output_extent, frame.output_extent);
        let moving = 1.0 / self.tuning.taa_alpha - 1.0;
        let still = (-STILL_SHARPNESS * motion.length_squared()).exp();
        let limit = moving * (1.0 + (STILL_PAST - 1.0) * still);
        Some((clipped(self.shown, gamma, around, &before), (before.weight * wider.x * wider.y).min(limit)))
    }
}

/// Whether all of the 2×2 texels around a position belong to something at this depth; none where none of 4×4 does.
fn was_whole(rect: RenderRect, history: &Image<Kept>, position: Vec2, expected: f32) -> Option<bool> {
    let corner = (position - 0.5).floor().as_ivec2();
    let belongs = |offset: IVec2| {
        let z = history.at(rect.clamp(corner + offset)).depth;
        match expected > 0.0 {
            true => (z - expected).abs() <= DEPTH_TOLERANCE * expected,
            false => z == 0.0,
        }
    };
    let some = (-1..3).any(|y| (-1..3).any(|x| belongs(IVec2::new(x, y))));
    some.then(|| (0..2).all(|y| (0..2).all(|x| belongs(IVec2::new(x, y)))))
}

/// Sides of one extent over those of another; 1 to the bit where they are equal.
fn quotient(of: [u32; 2], by: [u32; 2]) -> Vec2 {
    extent(of) / extent(by)
}

fn rgb(image: &Image<[f32; 4]>, p: IVec2) -> Vec3 {
    let [r, g, b, _] = image.at(p);
    Vec3::new(r, g, b)
}

fn sample(frame: &FrameConstants, shown: Shown, inputs: &UpscaleInputs, p: IVec2) -> Sample {
    let in_range = |c: Vec3, most: f32| (c * frame.filter_exposure).clamp(Vec3::ZERO, Vec3::splat(most));
    let radiance = inputs.radiance.iter().map(|image| rgb(image, p)).sum::<Vec3>();
    let surface = unpack_guide(inputs.guide.at(p));
    let (divisor, _) = divisor(inputs.albedo.filter(|_| !surface.is_background()).map(|albedo| albedo.at(p)));
    let irradiance = in_range(radiance, BRIGHTEST_SAMPLE) / Vec3::from(divisor);
    Sample { radiance: in_range(radiance, shown.brightest), irradiance, surface }
}

/// What the past had at a position.
#[derive(Clone, Copy, Debug)]
struct Before {
    colour: Vec3,
    /// Mean of the texels around.
    around: Vec3,
    weight: f32,
}

/// The history in this light at a position in pixels: colour by Catmull and Rom, sharper than bilinear; weight bilinear.
fn history_at(rect: RenderRect, history: &Image<Kept>, s: Vec2, light: Vec3) -> Before {
    let corner = (s - 0.5).floor();
    let f = s - 0.5 - corner;
    let (x, y) = (catmull_rom_weights(f.x), catmull_rom_weights(f.y));
    let linear = |t: f32| [0.0, 1.0 - t, t, 0.0];
    let (linear_x, linear_y) = (linear(f.x), linear(f.y));
    let (mut sum, mut least, mut most, mut weight) = (Vec3::ZERO, Vec3::MAX, Vec3::ZERO, 0.0);
    let (mut mean, mut total) = (Vec3::ZERO, 0.0);
    for j in 0..4 {
        for i in 0..4 {
            let q = rect.clamp(corner.as_ivec2() + IVec2::new(i as i32 - 1, j as i32 - 1));
            let kept = history.at(q);
            sum += x[i] * y[j] * kept.even;
            (least, most) = (least.min(kept.even), most.max(kept.even));
            let near = (-BOX_SHARPNESS * (Vec2::new(i as f32 - 1.0, j as f32 - 1.0) - f).length_squared()).exp();
            mean += near * kept.even;
            total += near;
            weight += linear_x[i] * linear_y[j] * kept.weight;
        }
    }
    Before { colour: ratio_of(sum.clamp(least, most)) * light, around: ratio_of(mean / total), weight }
}

fn catmull_rom_weights(t: f32) -> [f32; 4] {
    [t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)]
}

fn to_ycocg(c: Vec3) -> Vec3 {
    Vec3::new(c.x / 4.0 + c.y / 2.0 + c.z / 4.0, (c.x - c.z) / 2.0, -c.x / 4.0 + c.y / 2.0 - c.z / 4.0)
}

fn from_ycocg(c: Vec3) -> Vec3 {
    Vec3::new(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z)
}

/// Differences of means that are noise or edges: in deviations, and as a share of the mean.
const SAME_DEVIATION: f32 = 0.5;
const SAME_SHARE: f32 = 0.1;

/// What the light around changed by, where nothing was divided by it: from none of it to all, at twice the difference that is none.
fn change_of_light(shown: Shown, around: &Neighbourhood, before: Vec3) -> Vec3 {
    let offset = to_ycocg(before * shown.evenness(before)) - around.mean;
    let same = (SAME_DEVIATION * around.deviation).max(Vec3::splat((SAME_SHARE * around.mean.x).max(1e-6)));
    offset * ((offset.abs() / same).max_element() - 1.0).clamp(0.0, 1.0)
}

/// The history moved towards the mean of the neighbourhood until it is within `gamma` deviations, in YCoCg of compressed colours.
fn clipped(shown: Shown, gamma: f32, around: &Neighbourhood, before: &Before) -> Vec3 {
    let history = before.colour;
    let change = if shown.divides { Vec3::ZERO } else { change_of_light(shown, around, before.around) };
    let distance = to_ycocg(history * shown.evenness(history)) - around.mean - change;
    let smallest = (SMALLEST_BOX * around.mean.x).max(1e-6);
    let excess = (distance.abs() / (gamma * around.deviation).max(Vec3::splat(smallest))).max_element();
    if excess <= 1.0 && change == Vec3::ZERO {
        return history;
    }
    let compressed = from_ycocg(around.mean + distance / excess.max(1.0)).max(Vec3::ZERO);
    compressed / (1.0 - shown.steepness * luminance(compressed.to_array())).max(1e-4)
}

/// The clip divides by a deviation that is the root of a difference; a test of depth may fall the other way on its threshold.
const CLIPPED: Tolerance = Tolerance { relative: 4e-3, absolute: 1e-3, outliers: 2e-3 };

/// As above, with a step of the history's.
const KEPT: Tolerance = Tolerance { absolute: 2e-3, ..CLIPPED };

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] =
    &[STATISTICS, rule("upscale_history", Unit::Pixel, Reading::UpscaleHistory, KEPT), pixels("upscaled_radiance", CLIPPED)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let previous = b.packed("previous_upscale_history")?.map(|texel| unpack_upscale_history(*texel));
    let transforms = b.instance_transforms()?;
    let motion = match b.optional_packed("surface_motion")? {
        Some(motion) => Motion::Stored(motion),
        None => Motion::Host {
            motion: b.optional_colour("motion")?,
            surface_id: b.optional_uint("surface_id")?,
            transforms: transforms.as_deref(),
        },
    };
    let inputs = UpscaleInputs {
        radiance: &b.colours("radiance")?,
        albedo: b.optional_colour("albedo")?,
        guide: &*rendered_guide(b, false)?,
        motion,
        tone_mapped: b.is_on("SHOWN")?,
        previous: Some(&previous),
    };
    let upscaled = temporal_upscale(&b.frame.of_guides(), b.tuning, b.extent_of("upscaled_radiance")?, Outgoing::of(b)?, &inputs);
    if b.has("statistics") {
        b.count(&upscaled.statistics)?;
    }
    b.write("upscale_history", upscaled.history.map(pack_upscale_history))?;
    b.write("upscaled_radiance", upscaled.picture)
}

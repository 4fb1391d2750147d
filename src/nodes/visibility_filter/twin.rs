//! The stage `visibility_filter` \[Mehta et al. 2012\]: one level of the filter of visibility, no wider than its penumbra.

use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::geometry_weights::Geometry;
use crate::reference::rules::{pixels, rule, WEIGHTED};
use crate::reference::visibility::{
    each, halves_of, histories_of, largest, lights_of, of_light, pack_halves, write_words, Ruler, VisibilityHistory, Visible,
};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec2};

#[cfg(test)]
mod tests;

/// Tolerated difference of visibility where the deviation is 0.
const VISIBILITY_EPSILON: f32 = 0.01;
/// Variances of a kernel, in squared pixels, up to which a level changes nothing.
const NARROW: f32 = 0.02;
/// Variance of the kernel along an edge, squared steps of the level.
const ALONG: f32 = 1.0;
/// Variance of how far aside a tap along an edge may lie, squared pixels.
const ASIDE: f32 = 0.1;
/// Levels that filter along edges.
const ALONG_LEVELS: u32 = 2;

/// Inputs of [`visibility_filter`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VisibilityFilterInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// Angular radius of the light.
    pub light_radius: f32,
    /// The history of this frame, which the distance of the occluder is read from.
    pub visibility_history: &'a Image<VisibilityHistory>,
    /// Visibility and its standard deviation.
    pub estimate: &'a Image<(Visible, f32)>,
}

/// The estimates that the first level starts from: visibility, and the standard deviation of a mean with the smallest weight 1/N.
pub(crate) fn first_estimate(visibility_history: &Image<VisibilityHistory>) -> Image<(Visible, f32)> {
    visibility_history.map(|h| (h.mean, h.deviation / (2.0 * h.history_length - 1.0).max(f32::MIN_POSITIVE).sqrt()))
}

/// Filters estimates by a kernel whose variance is the level's share of what the penumbra allows.
pub(crate) fn visibility_filter(
    frame: &FrameConstants,
    tuning: &Tuning,
    level: u32,
    inputs: &VisibilityFilterInputs,
) -> Image<(Visible, f32)> {
    let geometry = Geometry::new(frame, tuning, inputs.guide);
    let rect = RenderRect::new(frame.render_extent);
    Image::compute(inputs.guide.extent(), frame.render_extent, |p| {
        let estimate = inputs.estimate.at(p);
        if geometry.is_background(p) {
            return estimate;
        }
        let ruler = Ruler::new(frame, &geometry.surface(p));
        let distance = inputs.visibility_history.at(p).occluder_distance;
        let deviation = tuning.penumbra_blur * inputs.light_radius * distance / ruler.longer();
        let variance = share_of_level((deviation * deviation).min(1e6), level);
        let is_edge = level < ALONG_LEVELS && distance > 0.0;
        if variance <= NARROW && !is_edge {
            return estimate;
        }
        let taps = || rect.window(p, 2, 1 << level).filter(|(_, q)| !geometry.is_background(*q));
        let (v, sigma) = estimate;
        let rise = |q: IVec2| (0..3).map(|c| inputs.estimate.at(q).0[c] - v[c]).sum::<f32>() / 3.0;
        let slope: Vec2 = taps().map(|(o, q)| o.as_vec2() * geometry.weight_of_shape(p, q) * rise(q)).sum();
        let light = if level < ALONG_LEVELS && slope.length_squared() > 1e-6 { slope.normalize() } else { Vec2::ZERO };
        let kernel = Kernel { ruler, light, variance: variance.max(1e-6), full: 4_f32.powi(level as i32) };
        let tolerance = tuning.visibility_sigma * sigma + VISIBILITY_EPSILON;
        let (mut sum, mut squares, mut weights) = ([0.0; 3], 0.0, 0.0);
        for (offset, q) in taps() {
            let (v_q, sigma_q) = inputs.estimate.at(q);
            let difference = largest(each(|c| (v_q[c] - v[c]).abs()));
            let near = match offset == IVec2::ZERO {
                true => 1.0,
                false => (-kernel.way(offset * (1 << level)) - difference / tolerance).exp(),
            };
            let weight = near * geometry.weight_of_shape(p, q);
            sum = each(|c| sum[c] + weight * v_q[c]);
            squares += weight * weight * sigma_q * sigma_q;
            weights += weight;
        }
        (sum.map(|sum| sum / weights), squares.sqrt() / weights)
    })
}

/// A Gaussian on the surface, which is longer along an edge of the shadow.
struct Kernel {
    ruler: Ruler,
    /// The way into the light, of unit length; 0 where there is none.
    light: Vec2,
    /// Squared pixels, where the surface faces the camera.
    variance: f32,
    /// Squared steps of the level.
    full: f32,
}

impl Kernel {
    /// The negative exponent of the weight.
    fn way(&self, offset: IVec2) -> f32 {
        let offset = offset.as_vec2();
        let scale = 2.0 * self.variance * self.ruler.longer() * self.ruler.longer();
        let round = self.ruler.squared(offset) / scale;
        if self.light == Vec2::ZERO {
            return round;
        }
        let (across, along) = (offset.dot(self.light), offset.dot(Vec2::new(-self.light.y, self.light.x)));
        let aside = (self.ruler.squared(across * self.light) / scale).min(across * across / (2.0 * ASIDE));
        round.min(aside + along * along / (2.0 * ALONG * self.full))
    }
}

/// A level is good for a variance of 4^level, and finer ones come first.
fn share_of_level(wanted: f32, level: u32) -> f32 {
    let full = 4_f32.powi(level as i32);
    let finer: f32 = (0..level).map(|finer| 4_f32.powi(finer as i32)).sum();
    (wanted - finer).clamp(0.0, full)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    rule("filter_out", Unit::Pixel, Reading::Halves, WEIGHTED),
    rule("filter_out_colours", Unit::Pixel, Reading::Halves, WEIGHTED),
    pixels("denoised_visibility", WEIGHTED),
    pixels("denoised_visibility_1", WEIGHTED),
    pixels("denoised_visibility_2", WEIGHTED),
    pixels("denoised_visibility_3", WEIGHTED),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (names, coloured) = (["filter_in", "filter_in_colours"], b.has("filter_in_colours"));
    let mut words = Vec::new();
    for light in 0..lights_of(b) {
        let estimate = match b.is_on("FIRST")? {
            true => first_estimate(&histories_of(b, names, light)?),
            false => halves_of(b, names, light)?,
        };
        let inputs = VisibilityFilterInputs {
            guide: b.packed("guide")?,
            light_radius: b.tuning.light_radii()[light],
            visibility_history: &histories_of(b, ["visibility_history", ""], light)?,
            estimate: &estimate,
        };
        let filtered = visibility_filter(b.frame, b.tuning, b.level, &inputs);
        let output = of_light("denoised_visibility", light);
        match (b.has(&output), coloured) {
            (true, true) => b.write(&output, filtered.map(|([red, green, blue], _)| [*red, *green, *blue, 1.0]))?,
            (true, false) => b.write(&output, filtered.map(|(v, _)| v[0]))?,
            (false, _) => words.push(filtered.map(|(v, sigma)| pack_halves(*v, *sigma))),
        }
    }
    write_words(b, ["filter_out", "filter_out_colours"], &words)
}

//! Pixels whose irradiance is not that of a sample of their own, and what fills them.

use super::binary16::store;
use super::geometry_weights::Geometry;
use super::{render_rect::RenderRect, Image};
use crate::{Counter, FrameConstants, Statistics, Tuning};
use glam::IVec2;

/// Alpha of irradiance that was filled in from neighbours, or that will be.
pub(crate) const HOLE: f32 = -1.0;

/// Alpha of irradiance in a hole without a sample around it.
pub(crate) const EMPTY_HOLE: f32 = -2.0;

/// Frames that a texel of irradiance is worth: what was filled in is the light of neighbours.
pub(crate) fn sample_worth([.., alpha]: [f32; 4]) -> f32 {
    match alpha {
        EMPTY_HOLE => 0.0,
        alpha if alpha < 0.0 => 0.5,
        _ => 1.0,
    }
}

/// Inputs of [`fill_holes`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FillHolesInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: irradiance of one signal; alpha: [`HOLE`] where there is none.
    pub holed: &'a Image<[f32; 4]>,
    /// Pixels to each side in which samples are looked for.
    pub radius: u32,
}

/// Irradiance without holes, half precision; alpha: [`HOLE`] where it was filled in, [`EMPTY_HOLE`] where there was no sample around,
/// which is counted as radiance that is not finite.
pub(crate) fn fill_holes(frame: &FrameConstants, tuning: &Tuning, inputs: &FillHolesInputs) -> (Image<[f32; 4]>, Statistics) {
    let geometry = Geometry::new(frame, tuning, inputs.guide);
    let texels = Image::compute(inputs.holed.extent(), frame.render_extent, |p| {
        if inputs.holed.at(p)[3] >= 0.0 {
            return (inputs.holed.at(p), false);
        }
        let taps = taps_around(frame, &geometry, inputs, p);
        // Where nothing around is the same surface, everything counts.
        let mean = weighted_mean(&taps, |tap| tap.by_distance * tap.by_edges, 1e-6)
            .or_else(|| weighted_mean(&taps, |tap| tap.by_distance, 0.0));
        let [r, g, b] = mean.unwrap_or_default().map(store);
        ([r, g, b, if mean.is_some() { HOLE } else { EMPTY_HOLE }], mean.is_none())
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Radiance] = texels.texels().iter().map(|texel| u32::from(texel.1)).sum();
    (texels.map(|texel| texel.0), statistics)
}

/// A sample near a hole.
struct Tap {
    irradiance: [f32; 3],
    by_distance: f32,
    by_edges: f32,
}

/// The samples around a hole: of surfaces for a surface, of the background for the background.
fn taps_around(frame: &FrameConstants, geometry: &Geometry, inputs: &FillHolesInputs, p: IVec2) -> Vec<Tap> {
    let is_background = geometry.is_background(p);
    let window = RenderRect::new(frame.render_extent).window(p, inputs.radius as i32, 1);
    let samples = window.filter(|(_, q)| inputs.holed.at(*q)[3] >= 0.0 && geometry.is_background(*q) == is_background);
    let tap = |(offset, q): (IVec2, IVec2)| {
        let [r, g, b, _] = inputs.holed.at(q);
        let by_edges = if is_background { 1.0 } else { geometry.weight(p, q) };
        Tap { irradiance: [r, g, b], by_distance: 1.0 / offset.as_vec2().length_squared(), by_edges }
    };
    samples.map(tap).collect()
}

/// None where the weights add up to no more than `least`.
fn weighted_mean(taps: &[Tap], weight: impl Fn(&Tap) -> f32, least: f32) -> Option<[f32; 3]> {
    let sum: f32 = taps.iter().map(&weight).sum();
    let component = |i: usize| taps.iter().map(|tap| weight(tap) * tap.irradiance[i]).sum::<f32>() / sum;
    (sum > least).then(|| [0, 1, 2].map(component))
}

//! The stage `variance` [SVGF 4.2]: the standard deviation of luminance, from the history where it is long enough, else from the neighbourhood.

use super::binary16::store;
use super::geometry_weights::Geometry;
use super::moments::{unpack_moments, Moments};
use super::{render_rect::RenderRect, Image};
use crate::FrameConstants;
use glam::IVec2;

#[cfg(test)]
mod tests;

/// Radius of the neighbourhood, pixels: 7×7.
const RADIUS: i32 = 3;

/// Inputs of [`variance`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub struct VarianceInputs<'a> {
    /// As written by `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// As written by `import`.
    pub depth_gradient: &'a Image<u32>,
    /// rgb: accumulated irradiance of every signal.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// Moments of this frame, of every signal.
    pub moments: &'a [&'a Image<[u16; 4]>],
}

/// For every signal rgb: irradiance as it came; alpha: standard deviation of its luminance, half precision.
pub fn variance(frame: &FrameConstants, inputs: &VarianceInputs) -> Vec<Image<[f32; 4]>> {
    let geometry = Geometry::new(frame, inputs.guide, inputs.depth_gradient);
    let signals = inputs.irradiance.iter().zip(inputs.moments);
    signals
        .map(|(irradiance, moments)| {
            let moments = Image::compute(geometry.extent(), frame.render_extent, |p| unpack_moments(moments.at(p)));
            Image::compute(geometry.extent(), frame.render_extent, |p| {
                let [r, g, b, _] = irradiance.at(p);
                [store(r), store(g), store(b), store(deviation(frame, &geometry, &moments, p))]
            })
        })
        .collect()
}

fn deviation(frame: &FrameConstants, geometry: &Geometry, moments: &Image<Moments>, p: IVec2) -> f32 {
    let centre = moments.at(p);
    if geometry.is_background(p) {
        return 0.0;
    }
    if centre.history_length >= frame.spatial_variance_frames {
        return centre.deviation;
    }
    let rect = RenderRect::new(frame.render_extent);
    let (mut sum, mut mean) = (0.0, 0.0);
    for (_, q) in rect.window(p, RADIUS, 1) {
        let weight = geometry.weight(p, q);
        sum += weight;
        mean += weight * moments.at(q).mean;
    }
    mean /= sum;
    // μ2 − μ1² of the window, taken about the mean, so that it does not cancel.
    let mut variance = 0.0;
    for (_, q) in rect.window(p, RADIUS, 1) {
        let Moments { mean: m, deviation, .. } = moments.at(q);
        variance += geometry.weight(p, q) * (deviation * deviation + (m - mean) * (m - mean));
    }
    // A short history was averaged over few frames: its mean is that much less certain [SVGF 4.2, as published implementations do].
    (variance / sum * frame.spatial_variance_frames / centre.history_length.max(1.0)).sqrt()
}

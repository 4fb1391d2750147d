//! The stage `volume_points` \[PSVGF\]: what a volume scatters towards the camera, and the points that the next frame carries
//! forward.

use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::holes::{EMPTY_HOLE, HOLE};
use crate::reference::kept_radiance::{exposed, is_finite, is_saturated, storable};
use crate::reference::rules::{pixels, EXACT, HALF, STATISTICS};
use crate::reference::statistics::count;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};
use glam::IVec2;

/// A pixel of `volume_points`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VolumePoint {
    /// Positive view-space depth along the view axis, scene units; 0: there is no point.
    pub linear_depth: f32,
    /// Rises with the luminance of the radiance: the upper half of its bits as a float.
    pub contribution: u16,
}

/// A texel of `volume_points`.
pub(crate) fn pack_volume_point(point: &VolumePoint) -> [u16; 4] {
    let depth = point.linear_depth.to_bits();
    [depth as u16, (depth >> 16) as u16, point.contribution, 0]
}

/// The content of a texel of `volume_points`.
pub(crate) fn unpack_volume_point([low, high, contribution, _]: [u16; 4]) -> VolumePoint {
    VolumePoint { linear_depth: f32::from_bits(u32::from(low) | u32::from(high) << 16), contribution }
}

/// Inputs of [`volume_points`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VolumePointsInputs<'a> {
    /// rgb: noisy radiance of the volume, linear, scene units.
    pub noisy_volume: &'a Image<[f32; 4]>,
    /// x: linear depth of a point that contributes much; 0, infinite or NaN for none. `None`: no pixel has one.
    pub scattering_depth: Option<&'a Image<[f32; 4]>>,
}

/// Outputs of [`volume_points`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VolumePointsOutputs {
    /// rgb: radiance, half precision; alpha 0, [`HOLE`] where the mean of the samples around stands in for it, [`EMPTY_HOLE`] where
    /// there are none.
    pub radiance: Image<[f32; 4]>,
    /// See [`unpack_volume_point`].
    pub volume_points: Image<[u16; 4]>,
    /// Bad radiances, and depths that are NaN.
    pub statistics: Statistics,
}

/// Stops what is not finite, and keeps the points for the next frame.
pub(crate) fn volume_points(frame: &FrameConstants, inputs: &VolumePointsInputs) -> VolumePointsOutputs {
    let texels = Image::compute(inputs.noisy_volume.extent(), frame.render_extent, |p| {
        let [r, g, b, _] = exposed(frame, inputs.noisy_volume.at(p));
        let light = [r, g, b].map(|c| if c.is_finite() { c } else { 0.0 });
        let sample = sample_at(frame, inputs.noisy_volume, p);
        let [r, g, b, alpha] = sample.map_or_else(|| filled(frame, inputs.noisy_volume, p), |[r, g, b]| [r, g, b, 0.0]);
        let rgb = [r, g, b];
        let depth = inputs.scattering_depth.map_or(0.0, |image| image.at(p)[0]);
        let linear_depth = if depth.is_finite() && depth > 0.0 { depth } else { 0.0 };
        let luminance = sample.map_or(0.0, |_| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
        let point = VolumePoint { linear_depth, contribution: (luminance.to_bits() >> 16) as u16 };
        let [r, g, b] = rgb.map(store);
        (([r, g, b, alpha], pack_volume_point(&point)), (sample.is_none(), depth.is_nan(), is_saturated(light)))
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Radiance] = count(texels.texels().iter().map(|t| t.1 .0));
    statistics[Counter::ScatteringDepth] = count(texels.texels().iter().map(|t| t.1 .1));
    statistics[Counter::Saturated] = count(texels.texels().iter().map(|t| t.1 .2 && !t.1 .0));
    VolumePointsOutputs { radiance: texels.map(|t| t.0 .0), volume_points: texels.map(|t| t.0 .1), statistics }
}

/// Radiance of a pixel as the filter counts it, within what a half float holds; `None` where it is not finite.
fn sample_at(frame: &FrameConstants, noisy: &Image<[f32; 4]>, p: IVec2) -> Option<[f32; 3]> {
    is_finite(noisy.at(p)).then(|| storable(frame, noisy.at(p)))
}

/// The mean of the samples around a pixel that has none, weighed by their distance.
fn filled(frame: &FrameConstants, noisy: &Image<[f32; 4]>, p: IVec2) -> [f32; 4] {
    let window = RenderRect::new(frame.render_extent).window(p, 1, 1).filter(|(offset, _)| *offset != IVec2::ZERO);
    let samples = window.filter_map(|(offset, q)| Some((1.0 / offset.as_vec2().length_squared(), sample_at(frame, noisy, q)?)));
    let samples: Vec<_> = samples.map(|(weight, sample)| (weight, sample.map(store))).collect();
    let weights: f32 = samples.iter().map(|sample| sample.0).sum();
    if weights == 0.0 {
        return [0.0, 0.0, 0.0, EMPTY_HOLE];
    }
    let [r, g, b] = [0, 1, 2].map(|i| samples.iter().map(|(weight, sample)| weight * sample[i]).sum::<f32>() / weights);
    [r, g, b, HOLE]
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, pixels("radiance", HALF), pixels("volume_points", EXACT)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs =
        VolumePointsInputs { noisy_volume: b.colour("noisy_volume")?, scattering_depth: b.optional_colour("scattering_depth")? };
    let outputs = volume_points(b.frame, &inputs);
    b.count(&outputs.statistics)?;
    b.write("radiance", outputs.radiance)?;
    b.write("volume_points", outputs.volume_points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;

    fn taken_in(noisy: &Image<[f32; 4]>, depth: Option<&Image<[f32; 4]>>) -> VolumePointsOutputs {
        volume_points(&frame(noisy.extent()), &VolumePointsInputs { noisy_volume: noisy, scattering_depth: depth })
    }

    #[test]
    fn a_point_survives_packing() {
        let point = VolumePoint { linear_depth: 12.345, contribution: 0x3f80 };
        assert_eq!(unpack_volume_point(pack_volume_point(&point)), point);
    }

    #[test]
    fn what_is_no_depth_is_no_point() {
        let values = [0.0, -1.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 2.5];
        let depth = paint([6, 1], |x, _| [values[x as usize]; 4]);
        let outputs = taken_in(&Image::new([6, 1], [1.0; 4]), Some(&depth));
        let depths: Vec<f32> = outputs.volume_points.texels().iter().map(|t| unpack_volume_point(*t).linear_depth).collect();
        assert_eq!(depths, [0.0, 0.0, 0.0, 0.0, 0.0, 2.5]);
        assert_eq!(outputs.statistics[Counter::ScatteringDepth], 1);
        let without = taken_in(&Image::new([6, 1], [1.0; 4]), None);
        assert!(without.volume_points.texels().iter().all(|t| unpack_volume_point(*t).linear_depth == 0.0));
    }

    #[test]
    fn bad_radiance_is_no_sample_and_counted() {
        let noisy =
            paint([3, 1], |x, _| [[f32::NAN, 1.0, 1.0, 0.0], [1.0, f32::INFINITY, 0.0, 0.0], [1e9, -1.0, 0.25, 0.0]][x as usize]);
        let outputs = taken_in(&noisy, None);
        assert_eq!(outputs.radiance.texels(), [[0.0, 0.0, 0.0, EMPTY_HOLE], [65504.0, 0.0, 0.25, HOLE], [65504.0, 0.0, 0.25, 0.0]]);
        assert_eq!(unpack_volume_point(outputs.volume_points.texels()[1]).contribution, 0);
        assert_eq!(outputs.statistics[Counter::Radiance], 2);
    }

    #[test]
    fn the_contribution_rises_with_the_luminance() {
        let noisy = paint([64, 1], |x, _| [1.2_f32.powi(x - 32); 4]);
        let outputs = taken_in(&noisy, None);
        let contributions: Vec<u16> = outputs.volume_points.texels().iter().map(|t| unpack_volume_point(*t).contribution).collect();
        assert!(contributions.is_sorted() && contributions[0] < contributions[63]);
    }
}

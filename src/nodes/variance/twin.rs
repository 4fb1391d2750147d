//! The stage `variance` \[SVGF 4.2\]: the standard deviation of luminance, from the history where it is long enough, else from the
//! neighbourhood.

use crate::reference::binary16::{store, store_signed};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::geometry_weights::Geometry;
use crate::reference::luminance_history::{join_luminance_history, pack_luminance_history, with_detail, LuminanceHistory};
use crate::reference::rare_light::marked;
use crate::reference::rules::{pixels, rare_light, rule, EXACT, HALF, TESTED_COUNTS};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Error, FrameConstants, Statistics, Tuning};
use glam::IVec2;
use std::sync::atomic::{AtomicU32, Ordering};

mod of_mean;
#[cfg(test)]
mod tests;

use of_mean::{deviation_of_filled_mean, deviation_of_mean};

/// Radius of the neighbourhood of \[SVGF\], pixels: 7×7.
const RADIUS: i32 = 3;

/// Radius of the neighbourhood of \[PSVGF\], pixels: 5×5.
const FADING_RADIUS: i32 = 2;
const SIDE: usize = 7;

/// Deviation of the background: negative, so that a filter sees the background without the guide, and next to 0, so that it is no
/// deviation to anyone else.
const BACKGROUND_DEVIATION: f32 = -1.0 / 16384.0;

/// Inputs of [`variance`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
#[cfg(test)]
pub(crate) struct VarianceInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// rgb: accumulated irradiance of every signal.
    pub irradiance: &'a [&'a Image<[f32; 4]>],
    /// Luminance of this frame, of every signal.
    pub luminance_history: &'a [&'a Image<LuminanceHistory>],
}

/// Estimates for every signal. rgb: irradiance as it came; alpha: standard deviation of its luminance, half precision.
#[cfg(test)]
pub(crate) fn variance(frame: &FrameConstants, tuning: &Tuning, inputs: &VarianceInputs) -> Vec<Image<[f32; 4]>> {
    let geometry = Geometry::new(frame, tuning, inputs.guide);
    estimate(frame, tuning, &geometry, inputs.irradiance, inputs.luminance_history, deviation, false).images
}

fn deviation(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
) -> Estimated {
    let centre = luminance_history.at(p);
    if centre.history_length >= tuning.spatial_variance_frames {
        return centre.deviation.into();
    }
    spatial_variance(frame, tuning, geometry, luminance_history, p, RADIUS).sqrt().into()
}

/// The estimate over 5×5 pixels in every pixel, whose share fades as the history grows \[PSVGF\].
fn faded_deviation(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
) -> Estimated {
    let centre = luminance_history.at(p);
    let share = (tuning.spatial_variance_frames / centre.history_length.max(1.0)).min(1.0);
    let spatial = spatial_variance(frame, tuning, geometry, luminance_history, p, FADING_RADIUS);
    (share * spatial + (1.0 - share) * centre.deviation * centre.deviation).sqrt().into()
}

/// The estimate of a surface pixel.
struct Estimated {
    deviation: f32,
    /// Its noise comes again from frame to frame.
    is_repeated: bool,
    /// Few pixels of its window have its light; of the mean alone.
    rare: bool,
    /// The share of what bends that the past does not explain as noise, where that is told; of the mean alone.
    detail: Option<f32>,
}

impl From<f32> for Estimated {
    fn from(deviation: f32) -> Self {
        Self { deviation, is_repeated: false, rare: false, detail: None }
    }
}

/// Of every signal.
struct Estimates {
    images: Vec<Image<[f32; 4]>>,
    luminance_history: Vec<Image<u32>>,
    statistics: Statistics,
}

type Estimate = fn(&FrameConstants, &Tuning, &Geometry, &Image<LuminanceHistory>, IVec2) -> Estimated;

fn estimate(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    irradiance: &[&Image<[f32; 4]>],
    luminance_history: &[&Image<LuminanceHistory>],
    estimated: Estimate,
    is_marked: bool,
) -> Estimates {
    let repeated = AtomicU32::new(0);
    let signal = |(irradiance, luminance_history): (&&Image<[f32; 4]>, &&Image<LuminanceHistory>)| {
        Image::compute(geometry.extent(), frame.render_extent, |p| {
            let [r, g, b, _] = irradiance.at(p).map(store_signed);
            let packed = pack_luminance_history(&luminance_history.at(p), p);
            if geometry.is_background(p) {
                return ([r, g, b, BACKGROUND_DEVIATION], packed);
            }
            let Estimated { deviation, is_repeated, rare, detail } = estimated(frame, tuning, geometry, luminance_history, p);
            repeated.fetch_add(is_repeated.into(), Ordering::Relaxed);
            let alpha = store(if is_marked { marked(deviation, rare) } else { deviation });
            ([r, g, b, alpha], detail.map_or(packed, |detail| with_detail(packed, detail)))
        })
    };
    let texels: Vec<Image<([f32; 4], u32)>> = irradiance.iter().zip(luminance_history).map(signal).collect();
    let images = texels.iter().map(|image| image.map(|texel| texel.0)).collect();
    let packed = texels.iter().map(|image| image.map(|texel| texel.1)).collect();
    let mut statistics = Statistics::default();
    statistics[Counter::RepeatedSample] = repeated.into_inner();
    Estimates { images, luminance_history: packed, statistics }
}

/// Variance of the window, scaled by how short the history is.
fn spatial_variance(
    frame: &FrameConstants,
    tuning: &Tuning,
    geometry: &Geometry,
    luminance_history: &Image<LuminanceHistory>,
    p: IVec2,
    radius: i32,
) -> f32 {
    let rect = RenderRect::new(frame.render_extent);
    let mut window = [(0.0, LuminanceHistory::default()); SIDE * SIDE];
    for (tap, (_, q)) in window.iter_mut().zip(rect.window(p, radius, 1)) {
        *tap = (geometry.weight(p, q), luminance_history.at(q));
    }
    let sum: f32 = window.iter().map(|tap| tap.0).sum();
    let mean = window.iter().map(|(weight, m)| weight * m.mean).sum::<f32>() / sum;
    // μ2 − μ1² of the window, taken about the mean, so that it does not cancel.
    let second = |m: &LuminanceHistory| m.deviation * m.deviation + (m.mean - mean) * (m.mean - mean);
    let variance: f32 = window.iter().map(|(weight, m)| weight * second(m)).sum();
    // A short history was averaged over few frames: its mean is that much less certain [SVGF 4.2, as published implementations do].
    variance / sum * tuning.spatial_variance_frames / luminance_history.at(p).history_length.max(1.0)
}

/// The root of a difference of moments: where the variance is next to 0, rounding decides it.
const ESTIMATED: Tolerance = Tolerance { relative: 3e-3, absolute: 2e-3, ..HALF };

/// The ratio of a mean square to another.
const SHARE: Tolerance = Tolerance { relative: 0.0, absolute: 8e-3, outliers: 0.0 };

/// Mean and deviation come rounded to halves: the rest is arithmetic of whole numbers.
pub(crate) const RULES: &[Rule] = &[
    rule("statistics", Unit::Buffer, Reading::Counts, TESTED_COUNTS),
    pixels("estimate_0", ESTIMATED),
    pixels("estimate_1", ESTIMATED),
    rare_light("estimate_0"),
    rule("luminance_history_0", Unit::Pixel, Reading::LuminanceHistory, EXACT),
    rule("luminance_history_1", Unit::Pixel, Reading::LuminanceHistory, EXACT),
    rule("luminance_history_0", Unit::Pixel, Reading::Detail, SHARE),
    rule("luminance_history_1", Unit::Pixel, Reading::Detail, SHARE),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guide = b.packed("guide")?;
    let geometry = match b.is_on("VOLUME")? {
        true => Geometry::of_volume(b.frame, b.tuning, guide),
        false => Geometry::new(b.frame, b.tuning, guide),
    };
    let estimated: Estimate = match b.constant("ESTIMATOR")? {
        0 => deviation,
        1 => faded_deviation,
        3 if b.is_on("FILLED")? => deviation_of_filled_mean,
        3 => deviation_of_mean,
        _ => |_, _, _, luminance_history, p| luminance_history.at(p).deviation.into(),
    };
    let (irradiance, new_luminance) = (b.colours("irradiance")?, b.uints("new_luminance")?);
    let luminance_history: Vec<_> =
        irradiance.iter().zip(new_luminance).map(|(irradiance, new)| join_luminance_history(irradiance, new)).collect();
    let Estimates { images, luminance_history, statistics } = estimate(
        b.frame,
        b.tuning,
        &geometry,
        &irradiance,
        &luminance_history.iter().collect::<Vec<_>>(),
        estimated,
        b.is_on("MARKED")?,
    );
    b.count(&statistics)?;
    b.write_signals("estimate", images)?;
    b.write_signals("luminance_history", luminance_history)
}

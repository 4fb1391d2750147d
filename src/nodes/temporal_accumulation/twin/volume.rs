//! The stage for a volume \[PSVGF\]: along the volume's own motion, tested by the depth of the surface behind alone.

use super::*;
use crate::nodes::volume_motion::twin::unpack_volume_motion;
use crate::reference::volume::{relative_difference, volume_depth};

/// Inputs of [`volume_accumulation`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VolumeAccumulationInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `volume_motion`, from the stage of that name.
    pub volume_motion: &'a Image<u32>,
    /// rgb: radiance of the volume, as written by `volume_points`; a negative alpha marks pixels without a sample of their own.
    pub radiance: &'a Image<[f32; 4]>,
    /// One signal. Not read in a reset frame; `None` is treated as one.
    pub previous: Option<PreviousFrame<'a>>,
}

/// Accumulates the radiance of a volume. No pixel is background: fog lies before the sky as well.
pub(crate) fn volume_accumulation(
    frame: &FrameConstants,
    tuning: &Tuning,
    inputs: &VolumeAccumulationInputs,
) -> (Image<[f32; 4]>, Image<LuminanceHistory>) {
    let previous = inputs.previous.filter(|_| !is_reset(frame));
    let rect = RenderRect::new(frame.previous_render_extent);
    let bounds = AlphaBounds::new(tuning, false, false, 0.0);
    let signal = previous.and_then(|previous| previous.signals.first());
    let texels = Image::compute(inputs.guide.extent(), frame.render_extent, |p| {
        let history = previous.map_or(History::Disoccluded(Reason::Reset), |previous| {
            let depth = volume_depth(inputs.guide.at(p));
            let refusal = |q: IVec2| {
                if !rect.contains(q) {
                    Reason::OffScreen
                } else if relative_difference(volume_depth(previous.guide.at(q)), depth) > tuning.depth_tolerance {
                    Reason::Depth
                } else {
                    Reason::None
                }
            };
            let motion = Vec2::from(unpack_volume_motion(inputs.volume_motion.at(p)));
            let s = (p.as_vec2() + 0.5) * extent_ratio(frame) + motion - 0.5;
            taps::find(s, refusal).unwrap_or_else(|| History::Disoccluded(refusal(taps::nearest(s))))
        });
        let (c, luminance_history) = accumulate(frame, inputs.radiance.at(p), (history, 1.0), bounds, signal, [1.0; 3]);
        (c, luminance_history.in_halves())
    });
    (texels.map(|t| t.0), texels.map(|t| t.1))
}

//! The pixel of the previous frame nearest to where a surface was: coarser than the taps of `temporal_accumulation`, for statistics
//! over many pixels.

use super::bindings::Bindings;
use super::conventions::is_reset;
use super::guide::unpack_guide;
use super::luminance_history::LuminanceHistory;
use super::projection::extent_ratio;
use super::surface_motion::unpack_surface_motion;
use super::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec2};

/// History of a signal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SignalHistory<'a> {
    /// rgb: irradiance, as written by level 0 of `atrous`.
    pub irradiance: &'a Image<[f32; 4]>,
    /// The image `luminance_history` of the previous frame.
    pub luminance_history: &'a Image<LuminanceHistory>,
}

/// Guides of two frames; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HistoryGuides<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `surface_motion`, from the stage `import`.
    pub surface_motion: &'a Image<[u16; 4]>,
    /// The guide of the previous frame. Not read in a reset frame.
    pub previous_guide: &'a Image<[u16; 4]>,
}

impl<'a> HistoryGuides<'a> {
    /// The guides that a pass has bound.
    pub(crate) fn of(b: &Bindings<'a>) -> Result<Self, Error> {
        Ok(Self {
            guide: b.packed("guide")?,
            surface_motion: b.packed("surface_motion")?,
            previous_guide: b.packed("previous_guide")?,
        })
    }

    /// The pixel of the previous frame, where it still shows the surface of `p`: same id, expected depth.
    pub(crate) fn nearest(&self, frame: &FrameConstants, tuning: &Tuning, p: IVec2) -> Option<IVec2> {
        let surface = unpack_guide(self.guide.at(p));
        if surface.is_background() || is_reset(frame) {
            return None;
        }
        let motion = unpack_surface_motion(self.surface_motion.at(p));
        let tap = ((p.as_vec2() + 0.5) * extent_ratio(frame) + Vec2::from(motion.motion)).floor().as_ivec2();
        if !RenderRect::new(frame.previous_render_extent).contains(tap) {
            return None;
        }
        let previous = unpack_guide(self.previous_guide.at(tap));
        let expected = surface.linear_depth * (1.0 + motion.depth_ratio);
        let [dx, dy] = surface.gradient;
        let tolerance = tuning.depth_tolerance * expected + dx.abs() + dy.abs();
        let is_same =
            !previous.is_background() && previous.id == surface.id && (previous.linear_depth - expected).abs() <= tolerance;
        is_same.then_some(tap)
    }
}

//! Two frames compared: how much of an image is noise.

use super::tiles::Pair;
use crate::frame::FrameInputs;
use crate::frame_images::Texels;
use crate::motion::{self, SurfaceMotion};
use crate::setup::Setup;

/// The share of the tiles from which on an image is noisy.
const NOISY: f32 = 0.35;
/// The same where the place of a surface in the frame before is not known: without its motion, or with jitter, by which a fine
/// texture differs from frame to frame.
const NOISY_UNKNOWN: f32 = 0.6;

/// Two frames, and the way from one to the other.
pub struct Comparison<'a> {
    pair: &'a [FrameInputs; 2],
    /// Surfaces of the second frame.
    pub surface: SurfaceMotion,
    /// The share of noise from which on an image is noisy.
    pub limit: f32,
}

impl<'a> Comparison<'a> {
    /// `None` across a cut.
    pub fn new(pair: &'a [FrameInputs; 2], setup: &Setup) -> Option<Self> {
        let [before, now] = pair;
        let is_jittered = pair.iter().any(|frame| frame.params.jitter != [0.0; 2]);
        let is_cut = now.params.reset.is_some();
        (!is_cut).then(|| Self {
            pair,
            surface: motion::of_frame(now, &before.params, &setup.config.conventions),
            limit: if setup.knows_motion() && !is_jittered { NOISY } else { NOISY_UNKNOWN },
        })
    }

    /// The share of an image that is noise, by one number for each of its pixels. Pixels that are `skipped` do not count.
    pub fn share(&self, image: &str, values: impl Fn(&Texels) -> Vec<f32>, skipped: Option<&[bool]>) -> f32 {
        let [before, now] = self.pair;
        let Some((a, b)) = before.images.get(image).zip(now.images.get(image)) else { return 0.0 };
        let values = [values(a), values(b)];
        let values = values.each_ref().map(Vec::as_slice);
        Pair { extent: now.params.render_extent, values, motion_px: &self.surface.motion_px, skipped }.noisy_share()
    }
}

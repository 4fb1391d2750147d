//! The pictures of a frame for people.

use crate::display_transform::DisplayTransform;
use crate::frame::FrameInputs;
use std::borrow::Cow;

/// The pictures of a frame, as they are shown.
pub struct Views<'a> {
    /// Number of the frame.
    pub number: u64,
    /// Width and height.
    pub extent: [u32; 2],
    /// The input.
    pub noisy: Cow<'a, [[f32; 3]]>,
    /// The result.
    pub denoised: Cow<'a, [[f32; 3]]>,
    /// The converged picture.
    pub reference: Option<Cow<'a, [[f32; 3]]>>,
}

impl<'a> Views<'a> {
    /// Those of a frame and its result.
    pub fn new(frame: &'a FrameInputs, denoised: &'a [[f32; 3]], shown: DisplayTransform) -> Self {
        Self {
            number: frame.number,
            extent: frame.params.render_extent,
            noisy: shown.apply(&frame.noisy),
            denoised: shown.apply(denoised),
            reference: frame.reference.as_ref().map(|reference| shown.apply(reference)),
        }
    }
}

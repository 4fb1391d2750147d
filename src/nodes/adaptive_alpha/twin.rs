//! The stage `adaptive_alpha` \[ASVGF 3.5, eq. 14\]: how far the history of a pixel is still true.

use crate::reference::bindings::Bindings;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};

/// Source of the confidence.
#[derive(Clone, Copy, Debug)]
pub enum AdaptiveAlphaInput<'a> {
    /// The reconstructed gradient.
    Gradient {
        /// One texel a stratum: x: δ, y: Δ.
        gradient: &'a Image<[f32; 4]>,
        /// Pixels a side of a stratum.
        stratum_size: u32,
    },
    /// The host's own confidence, one texel a pixel: x, 0 to 1; where it is not finite, history is trusted.
    Confidence(&'a Image<[f32; 4]>),
}

/// `history_confidence` = 1 − λ for an image of `extent`: 1 keeps the history, 0 drops it.
pub fn adaptive_alpha(frame: &FrameConstants, tuning: &Tuning, extent: [u32; 2], input: AdaptiveAlphaInput) -> Image<f32> {
    let rect = RenderRect::new(frame.render_extent);
    Image::compute(extent, frame.render_extent, |p| match input {
        AdaptiveAlphaInput::Gradient { gradient, stratum_size } => {
            let changes = rect.window(p, 1, 1).map(|(_, q)| change(tuning, gradient.at(q / stratum_size as i32)));
            1.0 - changes.fold(0.0, f32::max)
        }
        AdaptiveAlphaInput::Confidence(host) => match host.at(p)[0] {
            c if c.is_finite() => c.clamp(0.0, 1.0),
            _ => 1.0,
        },
    })
}

/// λ of a stratum.
fn change(tuning: &Tuning, [change, brightest, ..]: [f32; 4]) -> f32 {
    if brightest > 0.0 {
        (tuning.gradient_scale * change.abs() / brightest).min(1.0)
    } else {
        0.0
    }
}

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let input = match b.optional_colour("confidence")? {
        Some(host) => AdaptiveAlphaInput::Confidence(host),
        None => AdaptiveAlphaInput::Gradient { gradient: b.colour("gradient")?, stratum_size: b.stratum_size()? },
    };
    let confidence = adaptive_alpha(b.frame, b.tuning, b.extent_of("history_confidence")?, input);
    b.write("history_confidence", confidence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::{frame, paint};

    #[test]
    fn the_largest_change_of_the_strata_around_counts() {
        let tuning = Tuning { gradient_scale: 2.0, ..Tuning::default() };
        // One stratum of nine changed by a quarter, in either direction alike; one has nothing to compare with.
        for sign in [1.0, -1.0] {
            let gradient = paint([3, 3], |x, y| match (x, y) {
                (1, 1) => [sign * 1.0, 4.0, 0.0, 0.0],
                (2, 0) => [1.0, 0.0, 0.0, 0.0],
                _ => [0.0, 1.0, 0.0, 0.0],
            });
            let input = AdaptiveAlphaInput::Gradient { gradient: &gradient, stratum_size: 3 };
            let confidence = adaptive_alpha(&frame([7, 7]), &tuning, [7, 7], input);
            let expected = paint([7, 7], |x, y| if (2..=6).contains(&x) && (2..=6).contains(&y) { 0.5 } else { 1.0 });
            assert_eq!(confidence, expected);
        }
    }

    #[test]
    fn what_a_host_says_is_bounded() {
        let host = paint([6, 1], |x, _| [[0.25, -1.0, 9.0, f32::NAN, f32::INFINITY, 1.0][x as usize], 0.0, 0.0, 0.0]);
        let confidence = adaptive_alpha(&frame([6, 1]), &Tuning::default(), [6, 1], AdaptiveAlphaInput::Confidence(&host));
        assert_eq!(confidence.texels(), [0.25, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }
}

//! The stage `history_confidence` \[ASVGF 3.5, eq. 14\]: how far the history of a pixel is still true.

use crate::nodes::change_test::twin::change_test;
use crate::reference::bindings::Bindings;
use crate::reference::blocks::Blocks;
use crate::reference::both_confidences::both_confidences;
use crate::reference::compare::{Condition, Reading, Rule, Tolerance, Unit};
use crate::reference::light_ratio::stratum_coherence;
use crate::reference::rules::{pixels, rule, HALF};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Error, FrameConstants, Tuning};

/// Source of the confidence.
#[derive(Clone, Copy, Debug)]
pub(crate) enum HistoryConfidenceInput<'a> {
    /// The reconstructed gradient.
    Gradient {
        /// One texel a stratum: x: δ, y: Δ.
        gradient: &'a Image<[f32; 4]>,
        /// Pixels a side of a stratum.
        stratum_size: u32,
        /// The image `light_ratio`, one texel a stratum, by which the history is scaled.
        light_ratio: Option<&'a Image<[f32; 4]>>,
        /// Confidence of another stage, one texel a pixel, for pixels without a gradient.
        other: Option<&'a Image<f32>>,
        /// How sure the change test is that nothing changed, or, below 0, that something did; one texel a block.
        steadiness: Option<&'a Image<f32>>,
    },
    /// The host's own confidence, one texel a pixel: x, 0 to 1; where it is not finite, history is trusted.
    Confidence(&'a Image<[f32; 4]>),
}

/// Confidence for images of `extent`.
pub(crate) fn history_confidence(
    frame: &FrameConstants,
    tuning: &Tuning,
    extent: [u32; 2],
    input: HistoryConfidenceInput,
) -> Image<f32> {
    let (rect, blocks) = (RenderRect::new(frame.render_extent), Blocks::new(frame.render_extent));
    Image::compute(extent, frame.render_extent, |p| match input {
        HistoryConfidenceInput::Gradient { gradient, stratum_size, light_ratio, other, steadiness } => {
            let strata = || rect.window(p, 1, 1).map(|(_, q)| q / stratum_size as i32);
            if let Some(other) = other.filter(|_| strata().all(|s| gradient.at(s)[1] == 0.0)) {
                return other.at(p);
            }
            let change = strata().map(|s| change(tuning, gradient.at(s))).fold(0.0, f32::max);
            let ratios = light_ratio.map_or_else(Vec::new, |ratio| strata().map(|s| ratio.at(s)).collect());
            let steadiness = steadiness.map_or(0.0, |steadiness| blocks.interpolated(p, |block| steadiness.at(block)));
            // A doubt is no change that the gradient missed.
            let missed = (1.0 - change) * steadiness.min(0.0).powi(2);
            1.0 - (change * (1.0 - steadiness.max(0.0)) * (1.0 - coherence(&ratios))).max(missed)
        }
        HistoryConfidenceInput::Confidence(host) => match host.at(p)[0] {
            c if c.is_finite() => c.clamp(0.0, 1.0),
            _ => 1.0,
        },
    })
}

/// How far history that is scaled by these ratios is true: 0 to 1.
fn coherence(ratios: &[[f32; 4]]) -> f32 {
    let surfaces = || ratios.iter().filter(|ratio| ratio[3] >= 0.0);
    let range = |i: usize| (surfaces().map(|r| r[i]).fold(f32::INFINITY, f32::min), surfaces().map(|r| r[i]).fold(0.0, f32::max));
    if surfaces().next().is_none() {
        return 0.0;
    }
    let differences = [0, 1, 2].map(range).map(|(least, largest)| (largest - least) / largest.max(1e-6));
    let difference = differences.into_iter().fold(0.0, f32::max);
    range(3).0 * stratum_coherence(difference)
}

/// λ of a stratum.
fn change(tuning: &Tuning, [change, brightest, ..]: [f32; 4]) -> f32 {
    if brightest > 0.0 {
        (tuning.gradient_scale * change.abs() / brightest).min(1.0)
    } else {
        0.0
    }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    pixels("history_confidence", HALF),
    Rule {
        when: Condition::Is("BOTH", 1),
        ..rule("history_confidence", Unit::Pixel, Reading::SpecularConfidence, Tolerance { absolute: 1e-3, ..HALF })
    },
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    if let Some(host) = b.optional_colour("confidence")? {
        let extent = b.extent_of("history_confidence")?;
        let confidence = history_confidence(b.frame, b.tuning, extent, HistoryConfidenceInput::Confidence(host));
        return b.write("history_confidence", confidence);
    }
    if !b.has("block_difference_0") {
        let (other, steadiness) = (b.optional_scalar("other_confidence")?, b.optional_scalar("steadiness")?);
        let confidence = of_gradient(b, other, steadiness, b.optional_colour("light_ratio")?)?;
        return b.write("history_confidence", confidence);
    }
    let (differences, light_ratio) = (b.wides("block_difference")?, b.optional_colour("light_ratio")?);
    let confidence = if b.is_on("BOTH")? {
        // Of light that is mixed there is one difference.
        let of_images = &differences[differences.len() - 1..];
        let (diffuse, specular) = (tested(b, &differences[..1], light_ratio)?, tested(b, of_images, None)?);
        Image::compute(diffuse.extent(), b.frame.render_extent, |p| both_confidences(diffuse.at(p), specular.at(p)))
    } else {
        tested(b, &differences, light_ratio)?
    };
    b.write("history_confidence", confidence)
}

fn tested(b: &Bindings, differences: &[&Image<[u32; 4]>], light_ratio: Option<&Image<[f32; 4]>>) -> Result<Image<f32>, Error> {
    let tested = change_test(b.frame, b.tuning, b.extent_of("history_confidence")?, differences, false);
    of_gradient(b, Some(&tested.history_confidence), Some(&tested.steadiness), light_ratio)
}

fn of_gradient(
    b: &Bindings,
    other: Option<&Image<f32>>,
    steadiness: Option<&Image<f32>>,
    light_ratio: Option<&Image<[f32; 4]>>,
) -> Result<Image<f32>, Error> {
    let (gradient, stratum_size) = (b.colour("gradient")?, b.stratum_size()?);
    let input = HistoryConfidenceInput::Gradient { gradient, stratum_size, light_ratio, other, steadiness };
    Ok(history_confidence(b.frame, b.tuning, b.extent_of("history_confidence")?, input))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::{frame, paint, svgf_tuning};

    #[test]
    fn the_largest_change_of_the_strata_around_counts() {
        let tuning = Tuning { gradient_scale: 2.0, ..svgf_tuning() };
        // One stratum of nine changed by a quarter, in either direction alike; one has nothing to compare with.
        for sign in [1.0, -1.0] {
            let gradient = paint([3, 3], |x, y| match (x, y) {
                (1, 1) => [sign * 1.0, 4.0, 0.0, 0.0],
                (2, 0) => [1.0, 0.0, 0.0, 0.0],
                _ => [0.0, 1.0, 0.0, 0.0],
            });
            let input = HistoryConfidenceInput::Gradient {
                gradient: &gradient,
                stratum_size: 3,
                light_ratio: None,
                other: None,
                steadiness: None,
            };
            let confidence = history_confidence(&frame([7, 7]), &tuning, [7, 7], input);
            let expected = paint([7, 7], |x, y| if (2..=6).contains(&x) && (2..=6).contains(&y) { 0.5 } else { 1.0 });
            assert_eq!(confidence, expected);
        }
    }

    #[test]
    fn history_that_follows_the_light_is_kept() {
        // Light fell by half everywhere; strata of the second column have another ratio, those of the third are background.
        let gradient = paint([3, 1], |_, _| [-0.5, 1.0, 0.0, 0.0]);
        let confidence = |second: f32, coherence: f32| {
            let ratio = paint([3, 1], |x, _| match x {
                0 => [0.5, 0.5, 0.5, coherence],
                1 => [second, 0.5, 0.5, 1.0],
                _ => [1.0, 1.0, 1.0, -1.0],
            });
            let input = HistoryConfidenceInput::Gradient {
                gradient: &gradient,
                stratum_size: 3,
                light_ratio: Some(&ratio),
                other: None,
                steadiness: None,
            };
            history_confidence(&frame([9, 3]), &svgf_tuning(), [9, 3], input).texels()[..9].to_vec()
        };
        assert_eq!(confidence(0.5, 1.0), [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0], "none of the background");
        assert_eq!(confidence(0.5, 0.25)[..5], [0.25, 0.25, 0.25, 0.25, 1.0], "as far as samples agree");
        assert_eq!(confidence(1.0, 1.0)[..5], [1.0, 1.0, 0.0, 0.0, 1.0], "not between strata that disagree");
    }

    #[test]
    fn pixels_without_a_gradient_take_the_other_confidence() {
        let gradient = paint([3, 1], |x, _| if x == 0 { [0.0, 1.0, 0.0, 0.0] } else { [0.0; 4] });
        let other = paint([9, 3], |_, _| 0.25);
        let input = HistoryConfidenceInput::Gradient {
            gradient: &gradient,
            stratum_size: 3,
            light_ratio: None,
            other: Some(&other),
            steadiness: None,
        };
        let confidence = history_confidence(&frame([9, 3]), &svgf_tuning(), [9, 3], input);
        assert_eq!(confidence.texels()[..9], [1.0, 1.0, 1.0, 1.0, 0.25, 0.25, 0.25, 0.25, 0.25]);
    }

    #[test]
    fn a_gradient_of_steady_blocks_drops_no_history_that_they_saw() {
        let gradient = paint([8, 1], |_, _| [1.0, 1.0, 0.0, 0.0]);
        let steadiness = paint([3, 1], |x, _| [1.0, 0.0, 0.5][x as usize]);
        let input = HistoryConfidenceInput::Gradient {
            gradient: &gradient,
            stratum_size: 3,
            light_ratio: None,
            other: None,
            steadiness: Some(&steadiness),
        };
        let outputs = history_confidence(&frame([24, 3]), &svgf_tuning(), [24, 3], input);
        let confidence = &outputs.texels()[..24];
        assert_eq!(confidence[..4], [1.0; 4], "the block at the edge");
        assert_eq!(confidence[4], 1.0 - 0.5 / 8.0, "half a pixel beyond its centre");
        assert_eq!(confidence[11], 0.5 / 8.0, "half a pixel before that of the block that changed");
        assert_eq!(confidence[20..], [0.5; 4], "the other edge");
    }

    #[test]
    fn a_change_that_a_gradient_missed_drops_history_where_blocks_are_sure() {
        let confidence = |delta: f32, steadiness: f32, coherence: f32| {
            let gradient = paint([3, 3], |_, _| [delta, 1.0, 0.0, 0.0]);
            let ratio = paint([3, 3], |_, _| [2.0, 2.0, 2.0, coherence]);
            let steadiness = paint([1, 1], |_, _| steadiness);
            let input = HistoryConfidenceInput::Gradient {
                gradient: &gradient,
                stratum_size: 3,
                light_ratio: Some(&ratio),
                other: None,
                steadiness: Some(&steadiness),
            };
            history_confidence(&frame([8, 8]), &svgf_tuning(), [8, 8], input).at(glam::IVec2::splat(4))
        };
        assert_eq!([-1.0, -0.5, 0.0, 1.0].map(|steadiness| confidence(0.0, steadiness, 0.0)), [0.0, 0.75, 1.0, 1.0]);
        assert_eq!(confidence(1.0, -1.0, 1.0), 1.0, "what the gradient saw is scaled");
        assert_eq!(confidence(1.0, -1.0, 0.0), 0.0);
    }

    #[test]
    fn what_a_host_says_is_bounded() {
        let host = paint([6, 1], |x, _| [[0.25, -1.0, 9.0, f32::NAN, f32::INFINITY, 1.0][x as usize], 0.0, 0.0, 0.0]);
        let confidence = history_confidence(&frame([6, 1]), &svgf_tuning(), [6, 1], HistoryConfidenceInput::Confidence(&host));
        assert_eq!(confidence.texels(), [0.25, 0.0, 1.0, 1.0, 1.0, 1.0]);
    }
}

//! The stage `firefly` \[PSVGF\]: outliers are scaled down to the brightest luminance that is usual around them, and what that takes is
//! spread over their block.

use crate::nodes::block_difference::twin::{difference_from_history, DIFFERENCE};
use crate::nodes::firefly_limits::twin::{limit_at, limits_of_pass, Limit, LIMITS};
use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{allocated_blocks, block_of, Blocks, BLOCK_SIZE};
use crate::reference::compare::Rule;
use crate::reference::guide::unpack_guide;
use crate::reference::luminance::{luminance, texel_luminance};
use crate::reference::rules::{pixels, rounded, HALF};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};

/// Of a cluster, in shares of what one outlier spreads at most: more would show.
const CLUSTER_SPREAD: f32 = 0.4;

/// Lamps that are mirrored are brighter than all around, and move otherwise than the mirror: so many times the limit are usual.
const HIGHLIGHT: f32 = 32.0;

/// Inputs of [`firefly`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct FireflyInputs<'a> {
    /// The image `guide`, from the stage `import`; `None` for a volume, of which every pixel takes part.
    pub guide: Option<&'a Image<[u16; 4]>>,
    /// The image `firefly_limits` of this signal, from the stage of that name.
    pub firefly_limits: &'a Image<u32>,
    /// rgb: irradiance of one signal, as written by `demodulate`.
    pub irradiance: &'a Image<[f32; 4]>,
    /// Whether it is specular light.
    pub is_specular: bool,
}

/// rgb: irradiance without outliers, half precision; alpha as it came.
pub(crate) fn firefly(frame: &FrameConstants, tuning: &Tuning, inputs: &FireflyInputs) -> Image<[f32; 4]> {
    let takes_part = |p| {
        let is_background = inputs.guide.is_some_and(|guide| unpack_guide(guide.at(p)).is_background());
        !is_background && inputs.irradiance.at(p)[3] >= 0.0
    };
    let blocks = Blocks::new(frame.render_extent).extent();
    let limit_of = |p| limit_at(inputs.firefly_limits, p);
    let spread = Image::compute(allocated_blocks(inputs.irradiance), blocks, |block| {
        let (mut sum, mut count) = ([0.0; 3], 0.0_f32);
        for p in Blocks::pixels(block, frame.render_extent).filter(|p| takes_part(*p)) {
            let texel = inputs.irradiance.at(p);
            let l = texel_luminance(texel);
            let limit = limit_of(p);
            let share = 1.0 - kept_share(l, &limit, inputs.is_specular);
            if share > 0.0 {
                let share = share.min(tuning.firefly_spread * limit.limit / l);
                sum = std::array::from_fn(|i| sum[i] + texel[i] * share);
            }
            count += 1.0;
        }
        let limit = limit_of(block * BLOCK_SIZE as i32);
        let most = match limit.is_cluster {
            true => CLUSTER_SPREAD * tuning.firefly_spread * limit.limit / luminance(sum).max(1e-6),
            false => 1.0,
        };
        sum.map(|s: f32| s / count.max(1.0) * most.min(1.0))
    });
    Image::compute(inputs.irradiance.extent(), frame.render_extent, |p| {
        let texel = inputs.irradiance.at(p);
        if !takes_part(p) {
            return texel;
        }
        let kept = kept_share(texel_luminance(texel), &limit_of(p), inputs.is_specular);
        let spread = spread.at(block_of(p));
        if kept == 1.0 && spread == [0.0; 3] {
            return texel;
        }
        let [r, g, b] = [0, 1, 2].map(|i| store(texel[i] * kept + spread[i]));
        [r, g, b, texel[3]]
    })
}

/// The share of a luminance that is kept.
fn kept_share(l: f32, limit: &Limit, is_specular: bool) -> f32 {
    let most = if is_specular { HIGHLIGHT * limit.limit } else { limit.limit };
    if most == 0.0 || l <= most {
        return 1.0;
    }
    // The pixels of a cluster add up: the further they are above the limit, the less of each is left.
    let share = most / l;
    if limit.is_cluster {
        share * share
    } else {
        share
    }
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[pixels("irradiance", HALF), rounded("irradiance"), DIFFERENCE, LIMITS];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guide = if b.is_on("VOLUME")? { None } else { Some(b.packed("guide")?) };
    let (irradiance, is_specular) = (b.colour("irradiance")?, b.is_on("SPECULAR")?);
    if !b.has("block_difference") {
        let inputs = FireflyInputs { guide, firefly_limits: b.uint("firefly_limits")?, irradiance, is_specular };
        return b.write("irradiance", firefly(b.frame, b.tuning, &inputs));
    }
    let limits = limits_of_pass(b)?;
    let filtered = firefly(b.frame, b.tuning, &FireflyInputs { guide, firefly_limits: &limits, irradiance, is_specular });
    let differences = difference_from_history(b, &filtered)?;
    b.write("firefly_limits", limits)?;
    b.write("block_difference", differences)?;
    b.write("irradiance", filtered)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nodes::block_percentiles::twin::{block_percentiles, BlockPercentilesInputs};
    use crate::nodes::firefly_limits::twin::{firefly_limits, FireflyLimitsInputs};
    use crate::reference::test_scene::*;

    const EXTENT: [u32; 2] = [45, 30];

    fn filtered(irradiance: &Image<[f32; 4]>) -> Image<[f32; 4]> {
        filtered_with(&svgf_tuning(), irradiance)
    }

    fn filtered_with(tuning: &Tuning, irradiance: &Image<[f32; 4]>) -> Image<[f32; 4]> {
        filtered_as(tuning, irradiance, false)
    }

    fn filtered_as(tuning: &Tuning, irradiance: &Image<[f32; 4]>, is_specular: bool) -> Image<[f32; 4]> {
        let (frame, guides) = (frame(EXTENT), guides(EXTENT, |_, _| surface(2.0)));
        let percentiles = block_percentiles(&frame, tuning, &BlockPercentilesInputs { guide: Some(&guides.guide), irradiance });
        let limits =
            firefly_limits(&frame, tuning, &FireflyLimitsInputs { block_percentiles: &percentiles, irradiance, history: None });
        let inputs = FireflyInputs { guide: Some(&guides.guide), firefly_limits: &limits, irradiance, is_specular };
        firefly(&frame, tuning, &inputs)
    }

    fn mean(image: &Image<[f32; 4]>) -> f64 {
        image.texels().iter().map(|t| f64::from(texel_luminance(*t))).sum::<f64>() / image.texels().len() as f64
    }

    #[test]
    fn energy_stays_where_there_are_no_outliers() {
        // Uniform; exponential, as heavy a tail as diffuse light at one sample has; black and white.
        let shapes: [fn(f32) -> f32; 3] = [|u| u, |u| -(1.0 - u).max(1e-7).ln(), |u| f32::from(u > 0.8)];
        for (i, shape) in shapes.into_iter().enumerate() {
            let input = noise(EXTENT, 5).map(|t| t.map(shape));
            let change = mean(&filtered(&input)) / mean(&input) - 1.0;
            assert!(change.abs() < 0.005, "shape {i}: {change}");
        }
    }

    #[test]
    fn what_is_cut_off_is_spread_over_the_block() {
        let mut input = noise(EXTENT, 5);
        for (x, y) in [(4, 4), (20, 12), (43, 29)] {
            *input.get_mut(x, y).expect("inside") = [6.0, 3.0, 3.0, 0.0];
        }
        let lost = |firefly_spread| {
            let tuning = Tuning { firefly_spread, ..svgf_tuning() };
            1.0 - mean(&filtered_with(&tuning, &input)) / mean(&input)
        };
        let (all, none) = (lost(0.0), lost(1024.0));
        assert!(all > 0.003 && none.abs() < 1e-4, "{all} without spread, {none} with");
    }

    #[test]
    fn no_more_is_spread_than_twice_what_is_left() {
        let mut input = noise(EXTENT, 3);
        *input.get_mut(20, 12).expect("inside") = [5000.0; 4];
        let output = filtered(&input);
        let left = texel_luminance(*output.get(20, 12).expect("inside"));
        let gained = texel_luminance(*output.get(17, 9).expect("inside")) - texel_luminance(*input.get(17, 9).expect("inside"));
        assert!(gained > 0.0 && gained < 2.1 * left / 64.0, "{gained} of {left}");
        assert_eq!(output.get(2, 2), input.get(2, 2), "in another block");
    }

    #[test]
    fn a_hole_takes_nothing() {
        let mut input = noise(EXTENT, 3);
        *input.get_mut(20, 12).expect("inside") = [5.0, 5.0, 5.0, 0.0];
        *input.get_mut(17, 9).expect("inside") = [0.0, 0.0, 0.0, -1.0];
        assert_eq!(filtered(&input).get(17, 9), input.get(17, 9));
    }

    #[test]
    fn an_outlier_is_scaled_down_and_keeps_its_hue() {
        let mut input = noise(EXTENT, 3);
        *input.get_mut(20, 12).expect("inside") = [5000.0, 2500.0, 0.0, 0.0];
        let output = filtered(&input);
        let [r, g, b, _] = *output.get(20, 12).expect("inside");
        assert!(r < 5.0 * (1.0 + 2.0 / 64.0) && (r / g - 2.0).abs() < 0.01 && b == 0.0, "{r} {g} {b}");
        assert_eq!(output.get(2, 2), input.get(2, 2));
    }

    #[test]
    fn a_highlight_stays_and_what_is_far_brighter_does_not() {
        let at = |lit: f32, is_specular: bool| {
            let mut input = noise(EXTENT, 3);
            *input.get_mut(20, 12).expect("inside") = [lit, lit, lit, 0.0];
            texel_luminance(*filtered_as(&svgf_tuning(), &input, is_specular).get(20, 12).expect("inside"))
        };
        let limit = at(5000.0, false);
        assert_eq!(at(30.0, true), 30.0);
        assert!(at(30.0, false) < 5.0);
        let ratio = at(5000.0, true) / limit;
        assert!((0.9 * HIGHLIGHT..1.02 * HIGHLIGHT).contains(&ratio), "{ratio}");
    }

    #[test]
    fn less_is_left_of_the_pixels_of_a_cluster_than_of_an_outlier() {
        let with = |size: i32| {
            let mut input = noise(EXTENT, 3);
            for (x, y) in (0..size).flat_map(|y| (0..size).map(move |x| (18 + x, 10 + y))) {
                *input.get_mut(x, y).expect("inside") = [500.0; 4];
            }
            let output = filtered(&input);
            let gained = mean(&output) / mean(&noise(EXTENT, 3)) - 1.0;
            (texel_luminance(*output.get(18, 10).expect("inside")), gained)
        };
        let ((outlier, _), (cluster, gained)) = (with(1), with(3));
        assert!(outlier > 1.5 && cluster < 0.2, "{outlier} {cluster}");
        assert!((-0.001..0.01).contains(&gained), "{gained}");
    }

    #[test]
    fn a_lit_corner_of_a_dark_block_and_a_rare_sample_among_black_ones_stay() {
        let lit = paint(EXTENT, |x, y| if x >= 15 && y >= 15 { [1.0; 4] } else { [0.01; 4] });
        assert_eq!(filtered(&lit), lit);
        let rare = paint(EXTENT, |x, y| if (x * 7 + y * 13) % 61 == 0 { [3.0; 4] } else { [0.0; 4] });
        assert_eq!(filtered(&rare), rare);
    }
}

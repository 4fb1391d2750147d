//! The stage `firefly_limits`: the brightest luminance that is no outlier, in cells of 4×4 pixels.

use crate::nodes::block_percentiles::twin::unpack_percentiles;
use crate::reference::binary16::{from_half_bits, half_bits, store};
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{block_of, Blocks};
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::guide::unpack_guide;
use crate::reference::luminance::texel_luminance;
use crate::reference::nearest_history::HistoryGuides;
use crate::reference::render_rect::RenderRect;
use crate::reference::rules::{rule, HALF};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::{IVec2, Vec2};

/// Pixels a side of a cell.
const CELL_SIZE: i32 = crate::reference::blocks::CELL_SIZE as i32;
/// A cluster of outliers lifts the limits of four blocks at most, and another one may be near.
const CLUSTER_BLOCKS: usize = 6;
/// So many times the limit of the blocks around is that of a cluster.
const CLUSTER_EXCESS: f32 = 2.0;
/// The share of a frame in what returns.
const RETURN_RATE: f32 = 0.2;
/// The most by which what returns grows in a frame: an outlier of one frame counts for no more.
const RETURN_GROWTH: f32 = 32.0;
/// What returns is a mean over frames, and of noise.
const RETURN_EXCESS: f32 = 2.8;
/// A place so near to the border of a cell, in cells, is in both.
const NEAR: f32 = 0.25;

/// Of the luminance of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limit {
    /// Luminance above it is cut off; 0: none is.
    pub limit: f32,
    /// The luminance that comes again at its place from frame to frame.
    pub returning: f32,
    /// What is above the limit is one sample in several pixels.
    pub is_cluster: bool,
}

/// A texel of `firefly_limits*`.
pub(crate) fn pack_limit(limit: &Limit) -> u32 {
    let sign = if limit.is_cluster { -1.0 } else { 1.0 };
    let [limit, returning] = [sign * store(limit.limit), store(limit.returning)].map(|l| u32::from(half_bits(l)));
    limit | returning << 16
}

/// The content of a texel of `firefly_limits*`.
pub(crate) fn unpack_limit(texel: u32) -> Limit {
    let limit = from_half_bits(texel as u16);
    Limit { limit: limit.abs(), returning: from_half_bits((texel >> 16) as u16), is_cluster: limit < 0.0 }
}

/// The limit at a pixel.
pub(crate) fn limit_at(firefly_limits: &Image<u32>, p: IVec2) -> Limit {
    unpack_limit(firefly_limits.at(p / CELL_SIZE))
}

/// Inputs of [`firefly_limits`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct FireflyLimitsInputs<'a> {
    /// The image `block_percentiles` of this signal, from the stage of that name.
    pub block_percentiles: &'a Image<u32>,
    /// rgb: irradiance of the signal; a negative alpha marks a pixel without a sample.
    pub irradiance: &'a Image<[f32; 4]>,
    /// Guides of both frames, and what this stage wrote in the previous one, which is not read in a reset frame.
    pub history: Option<(HistoryGuides<'a>, &'a Image<u32>)>,
}

/// One texel a cell; see [`unpack_limit`].
pub(crate) fn firefly_limits(frame: &FrameConstants, tuning: &Tuning, inputs: &FireflyLimitsInputs) -> Image<u32> {
    let cells = |extent: [u32; 2]| extent.map(|side| side.div_ceil(CELL_SIZE as u32));
    let blocks = Blocks::new(frame.render_extent);
    let usual = Image::compute(inputs.block_percentiles.extent(), blocks.extent(), |block| {
        usual_limit(frame, tuning, blocks, inputs.block_percentiles, block)
    });
    Image::compute(cells(inputs.irradiance.extent()), cells(frame.render_extent), |cell| {
        let mut limit = usual.at(block_of(cell * CELL_SIZE));
        let usual = limit.limit;
        let brightest = brightest_of(frame, inputs, cell);
        let before = inputs.history.and_then(|history| returning_before(frame, tuning, history, cell));
        let known = before.unwrap_or(0.0);
        if usual > 0.0 {
            limit.limit = usual.max(RETURN_EXCESS * known);
        }
        let most = if usual > 0.0 { usual + RETURN_GROWTH * known } else { brightest };
        let now = brightest.min(most);
        limit.returning = before.map_or(now, |before| before * (1.0 - RETURN_RATE) + now * RETURN_RATE);
        pack_limit(&limit)
    })
}

/// By one frame alone. 0: next to all samples are black, which does not say what is bright.
fn usual_limit(frame: &FrameConstants, tuning: &Tuning, blocks: Blocks, block_percentiles: &Image<u32>, block: IVec2) -> Limit {
    let of = |(_, block)| {
        let percentiles = unpack_percentiles(block_percentiles.at(block));
        let limit = match percentiles.up > 0.0 {
            true => tuning.firefly_bias * frame.filter_exposure + percentiles.up + percentiles.range(tuning),
            false => 0.0,
        };
        (limit, if percentiles.is_clumped { 0.0 } else { limit })
    };
    let beside = blocks.rect().window(block, 1, 1).map(of);
    let (nearby, scattered) = beside.fold((0.0_f32, 0.0_f32), |(a, b), (c, d)| (a.max(c), b.max(d)));
    let mut all: Vec<f32> = blocks.rect().window(block, 2, 1).map(|at| of(at).0).collect();
    all.sort_by(|a, b| b.total_cmp(a));
    let wide = all.get(CLUSTER_BLOCKS).copied().unwrap_or_default();
    let usual = wide.max(scattered);
    let is_cluster = wide > 0.0 && nearby > CLUSTER_EXCESS * usual;
    Limit { limit: if is_cluster { usual } else { nearby }, returning: 0.0, is_cluster }
}

/// Of the surfaces of a cell. The background is not filtered: beside an outline, a bright sky would let outliers of the surface pass.
fn brightest_of(frame: &FrameConstants, inputs: &FireflyLimitsInputs, cell: IVec2) -> f32 {
    let (side, rect) = (0..CELL_SIZE, RenderRect::new(frame.render_extent));
    let pixels = side.clone().flat_map(|y| side.clone().map(move |x| cell * CELL_SIZE + IVec2::new(x, y)));
    let is_surface = |p: &IVec2| inputs.history.is_none_or(|(guides, _)| !unpack_guide(guides.guide.at(*p)).is_background());
    let counted = pixels.filter(|p| rect.contains(*p)).filter(is_surface).map(|p| inputs.irradiance.at(p));
    counted.filter(|texel| texel[3] >= 0.0).map(texel_luminance).fold(0.0, f32::max)
}

/// The luminance that returned where a cell was.
fn returning_before(
    frame: &FrameConstants,
    tuning: &Tuning,
    (guides, limits): (HistoryGuides, &Image<u32>),
    cell: IVec2,
) -> Option<f32> {
    let last = IVec2::from(frame.render_extent.map(|side| side as i32 - 1));
    let tap = guides.nearest(frame, tuning, (cell * CELL_SIZE + CELL_SIZE / 2).min(last))?;
    let position = (tap.as_vec2() + 0.5) / CELL_SIZE as f32 - 0.5;
    let last = IVec2::from(frame.previous_render_extent.map(|side| (side as i32 - 1) / CELL_SIZE));
    let near = |fraction: f32| (position + Vec2::splat(fraction)).floor().as_ivec2().clamp(IVec2::ZERO, last);
    let (first, second) = (near(NEAR), near(1.0 - NEAR));
    let around = [first, IVec2::new(second.x, first.y), IVec2::new(first.x, second.y), second];
    let most = around.into_iter().map(|cell| unpack_limit(limits.at(cell)).returning).fold(0.0, f32::max);
    Some(most * frame.exposure_ratio)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[LIMITS];

pub(crate) const LIMITS: Rule = rule("firefly_limits", Unit::Cell, Reading::Halves, HALF);

/// The limits by what a pass binds.
pub(crate) fn limits_of_pass(b: &Bindings) -> Result<Image<u32>, Error> {
    let history = match b.has("previous_firefly_limits") {
        true => Some((HistoryGuides::of(b)?, b.uint("previous_firefly_limits")?)),
        false => None,
    };
    let (block_percentiles, irradiance) = (b.uint("block_percentiles")?, b.colour("irradiance")?);
    Ok(firefly_limits(b.frame, b.tuning, &FireflyLimitsInputs { block_percentiles, irradiance, history }))
}

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let limits = limits_of_pass(b)?;
    b.write("firefly_limits", limits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nodes::block_percentiles::twin::{block_percentiles, BlockPercentilesInputs};
    use crate::reference::test_scene::*;

    const EXTENT: [u32; 2] = [72, 56];
    /// A place in the middle of a block.
    const PLACE: IVec2 = IVec2::new(34, 26);

    /// Limits of a frame after those of the one before.
    fn limits(irradiance: &Image<[f32; 4]>, before: Option<&Image<u32>>) -> Image<u32> {
        limits_over(&guides(EXTENT, |_, _| surface(2.0)), irradiance, before)
    }

    fn limits_over(guides: &Guides, irradiance: &Image<[f32; 4]>, before: Option<&Image<u32>>) -> Image<u32> {
        let (frame, tuning) = (frame(EXTENT), svgf_tuning());
        let inputs = BlockPercentilesInputs { guide: Some(&guides.guide), irradiance };
        let block_percentiles = &block_percentiles(&frame, &tuning, &inputs);
        let of_both = HistoryGuides { guide: &guides.guide, surface_motion: &guides.surface_motion, previous_guide: &guides.guide };
        let history = before.map(|before| (of_both, before));
        firefly_limits(&frame, &tuning, &FireflyLimitsInputs { block_percentiles, irradiance, history })
    }

    /// Noise between 0 and 1 with bright pixels at some places around [`PLACE`].
    fn with_bright(seed: u32, places: &[(i32, i32)]) -> Image<[f32; 4]> {
        let mut image = noise(EXTENT, seed);
        for &(x, y) in places {
            let [x, y] = (PLACE + IVec2::new(x, y)).to_array();
            *image.get_mut(x, y).expect("inside") = [500.0; 4];
        }
        image
    }

    #[test]
    fn a_cluster_is_told_from_scattered_samples() {
        let square = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (0, 2), (1, 2), (2, 2)];
        let apart = square.map(|(x, y)| (2 * x - 1, 2 * y - 1));
        let (cluster, scattered) = (limits(&with_bright(3, &square), None), limits(&with_bright(3, &apart), None));
        let [cluster, scattered] = [limit_at(&cluster, PLACE), limit_at(&scattered, PLACE)];
        assert!(cluster.is_cluster && cluster.limit < 4.0, "{cluster:?}");
        assert!(!scattered.is_cluster && scattered.limit > 500.0, "{scattered:?}");
    }

    #[test]
    fn a_lit_patch_is_no_cluster() {
        let patch = |size: i32| {
            let image =
                paint(
                    EXTENT,
                    |x, y| if (30..30 + size).contains(&x) && (22..22 + size).contains(&y) { [9.0; 4] } else { [0.1; 4] },
                );
            limit_at(&limits(&image, None), PLACE)
        };
        assert!(!patch(9).is_cluster && patch(9).limit >= 9.0, "{:?}", patch(9));
        // So small, it is one until it returns.
        assert!(patch(3).is_cluster && patch(3).limit < 1.0, "{:?}", patch(3));
    }

    #[test]
    fn light_that_returns_is_no_outlier() {
        let run = |is_lit: fn(u32) -> bool| {
            (0..16).fold(None, |before: Option<Image<u32>>, i| {
                let image = with_bright(20 + i, if is_lit(i) { &[(1, 1)] } else { &[] });
                Some(limits(&image, before.as_ref()))
            })
        };
        let at = |image: Option<Image<u32>>| limit_at(&image.expect("frames"), PLACE);
        let (caustic, once, never) = (at(run(|i| i % 2 == 1)), at(run(|i| i == 3)), at(run(|_| false)));
        assert!(caustic.limit > 500.0, "{caustic:?}");
        assert!(once.limit < 3.0 * never.limit && never.limit < 4.0, "{once:?} {never:?}");
    }

    #[test]
    fn a_bright_sky_beside_an_outline_is_no_light_that_returns() {
        let is_sky = |x: i32| x > PLACE.x;
        let guides = guides(EXTENT, |x, _| if is_sky(x) { surface(0.0) } else { surface(2.0) });
        let run = |sky: f32| {
            let nothing = Image::new(EXTENT.map(|side| side.div_ceil(CELL_SIZE as u32)), 0);
            let limits = (0..16).fold(nothing, |before, i| {
                let noise = noise(EXTENT, 20 + i);
                let image = paint(EXTENT, |x, y| if is_sky(x) { [sky; 4] } else { noise.at(IVec2::new(x, y)) });
                limits_over(&guides, &image, Some(&before))
            });
            limit_at(&limits, PLACE)
        };
        assert_eq!(run(1000.0), run(0.0));
    }

    #[test]
    fn among_black_samples_nothing_is_cut_off() {
        let image = paint(EXTENT, |x, y| if (x * 7 + y * 13) % 61 == 0 { [3.0; 4] } else { [0.0; 4] });
        assert!(limits(&image, None).texels().iter().all(|texel| unpack_limit(*texel).limit == 0.0));
    }
}

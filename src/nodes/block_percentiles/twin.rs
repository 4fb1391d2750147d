//! The stage `block_percentiles` \[PSVGF\]: two percentiles of luminance in every 8×8 pixels.

use crate::reference::binary16::{from_half_bits, half_bits, store};
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{allocated_blocks, Blocks};
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::guide::unpack_guide;
use crate::reference::luminance::texel_luminance;
use crate::reference::rules::{rule, HALF};
use crate::reference::Image;
use crate::{Error, FrameConstants, Tuning};
use glam::IVec2;

/// Percentiles of the luminance of the irradiance of a block's surface pixels; 0, 0 without any.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Percentiles {
    /// The lower one.
    pub low: f32,
    /// The upper one.
    pub up: f32,
    /// The pixels from the upper one on lie beside each other in a darker block.
    pub is_clumped: bool,
}

impl Percentiles {
    /// Distance by which a luminance may leave the percentiles and still be usual: IPR.
    pub(crate) fn range(&self, tuning: &Tuning) -> f32 {
        (self.up - self.low) * tuning.percentile_range
    }
}

/// A texel of `block_percentiles*`.
pub(crate) fn pack_percentiles(percentiles: &Percentiles) -> u32 {
    let sign = if percentiles.is_clumped { -1.0 } else { 1.0 };
    u32::from(half_bits(store(percentiles.low))) | u32::from(half_bits(sign * store(percentiles.up))) << 16
}

/// The content of a texel of `block_percentiles*`.
pub(crate) fn unpack_percentiles(texel: u32) -> Percentiles {
    let up = from_half_bits((texel >> 16) as u16);
    Percentiles { low: from_half_bits(texel as u16), up: up.abs(), is_clumped: up < 0.0 }
}

/// A cluster of outliers, such as a sample that a pixel filter spread over 3×3 pixels, is less than the rest of a block.
const REST_SHARE: f32 = 0.7;
/// How far it is above that rest.
const CLUMP_EXCESS: f32 = 3.0;

/// Inputs of [`block_percentiles`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockPercentilesInputs<'a> {
    /// The image `guide`, from the stage `import`; `None` for a volume, of which every pixel takes part.
    pub guide: Option<&'a Image<[u16; 4]>>,
    /// rgb: irradiance of one signal, as written by `demodulate`; a negative alpha marks a pixel without a sample.
    pub irradiance: &'a Image<[f32; 4]>,
}

/// One texel a block; see [`unpack_percentiles`].
pub(crate) fn block_percentiles(frame: &FrameConstants, tuning: &Tuning, inputs: &BlockPercentilesInputs) -> Image<u32> {
    let blocks = Blocks::new(frame.render_extent);
    Image::compute(allocated_blocks(inputs.irradiance), blocks.extent(), |block| {
        let is_sample = |p: &IVec2| inputs.irradiance.at(*p)[3] >= 0.0;
        let is_surface = |p: &IVec2| !inputs.guide.is_some_and(|guide| unpack_guide(guide.at(*p)).is_background());
        let takes_part = |p: &IVec2| is_surface(p) && is_sample(p);
        let pixels: Vec<IVec2> = Blocks::pixels(block, frame.render_extent).filter(takes_part).collect();
        let luminance_at = |p: &IVec2| texel_luminance(inputs.irradiance.at(*p));
        let mut luminances: Vec<f32> = pixels.iter().map(luminance_at).collect();
        luminances.sort_by(f32::total_cmp);
        let at = |share: f32| match luminances.len() {
            0 => 0.0,
            n => luminances[((share * (n - 1) as f32 + 0.5) as usize).min(n - 1)],
        };
        let low = tuning.percentile_low.min(tuning.percentile_up);
        let (up, far_above) = (at(tuning.percentile_up), CLUMP_EXCESS * at(REST_SHARE));
        let is_clumped = |p: &&IVec2| {
            let beside = pixels.iter().filter(|q| (**q - **p).abs().element_sum() == 1 && luminance_at(q) > far_above);
            beside.count() >= 2
        };
        let brightest: Vec<&IVec2> = pixels.iter().filter(|p| luminance_at(p) >= up).collect();
        let clumped = brightest.iter().copied().filter(is_clumped).count();
        pack_percentiles(&Percentiles { low: at(low), up, is_clumped: 2 * clumped > brightest.len() })
    })
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    rule("block_percentiles_0", Unit::Block, Reading::Halves, HALF),
    rule("block_percentiles_1", Unit::Block, Reading::Halves, HALF),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let guide = if b.is_on("VOLUME")? { None } else { Some(b.packed("guide")?) };
    let of_signal = |irradiance| block_percentiles(b.frame, b.tuning, &BlockPercentilesInputs { guide, irradiance });
    let percentiles = b.colours("irradiance")?.into_iter().map(of_signal).collect();
    b.write_signals("block_percentiles", percentiles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;

    #[test]
    fn only_real_surface_pixels_count() {
        let extent = [11, 8];
        let guides = guides(extent, |x, y| if x == 9 && y == 0 { Surface::default() } else { surface(2.0) });
        use crate::reference::Surface;
        // The right block has 3 columns: luminances 8 to 10, of which one pixel is background.
        let irradiance = paint(extent, |x, y| if x == 9 && y == 0 { [1000.0; 4] } else { [x as f32; 4] });
        let inputs = BlockPercentilesInputs { guide: Some(&guides.guide), irradiance: &irradiance };
        let tuning = Tuning { percentile_low: 0.0, percentile_up: 1.0, ..svgf_tuning() };
        let blocks = block_percentiles(&frame(extent), &tuning, &inputs);
        assert_eq!(blocks.extent(), [2, 1]);
        let of = |x| unpack_percentiles(*blocks.get(x, 0).expect("inside"));
        assert_eq!((of(0).low, of(0).up.round()), (0.0, 7.0));
        assert_eq!((of(1).low.round(), of(1).up.round()), (8.0, 10.0));
    }

    #[test]
    fn a_block_of_sky_has_none() {
        let extent = [8, 8];
        let guides = guides(extent, |_, _| crate::reference::Surface::default());
        let irradiance = noise(extent, 1);
        let inputs = BlockPercentilesInputs { guide: Some(&guides.guide), irradiance: &irradiance };
        let blocks = block_percentiles(&frame(extent), &svgf_tuning(), &inputs);
        assert_eq!(unpack_percentiles(blocks.texels()[0]), Percentiles::default());
    }
}

//! The stage `visibility_samples`: the visibility of lights and the distances of their occluders, without what is none.

use crate::reference::binary16::LARGEST_HALF;
use crate::reference::bindings::Bindings;
use crate::reference::blocks::{block_of, Blocks};
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::guide::unpack_guide;
use crate::reference::rules::{rule, HALF, STATISTICS};
use crate::reference::statistics::count;
use crate::reference::visibility::{
    largest, lights_of, of_light, pack_halves, write_words, Visible, Words, BLOCK_HAS_LIT, BLOCK_HAS_OCCLUDED, NO_SAMPLE,
};
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};

/// The bits that a sample of a surface sets in its block.
fn kinds_of(visibility: Visible) -> u32 {
    let exists = visibility[0] <= 1.0;
    let lit = if exists && largest(visibility) > 0.0 { BLOCK_HAS_LIT } else { 0 };
    let occluded = if exists && largest(visibility.map(|v| 1.0 - v)) > 0.0 { BLOCK_HAS_OCCLUDED } else { 0 };
    lit | occluded
}

/// Adds to words of samples what the blocks around them hold. `kinds`: of each pixel alone, see [`kinds_of`].
fn with_blocks(words: &Image<Words>, kinds: &Image<u32>, render_extent: [u32; 2]) -> Image<Words> {
    Image::compute(words.extent(), render_extent, |p| {
        let [word, colours] = words.at(p);
        [Blocks::pixels(block_of(p), render_extent).fold(word, |bits, q| bits | kinds.at(q)), colours]
    })
}

/// Samples of a light, half floats: visibility in the low bits, [`NO_SAMPLE`] where there is none, distance of the occluder in the high
/// ones, 0 for none; in the second word green and blue. With the counters of what was none. A grey light has red alone.
pub(crate) fn visibility_samples(
    frame: &FrameConstants,
    guide: &Image<[u16; 4]>,
    noisy_visibility: &Image<[f32; 4]>,
    occluder_distance: &Image<[f32; 4]>,
    coloured: bool,
) -> (Image<Words>, Statistics) {
    let texels = Image::compute(guide.extent(), frame.render_extent, |p| {
        if unpack_guide(guide.at(p)).is_background() {
            return (pack_halves([1.0; 3], 0.0), 0, false, false);
        }
        let ([red, green, blue, _], d) = (noisy_visibility.at(p), occluder_distance.at(p)[0]);
        let v = if coloured { [red, green, blue] } else { [red; 3] };
        let is_finite = v.iter().all(|v| v.is_finite());
        let visibility = if is_finite { v.map(|v| v.clamp(0.0, 1.0)) } else { [NO_SAMPLE; 3] };
        let distance = if d.is_finite() && d > 0.0 { d.min(LARGEST_HALF) } else { 0.0 };
        (pack_halves(visibility, distance), kinds_of(visibility), !v.iter().all(|v| (0.0..=1.0).contains(v)), d.is_nan() || d < 0.0)
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Visibility] = count(texels.texels().iter().map(|t| t.2));
    statistics[Counter::OccluderDistance] = count(texels.texels().iter().map(|t| t.3));
    (with_blocks(&texels.map(|t| t.0), &texels.map(|t| t.1), frame.render_extent), statistics)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    rule("visibility_samples", Unit::Pixel, Reading::Halves, HALF),
    rule("sample_colours", Unit::Pixel, Reading::Halves, HALF),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (guide, coloured) = (b.packed("guide")?, b.has("sample_colours"));
    let (mut words, mut sum) = (Vec::new(), Statistics::default());
    for light in 0..lights_of(b) {
        let [visibility, distance] = ["noisy_visibility", "occluder_distance"].map(|name| b.colour(&of_light(name, light)));
        let (samples, statistics) = visibility_samples(b.frame, guide, visibility?, distance?, coloured);
        sum = sum.plus(&statistics);
        words.push(samples);
    }
    b.count(&sum)?;
    write_words(b, ["visibility_samples", "sample_colours"], &words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::binary16::from_half_bits;
    use crate::reference::test_scene::*;
    use glam::IVec2;

    #[test]
    fn what_is_no_visibility_is_counted_and_stops() {
        let values = [0.0, 1.0, 0.5, -0.25, 1.5, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        let distances = [0.0, 2.0, f32::INFINITY, -1.0, f32::NAN, 1e9, f32::NEG_INFINITY, -0.0];
        let g = guides([9, 1], |x, _| if x == 8 { Default::default() } else { surface(1.0) });
        let of = |values: [f32; 8]| paint([9, 1], move |x, _| [values.get(x as usize).copied().unwrap_or(f32::NAN); 4]);
        let (samples, statistics) = visibility_samples(&frame([9, 1]), &g.guide, &of(values), &of(distances), false);
        let halves =
            |shift: u32| samples.texels().iter().map(|t| from_half_bits((t[0] >> shift) as u16 & 0x7fff)).collect::<Vec<_>>();
        assert_eq!(halves(0), [0.0, 1.0, 0.5, 0.0, 1.0, NO_SAMPLE, NO_SAMPLE, NO_SAMPLE, 1.0]);
        assert_eq!(halves(16), [0.0, 2.0, 0.0, 0.0, 0.0, 65504.0, 0.0, 0.0, 0.0]);
        let counted = [Counter::Visibility, Counter::OccluderDistance].map(|c| statistics[c]);
        assert_eq!(counted, [5, 3]);
    }

    #[test]
    fn a_block_tells_the_kinds_of_its_samples() {
        let g = guides([40, 8], |x, _| if x >= 32 { Default::default() } else { surface(1.0) });
        // Blocks: lit but for one pixel, occluded but for a hole, lit, half lit, background.
        let values = paint([40, 8], |x, y| match (x / 8, x % 8 == 3 && y == 5) {
            (0, true) | (1, false) => [0.0; 4],
            (1, true) => [f32::NAN; 4],
            (3, _) => [0.5; 4],
            _ => [1.0; 4],
        });
        let (samples, _) = visibility_samples(&frame([40, 8]), &g.guide, &values, &Image::new([40, 8], [0.0; 4]), false);
        let both = BLOCK_HAS_LIT | BLOCK_HAS_OCCLUDED;
        let expected = [both, BLOCK_HAS_OCCLUDED, BLOCK_HAS_LIT, both, 0];
        for (x, y) in (0..40).flat_map(|x| (0..8).map(move |y| (x, y))) {
            assert_eq!(samples.at(IVec2::new(x, y))[0] & both, expected[x as usize / 8], "{x},{y}");
        }
    }

    #[test]
    fn a_colour_is_kept_and_bad_where_one_component_is() {
        let g = guides([4, 1], |_, _| surface(1.0));
        let seen = [[1.0, 0.5, 0.25], [0.0, 0.0, 0.0], [1.0, f32::NAN, 1.0], [0.5, 2.0, 0.5]];
        let given = paint([4, 1], |x, _| {
            let [r, g, b] = seen[x as usize];
            [r, g, b, 0.0]
        });
        let (samples, statistics) = visibility_samples(&frame([4, 1]), &g.guide, &given, &Image::new([4, 1], [2.0; 4]), true);
        let halves = |t: u32| [t, t >> 16].map(|bits| from_half_bits(bits as u16 & 0x7fff));
        let read = samples.texels().iter().map(|t| [halves(t[0]), halves(t[1])].concat()).collect::<Vec<_>>();
        let none = NO_SAMPLE;
        assert_eq!(read, [[1.0, 2.0, 0.5, 0.25], [0.0, 2.0, 0.0, 0.0], [none, 2.0, none, none], [0.5, 2.0, 1.0, 0.5]]);
        assert_eq!(statistics[Counter::Visibility], 2);
    }
}

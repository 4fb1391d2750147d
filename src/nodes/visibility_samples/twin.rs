//! The stage `visibility_samples`: the visibility of a light and the distance of its occluder, without what is none.

use crate::reference::binary16::{half_bits, LARGEST_HALF};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::guide::unpack_guide;
use crate::reference::rules::{rule, HALF, STATISTICS};
use crate::reference::statistics::count;
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};

/// The visibility of a pixel that has no sample.
pub(crate) const NO_SAMPLE: f32 = -1.0;

/// Samples of a host, half floats: visibility in the low bits, [`NO_SAMPLE`] where there is none, distance of the occluder in the
/// high ones, 0 for none; with the counters of what was none.
pub(crate) fn visibility_samples(
    frame: &FrameConstants,
    guide: &Image<[u16; 4]>,
    noisy_visibility: &Image<[f32; 4]>,
    occluder_distance: &Image<[f32; 4]>,
) -> (Image<u32>, Statistics) {
    let texels = Image::compute(guide.extent(), frame.render_extent, |p| {
        if unpack_guide(guide.at(p)).is_background() {
            return (packed(1.0, 0.0), false, false);
        }
        let (v, d) = (noisy_visibility.at(p)[0], occluder_distance.at(p)[0]);
        let visibility = if v.is_finite() { v.clamp(0.0, 1.0) } else { NO_SAMPLE };
        let distance = if d.is_finite() && d > 0.0 { d.min(LARGEST_HALF) } else { 0.0 };
        (packed(visibility, distance), !(0.0..=1.0).contains(&v), d.is_nan() || d < 0.0)
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Visibility] = count(texels.texels().iter().map(|t| t.1));
    statistics[Counter::OccluderDistance] = count(texels.texels().iter().map(|t| t.2));
    (texels.map(|t| t.0), statistics)
}

fn packed(visibility: f32, distance: f32) -> u32 {
    u32::from(half_bits(visibility)) | u32::from(half_bits(distance)) << 16
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, rule("visibility_samples", Unit::Pixel, Reading::Halves, HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (guide, visibility, distance) = (b.packed("guide")?, b.colour("noisy_visibility")?, b.colour("occluder_distance")?);
    let (samples, statistics) = visibility_samples(b.frame, guide, visibility, distance);
    b.count(&statistics)?;
    b.write("visibility_samples", samples)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::binary16::from_half_bits;
    use crate::reference::test_scene::*;

    #[test]
    fn what_is_no_visibility_is_counted_and_stops() {
        let values = [0.0, 1.0, 0.5, -0.25, 1.5, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        let distances = [0.0, 2.0, f32::INFINITY, -1.0, f32::NAN, 1e9, f32::NEG_INFINITY, -0.0];
        let g = guides([9, 1], |x, _| if x == 8 { Default::default() } else { surface(1.0) });
        let of = |values: [f32; 8]| paint([9, 1], move |x, _| [values.get(x as usize).copied().unwrap_or(f32::NAN); 4]);
        let (samples, statistics) = visibility_samples(&frame([9, 1]), &g.guide, &of(values), &of(distances));
        let halves = |shift: u32| samples.texels().iter().map(|t| from_half_bits((t >> shift) as u16)).collect::<Vec<_>>();
        assert_eq!(halves(0), [0.0, 1.0, 0.5, 0.0, 1.0, NO_SAMPLE, NO_SAMPLE, NO_SAMPLE, 1.0]);
        assert_eq!(halves(16), [0.0, 2.0, 0.0, 0.0, 0.0, 65504.0, 0.0, 0.0, 0.0]);
        let counted = [Counter::Visibility, Counter::OccluderDistance].map(|c| statistics[c]);
        assert_eq!(counted, [5, 3]);
    }
}

//! The stage `shadowed_light`: the light of the sources whose visibility was filtered is added.

use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::outgoing::Outgoing;
use crate::reference::rules::{pixels, HALF, STATISTICS};
use crate::reference::statistics::count;
use crate::reference::visibility::{each, of_light, Visible};
use crate::reference::Image;
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};

/// `radiance + unshadowed_direct · visibility`, with the counter of light that is not finite.
pub(crate) fn shadowed_light(
    frame: &FrameConstants,
    radiance: &Image<[f32; 4]>,
    unshadowed_direct: &Image<[f32; 4]>,
    visibility: &Image<Visible>,
    outgoing: Outgoing,
) -> (Image<[f32; 4]>, Statistics) {
    let texels = Image::compute(radiance.extent(), frame.render_extent, |p| {
        let (before, [r, g, b, _]) = (radiance.at(p), unshadowed_direct.at(p));
        if [r, g, b].iter().any(|c| !c.is_finite()) {
            return (before, true);
        }
        let seen = visibility.at(p);
        let [r, g, b] = each(|c| outgoing.store(before[c] + [r, g, b][c].clamp(0.0, outgoing.brightest()) * seen[c]));
        ([r, g, b, 1.0], false)
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Radiance] = count(texels.texels().iter().map(|t| t.1));
    (texels.map(|t| t.0), statistics)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, pixels("radiance", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (outgoing, mut statistics_sum) = (Outgoing::of(b)?, Statistics::default());
    let mut radiance = b.colour("radiance")?.clone();
    for light in 0.. {
        let name = of_light("denoised_visibility", light);
        if !b.has(&name) {
            break;
        }
        let visibility = match b.is_on("COLOURED")? {
            true => b.colour(&name)?.map(|[red, green, blue, _]| [*red, *green, *blue]),
            false => b.scalar(&name)?.map(|v| [*v; 3]),
        };
        let Some(light) = b.optional_colour(&of_light("unshadowed_direct", light))? else { continue };
        let (sum, statistics) = shadowed_light(b.frame, &radiance, light, &visibility, outgoing);
        radiance = sum;
        statistics_sum = statistics_sum.plus(&statistics);
    }
    b.count(&statistics_sum)?;
    b.write("radiance", radiance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::test_scene::*;

    #[test]
    fn light_that_is_not_finite_is_counted_and_not_added() {
        let light = paint([4, 1], |x, _| {
            [[2.0, 4.0, 8.0, 0.0], [f32::NAN, 1.0, 1.0, 0.0], [1.0, f32::INFINITY, 1.0, 0.0], [-1.0, 1e9, 1.0, 0.0]][x as usize]
        });
        let radiance = Image::new([4, 1], [1.0, 1.0, 1.0, 1.0]);
        let (sum, statistics) = shadowed_light(&frame([4, 1]), &radiance, &light, &Image::new([4, 1], [0.5, 0.5, 0.25]), Outgoing::Halves);
        assert_eq!(sum.texels(), [[2.0, 3.0, 3.0, 1.0], [1.0; 4], [1.0; 4], [1.0, 32752.0, 1.25, 1.0]]);
        assert_eq!(statistics[Counter::Radiance], 2);
    }
}

//! The stage `shadowed_light`: the light of the sources whose visibility was filtered is added.

use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::outgoing::Outgoing;
use crate::reference::rules::{pixels, HALF, STATISTICS};
use crate::reference::visibility::{each, of_light, Visible};
use crate::reference::Image;
use crate::{Counter, Error, FrameConstants, Input, Statistics};

/// A light without what is in the way, and its visibility.
type Lit<'a> = (&'a Image<[f32; 4]>, Image<Visible>);

/// `radiance + Σ unshadowed_direct · visibility`, with the counter of light that is not finite.
pub(crate) fn shadowed_light(
    frame: &FrameConstants,
    radiance: &Image<[f32; 4]>,
    lights: &[Lit],
    outgoing: Outgoing,
) -> (Image<[f32; 4]>, Statistics) {
    let texels = Image::compute(radiance.extent(), frame.render_extent, |p| {
        let is_light = |(light, _): &&Lit| light.at(p)[..3].iter().all(|c| c.is_finite());
        let good: Vec<_> = lights.iter().filter(is_light).collect();
        let bad = lights.len() - good.len();
        if good.is_empty() {
            return (radiance.at(p), bad);
        }
        let light = |(light, seen): &&Lit, c: usize| light.at(p)[c].clamp(0.0, outgoing.brightest()) * seen.at(p)[c];
        let sum = each(|c| good.iter().fold(radiance.at(p)[c], |sum, lit| sum + light(lit, c)));
        let [r, g, b] = sum.map(|c| outgoing.store(c));
        ([r, g, b, 1.0], bad)
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Radiance] = texels.texels().iter().map(|t| t.1 as u32).sum();
    (texels.map(|t| t.0), statistics)
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, pixels("radiance", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let mut lights = Vec::new();
    for (light, unshadowed) in Input::UNSHADOWED_DIRECT.iter().enumerate() {
        let name = of_light("denoised_visibility", light);
        let Some(unshadowed) = b.optional_colour(unshadowed.name)?.filter(|_| b.has(&name)) else { continue };
        lights.push((
            unshadowed,
            match b.is_on("COLOURED")? {
                true => b.colour(&name)?.map(|[red, green, blue, _]| [*red, *green, *blue]),
                false => b.scalar(&name)?.map(|v| [*v; 3]),
            },
        ));
    }
    let (sum, statistics) = shadowed_light(&b.frame.of_guides(), b.colour("radiance")?, &lights, Outgoing::of(b)?);
    b.count(&statistics)?;
    b.write("radiance", sum)
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
        let (sum, statistics) =
            shadowed_light(&frame([4, 1]), &radiance, &[(&light, Image::new([4, 1], [0.5, 0.5, 0.25]))], Outgoing::Halves);
        assert_eq!(sum.texels(), [[2.0, 3.0, 3.0, 1.0], [1.0; 4], [1.0; 4], [1.0, 32752.0, 1.25, 1.0]]);
        assert_eq!(statistics[Counter::Radiance], 2);
    }
}

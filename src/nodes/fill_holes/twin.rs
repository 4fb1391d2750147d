//! The stage `fill_holes`: pixels without a sample get the mean of the samples around them.

use crate::reference::binary16::store;
use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::geometry_weights::Geometry;
use crate::reference::rules::{pixels, HALF, STATISTICS};
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Error, FrameConstants, Statistics, Tuning};
use glam::IVec2;

/// Inputs of [`fill_holes`]; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FillHolesInputs<'a> {
    /// The image `guide`, from the stage `import`.
    pub guide: &'a Image<[u16; 4]>,
    /// The image `depth_gradient`, from the stage `import`.
    pub depth_gradient: &'a Image<u32>,
    /// rgb: irradiance of one signal; alpha: [`HOLE`](crate::reference::luminance::HOLE) where there is none.
    pub holed: &'a Image<[f32; 4]>,
    /// Pixels to each side in which samples are looked for.
    pub radius: u32,
}

/// Irradiance without holes, half precision, alpha as it came; and how many holes had no sample around them, as radiance that is not
/// finite.
pub(crate) fn fill_holes(frame: &FrameConstants, tuning: &Tuning, inputs: &FillHolesInputs) -> (Image<[f32; 4]>, Statistics) {
    let geometry = Geometry::new(frame, tuning, inputs.guide, inputs.depth_gradient);
    let texels = Image::compute(inputs.holed.extent(), frame.render_extent, |p| {
        let [.., alpha] = inputs.holed.at(p);
        if alpha >= 0.0 {
            return (inputs.holed.at(p), false);
        }
        let taps = taps_around(frame, &geometry, inputs, p);
        // Where nothing around is the same surface, everything counts.
        let mean = weighted_mean(&taps, |tap| tap.by_distance * tap.by_edges, 1e-6)
            .or_else(|| weighted_mean(&taps, |tap| tap.by_distance, 0.0));
        let [r, g, b] = mean.unwrap_or_default().map(store);
        ([r, g, b, alpha], mean.is_none())
    });
    let mut statistics = Statistics::default();
    statistics[Counter::Radiance] = texels.texels().iter().map(|texel| u32::from(texel.1)).sum();
    (texels.map(|texel| texel.0), statistics)
}

/// A sample near a hole.
struct Tap {
    irradiance: [f32; 3],
    by_distance: f32,
    by_edges: f32,
}

/// The samples around a hole: of surfaces for a surface, of the background for the background.
fn taps_around(frame: &FrameConstants, geometry: &Geometry, inputs: &FillHolesInputs, p: IVec2) -> Vec<Tap> {
    let is_background = geometry.is_background(p);
    let window = RenderRect::new(frame.render_extent).window(p, inputs.radius as i32, 1);
    let samples = window.filter(|(_, q)| inputs.holed.at(*q)[3] >= 0.0 && geometry.is_background(*q) == is_background);
    let tap = |(offset, q): (IVec2, IVec2)| {
        let [r, g, b, _] = inputs.holed.at(q);
        let by_edges = if is_background { 1.0 } else { geometry.weight(p, q) };
        Tap { irradiance: [r, g, b], by_distance: 1.0 / offset.as_vec2().length_squared(), by_edges }
    };
    samples.map(tap).collect()
}

/// None where the weights add up to no more than `least`.
fn weighted_mean(taps: &[Tap], weight: impl Fn(&Tap) -> f32, least: f32) -> Option<[f32; 3]> {
    let sum: f32 = taps.iter().map(&weight).sum();
    let component = |i: usize| taps.iter().map(|tap| weight(tap) * tap.irradiance[i]).sum::<f32>() / sum;
    (sum > least).then(|| [0, 1, 2].map(component))
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, pixels("filled", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = FillHolesInputs {
        guide: b.packed("guide")?,
        depth_gradient: b.uint("depth_gradient")?,
        holed: b.colour("holed")?,
        radius: b.constant("RADIUS")?,
    };
    let (filled, statistics) = fill_holes(b.frame, b.tuning, &inputs);
    b.count(&statistics)?;
    b.write("filled", filled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::luminance::HOLE;
    use crate::reference::test_scene::*;
    use crate::reference::Surface;

    const EXTENT: [u32; 2] = [9, 6];

    fn filled(
        radius: u32,
        surfaces: impl Fn(i32, i32) -> Surface + Sync,
        holed: &Image<[f32; 4]>,
    ) -> (Image<[f32; 4]>, Statistics) {
        let guides = guides(EXTENT, surfaces);
        let inputs = FillHolesInputs { guide: &guides.guide, depth_gradient: &guides.depth_gradient, holed, radius };
        fill_holes(&frame(EXTENT), &Tuning::default(), &inputs)
    }

    fn of_a_checkerboard(value: impl Fn(i32, i32) -> f32 + Sync) -> Image<[f32; 4]> {
        paint(EXTENT, |x, y| if (x + y) % 2 == 0 { [value(x, y), value(x, y), value(x, y), 0.0] } else { [0.0, 0.0, 0.0, HOLE] })
    }

    #[test]
    fn a_hole_takes_the_mean_of_its_neighbours_and_keeps_its_mark() {
        let (output, statistics) = filled(1, |_, _| surface(2.0), &of_a_checkerboard(|x, _| x as f32));
        // The samples left, right, above and below hold 2, 4, 3 and 3.
        assert_eq!(*output.get(3, 2).expect("inside"), [3.0, 3.0, 3.0, HOLE]);
        assert_eq!(*output.get(4, 2).expect("inside"), [4.0, 4.0, 4.0, 0.0], "a sample stays");
        assert_eq!(statistics[Counter::Radiance], 0);
    }

    #[test]
    fn a_hole_takes_nothing_from_another_surface_but_where_there_is_nothing_else() {
        let near = |x: i32| x < 4;
        let input = of_a_checkerboard(|x, _| if near(x) { 1.0 } else { 9.0 });
        let (output, _) = filled(1, |x, _| surface(if near(x) { 2.0 } else { 8.0 }), &input);
        assert!(output.texels().chunks(EXTENT[0] as usize).all(|row| row[3][0] == 1.0 && row[4][0] == 9.0));
        // A single pixel of sky among surfaces has no sky around it, and one of a surface in the sky no surface: black, and counted.
        let (output, statistics) = filled(1, |x, y| if (x, y) == (3, 2) { Surface::default() } else { surface(2.0) }, &input);
        assert_eq!((*output.get(3, 2).expect("inside"), statistics[Counter::Radiance]), ([0.0, 0.0, 0.0, HOLE], 1));
        // A surface whose neighbours are all other surfaces takes their mean.
        let (output, statistics) = filled(1, |x, y| surface(if (x, y) == (3, 2) { 2.0 } else { 8.0 }), &input);
        assert_eq!((output.get(3, 2).expect("inside")[0], statistics[Counter::Radiance]), (3.0, 0));
    }

    #[test]
    fn one_sample_of_4x4_reaches_every_pixel() {
        let input = paint(EXTENT, |x, y| if x % 4 == 1 && y % 4 == 2 { [0.5, 0.25, 2.0, 0.0] } else { [0.0, 0.0, 0.0, HOLE] });
        let (output, statistics) = filled(3, |_, _| surface(2.0), &input);
        // The right column lies beyond the last whole block.
        assert!(output.texels().iter().enumerate().all(|(i, t)| i % 9 == 8 || t[..3] == [0.5, 0.25, 2.0]), "{output:?}");
        assert_eq!(statistics[Counter::Radiance], 0);
    }
}

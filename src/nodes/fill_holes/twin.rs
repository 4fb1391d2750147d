//! The stage `fill_holes`: pixels without a sample get the mean of the samples around them.

use crate::reference::bindings::Bindings;
use crate::reference::compare::Rule;
use crate::reference::holes::{fill_holes, FillHolesInputs};
use crate::reference::rules::{pixels, HALF, STATISTICS};
use crate::Error;

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[STATISTICS, pixels("filled", HALF)];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let inputs = FillHolesInputs { guide: b.packed("guide")?, holed: b.colour("holed")?, radius: b.constant("RADIUS")? };
    let (filled, statistics) = fill_holes(b.frame, b.tuning, &inputs);
    b.count(&statistics)?;
    b.write("filled", filled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::holes::{EMPTY_HOLE, HOLE};
    use crate::reference::test_scene::*;
    use crate::reference::Image;
    use crate::reference::Surface;
    use crate::{Counter, Statistics, Tuning};

    const EXTENT: [u32; 2] = [9, 6];

    fn filled(
        radius: u32,
        surfaces: impl Fn(i32, i32) -> Surface + Sync,
        holed: &Image<[f32; 4]>,
    ) -> (Image<[f32; 4]>, Statistics) {
        let guides = guides(EXTENT, surfaces);
        let inputs = FillHolesInputs { guide: &guides.guide, holed, radius };
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
        assert_eq!((*output.get(3, 2).expect("inside"), statistics[Counter::Radiance]), ([0.0, 0.0, 0.0, EMPTY_HOLE], 1));
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

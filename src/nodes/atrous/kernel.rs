//! The kernels of the wavelet levels: which pixels of the grid of a level are taps, and how much each counts.

use crate::choice::choices;

choices! {
    /// The kernel of a level.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Kernel {
        /// 5×5 B3 spline \[SVGF\]: 25 taps.
        #[default]
        Spline = 0 => "spline",
        /// 3×3 box \[ASVGF\]: 9 taps, 1, 2, 4, 7, 15, 31, ... pixels apart. With even steps alone no level but the first would mix even
        /// pixels with odd ones, which leaves a lattice where the first one refuses outliers.
        Box = 1 => "box",
        /// The pixel and six around it: 7 taps. They are those of the box without the two beside it on even levels, without the two
        /// above and below it on odd ones, so that two levels together look the same way in both directions.
        Hexagon = 2 => "hexagon",
    }
}

/// One axis of the B3 spline, from the centre outwards \[EAW\].
const SPLINE: [f32; 3] = [3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

impl Kernel {
    /// The largest distance of a tap along an axis, in steps of the level.
    pub(crate) fn radius(self) -> i32 {
        match self {
            Self::Spline => 2,
            Self::Box | Self::Hexagon => 1,
        }
    }

    /// Distance between the taps of a level, pixels.
    pub(crate) fn step(self, level: u32) -> i32 {
        let step = 1_i32.checked_shl(level).unwrap_or(i32::MAX / 4);
        match self {
            Self::Box if level >= 3 => step - 1,
            _ => step,
        }
    }

    /// The weight of the tap at an offset in steps of the level; `None` where there is no tap.
    pub(crate) fn weight(self, level: u32, x: i32, y: i32) -> Option<f32> {
        let [x, y] = [x, y].map(|offset| offset.unsigned_abs() as usize);
        match self {
            Self::Spline => Some(SPLINE.get(x)? * SPLINE.get(y)?),
            Self::Box => Some(1.0 / 9.0),
            Self::Hexagon => {
                let left_out = if level.is_multiple_of(2) { (1, 0) } else { (0, 1) };
                ((x, y) != left_out).then_some(1.0 / 7.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_one_around_the_centre() {
        for (kernel, taps) in [(Kernel::Spline, 25), (Kernel::Box, 9), (Kernel::Hexagon, 7)] {
            for level in 0..4 {
                let side = || -kernel.radius()..=kernel.radius();
                let weights: Vec<f32> = side().flat_map(|y| side().filter_map(move |x| kernel.weight(level, x, y))).collect();
                assert_eq!(weights.len(), taps, "{kernel:?}");
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{kernel:?}");
            }
        }
    }

    /// So that even pixels are mixed with odd ones where the first level refuses outliers.
    #[test]
    fn a_box_has_odd_steps_after_the_first_level() {
        assert_eq!([0, 1, 2, 3, 4, 5].map(|level| Kernel::Box.step(level)), [1, 2, 4, 7, 15, 31]);
        for kernel in [Kernel::Spline, Kernel::Hexagon] {
            assert_eq!([0, 1, 2, 3, 4, 5].map(|level| kernel.step(level)), [1, 2, 4, 8, 16, 32], "{kernel}");
        }
    }

    #[test]
    fn a_hexagon_lies_the_other_way_on_the_next_level() {
        let beside = |level| Kernel::Hexagon.weight(level, 1, 0).is_some();
        let above = |level| Kernel::Hexagon.weight(level, 0, -1).is_some();
        assert_eq!([beside(0), above(0), beside(1), above(1)], [false, true, true, false]);
    }
}

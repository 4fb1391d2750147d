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
    }
}

/// One axis of the B3 spline, from the centre outwards \[EAW\].
const SPLINE: [f32; 3] = [3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0];

impl Kernel {
    /// The largest distance of a tap along an axis, in steps of the level.
    pub(crate) fn radius(self) -> i32 {
        match self {
            Self::Spline => 2,
            Self::Box => 1,
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

    /// The weight of the tap at an offset in steps of the level, at most [`Self::radius`] along each axis.
    pub(crate) fn weight(self, x: i32, y: i32) -> f32 {
        let [x, y] = [x, y].map(|offset| offset.unsigned_abs() as usize);
        match self {
            Self::Spline => SPLINE[x] * SPLINE[y],
            Self::Box => 1.0 / 9.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_one_around_the_centre() {
        for (kernel, taps) in [(Kernel::Spline, 25), (Kernel::Box, 9)] {
            let side = || -kernel.radius()..=kernel.radius();
            let weights: Vec<f32> = side().flat_map(|y| side().map(move |x| kernel.weight(x, y))).collect();
            assert_eq!(weights.len(), taps, "{kernel:?}");
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{kernel:?}");
        }
    }

    /// So that even pixels are mixed with odd ones where the first level refuses outliers.
    #[test]
    fn a_box_has_odd_steps_after_the_first_level() {
        assert_eq!([0, 1, 2, 3, 4, 5].map(|level| Kernel::Box.step(level)), [1, 2, 4, 7, 15, 31]);
        assert_eq!([0, 1, 2, 3, 4, 5].map(|level| Kernel::Spline.step(level)), [1, 2, 4, 8, 16, 32]);
    }
}

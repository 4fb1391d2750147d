//! Frames as a renderer would have made them that traces a share of the pixels alone.

use atrous::config::Sampling;
use clap::builder::PossibleValue;
use clap::ValueEnum;

/// Which pixels of a frame keep their sample: each in its turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Every other one, the others in the next frame.
    Checkerboard,
    /// One of 2×2, each in four frames.
    OneOf2x2,
    /// One of 4×4, each in sixteen frames.
    OneOf4x4,
}

impl ValueEnum for Pattern {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self::Checkerboard, Self::OneOf2x2, Self::OneOf4x4]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

impl Pattern {
    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Checkerboard => "checkerboard",
            Self::OneOf2x2 => "one_of_2x2",
            Self::OneOf4x4 => "one_of_4x4",
        }
    }

    /// What the filter is told.
    pub fn sampling(self) -> Sampling {
        match self {
            Self::Checkerboard | Self::OneOf2x2 => Sampling::OneOf2x2,
            Self::OneOf4x4 => Sampling::OneOf4x4,
        }
    }

    /// Whether a pixel is traced.
    pub fn keeps(self, index: u64, x: u64, y: u64) -> bool {
        let one_of = |side: u64| x % side == index % side && y % side == (index / side + index) % side;
        match self {
            Self::Checkerboard => (x + y + index).is_multiple_of(2),
            Self::OneOf2x2 => one_of(2),
            Self::OneOf4x4 => one_of(4),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_has_its_turn_and_every_block_a_sample() {
        for (pattern, side, turns, kept) in
            [(Pattern::Checkerboard, 2, 2, 2), (Pattern::OneOf2x2, 2, 4, 1), (Pattern::OneOf4x4, 4, 16, 1)]
        {
            let pixels = || (0..side * side).map(|i| (8 + i % side, 4 + i / side));
            for index in 5..5 + turns {
                assert_eq!(pixels().filter(|(x, y)| pattern.keeps(index, *x, *y)).count(), kept, "{pattern:?}, frame {index}");
            }
            for (x, y) in pixels() {
                assert_eq!((5..5 + turns).filter(|index| pattern.keeps(*index, x, y)).count(), 1, "{pattern:?}, pixel {x},{y}");
            }
        }
    }
}

//! Whether the light around a pixel is rare: the last bit that a half keeps of its deviation.

/// Pixels of a window that have its light, so many of which are few.
const FEW_LIT: f32 = 3.0;

/// A mark on more would round to infinity.
const LARGEST_MARKED: f32 = 65000.0;

/// The last bit that a half keeps.
const LAST_BIT: u32 = 0x2000;

/// Whether a deviation says so.
pub(crate) fn is_rare(deviation: f32) -> bool {
    deviation.to_bits() & LAST_BIT != 0
}

/// Whether few pixels of a window have its light: of weights and luminances.
pub(crate) fn few_have_it(window: impl Iterator<Item = (f32, f32)>) -> bool {
    let (sum, squares) = window.fold((0.0, 0.0), |(sum, squares), (weight, l)| (sum + weight * l, squares + weight * l * l));
    sum * sum <= FEW_LIT * squares
}

/// A deviation that says whether light is rare: the nearest half with that last bit.
pub(crate) fn marked(deviation: f32, rare: bool) -> f32 {
    let last = if rare { LAST_BIT } else { 0 };
    f32::from_bits((deviation.min(LARGEST_MARKED).to_bits() + LAST_BIT - last) & !(2 * LAST_BIT - 1) | last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::round_to_half;

    #[test]
    fn a_marked_deviation_is_next_to_the_same_and_a_half_keeps_it() {
        for deviation in [1e-4, 0.02, 0.333, 1.0, 77.7, 64_000.0] {
            for rare in [false, true] {
                let kept = marked(deviation, rare);
                assert_eq!(kept, round_to_half(kept));
                assert_eq!(is_rare(kept), rare, "{deviation}");
                assert!((kept - deviation).abs() <= 0.001 * deviation, "{deviation}: {kept}");
                assert_eq!(marked(kept, rare), kept, "it stays");
            }
        }
        assert_eq!(round_to_half(marked(0.0, true)), 0.0);
        assert!(marked(65_504.0, true) < 65_504.0);
    }

    #[test]
    fn three_pixels_of_a_window_are_few() {
        let lit = |count: usize| few_have_it((0..25).map(|i| (1.0, if i < count { 5.0 } else { 0.0 })));
        assert!(lit(0) && lit(1) && lit(3) && !lit(4));
        // All of a small surface.
        assert!(few_have_it((0..25).map(|i| (if i < 3 { 1.0 } else { 0.0 }, 5.0))));
    }
}

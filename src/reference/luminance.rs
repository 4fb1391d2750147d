//! Luminance.

/// The part that each component of linear RGB has in its luminance, Rec. 709.
pub(crate) const PARTS: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Rec. 709 luminance of linear RGB, in the unit of `c`.
pub fn luminance(c: [f32; 3]) -> f32 {
    PARTS[0] * c[0] + PARTS[1] * c[1] + PARTS[2] * c[2]
}

/// Luminance of the first three components of a texel.
pub(crate) fn texel_luminance([r, g, b, _]: [f32; 4]) -> f32 {
    luminance([r, g, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_green_leads() {
        assert!((luminance([1.0; 3]) - 1.0).abs() < 1e-6);
        assert_eq!(luminance([0.0, 1.0, 0.0]), 0.7152);
        assert_eq!(texel_luminance([1.0, 0.0, 0.0, 9.0]), 0.2126);
    }
}

//! Guides with noise in them, smoothed: what is left of their edges is better than none.

use crate::frame_images::Texels;

/// Pixels to each side that are averaged.
const RADIUS: usize = 3;

/// The mean of the pixels around each.
pub fn smooth(texels: &Texels, width: usize) -> Texels {
    let height = texels.len() / width.max(1);
    let rows = along(texels, width, |x, y| y * width + x, height);
    along(&rows, height, |y, x| y * width + x, width)
}

/// Running means of lines of `length` texels; `at` gives the place of a texel in a line.
fn along(texels: &Texels, length: usize, at: impl Fn(usize, usize) -> usize, lines: usize) -> Texels {
    let mut means = vec![[0.0; 4]; texels.len()];
    for line in 0..lines {
        for i in 0..length {
            let around = i.saturating_sub(RADIUS)..(i + RADIUS + 1).min(length);
            let count = around.len() as f32;
            let mut sum = [0.0; 4];
            for texel in around.map(|j| texels[at(j, line)]) {
                sum = std::array::from_fn(|c| sum[c] + texel[c]);
            }
            means[at(i, line)] = sum.map(|v| v / count);
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_becomes_a_square() {
        let mut texels = vec![[0.0; 4]; 9 * 8];
        texels[4 * 9 + 4] = [49.0; 4];
        let means = smooth(&texels, 9);
        for (i, mean) in means.iter().enumerate() {
            let is_near = (i % 9).abs_diff(4) <= 3 && (i / 9).abs_diff(4) <= 3;
            // At the border fewer are averaged.
            assert_eq!(mean[0] > 0.0, is_near, "{i}: {mean:?}");
        }
        assert_eq!(means[4 * 9 + 4][0], 1.0);
    }
}

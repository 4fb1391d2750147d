//! Convolution along the rows and columns of a plane. Beyond the border, the pixels of the border repeat.

/// The values of a function at the whole pixels from `-radius` to `radius`.
pub(super) fn sampled(radius: usize, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius as i32;
    (-radius..=radius).map(|x| function(f64::from(x))).collect()
}

/// Scales the positive values so that they sum to 1, and the negative ones so that they sum to -1.
pub(super) fn normalised(kernel: &[f64]) -> Vec<f32> {
    let positive: f64 = kernel.iter().filter(|&&v| v > 0.0).sum();
    let negative: f64 = kernel.iter().filter(|&&v| v < 0.0).sum();
    kernel.iter().map(|&v| (if v < 0.0 { -v / negative } else { v / positive }) as f32).collect()
}

/// Convolves each row with a kernel of odd length.
pub(super) fn rows(plane: &[f32], width: usize, kernel: &[f32]) -> Vec<f32> {
    let radius = kernel.len() / 2;
    let mut padded = vec![0.0; width + 2 * radius];
    let mut result = vec![0.0; plane.len()];
    for (row, result) in plane.chunks_exact(width).zip(result.chunks_exact_mut(width)) {
        padded[..radius].fill(row[0]);
        padded[radius..radius + width].copy_from_slice(row);
        padded[radius + width..].fill(row[width - 1]);
        for (tap, &weight) in kernel.iter().enumerate() {
            add_scaled(result, weight, &padded[tap..tap + width]);
        }
    }
    result
}

/// Convolves each column with a kernel of odd length.
pub(super) fn columns(plane: &[f32], width: usize, kernel: &[f32]) -> Vec<f32> {
    let (radius, last) = (kernel.len() / 2, plane.len() / width - 1);
    let mut result = vec![0.0; plane.len()];
    for (y, result) in result.chunks_exact_mut(width).enumerate() {
        for (tap, &weight) in kernel.iter().enumerate() {
            let source = (y + tap).saturating_sub(radius).min(last) * width;
            add_scaled(result, weight, &plane[source..source + width]);
        }
    }
    result
}

pub(super) fn add_scaled(sum: &mut [f32], weight: f32, values: &[f32]) {
    sum.iter_mut().zip(values).for_each(|(sum, &value)| *sum += weight * value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_border_repeats() {
        let plane = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
        let sum_of_three = [1.0, 1.0, 1.0];
        assert_eq!(rows(&plane, 3, &sum_of_three), [4.0, 7.0, 10.0, 32.0, 56.0, 80.0]);
        assert_eq!(columns(&plane, 3, &sum_of_three), [10.0, 20.0, 40.0, 17.0, 34.0, 68.0]);
        let far_left = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(rows(&plane, 3, &far_left), [1.0, 1.0, 1.0, 8.0, 8.0, 8.0]);
        assert_eq!(columns(&plane, 3, &far_left), [1.0, 2.0, 4.0, 1.0, 2.0, 4.0]);
    }

    #[test]
    fn positive_and_negative_weights_are_normalised_apart() {
        assert_eq!(normalised(&[-3.0, -1.0, 0.0, 2.0]), [-0.75, -0.25, 0.0, 1.0]);
    }
}

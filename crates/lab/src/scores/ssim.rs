//! Structural similarity.
//!
//! Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from error visibility to structural similarity",
//! eq. 13, with the choices of scikit-image's `structural_similarity(channel_axis=-1, data_range=1.0)`: a uniform
//! window of 7x7 pixels, sample covariance (divided by N - 1), and the mean over the windows that lie inside the image.

use super::tone::tone_map_rgb;
use super::{QualityError, Rgb};

const WINDOW: usize = 7;
/// (K1 L)^2 and (K2 L)^2 of eq. 13, with K1 = 0.01, K2 = 0.03 and the data range L = 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Mean structural similarity of the images after [`tone_map`](super::tone_map), in [-1, 1]; 1 for identical images.
///
/// The numbers are those of scikit-image with its default window of 7x7 pixels. An image with a side shorter than 7 is
/// measured with the largest odd window that fits into it; a window of one pixel has no variance, so that only the
/// luminance term of the index remains there.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn ssim(image: Rgb<'_>, reference: Rgb<'_>) -> Result<f64, QualityError> {
    unbiased_ssim(image, [reference; 2])
}

/// [`ssim`] against the picture that two references converge to, whose noise is independent: its variance in a window is the
/// covariance of both, to which their noise adds nothing. The tone map bends that noise a little, so that this holds as far as
/// the references are nearly converged; a covariance below 0, which noise can leave where the picture is flat, counts as 0.
///
/// # Errors
/// [`QualityError::ExtentMismatch`] if the sizes differ.
pub fn unbiased_ssim(image: Rgb<'_>, references: [Rgb<'_>; 2]) -> Result<f64, QualityError> {
    references.iter().try_for_each(|reference| image.same_extent(*reference))?;
    let tone_mapped = |i: Rgb<'_>| -> Vec<[f32; 3]> { i.pixels().iter().map(|&p| tone_map_rgb(p)).collect() };
    let (x, references) = (tone_mapped(image), references.map(tone_mapped));
    let (width, height) = (image.width() as usize, image.height() as usize);
    let sum: f64 = (0..3)
        .map(|channel| {
            let plane = |pixels: &[[f32; 3]]| -> Vec<f64> { pixels.iter().map(|p| f64::from(p[channel])).collect() };
            channel_ssim(&plane(&x), references.each_ref().map(|r| plane(r)), width, height)
        })
        .sum();
    Ok(sum / 3.0)
}

fn window_for(width: usize, height: usize) -> usize {
    let side = WINDOW.min(width).min(height);
    side - (1 - side % 2)
}

/// Mean over all windows inside the image. Sums slide down the columns and then along the row, so that the cost does
/// not depend on the window; in `f64` their rounding stays below 1e-12.
fn channel_ssim(x: &[f64], [a, b]: [Vec<f64>; 2], width: usize, height: usize) -> f64 {
    let window = window_for(width, height);
    let moments = |i: usize| Moments::of(x[i], a[i], b[i]);
    let mut columns = vec![Moments::default(); width];
    let mut total = 0.0;
    for y in 0..height {
        for (column, sums) in columns.iter_mut().enumerate() {
            sums.add(moments(y * width + column));
            if y >= window {
                sums.subtract(moments((y - window) * width + column));
            }
        }
        if y + 1 < window {
            continue;
        }
        let mut sums = Moments::default();
        for column in 0..width {
            sums.add(columns[column]);
            if column >= window {
                sums.subtract(columns[column - window]);
            }
            if column + 1 >= window {
                total += sums.similarity((window * window) as f64);
            }
        }
    }
    total / ((width - window + 1) * (height - window + 1)) as f64
}

/// Sums of x, a, b, x^2, a b and x (a + b) / 2 over some samples; a and b are the references.
#[derive(Debug, Clone, Copy, Default)]
struct Moments([f64; 6]);

impl Moments {
    fn of(x: f64, a: f64, b: f64) -> Self {
        Self([x, a, b, x * x, a * b, 0.5 * x * (a + b)])
    }

    fn add(&mut self, other: Self) {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a += b);
    }

    fn subtract(&mut self, other: Self) {
        self.0.iter_mut().zip(other.0).for_each(|(a, b)| *a -= b);
    }

    /// Eq. 13 for a window of `n` samples.
    fn similarity(self, n: f64) -> f64 {
        let [mean_x, mean_a, mean_b, xx, ab, xr] = self.0.map(|sum| sum / n);
        let (mean_r, mean_rr) = (0.5 * (mean_a + mean_b), mean_a * mean_b);
        let sample_norm = if n > 1.0 { n / (n - 1.0) } else { 0.0 };
        let variance_x = sample_norm * (xx - mean_x * mean_x);
        let variance_r = (sample_norm * (ab - mean_rr)).max(0.0);
        let covariance = sample_norm * (xr - mean_x * mean_r);
        let luminance = (2.0 * mean_x * mean_r + C1) / (mean_x * mean_x + mean_rr + C1);
        luminance * (2.0 * covariance + C2) / (variance_x + variance_r + C2)
    }
}

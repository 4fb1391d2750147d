//! Differences between the edges and the points of two images.

use super::convolution::{columns, normalised, rows, sampled};
use super::PIXELS_PER_DEGREE;
use std::f64::consts::FRAC_1_SQRT_2;

/// Width of the filter with which the eye finds edges, from the peak to the trough, in degrees: w.
const PEAK_TO_TROUGH: f64 = 0.082;

/// How much the strongest edges and points of two planes of luminance differ at each pixel, in [0, 1].
pub(super) fn differences(image: &[f32], reference: &[f32], width: usize) -> Vec<f32> {
    let filters = Filters::new();
    let [image_edges, image_points] = filters.strengths(image, width);
    let [edges, points] = filters.strengths(reference, width);
    let difference = |i: usize| (image_edges[i] - edges[i]).abs().max((image_points[i] - points[i]).abs());
    // The exponent q_f is 1/2. Strengths are at most sqrt(2).
    (0..image.len()).map(|i| (FRAC_1_SQRT_2 as f32 * difference(i)).sqrt()).collect()
}

/// A Gaussian, its first derivative (which finds edges) and its second one (which finds points).
struct Filters {
    blur: Vec<f32>,
    edge: Vec<f32>,
    point: Vec<f32>,
}

impl Filters {
    fn new() -> Self {
        let deviation = 0.5 * PEAK_TO_TROUGH * PIXELS_PER_DEGREE;
        let radius = (3.0 * deviation).ceil() as usize;
        let gaussian = |x: f64| (-(x / deviation).powi(2) / 2.0).exp();
        Self {
            blur: normalised(&sampled(radius, gaussian)),
            edge: normalised(&sampled(radius, |x| -x * gaussian(x))),
            point: normalised(&sampled(radius, |x| ((x / deviation).powi(2) - 1.0) * gaussian(x))),
        }
    }

    /// Strength of edges and of points at each pixel: the length of the vector of both directions' responses.
    fn strengths(&self, plane: &[f32], width: usize) -> [Vec<f32>; 2] {
        let blurred = rows(plane, width, &self.blur);
        [&self.edge, &self.point].map(|kernel| {
            let across = columns(&rows(plane, width, kernel), width, &self.blur);
            let along = columns(&blurred, width, kernel);
            across.iter().zip(along).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        })
    }
}

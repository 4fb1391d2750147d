//! Differences of colour in what the eye resolves: its contrast sensitivity is a blur of each opponent channel.

use super::colour::{ColourError, Planes};
use super::convolution::{add_scaled, columns, normalised, rows, sampled};
use super::PIXELS_PER_DEGREE;
use std::f64::consts::PI;

/// `a sqrt(pi / b) exp(-pi^2 r^2 / b)` at the distance r in degrees.
struct Gaussian {
    a: f64,
    b: f64,
}

const LIGHT: [Gaussian; 1] = [Gaussian { a: 1.0, b: 0.0047 }];
const RED_GREEN: [Gaussian; 1] = [Gaussian { a: 1.0, b: 0.0053 }];
const BLUE_YELLOW: [Gaussian; 2] = [Gaussian { a: 34.1, b: 0.04 }, Gaussian { a: 13.5, b: 0.025 }];
/// b of the widest of them.
const WIDEST: f64 = 0.04;

/// The error in colour of each pixel, in [0, 1].
pub(super) fn colour_differences(image: &Planes, reference: &Planes, width: usize) -> Vec<f32> {
    let (image, reference) = (resolved(image, width), resolved(reference, width));
    let error = ColourError::new();
    (0..image.y.len()).map(|i| error.between(image.uniform_colour(i), reference.uniform_colour(i))).collect()
}

fn resolved(planes: &Planes, width: usize) -> Planes {
    Planes {
        y: blurred(&planes.y, width, &LIGHT),
        cx: blurred(&planes.cx, width, &RED_GREEN),
        cz: blurred(&planes.cz, width, &BLUE_YELLOW),
    }
}

/// Convolves with the sum of some two-dimensional Gaussians, scaled so that all weights sum to 1. Each alone is separable:
/// its part in the result is the part that its weights have in the sum.
fn blurred(plane: &[f32], width: usize, gaussians: &[Gaussian]) -> Vec<f32> {
    // Three standard deviations of the widest.
    let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let kernels: Vec<Vec<f64>> =
        gaussians.iter().map(|g| sampled(radius, |x| (-(PI * x / PIXELS_PER_DEGREE).powi(2) / g.b).exp())).collect();
    let weight = |g: &Gaussian, kernel: &[f64]| g.a * (PI / g.b).sqrt() * kernel.iter().sum::<f64>().powi(2);
    let weights: Vec<f64> = gaussians.iter().zip(&kernels).map(|(g, kernel)| weight(g, kernel)).collect();
    let total: f64 = weights.iter().sum();
    let mut sum = vec![0.0; plane.len()];
    for (kernel, weight) in kernels.iter().zip(&weights) {
        let kernel = normalised(kernel);
        add_scaled(&mut sum, (weight / total) as f32, &columns(&rows(plane, width, &kernel), width, &kernel));
    }
    sum
}

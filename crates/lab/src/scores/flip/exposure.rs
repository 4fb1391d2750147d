//! The exposures of HDR-FLIP and the tone curve that follows them.

/// Value of the tone curve at which the exposures aim: t.
const ALMOST_WHITE: f64 = 0.85;
/// Luminances below count as this: a black reference would have an infinite exposure.
const SMALLEST_LUMINANCE: f64 = f32::EPSILON as f64;

/// Narkowicz's fit of the ACES curve is `(A x^2 + B x) / (C x^2 + D x + E)` of radiance that was scaled by [`PRE_EXPOSURE`].
const A: f32 = 2.51;
const B: f32 = 0.03;
const C: f32 = 2.43;
const D: f32 = 0.59;
const E: f32 = 0.14;
const PRE_EXPOSURE: f64 = 0.6;
/// Scaled radiance from here on is white.
const WHITE: f32 = 8.0;

/// Linear values in [0, 1] on a display: the tone curve of `2^stops` times the radiance. Negative radiance counts as 0.
pub(super) fn tone_mapped(pixels: &[[f32; 3]], stops: f64) -> Vec<[f32; 3]> {
    let scale = PRE_EXPOSURE * stops.exp2();
    let curve = |radiance: f32| {
        // In `f64`, neither the scale nor the product overflows; and beyond white the curve would divide infinities.
        let x = ((f64::from(radiance) * scale) as f32).clamp(0.0, WHITE);
        (x * (A * x + B) / (x * (C * x + D) + E)).min(1.0)
    };
    pixels.iter().map(|pixel| pixel.map(curve)).collect()
}

/// Exposures in stops, at least two, evenly from the one that makes the brightest pixel almost white to the one that does
/// so to the median pixel, one to two stops apart unless both are closer.
pub(super) fn exposures(reference: &[[f32; 3]]) -> Vec<f64> {
    let mut luminances: Vec<f64> = reference.iter().map(|&pixel| luminance(pixel)).collect();
    let middle = luminances.len() / 2;
    let (_, &mut median, brighter) = luminances.select_nth_unstable_by(middle, f64::total_cmp);
    let brightest = brighter.iter().fold(median, |a, &b| a.max(b));
    let start = (almost_white_radiance() / brightest).log2();
    // The quotient comes first: from a range of whole stops, rounding must not make one more.
    let range = (brightest / median).log2();
    let last = (range.ceil() as u32).max(2) - 1;
    (0..=last).map(|i| start + range * f64::from(i) / f64::from(last)).collect()
}

fn luminance(pixel: [f32; 3]) -> f64 {
    let [r, g, b] = pixel.map(|v| f64::from(v.max(0.0)));
    (0.2126 * r + 0.7152 * g + 0.0722 * b).max(SMALLEST_LUMINANCE)
}

/// The radiance that the tone curve maps to [`ALMOST_WHITE`]: the positive root of a quadratic equation.
fn almost_white_radiance() -> f64 {
    let [a, b, c, d, e] = [A, B, C, D, E].map(f64::from);
    let (square, linear, constant) = (a - ALMOST_WHITE * c, b - ALMOST_WHITE * d, -ALMOST_WHITE * e);
    let half = -0.5 * linear / square;
    (half + (half * half - constant / square).sqrt()) / PRE_EXPOSURE
}

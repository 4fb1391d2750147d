//! Colour spaces of FLIP, and the distance between two colours.

/// Linear Rec. 709 to CIE XYZ relative to the white D65, so that white is (1, 1, 1): no other place needs the white point.
const RGB_TO_XYZ: [[f32; 3]; 3] = [
    [10_135_552.0 / 23_359_437.0, 8_788_810.0 / 23_359_437.0, 4_435_075.0 / 23_359_437.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 80_288_307.0, 8_788_810.0 / 80_288_307.0, 70_074_185.0 / 80_288_307.0],
];

/// The inverse of [`RGB_TO_XYZ`].
const XYZ_TO_RGB: [[f32; 3]; 3] =
    [[3.080_342, -1.537_398_9, -0.542_943], [-0.921_178_4, 1.875_93, 0.045_248_41], [0.052_881_293, -0.204_011_2, 1.151_13]];

/// Exponent q_c of the distance between colours: large differences look less different than they measure.
const DISTANCE_EXPONENT: f32 = 0.7;
/// p_c and p_t: distances up to this part of the largest one take up the range [0, p_t] of the error.
const KNEE_DISTANCE: f32 = 0.4;
const KNEE_ERROR: f32 = 0.95;

fn multiply(matrix: &[[f32; 3]; 3], [x, y, z]: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// An image in the linear opponent space YCxCz: light, red against green, blue against yellow.
pub(super) struct Planes {
    pub(super) y: Vec<f32>,
    pub(super) cx: Vec<f32>,
    pub(super) cz: Vec<f32>,
}

impl Planes {
    /// Converts linear RGB in [0, 1].
    pub(super) fn of(pixels: &[[f32; 3]]) -> Self {
        let with_room = || Vec::with_capacity(pixels.len());
        let mut planes = Self { y: with_room(), cx: with_room(), cz: with_room() };
        for &rgb in pixels {
            let [x, y, z] = multiply(&RGB_TO_XYZ, rgb);
            planes.y.push(116.0 * y - 16.0);
            planes.cx.push(500.0 * (x - y));
            planes.cz.push(200.0 * (y - z));
        }
        planes
    }

    /// Luminance relative to white, in [0, 1].
    pub(super) fn luminance(&self) -> Vec<f32> {
        self.y.iter().map(|y| (y + 16.0) / 116.0).collect()
    }

    /// The colour of pixel `i` in a space where equal distances look equally different; colours that no display can show are
    /// moved into its range first.
    pub(super) fn uniform_colour(&self, i: usize) -> [f32; 3] {
        let y = (self.y[i] + 16.0) / 116.0;
        let rgb = multiply(&XYZ_TO_RGB, [self.cx[i] / 500.0 + y, y, y - self.cz[i] / 200.0]);
        hunt_lab(rgb.map(|v| v.clamp(0.0, 1.0)))
    }
}

/// CIE L*a*b* of linear RGB, its chroma scaled by the lightness (Hunt effect: dark colours look less colourful).
fn hunt_lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let curve = |t: f32| if t > DELTA.powi(3) { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 };
    let [x, y, z] = multiply(&RGB_TO_XYZ, rgb).map(curve);
    let lightness = 116.0 * y - 16.0;
    let hunt = 0.01 * lightness;
    [lightness, hunt * 500.0 * (x - y), hunt * 200.0 * (y - z)]
}

/// HyAB distance, which suits large differences better than a Euclidean one, raised to [`DISTANCE_EXPONENT`].
fn distance([l0, a0, b0]: [f32; 3], [l1, a1, b1]: [f32; 3]) -> f32 {
    ((l0 - l1).abs() + ((a0 - a1).powi(2) + (b0 - b1).powi(2)).sqrt()).powf(DISTANCE_EXPONENT)
}

/// Error between two colours, in [0, 1].
pub(super) struct ColourError {
    knee: f32,
    largest: f32,
}

impl ColourError {
    pub(super) fn new() -> Self {
        // No two colours of a display are farther apart than its green and its blue.
        let largest = distance(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0]));
        Self { knee: KNEE_DISTANCE * largest, largest }
    }

    /// The error between two results of [`Planes::uniform_colour`].
    pub(super) fn between(&self, left: [f32; 3], right: [f32; 3]) -> f32 {
        let distance = distance(left, right);
        if distance < self.knee {
            return distance * (KNEE_ERROR / self.knee);
        }
        KNEE_ERROR + (distance - self.knee) / (self.largest - self.knee) * (1.0 - KNEE_ERROR)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_matrices_are_inverse() {
        for axis in 0..3 {
            let unit = std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 });
            let back = multiply(&XYZ_TO_RGB, multiply(&RGB_TO_XYZ, unit));
            for (value, expected) in back.into_iter().zip(unit) {
                assert!((value - expected).abs() < 1e-6, "{back:?} instead of {unit:?}");
            }
        }
    }

    #[test]
    fn no_corner_of_the_display_is_farther_from_another_than_green_from_blue() {
        let corners: Vec<[f32; 3]> = (0..8).map(|i| [0, 1, 2].map(|bit| (i >> bit & 1) as f32)).collect();
        let error = ColourError::new();
        for &left in &corners {
            for &right in &corners {
                assert!((0.0..=1.0).contains(&error.between(hunt_lab(left), hunt_lab(right))), "{left:?} and {right:?}");
            }
        }
        assert_eq!(error.between(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])), 1.0);
    }
}

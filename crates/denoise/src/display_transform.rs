//! Light as it is shown and scored: in the colours of a display, and at a brightness that an eye sees.

use crate::exr_header::ExrHeader;
use exr::meta::attribute::Chromaticities;
use glam::{Mat3, Vec3};
use std::borrow::Cow;

/// Red, green, blue and white of Rec. 709 on the chromaticity diagram.
const REC709: [[f32; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];
/// From XYZ to what the cones of an eye see (Bradford), by which white stays white.
const CONES: [[f32; 3]; 3] = [[0.8951, -0.7502, 0.0389], [0.2664, 1.7135, -0.0685], [-0.1614, 0.0367, 1.0296]];

/// The way from the light of a file to that of pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DisplayTransform {
    /// A power of two.
    exponent: i32,
    /// From the colours of the file to Rec. 709, where they are others.
    matrix: Option<Mat3>,
}

impl DisplayTransform {
    /// By the header of the first frame, and the exponent that brings its light to about 1.
    pub fn new(header: &ExrHeader, exponent: i32) -> Self {
        let matrix = header.shared.chromaticities.and_then(|c| to_rec709(&c));
        Self { exponent, matrix }
    }

    /// Pixels as they are shown.
    pub fn apply<'a>(&self, pixels: &'a [[f32; 3]]) -> Cow<'a, [[f32; 3]]> {
        if self.exponent == 0 && self.matrix.is_none() {
            return Cow::Borrowed(pixels);
        }
        let factor = (self.exponent as f32).exp2();
        let matrix = self.matrix.unwrap_or(Mat3::IDENTITY);
        // Colours beyond those of the display have no light in some component.
        let shown = |p: &[f32; 3]| (matrix * Vec3::from(*p) * factor).max(Vec3::ZERO).to_array();
        Cow::Owned(pixels.iter().map(shown).collect())
    }
}

/// XYZ from the red, green and blue of some chromaticities.
fn to_xyz([red, green, blue, white]: [[f32; 2]; 4]) -> Mat3 {
    let xyz = |[x, y]: [f32; 2]| Vec3::new(x, y, 1.0 - x - y) / y;
    let primaries = Mat3::from_cols(xyz(red), xyz(green), xyz(blue));
    primaries * Mat3::from_diagonal(primaries.inverse() * xyz(white))
}

/// None where the colours are those of Rec. 709, or none at all.
fn to_rec709(c: &Chromaticities) -> Option<Mat3> {
    let own = [c.red, c.green, c.blue, c.white].map(|v| [v.0, v.1]);
    let differs = own.iter().flatten().zip(REC709.iter().flatten()).any(|(a, b)| (a - b).abs() > 0.002);
    let cones = Mat3::from_cols_array_2d(&CONES);
    let white = |[x, y]: [f32; 2]| cones * (Vec3::new(x, y, 1.0 - x - y) / y);
    let adapted = cones.inverse() * Mat3::from_diagonal(white(REC709[3]) / white(own[3])) * cones;
    let matrix = to_xyz(REC709).inverse() * adapted * to_xyz(own);
    (differs && matrix.is_finite()).then_some(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::Vec2;

    fn chromaticities([red, green, blue, white]: [[f32; 2]; 4]) -> Chromaticities {
        let [red, green, blue, white] = [red, green, blue, white].map(|[x, y]| Vec2(x, y));
        Chromaticities { red, green, blue, white }
    }

    #[test]
    fn white_stays_white_and_red_is_redder() {
        assert_eq!(to_rec709(&chromaticities(REC709)), None);
        let acescg = [[0.713, 0.293], [0.165, 0.83], [0.128, 0.044], [0.32168, 0.33767]];
        let shown = DisplayTransform { exponent: 0, matrix: to_rec709(&chromaticities(acescg)) };
        let white = shown.apply(&[[1.0; 3]])[0];
        assert!(white.iter().all(|v| (v - 1.0).abs() < 1e-3), "{white:?}");
        // The published matrix from ACEScg to linear sRGB has 1.705 here.
        let red = shown.apply(&[[1.0, 0.0, 0.0]])[0];
        assert!((red[0] - 1.705).abs() < 2e-3 && red[1] == 0.0, "{red:?}");
        assert_eq!(to_rec709(&chromaticities([[0.0; 2]; 4])), None);
    }
}

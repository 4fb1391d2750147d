//! Normals as hosts encode them, and unit normals as a point in a square: an octahedron unfolded, quantised so that axis-aligned normals are exact.

use crate::config::NormalEncoding;
use glam::{Vec2, Vec3};

fn sign(v: f32) -> f32 {
    // sign(0) = 1, and −0 counts as 0: a fold must not lose a component.
    if v >= 0.0 {
        1.0
    } else {
        -1.0
    }
}

fn fold(e: Vec2) -> Vec2 {
    Vec2::new((1.0 - e.y.abs()) * sign(e.x), (1.0 - e.x.abs()) * sign(e.y))
}

/// The point of the square −1..1 for a direction of any length but 0.
pub(crate) fn to_square(n: Vec3) -> Vec2 {
    let e = n.truncate() / (n.x.abs() + n.y.abs() + n.z.abs());
    if n.z < 0.0 {
        fold(e)
    } else {
        e
    }
}

/// The direction of a point of the square −1..1; not normalised.
pub(crate) fn from_square(e: Vec2) -> Vec3 {
    let z = 1.0 - e.x.abs() - e.y.abs();
    (if z < 0.0 { fold(e) } else { e }).extend(z)
}

/// The vector that a texel encodes, of any length, in the space that it is in.
pub fn decode_normal(encoding: NormalEncoding, v: [f32; 4]) -> [f32; 3] {
    let (xy, xyz) = (Vec2::new(v[0], v[1]), Vec3::new(v[0], v[1], v[2]));
    let normal = match encoding {
        NormalEncoding::Xyz => xyz,
        NormalEncoding::XyzUnorm => xyz * 2.0 - 1.0,
        NormalEncoding::Octahedral => from_square(xy),
        NormalEncoding::OctahedralUnorm => from_square(xy * 2.0 - 1.0),
    };
    normal.into()
}

fn quantise(n: Vec3, half_range: f32) -> [u32; 2] {
    (to_square(n) * half_range + (half_range + 0.5)).floor().to_array().map(|u| u as u32)
}

fn restore(u: [u32; 2], half_range: f32) -> Vec3 {
    from_square(Vec2::new(u[0] as f32, u[1] as f32) / half_range - 1.0).normalize_or(Vec3::Z)
}

/// A unit normal in 20 bits: x in bits 0 to 9, y in bits 10 to 19.
pub(crate) fn octahedral10(normal: [f32; 3]) -> u32 {
    let [x, y] = quantise(normal.into(), 511.0);
    x | y << 10
}

/// The unit normal of [`octahedral10`]; higher bits are ignored.
pub(crate) fn octahedral10_to_normal(bits: u32) -> [f32; 3] {
    restore([bits & 0x3ff, bits >> 10 & 0x3ff], 511.0).to_array()
}

/// A unit normal in 16 bits: x in bits 0 to 7, y in bits 8 to 15.
pub(crate) fn octahedral8(normal: [f32; 3]) -> u16 {
    let [x, y] = quantise(normal.into(), 127.0);
    (x | y << 8) as u16
}

/// The unit normal of [`octahedral8`].
pub(crate) fn octahedral8_to_normal(bits: u16) -> [f32; 3] {
    restore([u32::from(bits & 0xff), u32::from(bits >> 8)], 127.0).to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sphere() -> impl Iterator<Item = Vec3> {
        (0..4000).map(|i| {
            let (z, turn) = (1.0 - (2.0 * i as f32 + 1.0) / 4000.0, i as f32 * 2.399_963);
            let r = (1.0 - z * z).sqrt();
            Vec3::new(r * turn.cos(), r * turn.sin(), z)
        })
    }

    fn largest_angle(trip: impl Fn([f32; 3]) -> [f32; 3]) -> f32 {
        sphere().map(|n| n.cross(Vec3::from(trip(n.to_array()))).length().asin()).fold(0.0, f32::max)
    }

    #[test]
    fn axes_are_exact() {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            for n in [axis, -axis] {
                assert_eq!(Vec3::from(octahedral10_to_normal(octahedral10(n.to_array()))), n);
                assert_eq!(Vec3::from(octahedral8_to_normal(octahedral8(n.to_array()))), n);
            }
        }
        assert_eq!(octahedral10([0.0, 0.0, -1.0]), 1022 | 1022 << 10);
        assert_eq!(octahedral10([1.0, 0.0, 0.0]), 1022 | 511 << 10);
        assert_eq!(octahedral8([0.0, -1.0, 0.0]), 127);
    }

    #[test]
    fn the_angular_error_is_bounded() {
        // Half a step per axis, stretched most at the centre of a face: by 3·√2.
        for (half_range, angle) in [
            (511.0, largest_angle(|n| octahedral10_to_normal(octahedral10(n)))),
            (127.0, largest_angle(|n| octahedral8_to_normal(octahedral8(n)))),
        ] {
            let bound = 3.0 * 2.0_f32.sqrt() * 0.5 / half_range;
            assert!(angle < bound && angle > 0.5 * bound, "{half_range}: {angle} rad, bound {bound}");
        }
    }

    #[test]
    fn bits_stay_in_their_fields() {
        for n in sphere() {
            assert!(octahedral10(n.to_array()) < 1 << 20);
            let u = octahedral8(n.to_array());
            assert!(u & 0xff <= 254 && u >> 8 <= 254);
        }
    }
}

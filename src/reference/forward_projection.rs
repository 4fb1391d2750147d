//! Positions in this frame of surfaces of the previous one, to the bit as the GPU computes them: no result rests on a quotient,
//! whose precision a device may choose, nor on the order of a sum.

use super::reprojection::InstanceTransform;
use crate::{FrameConstants, Tuning};
use glam::{IVec2, Vec3, Vec4, Vec4Swizzles};

/// A transform with a smaller determinant has no inverse.
const SMALLEST_DETERMINANT: f32 = 1e-20;

/// A position in this frame, homogeneous.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ForwardPosition {
    /// Pixels: numerator / denominator.
    pub numerator: [f32; 2],
    pub denominator: [f32; 2],
    /// Linear depth: depth / depth_denominator.
    pub depth: f32,
    pub depth_denominator: f32,
}

/// The sum of products, from x to w.
fn product_sum(a: Vec4, b: Vec4) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w
}

fn product(m: &[[f32; 4]; 4], row: usize, v: Vec4) -> f32 {
    product_sum(Vec4::from_array(m.map(|column| column[row])), v)
}

/// The world position of a pixel of the previous frame; w is 1.
pub(crate) fn previous_world_position(frame: &FrameConstants, pixel: IVec2, linear_depth: f32) -> Vec4 {
    let w = frame.previous_clip_w_scale * linear_depth + frame.previous_clip_w_offset;
    let place = Vec4::new((pixel.x as f32 + 0.5) * w, (pixel.y as f32 + 0.5) * w, linear_depth, 1.0);
    let [x, y, z] = [0, 1, 2].map(|row| product(&frame.world_from_previous_sample, row, place));
    Vec4::new(x, y, z, 1.0)
}

/// The position of this frame whose transform leads to the previous one: by the adjugate, so that w is the determinant.
pub(crate) fn invert_transform(transform: &InstanceTransform, previous: Vec4) -> Option<Vec4> {
    let rows = transform.map(Vec4::from_array);
    let [x, y, z] = rows.map(|row| row.xyz());
    let (yz, zx, xy) = (y.cross(z), z.cross(x), x.cross(y));
    let d = previous.xyz() - Vec3::new(rows[0].w, rows[1].w, rows[2].w);
    let determinant = x.x * yz.x + x.y * yz.y + x.z * yz.z;
    let current = (yz * d.x + zx * d.y + xy * d.z).extend(determinant);
    let current = if determinant < 0.0 { -current } else { current };
    (current.w >= SMALLEST_DETERMINANT && current.is_finite()).then_some(current)
}

/// A world position in this frame.
pub(crate) fn project(frame: &FrameConstants, world: Vec4) -> ForwardPosition {
    let [x, y, depth, w] = [0, 1, 2, 3].map(|row| product(&frame.sample_from_world, row, world));
    ForwardPosition { numerator: [x, y], denominator: [w, w], depth, depth_denominator: world.w }
}

/// The largest integer q with q·denominator ≤ numerator, both rounded to `f32`.
pub(crate) fn floor_quotient(numerator: f32, denominator: f32) -> i32 {
    let q = (numerator / denominator).floor();
    let fits = |q: f32| q * denominator <= numerator;
    let largest = [q + 1.0, q, q - 1.0].into_iter().find(|q| fits(*q));
    largest.unwrap_or(q) as i32
}

/// The pixel of this frame that covers a position; `None` off screen, behind the camera, or where it is not finite.
pub(crate) fn covering_pixel(frame: &FrameConstants, position: &ForwardPosition) -> Option<IVec2> {
    let side = |i: usize| {
        let (numerator, denominator) = (position.numerator[i], position.denominator[i]);
        let is_usable = numerator.is_finite() && denominator.is_finite() && denominator > 0.0;
        let is_inside = numerator >= 0.0 && numerator < frame.render_extent[i] as f32 * denominator;
        (is_usable && is_inside).then(|| floor_quotient(numerator, denominator))
    };
    Some(IVec2::new(side(0)?, side(1)?))
}

/// Whether a surface of this frame at `linear_depth` is the one at the position.
pub(crate) fn is_visible(tuning: &Tuning, position: &ForwardPosition, linear_depth: f32, depth_gradient: [f32; 2]) -> bool {
    let difference = linear_depth * position.depth_denominator - position.depth;
    let slope = depth_gradient[0].abs() + depth_gradient[1].abs();
    let tolerance = tuning.depth_tolerance * linear_depth + slope;
    difference.abs() <= tolerance * position.depth_denominator
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quotient_is_the_largest_that_fits() {
        for (numerator, denominator, expected) in
            [(7.5, 2.5, 3), (7.4999, 2.5, 2), (0.0, 3.0, 0), (1e-30, 1.0, 0), (99.99, 10.0, 9)]
        {
            assert_eq!(floor_quotient(numerator, denominator), expected, "{numerator} / {denominator}");
        }
        for i in 0..10_000 {
            let (w, q) = (0.1 + i as f32 * 0.013, i % 4096);
            let at = q as f32 * w;
            assert_eq!(floor_quotient(at, w), q);
            if q > 0 {
                assert_eq!(floor_quotient(f32::from_bits(at.to_bits() - 1), w), q - 1);
            }
        }
    }

    #[test]
    fn a_transform_is_inverted_and_a_singular_one_is_not() {
        let turned: InstanceTransform = [[0.0, -2.0, 0.0, 5.0], [2.0, 0.0, 0.0, -1.0], [0.0, 0.0, 2.0, 0.5]];
        let mirrored: InstanceTransform = [[-1.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        for transform in [turned, mirrored] {
            let current = Vec4::new(1.0, -2.0, 3.0, 1.0);
            let previous = Vec3::from(transform.map(|row| Vec4::from(row).dot(current)));
            let found = invert_transform(&transform, previous.extend(1.0)).expect("invertible");
            assert!((found.xyz() / found.w - current.xyz()).length() < 1e-5 && found.w > 0.0, "{found}");
        }
        let flat: InstanceTransform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]];
        assert_eq!(invert_transform(&flat, Vec4::ONE), None);
        assert_eq!(invert_transform(&[[f32::MAX; 4]; 3], Vec4::ONE), None);
    }
}

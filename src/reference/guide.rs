//! The packed guide: what the filters know of the surface in a pixel. It is also the history of depth, normal and id.

use glam::{Vec2, Vec3};

/// A pixel of the guide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Surface {
    /// View-space depth along the view axis, positive, scene units, kept with a mantissa of 12 bits, from 2⁻³⁰ to 2³²; 0 is the background.
    pub linear_depth: f32,
    /// Whether its light is kept apart from that of other surfaces: the albedo is too dark to divide by, or not finite.
    pub is_apart: bool,
    /// World-space normal, of unit length but for its steps of 1/127.
    pub normal: [f32; 3],
    /// Of the depth, scene units per pixel along x and y; kept as a direction and a length, each in steps.
    pub gradient: [f32; 2],
    /// Surface id, folded to 8 bits; 0 for the background.
    pub id: u8,
}

impl Surface {
    /// Whether no surface was hit.
    pub(crate) fn is_background(&self) -> bool {
        self.linear_depth == 0.0
    }

    pub(crate) fn unit_normal(&self) -> Vec3 {
        Vec3::from(self.normal).normalize_or_zero()
    }
}

/// A surface id in 8 bits: itself up to 255, else hashed into 1 to 255, so that only the background is 0.
pub(crate) fn fold_id(id: u32) -> u8 {
    let folded = if id <= 255 { id } else { 1 + pcg(id) % 255 };
    folded as u8
}

/// The hash of the published generator.
pub(crate) fn pcg(v: u32) -> u32 {
    let s = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let w = ((s >> ((s >> 28) + 4)) ^ s).wrapping_mul(277_803_737);
    (w >> 22) ^ w
}

/// Steps from 0 to 1 of a component of the normal.
const NORMAL_STEPS: f32 = 127.0;

/// The exponent of a depth is kept less this one, so that its two upper bits are free, between the least and the largest of these.
const DEPTH_EXPONENT: u32 = 96 << 23;
const LEAST_DEPTH: f32 = 1.0 / (1 << 30) as f32;
const LARGEST_DEPTH: f32 = (1u64 << 32) as f32;
const DEPTH_BITS: u32 = 0x1fff_f800;
const APART_BIT: u32 = 1 << 31;

/// Directions of the gradient on a diamond, for which axes are exact.
const DIRECTIONS: f32 = 128.0;
/// Code 1 of the sum of the components over the depth is 2⁻¹⁴, and one step is a quarter of a power of 2.
const LEAST_SLOPE: u32 = 451;

/// 13 bits: the direction in the lower 7, how steep it is above.
fn pack_gradient(gradient: Vec2, linear_depth: f32) -> u32 {
    let sum = gradient.abs().element_sum();
    let direction = gradient / sum.max(1e-37);
    let turn = if direction.y >= 0.0 { 1.0 - direction.x } else { 3.0 + direction.x };
    let slope = (((sum / linear_depth).to_bits() + 0x0010_0000) >> 21).clamp(LEAST_SLOPE, LEAST_SLOPE + 63) - LEAST_SLOPE;
    match slope {
        0 => 0,
        slope => slope << 7 | (turn * (DIRECTIONS / 4.0) + 0.5).floor() as u32 & 127,
    }
}

fn unpack_gradient(code: u32, linear_depth: f32) -> [f32; 2] {
    let turn = (code & 127) as f32 * (4.0 / DIRECTIONS);
    let y = if turn <= 2.0 { 1.0 - (turn - 1.0).abs() } else { (turn - 3.0).abs() - 1.0 };
    match code >> 7 {
        0 => [0.0; 2],
        slope => [(2.0 - turn).abs() - 1.0, y].map(|c| c * (f32::from_bits((slope + LEAST_SLOPE) << 21) * linear_depth)),
    }
}

/// A texel of `guide`. The background is all zeros.
pub(crate) fn pack_guide(surface: &Surface) -> [u16; 4] {
    if surface.is_background() {
        return [0; 4];
    }
    let linear_depth = surface.linear_depth.clamp(LEAST_DEPTH, LARGEST_DEPTH);
    let depth = (linear_depth.to_bits() - DEPTH_EXPONENT + 0x400) & DEPTH_BITS;
    let gradient = pack_gradient(surface.gradient.into(), linear_depth);
    let word = depth | u32::from(surface.is_apart) << 31 | gradient & 0x7ff | (gradient >> 11) << 29;
    let [x, y, z] = surface.normal.map(|c| (c * NORMAL_STEPS + NORMAL_STEPS + 0.5).floor() as u16);
    [word as u16, (word >> 16) as u16, x | y << 8, z | u16::from(surface.id) << 8]
}

/// The surface of a texel of `guide`.
pub(crate) fn unpack_guide(texel: [u16; 4]) -> Surface {
    let [x, y, z, w] = texel;
    let (word, steps) = (u32::from(x) | u32::from(y) << 16, [z & 0xff, z >> 8, w & 0xff]);
    let linear_depth = match word & DEPTH_BITS {
        0 => 0.0,
        depth => f32::from_bits(depth + DEPTH_EXPONENT),
    };
    Surface {
        linear_depth,
        is_apart: word & APART_BIT != 0,
        normal: steps.map(|steps| (f32::from(steps) - NORMAL_STEPS) / NORMAL_STEPS),
        gradient: unpack_gradient(word & 0x7ff | (word >> 29 & 3) << 11, linear_depth),
        id: (w >> 8) as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_survives_packing() {
        let surface =
            Surface { linear_depth: 12.375, is_apart: false, normal: [0.0, -1.0, 0.0], gradient: [-12.375, 0.0], id: 200 };
        for is_apart in [false, true] {
            let surface = Surface { is_apart, ..surface };
            assert_eq!(unpack_guide(pack_guide(&surface)), surface);
        }
        assert!(unpack_guide(pack_guide(&Surface { linear_depth: 0.0, ..surface })).is_background());
        assert_eq!(pack_guide(&Surface { linear_depth: 0.0, ..surface }), [0; 4]);
    }

    #[test]
    fn fields_lie_where_the_specification_puts_them() {
        let surface = Surface { linear_depth: 1.0, is_apart: true, normal: [1.0, 0.0, 0.0], gradient: [0.0, 0.5], id: 7 };
        // Exponent 31 and a direction of 32 of 128; 1/2 is 13 powers of 2 above the least slope.
        let (depth, gradient) = (31 << 23, 32 | (13 * 4 + 1) << 7);
        let word: u32 = 1 << 31 | depth | gradient & 0x7ff | (gradient >> 11) << 29;
        assert_eq!(pack_guide(&surface), [word as u16, (word >> 16) as u16, 254 | 127 << 8, 127 | 7 << 8]);
    }

    #[test]
    fn depth_keeps_four_digits_and_normals_half_a_step() {
        for i in 1..1000 {
            let (linear_depth, angle) = (i as f32 * 1.234_567e-2, i as f32 * 0.1);
            let normal = Vec3::new(angle.sin() * 0.6, angle.cos() * 0.6, 0.8);
            let surface = Surface { linear_depth, is_apart: i % 2 == 0, normal: normal.into(), gradient: [0.0; 2], id: 1 };
            let read = unpack_guide(pack_guide(&surface));
            assert!((read.linear_depth / linear_depth - 1.0).abs() < 1.23e-4, "{linear_depth}: {}", read.linear_depth);
            assert!((Vec3::from(read.normal) - normal).abs().max_element() <= 0.501 / NORMAL_STEPS, "{normal}: {:?}", read.normal);
        }
        let of = |linear_depth| unpack_guide(pack_guide(&Surface { linear_depth, ..Surface::default() })).linear_depth;
        assert_eq!([1e-30, f32::MIN_POSITIVE, 1e30, f32::MAX].map(of), [LEAST_DEPTH, LEAST_DEPTH, LARGEST_DEPTH, LARGEST_DEPTH]);
    }

    #[test]
    fn a_gradient_keeps_its_direction_and_about_its_length() {
        for (i, linear_depth) in (0..1000).zip([0.01, 1.0, 3000.0].into_iter().cycle()) {
            let slope = 1e-4 * 1.01_f32.powi(i);
            let given = Vec2::from_angle(i as f32 * 0.7) * slope * linear_depth;
            let read = Vec2::from(
                unpack_guide(pack_guide(&Surface { linear_depth, gradient: given.into(), ..Surface::default() })).gradient,
            );
            let sum = given.abs().element_sum();
            // Half a step of the direction is 1/64 of the sum of both components.
            let aside = read / read.abs().element_sum() - given / sum;
            assert!(aside.abs().max_element() < 0.0157, "{given}: {read}");
            if slope < 1.5 {
                assert!((read.abs().element_sum() / sum - 1.0).abs() < 0.126, "{given}: {read}");
            }
        }
        let of = |gradient| unpack_guide(pack_guide(&Surface { linear_depth: 1.0, gradient, ..Surface::default() })).gradient;
        assert_eq!([[1e-5, 0.0], [0.0, -1.0], [-1e30, 0.0], [0.0, 0.0]].map(of), [[0.0; 2], [0.0, -1.0], [-3.0, 0.0], [0.0; 2]]);
    }

    #[test]
    fn ids_fold_into_a_byte_and_only_zero_is_background() {
        assert!((0..=255).all(|id| u32::from(fold_id(id)) == id));
        assert!((256..100_000).chain([u32::MAX]).all(|id| fold_id(id) != 0));
        let mut seen = [0u32; 256];
        (256..256 + 25_500).for_each(|id| seen[usize::from(fold_id(id))] += 1);
        assert!(seen[1..].iter().all(|&n| n > 40 && n < 180), "{seen:?}");
        // pcg(0) of the published generator, so that the constants cannot drift.
        assert_eq!(pcg(0), 129_708_002);
    }
}

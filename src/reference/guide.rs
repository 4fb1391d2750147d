//! The packed guide: what the filters know of the surface in a pixel. It is also the history of depth, normal and id.

use glam::Vec3;

/// A pixel of the guide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Surface {
    /// View-space depth along the view axis, positive, scene units, kept with a mantissa of 19 bits; 0 is the background.
    pub linear_depth: f32,
    /// Whether the albedo is too dark to divide the light by.
    pub is_dark: bool,
    /// World-space normal, of unit length but for its steps of 1/127.
    pub normal: [f32; 3],
    /// 0 to 1; kept in steps of 1/15.
    pub roughness: f32,
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

/// A texel of `guide`. The background is all zeros.
pub(crate) fn pack_guide(surface: &Surface) -> [u16; 4] {
    if surface.is_background() {
        return [0; 4];
    }
    let roughness = (surface.roughness.clamp(0.0, 1.0) * 15.0 + 0.5).floor() as u32;
    let depth = surface.linear_depth.to_bits() & !0xf | roughness;
    let depth = depth | u32::from(surface.is_dark) << 31;
    let [x, y, z] = surface.normal.map(|c| (c * NORMAL_STEPS + NORMAL_STEPS + 0.5).floor() as u16);
    [depth as u16, (depth >> 16) as u16, x | y << 8, z | u16::from(surface.id) << 8]
}

/// The surface of a texel of `guide`.
pub(crate) fn unpack_guide(texel: [u16; 4]) -> Surface {
    let [x, y, z, w] = texel;
    let steps = [z & 0xff, z >> 8, w & 0xff];
    Surface {
        linear_depth: f32::from_bits(u32::from(x & !0xf) | u32::from(y & 0x7fff) << 16),
        is_dark: y >> 15 == 1,
        normal: steps.map(|steps| (f32::from(steps) - NORMAL_STEPS) / NORMAL_STEPS),
        roughness: f32::from(x & 0xf) / 15.0,
        id: (w >> 8) as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_survives_packing() {
        let surface = Surface { linear_depth: 12.375, is_dark: false, normal: [0.0, -1.0, 0.0], roughness: 0.4, id: 200 };
        for is_dark in [false, true] {
            let surface = Surface { is_dark, ..surface };
            assert_eq!(unpack_guide(pack_guide(&surface)), surface);
        }
        assert!(unpack_guide(pack_guide(&Surface { linear_depth: 0.0, ..surface })).is_background());
        assert_eq!(pack_guide(&Surface { linear_depth: 0.0, ..surface }), [0; 4]);
    }

    #[test]
    fn fields_lie_where_the_specification_puts_them() {
        let texel = pack_guide(&Surface { linear_depth: 1.0, is_dark: true, normal: [1.0, 0.0, 0.0], roughness: 1.0, id: 7 });
        assert_eq!(texel, [15, 0xbf80, 254 | 127 << 8, 127 | 7 << 8]);
    }

    #[test]
    fn depth_keeps_six_digits_and_normals_half_a_step() {
        for i in 1..1000 {
            let (linear_depth, angle) = (i as f32 * 1.234_567e-2, i as f32 * 0.1);
            let normal = Vec3::new(angle.sin() * 0.6, angle.cos() * 0.6, 0.8);
            let read = unpack_guide(pack_guide(&Surface {
                linear_depth,
                is_dark: i % 2 == 0,
                normal: normal.into(),
                roughness: 0.7,
                id: 1,
            }));
            assert!((read.linear_depth / linear_depth - 1.0).abs() < 2e-6, "{linear_depth}: {}", read.linear_depth);
            assert!((Vec3::from(read.normal) - normal).abs().max_element() <= 0.501 / NORMAL_STEPS, "{normal}: {:?}", read.normal);
        }
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

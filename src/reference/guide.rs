//! The packed guide: what the filters know of the surface in a pixel. It is also the history of depth, normal and id.

use super::octahedral::{octahedral10, octahedral10_to_normal};
use glam::Vec3;

/// A pixel of the guide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// View-space depth along the view axis, positive, scene units; 0 is the background.
    pub linear_depth: f32,
    /// World-space unit normal.
    pub normal: [f32; 3],
    /// 0 to 1; kept in steps of 1/15.
    pub roughness: f32,
    /// Surface id, folded by [`fold_id`]; 0 for the background.
    pub id: u8,
}

impl Surface {
    /// Whether no surface was hit.
    pub fn is_background(&self) -> bool {
        self.linear_depth == 0.0
    }

    pub(crate) fn cosine(&self, other: &Self) -> f32 {
        Vec3::from(self.normal).dot(other.normal.into())
    }
}

/// A surface id in 8 bits: itself up to 255, else hashed into 1 to 255, so that only the background is 0.
pub fn fold_id(id: u32) -> u8 {
    let folded = if id <= 255 { id } else { 1 + pcg(id) % 255 };
    folded as u8
}

/// The hash of the published generator.
pub(crate) fn pcg(v: u32) -> u32 {
    let s = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let w = ((s >> ((s >> 28) + 4)) ^ s).wrapping_mul(277_803_737);
    (w >> 22) ^ w
}

/// A texel of `guide`. The background is all zeros.
pub fn pack_guide(surface: &Surface) -> [u16; 4] {
    if surface.is_background() {
        return [0; 4];
    }
    let depth = surface.linear_depth.to_bits();
    let roughness = (surface.roughness.clamp(0.0, 1.0) * 15.0 + 0.5).floor() as u32;
    let rest = octahedral10(surface.normal) | roughness << 20 | u32::from(surface.id) << 24;
    [depth as u16, (depth >> 16) as u16, rest as u16, (rest >> 16) as u16]
}

/// The surface of a texel of `guide`.
pub fn unpack_guide(texel: [u16; 4]) -> Surface {
    let [x, y, z, w] = texel.map(u32::from);
    let rest = z | w << 16;
    Surface {
        linear_depth: f32::from_bits(x | y << 16),
        normal: octahedral10_to_normal(rest),
        roughness: (rest >> 20 & 0xf) as f32 / 15.0,
        id: (rest >> 24) as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_survives_packing() {
        let surface = Surface { linear_depth: 12.345, normal: [0.0, -1.0, 0.0], roughness: 0.4, id: 200 };
        assert_eq!(unpack_guide(pack_guide(&surface)), surface);
        assert!(unpack_guide(pack_guide(&Surface { linear_depth: 0.0, ..surface })).is_background());
        assert_eq!(pack_guide(&Surface { linear_depth: 0.0, ..surface }), [0; 4]);
    }

    #[test]
    fn fields_lie_where_the_specification_puts_them() {
        let texel = pack_guide(&Surface { linear_depth: 1.0, normal: [1.0, 0.0, 0.0], roughness: 1.0, id: 7 });
        let rest: u32 = 1022 | 511 << 10 | 15 << 20 | 7 << 24;
        assert_eq!(texel, [0, 0x3f80, rest as u16, (rest >> 16) as u16]);
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

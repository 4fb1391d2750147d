//! The distance that one sees through a pixel of a volume, which is all that its filters know of it. Normals and ids of surfaces
//! mean nothing to them.

use super::guide::{unpack_guide, Surface};

/// Depth where nothing is hit: beyond every surface, and finite.
const FAR: f32 = 1e30;

/// The distance that one sees in a pixel of the guide.
pub(crate) fn volume_depth(texel: [u16; 4]) -> f32 {
    sight(&unpack_guide(texel))
}

/// The distance that one sees up to a surface.
pub(crate) fn sight(surface: &Surface) -> f32 {
    if surface.is_background() {
        FAR
    } else {
        surface.linear_depth.min(FAR)
    }
}

/// Difference of two depths as a share of the larger one: 0 to 1.
pub(crate) fn relative_difference(a: f32, b: f32) -> f32 {
    (a - b).abs() / a.max(b)
}

#[cfg(test)]
mod tests {
    use super::super::{pack_guide, test_scene::surface};
    use super::*;

    #[test]
    fn the_background_is_far_and_equal_to_itself() {
        let (near, sky) = (volume_depth(pack_guide(&surface(2.0))), volume_depth(pack_guide(&Surface::default())));
        assert_eq!((near, relative_difference(sky, sky), relative_difference(near, near)), (2.0, 0.0, 0.0));
        assert_eq!(
            (relative_difference(sky, near), relative_difference(near, sky), relative_difference(2.0, 1.0)),
            (1.0, 1.0, 0.5)
        );
    }
}

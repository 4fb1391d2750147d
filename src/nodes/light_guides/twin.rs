//! The stage `light_guides`: guides of the pixels that light was traced for.

use crate::reference::binary16::{from_half_bits, half_bits};
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Unit};
use crate::reference::rules::{rule, EXACT, HALF};
use crate::reference::surface_motion::{pack_depth_gradient, unpack_depth_gradient};
use crate::reference::Image;
use crate::{Error, FrameConstants};

/// The texel of every pixel of the light, from that of the guides' pixel that it was traced for.
fn picked<T: Copy + Default + Send + Sync, U: Copy + Default + Send + Sync>(
    frame: &FrameConstants,
    extent: [u32; 2],
    of: &Image<T>,
    f: impl Fn(T) -> U + Sync,
) -> Image<U> {
    Image::compute(extent, frame.render_extent, |p| f(of.at(frame.guide_pixel(p))))
}

/// Motion counts pixels of the light, of which there are fewer.
pub(crate) fn motion_of_light(frame: &FrameConstants, [x, y, z, w]: [u16; 4]) -> [u16; 4] {
    let scaled = |bits: u16, ratio: u32| half_bits(from_half_bits(bits) / ratio as f32);
    [scaled(x, frame.light_ratio[0]), scaled(y, frame.light_ratio[1]), z, w]
}

/// The change of depth from one pixel of the light to the next, on the plane of its surface.
pub(crate) fn gradient_of_light(frame: &FrameConstants, texel: u32) -> u32 {
    let [x, y] = unpack_depth_gradient(texel);
    pack_depth_gradient([x * frame.light_ratio[0] as f32, y * frame.light_ratio[1] as f32])
}

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    rule("guide", Unit::Pixel, Reading::Guide, EXACT),
    rule("surface_motion", Unit::Pixel, Reading::SurfaceMotion, HALF),
    rule("depth_gradient", Unit::Pixel, Reading::DepthGradient, HALF),
    rule("object_normal_guide", Unit::Pixel, Reading::Normal, EXACT),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let (frame, extent) = (b.frame, b.extent_of("guide")?);
    let guide = picked(frame, extent, b.packed("rendered_guide")?, |texel| texel);
    let motion = picked(frame, extent, b.packed("rendered_surface_motion")?, |texel| motion_of_light(frame, texel));
    let gradient = picked(frame, extent, b.uint("rendered_depth_gradient")?, |texel| gradient_of_light(frame, texel));
    let normals = b.optional_uint("rendered_object_normal_guide")?.map(|of| picked(frame, extent, of, |texel| texel));
    b.write("guide", guide)?;
    b.write("surface_motion", motion)?;
    b.write("depth_gradient", gradient)?;
    match normals {
        Some(normals) if b.has("object_normal_guide") => b.write("object_normal_guide", normals),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::projection::view_position;
    use crate::reference::surface_motion::{pack_surface_motion, unpack_surface_motion};
    use crate::reference::test_scene::{camera, frame_with};
    use crate::{Config, FrameParams};
    use glam::{IVec2, Vec3};

    const EXTENT: [u32; 2] = [24, 16];

    fn frame(light: [u32; 2], light_offset: [u32; 2]) -> FrameConstants {
        let config = Config { light_extent: Some(light), ..Config::new(EXTENT) };
        let before = camera(EXTENT, Vec3::ZERO);
        frame_with(&config, &before, &FrameParams { jitter: [0.3, -0.45], light_offset, ..before })
    }

    #[test]
    fn a_pixel_of_light_lies_where_it_was_traced() {
        for (light, offset) in [([12, 8], [0, 0]), ([12, 8], [1, 0]), ([12, 8], [1, 1]), ([24, 8], [0, 1]), ([12, 16], [1, 0])] {
            let frame = frame(light, offset);
            assert_eq!(frame.render_extent, light);
            for p in [IVec2::new(0, 0), IVec2::new(5, 3), IVec2::new(11, 7)] {
                let (of_light, traced) =
                    (view_position(&frame, p, 3.0), view_position(&frame.of_guides(), frame.guide_pixel(p), 3.0));
                assert!((of_light - traced).length() < 1e-5, "{light:?} {offset:?} {p}: {of_light} {traced}");
            }
        }
    }

    #[test]
    fn motion_and_change_of_depth_count_pixels_of_light() {
        let frame = frame([12, 16], [1, 0]);
        let texel = pack_surface_motion([3.0, -5.0], Some((0.25, [0.0, 0.0, 1.0])));
        let moved = unpack_surface_motion(motion_of_light(&frame, texel));
        assert_eq!((moved.motion, moved.depth_ratio), ([1.5, -5.0], 0.25));
        let gradient = gradient_of_light(&frame, pack_depth_gradient([0.5, 60000.0]));
        assert_eq!(unpack_depth_gradient(gradient), [1.0, 60000.0]);
    }
}

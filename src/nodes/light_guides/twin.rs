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

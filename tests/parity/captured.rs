//! What a pass read and wrote on the GPU, as its twin takes it.

use ::atrous::executor::Session;
use ::atrous::reference::Texels;
use ::atrous::{Access, Component, Error, ImageFormat, Shape};
use ash::vk;

/// For every use of a pass what was there; `None` where nothing is bound, or was not asked for.
pub type Captured = Vec<Option<Texels>>;

/// What a pass touches, of the accesses that are wanted.
pub fn capture(s: &mut Session, pass: usize, want: fn(Access) -> bool) -> Result<Captured, Error> {
    let declaration = s.executor().denoiser().declaration().clone();
    let texels = declaration.passes()[pass].uses.iter().map(|u| {
        let resource = declaration.resource(u.resource);
        if !want(u.access) || u.access == Access::Uniform {
            return Ok(None);
        }
        // An optional input that nothing is bound to has no bytes.
        let Ok(bytes) = s.download_bytes(&resource.name, u.frame) else { return Ok(None) };
        match resource.shape {
            Shape::Image { format, .. } => {
                let extent = resource.extent(declaration.setup()).expect("an image");
                Texels::from_bytes(kept_as(format), extent, &bytes).map(Some)
            }
            Shape::Buffer { .. } => Ok(Some(Texels::Bytes(bytes))),
        }
    });
    texels.collect()
}

/// The format in which a session has an image; those of a host are four floats, or ids.
fn kept_as(format: ImageFormat) -> vk::Format {
    match format {
        ImageFormat::Exactly(format) => format,
        ImageFormat::Any(Component::Float, _) => vk::Format::R32G32B32A32_SFLOAT,
        ImageFormat::Any(Component::Uint, _) => vk::Format::R32_UINT,
    }
}

//! Formats that an image may have.

use super::texel::{Class, Texel};
use crate::shaders::Component;
use ash::vk;

/// The formats that an image may have.
///
/// Closed by the contract: you may match every one, since a new one would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// One format. Images that we write are declared so, and the shader carries the same format qualifier.
    Exactly(vk::Format),
    /// Any format of this numeric class. The second is the recommended one.
    Any(Component, vk::Format),
}

impl ImageFormat {
    /// The format to create the image with, unless you have a reason for a different one.
    pub const fn preferred(self) -> vk::Format {
        match self {
            Self::Exactly(format) | Self::Any(_, format) => format,
        }
    }

    /// Whether an image of `format` can be bound.
    pub fn accepts(self, format: vk::Format) -> bool {
        match self {
            Self::Exactly(exact) => exact == format,
            Self::Any(component, _) => component_of(format) == Some(component),
        }
    }
}

impl std::fmt::Display for ImageFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exactly(format) => write!(f, "{format:?}"),
            Self::Any(Component::Float, format) => write!(f, "any floating-point or normalised colour format, such as {format:?}"),
            Self::Any(Component::Uint, format) => write!(f, "any unsigned integer format, such as {format:?}"),
        }
    }
}

/// The numeric class that a shader sees; `None` for formats that no image of ours can have.
pub(crate) fn component_of(format: vk::Format) -> Option<Component> {
    Texel::of(format).map(|texel| match texel.class() {
        Class::Float => Component::Float,
        Class::Uint => Component::Uint,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_takes_its_formats_and_no_others() {
        let any = ImageFormat::Any(Component::Float, vk::Format::R32_SFLOAT);
        assert!(any.accepts(vk::Format::D32_SFLOAT));
        assert!(any.accepts(vk::Format::B10G11R11_UFLOAT_PACK32));
        assert!(!any.accepts(vk::Format::R32_UINT));
        assert!(!any.accepts(vk::Format::UNDEFINED));
        assert!(!ImageFormat::Exactly(vk::Format::R16G16B16A16_SFLOAT).accepts(vk::Format::R32G32B32A32_SFLOAT));
    }
}

//! Formats that an image may have.

use crate::shaders::Component;
use ash::vk;

/// The formats that an image may have.
///
/// Closed by the contract: a host may match every one, and another would be a breaking change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// One format. Images that we write are declared so, and the shader carries the same format qualifier.
    Exactly(vk::Format),
    /// Any format of this numeric class; the second is the one to take where there is no reason for another.
    Any(Component, vk::Format),
}

impl ImageFormat {
    /// The format to create the image with, where the host has no other reason.
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

/// The numeric class that a shader sees, `None` for formats that no input of ours can have (signed integers, multi-planar, unknown
/// ones).
pub(crate) fn component_of(format: vk::Format) -> Option<Component> {
    use vk::Format as F;
    match format {
        F::R8_UINT | F::R16_UINT | F::R32_UINT | F::R8G8_UINT | F::R16G16_UINT | F::R32G32_UINT => Some(Component::Uint),
        F::R8G8B8A8_UINT | F::R16G16B16A16_UINT | F::R32G32B32A32_UINT | F::A2B10G10R10_UINT_PACK32 => Some(Component::Uint),
        F::R8_UNORM | F::R8_SNORM | F::R8G8_UNORM | F::R8G8_SNORM | F::R8G8B8A8_UNORM | F::R8G8B8A8_SNORM => Some(Component::Float),
        F::R8G8B8A8_SRGB | F::B8G8R8A8_UNORM | F::B8G8R8A8_SRGB => Some(Component::Float),
        F::R16_UNORM | F::R16_SNORM | F::R16G16_UNORM | F::R16G16_SNORM | F::R16G16B16A16_UNORM => Some(Component::Float),
        F::R16G16B16A16_SNORM | F::R16_SFLOAT | F::R16G16_SFLOAT | F::R16G16B16_SFLOAT => Some(Component::Float),
        F::R16G16B16A16_SFLOAT | F::R32_SFLOAT | F::R32G32_SFLOAT | F::R32G32B32_SFLOAT => Some(Component::Float),
        F::R32G32B32A32_SFLOAT | F::B10G11R11_UFLOAT_PACK32 | F::E5B9G9R9_UFLOAT_PACK32 => Some(Component::Float),
        F::A2B10G10R10_UNORM_PACK32 | F::A2R10G10B10_UNORM_PACK32 | F::A2B10G10R10_SNORM_PACK32 => Some(Component::Float),
        F::D16_UNORM | F::D32_SFLOAT | F::X8_D24_UNORM_PACK32 => Some(Component::Float),
        F::D24_UNORM_S8_UINT | F::D32_SFLOAT_S8_UINT => Some(Component::Float),
        _ => None,
    }
}

/// Bytes of one texel of a format that we declare ourselves.
pub(crate) fn bytes_per_texel(format: vk::Format) -> u64 {
    match format {
        vk::Format::R32_UINT | vk::Format::R32_SFLOAT | vk::Format::R8G8B8A8_UNORM => 4,
        vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
        _ => 8,
    }
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

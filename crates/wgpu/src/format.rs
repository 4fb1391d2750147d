//! Formats of textures in the words of both.

use ash::vk;
use wgpu::TextureFormat as T;

/// Every format that a texture may have here, with Vulkan's name. `Depth24Plus` is missing, since
/// it differs from device to device.
const FORMATS: [(T, vk::Format); 30] = [
    (T::R8Unorm, vk::Format::R8_UNORM),
    (T::R16Float, vk::Format::R16_SFLOAT),
    (T::R16Unorm, vk::Format::R16_UNORM),
    (T::R16Uint, vk::Format::R16_UINT),
    (T::R32Float, vk::Format::R32_SFLOAT),
    (T::R32Uint, vk::Format::R32_UINT),
    (T::R8Uint, vk::Format::R8_UINT),
    (T::Rg8Unorm, vk::Format::R8G8_UNORM),
    (T::Rg8Snorm, vk::Format::R8G8_SNORM),
    (T::Rg16Float, vk::Format::R16G16_SFLOAT),
    (T::Rg16Snorm, vk::Format::R16G16_SNORM),
    (T::Rg16Unorm, vk::Format::R16G16_UNORM),
    (T::Rg16Uint, vk::Format::R16G16_UINT),
    (T::Rg32Float, vk::Format::R32G32_SFLOAT),
    (T::Rg32Uint, vk::Format::R32G32_UINT),
    (T::Rgba8Unorm, vk::Format::R8G8B8A8_UNORM),
    (T::Rgba8UnormSrgb, vk::Format::R8G8B8A8_SRGB),
    (T::Rgba8Snorm, vk::Format::R8G8B8A8_SNORM),
    (T::Rgba8Uint, vk::Format::R8G8B8A8_UINT),
    (T::Bgra8Unorm, vk::Format::B8G8R8A8_UNORM),
    (T::Bgra8UnormSrgb, vk::Format::B8G8R8A8_SRGB),
    (T::Rgb10a2Unorm, vk::Format::A2B10G10R10_UNORM_PACK32),
    (T::Rg11b10Ufloat, vk::Format::B10G11R11_UFLOAT_PACK32),
    (T::Rgba16Float, vk::Format::R16G16B16A16_SFLOAT),
    (T::Rgba16Snorm, vk::Format::R16G16B16A16_SNORM),
    (T::Rgba16Uint, vk::Format::R16G16B16A16_UINT),
    (T::Rgba32Float, vk::Format::R32G32B32A32_SFLOAT),
    (T::Rgba32Uint, vk::Format::R32G32B32A32_UINT),
    (T::Depth16Unorm, vk::Format::D16_UNORM),
    (T::Depth32Float, vk::Format::D32_SFLOAT),
];

/// Vulkan's name of a format, if it is certain.
pub fn to_vulkan(format: T) -> Option<vk::Format> {
    FORMATS.iter().find(|(ours, _)| *ours == format).map(|(_, vulkan)| *vulkan)
}

/// wgpu's name of a format.
pub fn to_wgpu(format: vk::Format) -> Option<T> {
    FORMATS.iter().find(|(_, vulkan)| *vulkan == format).map(|(ours, _)| *ours)
}

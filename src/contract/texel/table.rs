//! The table of formats.

use super::decode::{depth24, float11, shared_exponent, snorm10, uint10, unorm10, unorm10_bgr};
use ash::vk;

/// The numeric class of an image as a shader sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// Floating point or normalised, depth included.
    Float,
    /// Unsigned integer.
    Uint,
}

/// The formats of the table in words, for errors.
pub(crate) const ACCEPTED: &str = "one of R, RG, RGB, RGBA or BGRA with components of 8 or 16 bit (UNORM, SNORM, UINT, 8 bit also SRGB), SFLOAT of \
     16 or 32 bit or 32-bit UINT, A2B10G10R10 (UNORM, SNORM, UINT), A2R10G10B10_UNORM, B10G11R11_UFLOAT, E5B9G9R9_UFLOAT, D16, D24 or \
     D32_SFLOAT; copy the image into one of these and bind the copy";

/// The encoding of one component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sample {
    Unorm8,
    Snorm8,
    Srgb8,
    Uint8,
    Unorm16,
    Snorm16,
    Uint16,
    Half,
    Uint32,
    Float,
}

impl Sample {
    pub(super) const fn bytes(self) -> usize {
        match self {
            Self::Unorm8 | Self::Snorm8 | Self::Srgb8 | Self::Uint8 => 1,
            Self::Unorm16 | Self::Snorm16 | Self::Uint16 | Self::Half => 2,
            Self::Uint32 | Self::Float => 4,
        }
    }

    const fn class(self) -> Class {
        match self {
            Self::Uint8 | Self::Uint16 | Self::Uint32 => Class::Uint,
            _ => Class::Float,
        }
    }
}

/// The layout of a texel.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Layout {
    /// Components one after the other; where red, green, blue and alpha are.
    Plain(Sample, &'static [usize]),
    /// 32 bits that hold so many components, and what they are.
    Packed(Class, usize, fn(u32) -> [f32; 4]),
}

const R: &[usize] = &[0];
const RG: &[usize] = &[0, 1];
const RGB: &[usize] = &[0, 1, 2];
const RGBA: &[usize] = &[0, 1, 2, 3];
const BGRA: &[usize] = &[2, 1, 0, 3];

const TABLE: &[(vk::Format, Layout)] = {
    use {vk::Format as F, Class::Float, Class::Uint, Layout::Packed, Layout::Plain, Sample as S};
    &[
        (F::R8_UNORM, Plain(S::Unorm8, R)),
        (F::R8G8_UNORM, Plain(S::Unorm8, RG)),
        (F::R8G8B8A8_UNORM, Plain(S::Unorm8, RGBA)),
        (F::B8G8R8A8_UNORM, Plain(S::Unorm8, BGRA)),
        (F::R8G8B8A8_SRGB, Plain(S::Srgb8, RGBA)),
        (F::B8G8R8A8_SRGB, Plain(S::Srgb8, BGRA)),
        (F::R8_SNORM, Plain(S::Snorm8, R)),
        (F::R8G8_SNORM, Plain(S::Snorm8, RG)),
        (F::R8G8B8A8_SNORM, Plain(S::Snorm8, RGBA)),
        (F::R8_UINT, Plain(S::Uint8, R)),
        (F::R8G8_UINT, Plain(S::Uint8, RG)),
        (F::R8G8B8A8_UINT, Plain(S::Uint8, RGBA)),
        (F::R16_UNORM, Plain(S::Unorm16, R)),
        (F::R16G16_UNORM, Plain(S::Unorm16, RG)),
        (F::R16G16B16A16_UNORM, Plain(S::Unorm16, RGBA)),
        (F::R16_SNORM, Plain(S::Snorm16, R)),
        (F::R16G16_SNORM, Plain(S::Snorm16, RG)),
        (F::R16G16B16A16_SNORM, Plain(S::Snorm16, RGBA)),
        (F::R16_UINT, Plain(S::Uint16, R)),
        (F::R16G16_UINT, Plain(S::Uint16, RG)),
        (F::R16G16B16A16_UINT, Plain(S::Uint16, RGBA)),
        (F::R16_SFLOAT, Plain(S::Half, R)),
        (F::R16G16_SFLOAT, Plain(S::Half, RG)),
        (F::R16G16B16_SFLOAT, Plain(S::Half, RGB)),
        (F::R16G16B16A16_SFLOAT, Plain(S::Half, RGBA)),
        (F::R32_UINT, Plain(S::Uint32, R)),
        (F::R32G32_UINT, Plain(S::Uint32, RG)),
        (F::R32G32B32A32_UINT, Plain(S::Uint32, RGBA)),
        (F::R32_SFLOAT, Plain(S::Float, R)),
        (F::R32G32_SFLOAT, Plain(S::Float, RG)),
        (F::R32G32B32_SFLOAT, Plain(S::Float, RGB)),
        (F::R32G32B32A32_SFLOAT, Plain(S::Float, RGBA)),
        (F::A2B10G10R10_UNORM_PACK32, Packed(Float, 4, unorm10)),
        (F::A2R10G10B10_UNORM_PACK32, Packed(Float, 4, unorm10_bgr)),
        (F::A2B10G10R10_SNORM_PACK32, Packed(Float, 4, snorm10)),
        (F::A2B10G10R10_UINT_PACK32, Packed(Uint, 4, uint10)),
        (F::B10G11R11_UFLOAT_PACK32, Packed(Float, 3, float11)),
        (F::E5B9G9R9_UFLOAT_PACK32, Packed(Float, 3, shared_exponent)),
        // Of a combined format the depth alone is sampled and copied.
        (F::D16_UNORM, Plain(S::Unorm16, R)),
        (F::X8_D24_UNORM_PACK32, Packed(Float, 1, depth24)),
        (F::D24_UNORM_S8_UINT, Packed(Float, 1, depth24)),
        (F::D32_SFLOAT, Plain(S::Float, R)),
        (F::D32_SFLOAT_S8_UINT, Plain(S::Float, R)),
    ]
};

/// A texel of a format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Texel {
    format: vk::Format,
    pub(crate) layout: Layout,
}

impl Texel {
    /// The texel of a format; `None` for one that no image of ours can have (signed integers, multi-planar, compressed, unknown).
    pub(crate) fn of(format: vk::Format) -> Option<Self> {
        Self::all().find(|texel| texel.format == format)
    }

    /// The texel of every format that an image may have.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|&(format, layout)| Self { format, layout })
    }

    /// The format.
    #[cfg(test)]
    pub(crate) fn format(&self) -> vk::Format {
        self.format
    }

    /// The numeric class.
    pub(crate) fn class(&self) -> Class {
        match self.layout {
            Layout::Plain(sample, _) => sample.class(),
            Layout::Packed(class, ..) => class,
        }
    }

    /// Bytes, as a copy of [`Self::copied_aspect`] into a buffer has them.
    pub(crate) fn bytes(&self) -> usize {
        match self.layout {
            Layout::Plain(sample, order) => sample.bytes() * order.len(),
            Layout::Packed(..) => 4,
        }
    }

    /// Every aspect, for barriers: they name all of them.
    pub(crate) fn aspects(&self) -> vk::ImageAspectFlags {
        match self.format {
            vk::Format::D24_UNORM_S8_UINT | vk::Format::D32_SFLOAT_S8_UINT => {
                vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL
            }
            vk::Format::D16_UNORM | vk::Format::D32_SFLOAT | vk::Format::X8_D24_UNORM_PACK32 => vk::ImageAspectFlags::DEPTH,
            _ => vk::ImageAspectFlags::COLOR,
        }
    }

    /// The one aspect that is sampled and copied: of a depth-stencil image the depth.
    pub(crate) fn copied_aspect(&self) -> vk::ImageAspectFlags {
        self.aspects() & !vk::ImageAspectFlags::STENCIL
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bits of a copied texel by the name of the format: the digits behind the letters of its components.
    fn bits_by_name(name: &str) -> usize {
        let depth = name.trim_end_matches("_UINT").trim_end_matches("_S8");
        // 24 bits of depth are copied as 32.
        if depth.contains("D24") {
            return 32;
        }
        let components = depth.split('_').next().unwrap_or_default();
        components.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse::<usize>().ok()).sum()
    }

    #[test]
    fn size_class_and_aspect_are_those_of_the_name() {
        for texel in Texel::all() {
            let name = format!("{:?}", texel.format());
            assert_eq!(8 * texel.bytes(), bits_by_name(&name), "{name}");
            let is_depth = name.contains("D16") || name.contains("D24") || name.contains("D32");
            assert_eq!(texel.copied_aspect() == vk::ImageAspectFlags::DEPTH, is_depth, "{name}");
            assert_eq!(texel.aspects().contains(vk::ImageAspectFlags::STENCIL), name.contains("S8"), "{name}");
            assert_eq!(texel.class() == Class::Uint, name.contains("UINT") && !is_depth, "{name}");
        }
    }

    #[test]
    fn a_format_has_one_row_and_others_none() {
        for texel in Texel::all() {
            assert_eq!(Texel::all().filter(|other| other.format() == texel.format()).count(), 1, "{:?}", texel.format());
        }
        for format in [vk::Format::UNDEFINED, vk::Format::R32_SINT, vk::Format::S8_UINT, vk::Format::R64_SFLOAT] {
            assert!(Texel::of(format).is_none(), "{format:?}");
        }
    }
}

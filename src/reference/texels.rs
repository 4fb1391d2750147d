//! The texels of an image, or the bytes of a buffer, on the CPU.

use super::binary16::from_half_bits;
use super::Image;
use crate::{Component, Error, FrameConstants, ImageFormat};
use ash::vk;
use glam::IVec2;

/// Texels in the representation that the twins read and write, or the bytes of a buffer.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Four floats: images of a host, and our own with four halves.
    Colour(Image<[f32; 4]>),
    /// One float: our own images of that kind.
    Scalar(Image<f32>),
    /// 64 packed bits.
    Packed(Image<[u16; 4]>),
    /// 32 packed bits, and ids of a host.
    Uint(Image<u32>),
    /// Four times 32 packed bits.
    Wide(Image<[u32; 4]>),
    /// A buffer.
    Bytes(Vec<u8>),
}

impl Texels {
    /// Zeros everywhere, for an image of a declaration.
    ///
    /// # Errors
    /// [`Error::Format`] for a format that no stage of ours reads or writes.
    pub fn zeroed(format: ImageFormat, extent: [u32; 2]) -> Result<Self, Error> {
        match format {
            ImageFormat::Any(Component::Float, _) => Ok(Self::Colour(Image::new(extent, [0.0; 4]))),
            ImageFormat::Any(Component::Uint, _) => Ok(Self::Uint(Image::new(extent, 0))),
            ImageFormat::Exactly(vk::Format::R32_SFLOAT) => Ok(Self::Scalar(Image::new(extent, 0.0))),
            ImageFormat::Exactly(format) => {
                let bytes = vec![0; byte_size(format, extent)?];
                Self::from_bytes(format, extent, &bytes)
            }
        }
    }

    /// The texels of an image in memory, row by row without gaps. An image of one float becomes [`Self::Scalar`].
    ///
    /// # Errors
    /// [`Error::Format`] for a format that no stage of ours reads or writes; [`Error::Size`] for a wrong number of bytes.
    pub fn from_bytes(format: vk::Format, extent: [u32; 2], bytes: &[u8]) -> Result<Self, Error> {
        let needed = byte_size(format, extent)?;
        if bytes.len() != needed {
            let (given, needed) = (format!("{} bytes", bytes.len()), format!("{needed} bytes for {extent:?} texels of {format:?}"));
            return Err(Error::Size { resource: "Texels::from_bytes".into(), given, needed });
        }
        let halves = || bytemuck::allocation::pod_collect_to_vec::<u8, [u16; 4]>(bytes);
        Ok(match format {
            vk::Format::R32G32B32A32_SFLOAT => Self::Colour(image(extent, bytes)?),
            vk::Format::R16G16B16A16_SFLOAT => {
                Self::Colour(Image::from_texels(extent, halves())?.map(|texel| texel.map(from_half_bits)))
            }
            vk::Format::R32_SFLOAT => Self::Scalar(image(extent, bytes)?),
            vk::Format::R32_UINT => Self::Uint(image(extent, bytes)?),
            vk::Format::R32G32B32A32_UINT => Self::Wide(image(extent, bytes)?),
            _ => Self::Packed(image(extent, bytes)?),
        })
    }

    /// Width and height; a buffer has its bytes in one row.
    pub fn extent(&self) -> [u32; 2] {
        match self {
            Self::Colour(image) => image.extent(),
            Self::Scalar(image) => image.extent(),
            Self::Packed(image) => image.extent(),
            Self::Uint(image) => image.extent(),
            Self::Wide(image) => image.extent(),
            Self::Bytes(bytes) => [bytes.len() as u32, 1],
        }
    }

    /// Every texel as four floats, as a host that reads an image back sees it: packed halves of 16 bits each as whole numbers.
    pub fn to_floats(&self) -> Vec<[f32; 4]> {
        match self {
            Self::Colour(image) => image.texels().to_vec(),
            Self::Scalar(image) => image.texels().iter().map(|x| [*x, 0.0, 0.0, 0.0]).collect(),
            Self::Packed(image) => image.texels().iter().map(|t| t.map(f32::from)).collect(),
            Self::Uint(image) => image.texels().iter().map(|x| [*x as f32, 0.0, 0.0, 0.0]).collect(),
            Self::Wide(image) => image.texels().iter().map(|t| t.map(|x| x as f32)).collect(),
            Self::Bytes(bytes) => bytes.iter().map(|x| [f32::from(*x), 0.0, 0.0, 0.0]).collect(),
        }
    }

    /// A part of an image, from a pixel on. A buffer is whole.
    pub(crate) fn part(&self, [x, y]: [u32; 2], extent: [u32; 2]) -> Self {
        fn cut<T: Copy + Default + Send + Sync>(image: &Image<T>, [x, y]: [i32; 2], [width, height]: [u32; 2]) -> Image<T> {
            let [w, h] = image.extent().map(|side| side as i32);
            // Beyond the image nothing is read.
            let nearest = |p: IVec2| IVec2::new((p.x + x).clamp(0, w - 1), (p.y + y).clamp(0, h - 1));
            Image::compute([width, height], [width, height], |p| image.at(nearest(p)))
        }
        let at = [x as i32, y as i32];
        match self {
            Self::Colour(image) => Self::Colour(cut(image, at, extent)),
            Self::Scalar(image) => Self::Scalar(cut(image, at, extent)),
            Self::Packed(image) => Self::Packed(cut(image, at, extent)),
            Self::Uint(image) => Self::Uint(cut(image, at, extent)),
            Self::Wide(image) => Self::Wide(cut(image, at, extent)),
            Self::Bytes(bytes) => Self::Bytes(bytes.clone()),
        }
    }

    /// Puts the first `extent` texels of a picture of the same kind at a pixel of this image.
    pub(crate) fn put(&mut self, picture: &Self, at: [u32; 2], extent: [u32; 2]) {
        fn put<T: Copy>(to: &mut Image<T>, from: &Image<T>, [x, y]: [u32; 2], [width, height]: [u32; 2]) {
            for (row, column) in (0..height as i32).flat_map(|row| (0..width as i32).map(move |column| (row, column))) {
                if let (Some(to), Some(from)) = (to.get_mut(column + x as i32, row + y as i32), from.get(column, row)) {
                    *to = *from;
                }
            }
        }
        match (self, picture) {
            (Self::Colour(to), Self::Colour(from)) => put(to, from, at, extent),
            (Self::Scalar(to), Self::Scalar(from)) => put(to, from, at, extent),
            (Self::Packed(to), Self::Packed(from)) => put(to, from, at, extent),
            (Self::Uint(to), Self::Uint(from)) => put(to, from, at, extent),
            (Self::Wide(to), Self::Wide(from)) => put(to, from, at, extent),
            (to, from) => *to = from.clone(),
        }
    }

    /// The constants of a frame, where that is what a buffer holds.
    pub(crate) fn as_constants(&self) -> Option<FrameConstants> {
        match self {
            Self::Bytes(bytes) => bytemuck::try_pod_read_unaligned(bytes).ok(),
            _ => None,
        }
    }

    /// Name of the kind, for messages.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Colour(_) => COLOUR,
            Self::Scalar(_) => SCALAR,
            Self::Packed(_) => PACKED,
            Self::Uint(_) => UINT,
            Self::Wide(_) => WIDE,
            Self::Bytes(_) => BYTES,
        }
    }
}

pub(super) const COLOUR: &str = "an image of four floats";
pub(super) const SCALAR: &str = "an image of one float";
pub(super) const PACKED: &str = "an image of 64 packed bits";
pub(super) const UINT: &str = "an image of 32 bits";
pub(super) const WIDE: &str = "an image of four times 32 bits";
pub(super) const BYTES: &str = "a buffer";

fn image<T: Clone + bytemuck::AnyBitPattern + bytemuck::NoUninit>(extent: [u32; 2], bytes: &[u8]) -> Result<Image<T>, Error> {
    Image::from_texels(extent, bytemuck::allocation::pod_collect_to_vec(bytes))
}

fn byte_size(format: vk::Format, [width, height]: [u32; 2]) -> Result<usize, Error> {
    let each = match format {
        vk::Format::R32G32B32A32_SFLOAT | vk::Format::R32G32B32A32_UINT => 16,
        vk::Format::R16G16B16A16_SFLOAT | vk::Format::R16G16B16A16_UINT => 8,
        vk::Format::R32_SFLOAT | vk::Format::R32_UINT => 4,
        given => {
            let allowed = "R32G32B32A32_SFLOAT, R16G16B16A16_SFLOAT, R32_SFLOAT, R32G32B32A32_UINT, R16G16B16A16_UINT or R32_UINT";
            return Err(Error::Format { resource: "Texels".into(), given, allowed: allowed.into() });
        }
    };
    Ok(width as usize * height as usize * each)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_texels_of_their_format() {
        let one = half::f16::ONE.to_bits();
        let halves = bytemuck::cast_slice(&[[one, 0, one, 0]]).to_vec();
        let texels = Texels::from_bytes(vk::Format::R16G16B16A16_SFLOAT, [1, 1], &halves).expect("eight bytes");
        assert_eq!(texels, Texels::Colour(Image::new([1, 1], [1.0, 0.0, 1.0, 0.0])));
        let texels = Texels::from_bytes(vk::Format::R16G16B16A16_UINT, [1, 1], &halves).expect("eight bytes");
        assert_eq!(texels, Texels::Packed(Image::new([1, 1], [one, 0, one, 0])));
        let scalar = Texels::from_bytes(vk::Format::R32_SFLOAT, [1, 1], &0.5_f32.to_ne_bytes()).expect("four bytes");
        assert_eq!(scalar, Texels::Scalar(Image::new([1, 1], 0.5)));
        assert_eq!(scalar.to_floats(), [[0.5, 0.0, 0.0, 0.0]]);
    }

    #[test]
    fn zeros_have_the_kind_that_bytes_become() {
        let any = |component, format| Texels::zeroed(ImageFormat::Any(component, format), [2, 3]).expect("known").kind();
        assert_eq!(any(Component::Float, vk::Format::R32_SFLOAT), COLOUR);
        assert_eq!(any(Component::Uint, vk::Format::R8_UINT), UINT);
        for (format, kind) in [
            (vk::Format::R16G16B16A16_SFLOAT, COLOUR),
            (vk::Format::R32_SFLOAT, SCALAR),
            (vk::Format::R16G16B16A16_UINT, PACKED),
            (vk::Format::R32_UINT, UINT),
            (vk::Format::R32G32B32A32_UINT, WIDE),
        ] {
            let zeros = Texels::zeroed(ImageFormat::Exactly(format), [2, 3]).expect("known");
            assert_eq!((zeros.kind(), zeros.extent()), (kind, [2, 3]));
        }
    }

    #[test]
    fn what_does_not_fit_is_named() {
        let short = Texels::from_bytes(vk::Format::R32_UINT, [2, 2], &[0; 15]).expect_err("a byte is missing").to_string();
        assert!(short.contains("15 bytes") && short.contains("16 bytes"), "{short}");
        let format = Texels::zeroed(ImageFormat::Exactly(vk::Format::R8_UNORM), [1, 1]).expect_err("no stage writes it");
        assert!(format.to_string().contains("R8_UNORM"), "{format}");
    }
}

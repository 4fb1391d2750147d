//! Texels of a host's image as samples of an EXR file. Floats and integers keep their bits; what is normalised becomes 32-bit
//! float.

use ash::vk;
use exr::image::FlatSamples;
use half::f16;

/// Formats that a capture takes, for errors.
pub(crate) const ALLOWED: &str = "for a capture one of R, RG, RGB, RGBA or BGRA with components of 8 or 16 bit (UNORM, SNORM, UINT, 8 bit also \
     SRGB), SFLOAT of 16 or 32 bit or 32-bit UINT, A2B10G10R10_UNORM, B10G11R11_UFLOAT, D16, D24 or D32_SFLOAT; copy the image into one of \
     these and bind the copy";

/// The encoding of one component.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sample {
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
    const fn bytes(self) -> usize {
        match self {
            Self::Unorm8 | Self::Snorm8 | Self::Srgb8 | Self::Uint8 => 1,
            Self::Unorm16 | Self::Snorm16 | Self::Uint16 | Self::Half => 2,
            Self::Uint32 | Self::Float => 4,
        }
    }
}

/// The layout of a texel.
#[derive(Clone, Copy)]
enum Texel {
    /// Components one after the other; where red, green, blue and alpha are.
    Plain(Sample, &'static [usize]),
    /// 32 bits that hold so many components.
    Packed(usize, fn(u32) -> [f32; 3]),
}

const R: &[usize] = &[0];
const RG: &[usize] = &[0, 1];
const RGB: &[usize] = &[0, 1, 2];
const RGBA: &[usize] = &[0, 1, 2, 3];
const BGRA: &[usize] = &[2, 1, 0, 3];

fn texel(format: vk::Format) -> Option<Texel> {
    use {vk::Format as F, Sample as S, Texel::Packed, Texel::Plain};
    Some(match format {
        F::R8_UNORM => Plain(S::Unorm8, R),
        F::R8G8_UNORM => Plain(S::Unorm8, RG),
        F::R8G8B8A8_UNORM => Plain(S::Unorm8, RGBA),
        F::B8G8R8A8_UNORM => Plain(S::Unorm8, BGRA),
        F::R8G8B8A8_SRGB => Plain(S::Srgb8, RGBA),
        F::B8G8R8A8_SRGB => Plain(S::Srgb8, BGRA),
        F::R8_SNORM => Plain(S::Snorm8, R),
        F::R8G8_SNORM => Plain(S::Snorm8, RG),
        F::R8G8B8A8_SNORM => Plain(S::Snorm8, RGBA),
        F::R8_UINT => Plain(S::Uint8, R),
        F::R8G8_UINT => Plain(S::Uint8, RG),
        F::R8G8B8A8_UINT => Plain(S::Uint8, RGBA),
        F::R16_UNORM | F::D16_UNORM => Plain(S::Unorm16, R),
        F::R16G16_UNORM => Plain(S::Unorm16, RG),
        F::R16G16B16A16_UNORM => Plain(S::Unorm16, RGBA),
        F::R16_SNORM => Plain(S::Snorm16, R),
        F::R16G16_SNORM => Plain(S::Snorm16, RG),
        F::R16G16B16A16_SNORM => Plain(S::Snorm16, RGBA),
        F::R16_UINT => Plain(S::Uint16, R),
        F::R16G16_UINT => Plain(S::Uint16, RG),
        F::R16G16B16A16_UINT => Plain(S::Uint16, RGBA),
        F::R16_SFLOAT => Plain(S::Half, R),
        F::R16G16_SFLOAT => Plain(S::Half, RG),
        F::R16G16B16_SFLOAT => Plain(S::Half, RGB),
        F::R16G16B16A16_SFLOAT => Plain(S::Half, RGBA),
        F::R32_UINT => Plain(S::Uint32, R),
        F::R32G32_UINT => Plain(S::Uint32, RG),
        F::R32G32B32A32_UINT => Plain(S::Uint32, RGBA),
        // Of a combined format the depth aspect alone is copied.
        F::R32_SFLOAT | F::D32_SFLOAT | F::D32_SFLOAT_S8_UINT => Plain(S::Float, R),
        F::R32G32_SFLOAT => Plain(S::Float, RG),
        F::R32G32B32_SFLOAT => Plain(S::Float, RGB),
        F::R32G32B32A32_SFLOAT => Plain(S::Float, RGBA),
        F::X8_D24_UNORM_PACK32 | F::D24_UNORM_S8_UINT => Packed(1, depth24),
        F::A2B10G10R10_UNORM_PACK32 => Packed(3, unorm10),
        F::B10G11R11_UFLOAT_PACK32 => Packed(3, float11),
        _ => return None,
    })
}

fn depth24(v: u32) -> [f32; 3] {
    [(f64::from(v & 0xff_ffff) / f64::from(0xff_ffff)) as f32, 0.0, 0.0]
}

fn unorm10(v: u32) -> [f32; 3] {
    [v, v >> 10, v >> 20].map(|c| (c & 0x3ff) as f32 / 1023.0)
}

/// Floats without a sign: five bits of exponent as a half float has, and fewer of mantissa.
fn float11(v: u32) -> [f32; 3] {
    [(v & 0x7ff) << 4, (v >> 11 & 0x7ff) << 4, (v >> 22) << 5].map(|bits| f16::from_bits(bits as u16).to_f32())
}

fn from_srgb(v: f32) -> f32 {
    if v <= 0.04045 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

/// Bytes of a texel as a copy of the image into a buffer has it; `None` for a format that no capture takes.
pub(crate) fn texel_bytes(format: vk::Format) -> Option<usize> {
    texel(format).map(|t| match t {
        Texel::Plain(sample, order) => sample.bytes() * order.len(),
        Texel::Packed(..) => 4,
    })
}

/// One plane for each of red, green, blue and alpha that the format has.
pub(crate) fn planes(format: vk::Format, bytes: &[u8]) -> Option<Vec<FlatSamples>> {
    Some(match texel(format)? {
        Texel::Plain(sample, order) => {
            let plane = |component: usize| {
                let sample = if sample == Sample::Srgb8 && component == 3 { Sample::Unorm8 } else { sample };
                plain(sample, bytes, sample.bytes() * order[component], sample.bytes() * order.len())
            };
            (0..order.len()).map(plane).collect()
        }
        Texel::Packed(count, unpack) => {
            let plane = |i: usize| FlatSamples::F32(each(bytes, 0, 4).map(|b| unpack(u32::from_ne_bytes(b))[i]).collect());
            (0..count).map(plane).collect()
        }
    })
}

/// `N` bytes at `at` of every `stride`.
fn each<const N: usize>(bytes: &[u8], at: usize, stride: usize) -> impl Iterator<Item = [u8; N]> + '_ {
    bytes.chunks_exact(stride).map(move |texel| std::array::from_fn(|i| texel[at + i]))
}

fn plain(sample: Sample, bytes: &[u8], at: usize, stride: usize) -> FlatSamples {
    let of8 = |f: fn([u8; 1]) -> f32| FlatSamples::F32(each(bytes, at, stride).map(f).collect());
    let of16 = |f: fn([u8; 2]) -> f32| FlatSamples::F32(each(bytes, at, stride).map(f).collect());
    match sample {
        Sample::Unorm8 => of8(|[b]| f32::from(b) / 255.0),
        Sample::Srgb8 => of8(|[b]| from_srgb(f32::from(b) / 255.0)),
        Sample::Snorm8 => of8(|b| (f32::from(i8::from_ne_bytes(b)) / 127.0).max(-1.0)),
        Sample::Unorm16 => of16(|b| f32::from(u16::from_ne_bytes(b)) / 65535.0),
        Sample::Snorm16 => of16(|b| (f32::from(i16::from_ne_bytes(b)) / 32767.0).max(-1.0)),
        Sample::Half => FlatSamples::F16(each(bytes, at, stride).map(f16::from_ne_bytes).collect()),
        Sample::Float => FlatSamples::F32(each(bytes, at, stride).map(f32::from_ne_bytes).collect()),
        Sample::Uint8 => FlatSamples::U32(each(bytes, at, stride).map(|[b]| u32::from(b)).collect()),
        Sample::Uint16 => FlatSamples::U32(each(bytes, at, stride).map(|b| u32::from(u16::from_ne_bytes(b))).collect()),
        Sample::Uint32 => FlatSamples::U32(each(bytes, at, stride).map(u32::from_ne_bytes).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(format: vk::Format, bytes: &[u8]) -> Vec<f32> {
        let planes = planes(format, bytes).expect("a format that is taken");
        planes.iter().flat_map(|p| p.values_as_f32().collect::<Vec<_>>()).collect()
    }

    #[test]
    fn texels_become_what_a_shader_reads() {
        use vk::Format as F;
        assert_eq!(floats(F::R8G8B8A8_UNORM, &[0, 255, 51, 255]), [0.0, 1.0, 0.2, 1.0]);
        assert_eq!(floats(F::B8G8R8A8_UNORM, &[0, 51, 255, 255]), [1.0, 0.2, 0.0, 1.0]);
        assert_eq!(floats(F::R8G8_SNORM, &[0x80, 127]), [-1.0, 1.0]);
        let srgb = floats(F::R8G8B8A8_SRGB, &[0, 188, 255, 51]);
        assert!(srgb[1] > 0.49 && srgb[1] < 0.51 && srgb[3] == 0.2, "{srgb:?}");
        assert_eq!(floats(F::R16G16_UNORM, &[0, 0, 0xff, 0xff]), [0.0, 1.0]);
        assert_eq!(floats(F::R16_SNORM, &[0x01, 0x80]), [-1.0]);
        assert_eq!(floats(F::R16G16_SFLOAT, &[0x00, 0x3c, 0x00, 0xc0]), [1.0, -2.0]);
        assert_eq!(floats(F::D24_UNORM_S8_UINT, &[0xff, 0xff, 0xff, 0x12]), [1.0]);
        assert_eq!(floats(F::A2B10G10R10_UNORM_PACK32, &(1023u32 << 10).to_ne_bytes()), [0.0, 1.0, 0.0]);
        let one = 15u32 << 6 | 16 << 17 | 14 << 27;
        assert_eq!(floats(F::B10G11R11_UFLOAT_PACK32, &one.to_ne_bytes()), [1.0, 2.0, 0.5]);
    }

    #[test]
    fn bits_of_floats_and_integers_are_kept() {
        let nan = f32::from_bits(0x7fc0_1234);
        let Some([FlatSamples::F32(v)]) = planes(vk::Format::D32_SFLOAT, &nan.to_ne_bytes()).as_deref().map(|p| [p[0].clone()])
        else {
            panic!("one plane of floats");
        };
        assert_eq!(v[0].to_bits(), nan.to_bits());
        let ids = planes(vk::Format::R32_UINT, &u32::MAX.to_ne_bytes()).expect("taken");
        assert!(matches!(&ids[0], FlatSamples::U32(v) if v == &[u32::MAX]));
        assert_eq!(texel_bytes(vk::Format::R16G16B16_SFLOAT), Some(6));
        assert!(texel_bytes(vk::Format::E5B9G9R9_UFLOAT_PACK32).is_none());
    }
}

//! Samples of texels. Floats and integers keep their bits; normalised and packed values become
//! 32-bit float.

use super::table::{Class, Layout, Sample, Texel};
use half::f16;

/// One component of every texel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Plane {
    /// Halves as they were.
    Half(Vec<f16>),
    /// Floats as they were, and what becomes float.
    Float(Vec<f32>),
    /// Integers.
    Uint(Vec<u32>),
}

impl Texel {
    /// One plane for each of red, green, blue and alpha that the format has. Bytes behind the last whole texel are left out.
    pub(crate) fn planes(&self, bytes: &[u8]) -> Vec<Plane> {
        match self.layout {
            Layout::Plain(sample, order) => {
                let plane = |component: usize| {
                    let sample = if sample == Sample::Srgb8 && component == 3 { Sample::Unorm8 } else { sample };
                    plain(sample, bytes, sample.bytes() * order[component], sample.bytes() * order.len())
                };
                (0..order.len()).map(plane).collect()
            }
            Layout::Packed(class, count, unpack) => (0..count)
                .map(|i| {
                    let components = each(bytes, 0, 4).map(|b| unpack(u32::from_ne_bytes(b))[i]);
                    match class {
                        Class::Float => Plane::Float(components.collect()),
                        Class::Uint => Plane::Uint(components.map(|v| v as u32).collect()),
                    }
                })
                .collect(),
        }
    }

    /// Texels as floats; components that the format lacks are 0. Bytes behind the last whole texel are left out.
    pub(crate) fn to_floats(self, bytes: &[u8]) -> Vec<[f32; 4]> {
        fn put<T: Copy>(texels: &mut [[f32; 4]], component: usize, samples: &[T], float: fn(T) -> f32) {
            texels.iter_mut().zip(samples).for_each(|(texel, &sample)| texel[component] = float(sample));
        }
        let mut texels = vec![[0.0; 4]; bytes.len() / self.bytes()];
        for (component, plane) in self.planes(bytes).iter().enumerate() {
            match plane {
                Plane::Half(samples) => put(&mut texels, component, samples, f16::to_f32),
                Plane::Float(samples) => put(&mut texels, component, samples, |v| v),
                Plane::Uint(samples) => put(&mut texels, component, samples, |v| v as f32),
            }
        }
        texels
    }
}

/// `N` bytes at `at` of every `stride`.
fn each<const N: usize>(bytes: &[u8], at: usize, stride: usize) -> impl Iterator<Item = [u8; N]> + '_ {
    bytes.chunks_exact(stride).map(move |texel| std::array::from_fn(|i| texel[at + i]))
}

fn plain(sample: Sample, bytes: &[u8], at: usize, stride: usize) -> Plane {
    let of8 = |f: fn([u8; 1]) -> f32| Plane::Float(each(bytes, at, stride).map(f).collect());
    let of16 = |f: fn([u8; 2]) -> f32| Plane::Float(each(bytes, at, stride).map(f).collect());
    match sample {
        Sample::Unorm8 => of8(|[b]| f32::from(b) / 255.0),
        Sample::Srgb8 => of8(|[b]| from_srgb(f32::from(b) / 255.0)),
        Sample::Snorm8 => of8(|b| (f32::from(i8::from_ne_bytes(b)) / 127.0).max(-1.0)),
        Sample::Unorm16 => of16(|b| f32::from(u16::from_ne_bytes(b)) / 65535.0),
        Sample::Snorm16 => of16(|b| (f32::from(i16::from_ne_bytes(b)) / 32767.0).max(-1.0)),
        Sample::Half => Plane::Half(each(bytes, at, stride).map(f16::from_ne_bytes).collect()),
        Sample::Float => Plane::Float(each(bytes, at, stride).map(f32::from_ne_bytes).collect()),
        Sample::Uint8 => Plane::Uint(each(bytes, at, stride).map(|[b]| u32::from(b)).collect()),
        Sample::Uint16 => Plane::Uint(each(bytes, at, stride).map(|b| u32::from(u16::from_ne_bytes(b))).collect()),
        Sample::Uint32 => Plane::Uint(each(bytes, at, stride).map(u32::from_ne_bytes).collect()),
    }
}

fn from_srgb(v: f32) -> f32 {
    if v <= 0.04045 {
        v / 12.92
    } else {
        ((v + 0.055) / 1.055).powf(2.4)
    }
}

pub(crate) fn depth24(v: u32) -> [f32; 4] {
    [(f64::from(v & 0xff_ffff) / f64::from(0xff_ffff)) as f32, 0.0, 0.0, 0.0]
}

pub(crate) fn uint10(v: u32) -> [f32; 4] {
    [v & 0x3ff, v >> 10 & 0x3ff, v >> 20 & 0x3ff, v >> 30].map(|c| c as f32)
}

pub(crate) fn unorm10(v: u32) -> [f32; 4] {
    let [r, g, b, a] = uint10(v);
    [r / 1023.0, g / 1023.0, b / 1023.0, a / 3.0]
}

pub(crate) fn unorm10_bgr(v: u32) -> [f32; 4] {
    let [b, g, r, a] = unorm10(v);
    [r, g, b, a]
}

pub(crate) fn snorm10(v: u32) -> [f32; 4] {
    // The sign is moved to that of the integer, and back with its copies.
    let ten = |shift: u32| ((v << shift) as i32 >> 22) as f32 / 511.0;
    [ten(22), ten(12), ten(2), (v as i32 >> 30) as f32].map(|c| c.max(-1.0))
}

/// Floats without a sign: five bits of exponent as a half float has, and fewer of mantissa.
pub(crate) fn float11(v: u32) -> [f32; 4] {
    [(v & 0x7ff) << 4, (v >> 11 & 0x7ff) << 4, (v >> 22) << 5, 0].map(|bits| f16::from_bits(bits as u16).to_f32())
}

/// Nine bits each of red, green and blue, and one exponent: 2^(e − 15 − 9).
pub(crate) fn shared_exponent(v: u32) -> [f32; 4] {
    // From its bits: what `exp2` gives may be rounded elsewhere.
    let scale = f32::from_bits(((v >> 27) + 127 - 24) << 23);
    [v & 0x1ff, v >> 9 & 0x1ff, v >> 18 & 0x1ff, 0].map(|c| c as f32 * scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ash::vk::Format as F;

    fn floats(format: F, bytes: &[u8]) -> Vec<[f32; 4]> {
        Texel::of(format).expect("a row").to_floats(bytes)
    }

    #[test]
    fn texels_become_what_a_shader_reads() {
        let one = |format, bytes: &[u8]| floats(format, bytes)[0];
        assert_eq!(one(F::R8G8B8A8_UNORM, &[0, 255, 51, 255]), [0.0, 1.0, 0.2, 1.0]);
        assert_eq!(one(F::B8G8R8A8_UNORM, &[0, 51, 255, 255]), [1.0, 0.2, 0.0, 1.0]);
        assert_eq!(one(F::R8G8_SNORM, &[0x80, 127]), [-1.0, 1.0, 0.0, 0.0]);
        let srgb = one(F::R8G8B8A8_SRGB, &[0, 188, 255, 51]);
        assert!(srgb[1] > 0.49 && srgb[1] < 0.51 && srgb[3] == 0.2, "{srgb:?}");
        assert_eq!(one(F::R16G16_UNORM, &[0, 0, 0xff, 0xff]), [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(one(F::R16_SNORM, &[0x01, 0x80]), [-1.0, 0.0, 0.0, 0.0]);
        assert_eq!(one(F::R16G16_SFLOAT, &[0x00, 0x3c, 0x00, 0xc0]), [1.0, -2.0, 0.0, 0.0]);
        assert_eq!(one(F::R8G8_UINT, &[7, 200]), [7.0, 200.0, 0.0, 0.0]);
        assert_eq!(one(F::D16_UNORM, &[0xff, 0xff]), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(one(F::D24_UNORM_S8_UINT, &[0xff, 0xff, 0xff, 0x12]), [1.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn packed_texels_become_what_a_shader_reads() {
        let one = |format, bits: u32| floats(format, &bits.to_ne_bytes())[0];
        assert_eq!(one(F::A2B10G10R10_UNORM_PACK32, 1023 << 10 | 3 << 30), [0.0, 1.0, 0.0, 1.0]);
        assert_eq!(one(F::A2R10G10B10_UNORM_PACK32, 1023 << 20), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(one(F::A2B10G10R10_SNORM_PACK32, 0x200 | 511 << 10 | 0x201 << 20), [-1.0, 1.0, -1.0, 0.0]);
        assert_eq!(one(F::A2B10G10R10_UINT_PACK32, 5 | 1023 << 20 | 1 << 30), [5.0, 0.0, 1023.0, 1.0]);
        assert_eq!(one(F::B10G11R11_UFLOAT_PACK32, 15 << 6 | 16 << 17 | 14 << 27), [1.0, 2.0, 0.5, 0.0]);
        assert_eq!(one(F::E5B9G9R9_UFLOAT_PACK32, 256 | 128 << 9 | 511 << 18 | 16 << 27), [1.0, 0.5, 511.0 / 256.0, 0.0]);
    }

    #[test]
    fn bits_of_floats_and_integers_are_kept() {
        let nan = f32::from_bits(0x7fc0_1234);
        let planes = |format, bytes: &[u8]| Texel::of(format).expect("a row").planes(bytes);
        let [Plane::Float(v)] = &planes(F::D32_SFLOAT, &nan.to_ne_bytes())[..] else { panic!("one plane of floats") };
        assert_eq!(v[0].to_bits(), nan.to_bits());
        assert_eq!(planes(F::R32_UINT, &u32::MAX.to_ne_bytes()), [Plane::Uint(vec![u32::MAX])]);
        assert_eq!(planes(F::R16_SFLOAT, &[0x01, 0x7c]).len(), 1);
        let [Plane::Half(v)] = &planes(F::R16_SFLOAT, &[0x01, 0x7c])[..] else { panic!("one plane of halves") };
        assert_eq!(v[0].to_bits(), 0x7c01);
    }

    #[test]
    fn a_slice_that_is_cut_or_not_aligned_gives_the_whole_texels_in_it() {
        let bytes: Vec<u8> = (0..=64).collect();
        for texel in Texel::all() {
            for (from, to) in [(0, 64), (1, 64), (3, 50), (1, 1), (0, 3)] {
                let slice = &bytes[from..to];
                assert_eq!(texel.to_floats(slice).len(), (to - from) / texel.bytes(), "{:?}", texel.format());
            }
        }
    }
}

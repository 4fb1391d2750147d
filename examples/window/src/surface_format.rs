//! Which of its formats a window is drawn in, and what that asks of the shaders.

use ash::vk::{ColorSpaceKHR as Space, Format as F, SurfaceFormatKHR};

/// Luminance of white beside brighter things, cd/m² \[ITU-R BT.2408, Table 1\].
pub const SDR_WHITE_NITS: f32 = 203.0;
/// What an HDR10 display is taken to reach, cd/m²: most films are mastered for it, and displays roll off what they do not reach.
const HDR10_PEAK_NITS: f32 = 1000.0;
/// How much brighter than white a display with extended linear sRGB is taken to be: systems differ in what 1 is in nits.
const EXTENDED_PEAK: f32 = 4.0;

/// How colours get to the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// The format encodes.
    Srgb,
    /// glsl/window/encode.frag encodes by the curve of sRGB.
    Unorm,
    /// Extended linear sRGB (scRGB): 1 is white, more is brighter.
    Extended,
    /// glsl/window/encode.frag encodes for HDR10: primaries of BT.2020, the curve PQ.
    Hdr10,
}

impl Encoding {
    /// The brightest colour, over white.
    pub fn peak(self) -> f32 {
        match self {
            Self::Srgb | Self::Unorm => 1.0,
            Self::Extended => EXTENDED_PEAK,
            Self::Hdr10 => HDR10_PEAK_NITS / SDR_WHITE_NITS,
        }
    }

    /// Whether a pass of its own encodes what was drawn. The panel is blended before that, in linear light.
    pub fn is_in_shader(self) -> bool {
        matches!(self, Self::Unorm | Self::Hdr10)
    }

    /// For people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Srgb | Self::Unorm => "SDR (sRGB)",
            Self::Extended => "HDR (scRGB: extended linear sRGB)",
            Self::Hdr10 => "HDR (HDR10: BT.2020, PQ)",
        }
    }
}

fn encoding(format: &SurfaceFormatKHR) -> Option<Encoding> {
    match (format.format, format.color_space) {
        (F::B8G8R8A8_SRGB | F::R8G8B8A8_SRGB, Space::SRGB_NONLINEAR) => Some(Encoding::Srgb),
        (F::R16G16B16A16_SFLOAT, Space::EXTENDED_SRGB_LINEAR_EXT) => Some(Encoding::Extended),
        (F::A2B10G10R10_UNORM_PACK32 | F::A2R10G10B10_UNORM_PACK32, Space::HDR10_ST2084_EXT) => Some(Encoding::Hdr10),
        (_, Space::SRGB_NONLINEAR) => Some(Encoding::Unorm),
        _ => None,
    }
}

/// A format of the window, and what the shaders have to do for it. An 8-bit sRGB one, unless `hdr` is wanted and there: scRGB before HDR10,
/// since the window system then does what this cannot know, the display's own white and peak.
pub fn choose_format(formats: &[SurfaceFormatKHR], hdr: bool) -> Option<(SurfaceFormatKHR, Encoding)> {
    use Encoding::{Extended, Hdr10, Srgb, Unorm};
    let order = if hdr { [Extended, Hdr10, Srgb, Unorm] } else { [Srgb, Unorm, Extended, Hdr10] };
    let find = |wanted| formats.iter().find(|format| encoding(format) == Some(wanted)).map(|found| (*found, wanted));
    order.into_iter().find_map(find).or(formats.first().map(|found| (*found, Unorm)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn format(format: F, color_space: Space) -> SurfaceFormatKHR {
        SurfaceFormatKHR { format, color_space }
    }

    const UNORM: SurfaceFormatKHR = format(F::B8G8R8A8_UNORM, Space::SRGB_NONLINEAR);
    const SRGB: SurfaceFormatKHR = format(F::B8G8R8A8_SRGB, Space::SRGB_NONLINEAR);
    const SCRGB: SurfaceFormatKHR = format(F::R16G16B16A16_SFLOAT, Space::EXTENDED_SRGB_LINEAR_EXT);
    const HDR10: SurfaceFormatKHR = format(F::A2B10G10R10_UNORM_PACK32, Space::HDR10_ST2084_EXT);
    const HDR10_OTHER: SurfaceFormatKHR = format(F::A2R10G10B10_UNORM_PACK32, Space::HDR10_ST2084_EXT);
    const SDR_10_BIT: SurfaceFormatKHR = format(F::A2B10G10R10_UNORM_PACK32, Space::SRGB_NONLINEAR);

    /// What is chosen without and with the wish for HDR.
    fn chosen(formats: &[SurfaceFormatKHR]) -> [Option<(SurfaceFormatKHR, Encoding)>; 2] {
        [false, true].map(|hdr| choose_format(formats, hdr))
    }

    #[test]
    fn a_window_without_hdr_ignores_the_wish() {
        assert_eq!(chosen(&[UNORM, SRGB]), [Some((SRGB, Encoding::Srgb)); 2]);
        assert_eq!(chosen(&[UNORM]), [Some((UNORM, Encoding::Unorm)); 2]);
        assert_eq!(chosen(&[]), [None; 2]);
    }

    #[test]
    fn ten_bits_alone_are_no_hdr() {
        assert_eq!(chosen(&[SDR_10_BIT, SRGB]), [Some((SRGB, Encoding::Srgb)); 2]);
        assert_eq!(chosen(&[SDR_10_BIT]), [Some((SDR_10_BIT, Encoding::Unorm)); 2]);
    }

    #[test]
    fn hdr_is_scrgb_before_hdr10_and_only_by_wish() {
        let sdr = Some((SRGB, Encoding::Srgb));
        assert_eq!(chosen(&[HDR10, SRGB, SCRGB]), [sdr, Some((SCRGB, Encoding::Extended))]);
        assert_eq!(chosen(&[SCRGB, UNORM, SRGB]), [sdr, Some((SCRGB, Encoding::Extended))]);
        assert_eq!(chosen(&[SRGB, HDR10]), [sdr, Some((HDR10, Encoding::Hdr10))]);
        assert_eq!(chosen(&[HDR10_OTHER, SRGB]), [sdr, Some((HDR10_OTHER, Encoding::Hdr10))]);
        assert_eq!(chosen(&[HDR10, UNORM])[0], Some((UNORM, Encoding::Unorm)));
    }

    #[test]
    fn formats_that_do_not_belong_to_their_colour_space_are_not_hdr() {
        let half = format(F::R16G16B16A16_SFLOAT, Space::HDR10_ST2084_EXT);
        let ten = format(F::A2B10G10R10_UNORM_PACK32, Space::EXTENDED_SRGB_LINEAR_EXT);
        assert_eq!(chosen(&[half, ten, SRGB]), [Some((SRGB, Encoding::Srgb)); 2]);
    }

    #[test]
    fn a_window_with_nothing_but_hdr_is_encoded_for_it() {
        assert_eq!(chosen(&[HDR10]), [Some((HDR10, Encoding::Hdr10)); 2]);
        assert_eq!(chosen(&[HDR10, SCRGB])[0], Some((SCRGB, Encoding::Extended)));
    }

    #[test]
    fn the_peak_is_beyond_white_for_hdr_alone() {
        assert_eq!([Encoding::Srgb, Encoding::Unorm].map(Encoding::peak), [1.0; 2]);
        assert!((Encoding::Hdr10.peak() * SDR_WHITE_NITS - 1000.0).abs() < 1e-3);
        assert!(Encoding::Extended.peak() > 1.0);
    }
}

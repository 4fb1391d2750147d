//! Strata: blocks of pixels with at most one gradient sample each \[ASVGF 3.1\].

use crate::FrameConstants;
use glam::{IVec2, UVec2};

/// The candidate of a stratum without a pixel to pick.
pub(crate) const NO_PIXEL: u16 = u16::MAX;

/// The content of a texel of `gradient_samples`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct GradientSample {
    /// The pixel of this frame that is shaded again.
    pub pixel: [u32; 2],
    /// The pixel of the previous frame whose surface and seed it takes.
    pub previous_pixel: [u32; 2],
}

/// A texel of `gradient_samples`: x, y: the previous pixel; z: 1 + place in the stratum, row by row, 0 where there is no sample; w:
/// 0.
pub(crate) fn pack_gradient_sample(stratum_size: u32, sample: Option<GradientSample>) -> [u16; 4] {
    let Some(sample) = sample else { return [0; 4] };
    let [x, y] = sample.pixel.map(|v| v % stratum_size);
    [sample.previous_pixel[0] as u16, sample.previous_pixel[1] as u16, (1 + x + y * stratum_size) as u16, 0]
}

/// The content of the texel of a stratum.
pub(crate) fn unpack_gradient_sample(stratum_size: u32, stratum: [u32; 2], texel: [u16; 4]) -> Option<GradientSample> {
    let place = u32::from(texel[2]).checked_sub(1)?;
    let offset = [place % stratum_size, place / stratum_size];
    let pixel = [0, 1].map(|i| stratum[i] * stratum_size + offset[i]);
    Some(GradientSample { pixel, previous_pixel: [texel[0].into(), texel[1].into()] })
}

/// The strata of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strata {
    pub size: u32,
    render_extent: UVec2,
}

impl Strata {
    pub(crate) fn new(frame: &FrameConstants, size: u32) -> Self {
        Self { size, render_extent: frame.render_extent.into() }
    }

    pub(crate) fn of_previous(frame: &FrameConstants, size: u32) -> Self {
        Self { size, render_extent: frame.previous_render_extent.into() }
    }

    /// Number of strata in x and y.
    pub(crate) fn count(&self) -> UVec2 {
        (self.render_extent + self.size - 1) / self.size
    }

    pub(crate) fn contains(&self, stratum: IVec2) -> bool {
        stratum.cmpge(IVec2::ZERO).all() && stratum.as_uvec2().cmplt(self.count()).all()
    }

    pub(crate) fn first_pixel(&self, stratum: IVec2) -> IVec2 {
        stratum * self.size as i32
    }

    /// Pixels of a stratum that exist: one at the right or lower border may be cut.
    pub(crate) fn extent_of(&self, stratum: IVec2) -> UVec2 {
        (self.render_extent - self.first_pixel(stratum).as_uvec2()).min(UVec2::splat(self.size))
    }

    /// Pixels of a stratum with their places, row by row.
    pub(crate) fn pixels(self, stratum: IVec2) -> impl Iterator<Item = (u32, IVec2)> {
        let extent = self.extent_of(stratum);
        let offsets = (0..extent.y).flat_map(move |y| (0..extent.x).map(move |x| UVec2::new(x, y)));
        offsets.map(move |o| (o.x + o.y * self.size, self.first_pixel(stratum) + o.as_ivec2()))
    }
}

//! Blocks of 8×8 pixels: the unit of the statistics of \[PSVGF\].

use super::{render_rect::RenderRect, Image};
use glam::IVec2;

/// Pixels a side of a block.
pub(crate) const BLOCK_SIZE: u32 = 8;
/// Pixels a side of the cells in which outliers are told from light that returns.
pub(crate) const CELL_SIZE: u32 = 4;

/// The blocks of a render extent; incomplete ones at its right and lower edge count.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocks {
    extent: [u32; 2],
}

impl Blocks {
    pub(crate) fn new(render_extent: [u32; 2]) -> Self {
        Self { extent: render_extent.map(|side| side.div_ceil(BLOCK_SIZE)) }
    }

    /// Width and height in blocks.
    pub(crate) fn extent(&self) -> [u32; 2] {
        self.extent
    }

    pub(crate) fn rect(&self) -> RenderRect {
        RenderRect::new(self.extent)
    }

    /// The pixels that a block has inside of a render extent, in row order.
    pub(crate) fn pixels(block: IVec2, render_extent: [u32; 2]) -> impl Iterator<Item = IVec2> {
        let (rect, side) = (RenderRect::new(render_extent), BLOCK_SIZE as i32);
        let offsets = (0..side).flat_map(move |y| (0..side).map(move |x| IVec2::new(x, y)));
        offsets.map(move |offset| block * side + offset).filter(move |p| rect.contains(*p))
    }

    /// The four blocks whose centres are nearest to a pixel, with bilinear weights; beyond the edge the last block stands in.
    pub(crate) fn around(&self, p: IVec2) -> [(IVec2, f32); 4] {
        self.rect().cells_around(p, BLOCK_SIZE)
    }

    /// A value of blocks at a pixel, bilinear between their centres.
    pub(crate) fn interpolated(&self, p: IVec2, value: impl Fn(IVec2) -> f32) -> f32 {
        self.around(p).into_iter().map(|(block, weight)| weight * value(block)).sum()
    }
}

/// The block that a pixel lies in.
pub(crate) fn block_of(p: IVec2) -> IVec2 {
    p / BLOCK_SIZE as i32
}

/// Texels of an image with one texel a block, for an allocated extent.
pub(crate) fn allocated_blocks<T>(image: &Image<T>) -> [u32; 2]
where
    T: Clone,
{
    image.extent().map(|side| side.div_ceil(BLOCK_SIZE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn incomplete_blocks_have_the_pixels_that_exist() {
        let blocks = Blocks::new([13, 9]);
        assert_eq!(blocks.extent(), [2, 2]);
        let count = |x, y| Blocks::pixels(IVec2::new(x, y), [13, 9]).count();
        assert_eq!((count(0, 0), count(1, 0), count(0, 1), count(1, 1)), (64, 40, 8, 5));
    }

    #[test]
    fn weights_of_the_blocks_around_sum_to_one() {
        let blocks = Blocks::new([29, 17]);
        for p in [IVec2::ZERO, IVec2::new(28, 16), IVec2::new(11, 3)] {
            let around = blocks.around(p);
            assert!((around.iter().map(|b| b.1).sum::<f32>() - 1.0).abs() < 1e-6);
            assert!(around.iter().all(|b| blocks.rect().contains(b.0)));
        }
    }
}

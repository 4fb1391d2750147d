//! An image on the CPU.

use crate::error::Error;
use glam::IVec2;
use std::thread;

/// Number of pixels below which a second thread costs more than it saves.
const PIXELS_WORTH_THREADS: usize = 4096;

/// An image of `extent` = (width, height) texels, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<T> {
    extent: [u32; 2],
    texels: Vec<T>,
}

impl<T: Clone> Image<T> {
    /// An image that is `fill` everywhere.
    pub fn new(extent: [u32; 2], fill: T) -> Self {
        Self { extent, texels: vec![fill; extent[0] as usize * extent[1] as usize] }
    }

    /// An image of the given texels, row by row from the top left.
    ///
    /// # Errors
    /// [`Error::Size`] where their number is not width times height.
    pub fn from_texels(extent: [u32; 2], texels: Vec<T>) -> Result<Self, Error> {
        let needed = extent[0] as usize * extent[1] as usize;
        if texels.len() != needed {
            return Err(Error::Size {
                resource: "Image::from_texels".into(),
                given: format!("{} texels", texels.len()),
                needed: format!("{needed} texels ({} x {})", extent[0], extent[1]),
            });
        }
        Ok(Self { extent, texels })
    }

    /// Width and height.
    pub fn extent(&self) -> [u32; 2] {
        self.extent
    }

    /// The texels, row by row from the top left.
    pub fn texels(&self) -> &[T] {
        &self.texels
    }

    /// The texel at column `x`, row `y`; `None` outside the image.
    pub fn get(&self, x: i32, y: i32) -> Option<&T> {
        self.texels.get(self.index(x, y)?)
    }

    /// The texel at column `x`, row `y` for writing; `None` outside the image.
    pub fn get_mut(&mut self, x: i32, y: i32) -> Option<&mut T> {
        let index = self.index(x, y)?;
        self.texels.get_mut(index)
    }

    fn index(&self, x: i32, y: i32) -> Option<usize> {
        let (x, y) = (u32::try_from(x).ok()?, u32::try_from(y).ok()?);
        (x < self.extent[0] && y < self.extent[1]).then(|| y as usize * self.extent[0] as usize + x as usize)
    }

    /// Every texel mapped.
    pub fn map<U: Clone>(&self, f: impl Fn(&T) -> U) -> Image<U> {
        // Compiled once for two types of texels, and not for each function between them.
        fn mapped<T, U>(texels: &[T], f: &dyn Fn(&T) -> U) -> Vec<U> {
            texels.iter().map(f).collect()
        }
        Image { extent: self.extent, texels: mapped(&self.texels, &f) }
    }
}

impl<T: Copy + Default> Image<T> {
    /// The texel of a pixel that is known to exist; as on the GPU, what lies outside reads as zero.
    pub(crate) fn at(&self, p: IVec2) -> T {
        self.get(p.x, p.y).copied().unwrap_or_default()
    }
}

impl<T: Clone + Default + Send> Image<T> {
    /// An image whose top left `render_extent` is `f(pixel)` and whose rest is the default. Each texel is a function of its own
    /// pixel, so the number of threads cannot change the result.
    pub(crate) fn compute(extent: [u32; 2], render_extent: [u32; 2], f: impl Fn(IVec2) -> T + Sync) -> Self {
        let mut image = Self::new(extent, T::default());
        image.fill(render_extent, &f);
        image
    }

    /// Compiled once for a type of texels, and not for each function of them.
    fn fill(&mut self, render_extent: [u32; 2], f: &(dyn Fn(IVec2) -> T + Sync)) {
        let [stride, width, height] =
            [self.extent[0], render_extent[0].min(self.extent[0]), render_extent[1].min(self.extent[1])].map(|n| n as usize);
        if width == 0 || height == 0 {
            return;
        }
        let threads = match thread::available_parallelism() {
            Ok(threads) if width * height >= PIXELS_WORTH_THREADS => threads.get(),
            _ => 1,
        };
        let rows_each = height.div_ceil(threads);
        let fill = |first_row: usize, band: &mut [T]| {
            for (row, texels) in band.chunks_mut(stride).enumerate() {
                for (x, texel) in texels.iter_mut().take(width).enumerate() {
                    *texel = f(IVec2::new(x as i32, (first_row + row) as i32));
                }
            }
        };
        let (rows, _) = self.texels.split_at_mut(stride * height);
        if threads == 1 {
            fill(0, rows);
            return;
        }
        thread::scope(|scope| {
            for (i, band) in rows.chunks_mut(rows_each * stride).enumerate() {
                let fill = &fill;
                scope.spawn(move || fill(i * rows_each, band));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn access_is_checked() {
        let image = Image::from_texels([2, 2], vec![1, 2, 3, 4]).expect("four texels");
        assert_eq!(image.get(1, 0), Some(&2));
        for (x, y) in [(-1, 0), (0, -1), (2, 0), (0, 2), (i32::MIN, 0), (i32::MAX, i32::MAX)] {
            assert_eq!(image.get(x, y), None);
        }
        assert!(Image::from_texels([2, 2], vec![1, 2, 3]).is_err());
    }

    #[test]
    fn compute_fills_the_render_extent_and_nothing_else() {
        for (extent, render) in [([5, 4], [3, 2]), ([130, 90], [129, 70]), ([1, 1], [1, 1])] {
            let image = Image::compute(extent, render, |p| (p.x + 1, p.y + 1));
            for y in 0..extent[1] as i32 {
                for x in 0..extent[0] as i32 {
                    let inside = (x as u32) < render[0] && (y as u32) < render[1];
                    assert_eq!(image.get(x, y), Some(&if inside { (x + 1, y + 1) } else { (0, 0) }));
                }
            }
        }
    }
}

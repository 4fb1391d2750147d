//! Results of a size other than that of the frames: what the filter does not make itself is enlarged.

use crate::exr_header::ExrHeader;
use exr::meta::attribute::IntegerBounds;

/// The size of the frames, and that of the results.
#[derive(Clone, Copy, Debug)]
pub struct OutputSize {
    frame: [u32; 2],
    result: [u32; 2],
}

impl OutputSize {
    /// The results of frames.
    pub fn new(frame: [u32; 2], result: [u32; 2]) -> Self {
        Self { frame, result }
    }

    /// Width and height of a result.
    pub fn result(self) -> [u32; 2] {
        self.result
    }

    /// Pixels of a result.
    pub fn pixels(self) -> usize {
        self.result[0] as usize * self.result[1] as usize
    }

    /// Pixels of a frame.
    pub fn frame_pixels(self) -> usize {
        self.frame[0] as usize * self.frame[1] as usize
    }

    /// The pixel of the frame in which the middle of each pixel of the result lies, row by row.
    fn sources(self) -> impl Iterator<Item = usize> {
        let Self { frame, result } = self;
        let source = move |axis: usize, i: u32| (2 * u64::from(i) + 1) * u64::from(frame[axis]) / (2 * u64::from(result[axis]));
        let row = move |y: u32| (0..result[0]).map(move |x| source(1, y) * u64::from(frame[0]) + source(0, x));
        (0..result[1]).flat_map(row).map(|pixel| pixel as usize)
    }

    /// A picture at the size of the result.
    pub fn enlarged<T: Copy + Default>(self, picture: &[T]) -> Vec<T> {
        self.sources().map(|source| picture.get(source).copied().unwrap_or_default()).collect()
    }

    /// The window of a result.
    pub fn window(self) -> IntegerBounds {
        let [width, height] = self.result.map(|side| side as usize);
        IntegerBounds::new((0, 0), (width, height))
    }

    /// The header of a result: its windows are its picture.
    pub fn header(self, of: &ExrHeader) -> ExrHeader {
        let mut header = of.clone();
        (header.extent, header.window) = (self.result, self.window());
        header.shared.display_window = header.window;
        header.part_windows.clear();
        header
    }
}

#[cfg(test)]
mod tests {
    use super::OutputSize;

    #[test]
    fn a_pixel_is_repeated_where_its_middle_lies() {
        let picture = [1, 2, 3, 4];
        assert_eq!(OutputSize::new([2, 2], [4, 2]).enlarged(&picture), [1, 1, 2, 2, 3, 3, 4, 4]);
        assert_eq!(OutputSize::new([2, 2], [3, 3]).enlarged(&picture), [1, 2, 2, 3, 4, 4, 3, 4, 4]);
        assert_eq!(OutputSize::new([2, 2], [2, 2]).enlarged(&picture), picture);
    }
}

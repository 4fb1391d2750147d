//! The pixels of a picture: places, and those around them.

/// Width and height.
#[derive(Clone, Copy)]
pub struct Raster {
    width: usize,
    height: usize,
}

impl Raster {
    pub fn new([width, height]: [u32; 2]) -> Self {
        Self { width: width as usize, height: height as usize }
    }

    /// Of so many pixels in rows of a width.
    pub fn of_rows(width: usize, pixels: usize) -> Self {
        Self { width, height: pixels.checked_div(width).unwrap_or(0) }
    }

    pub fn pixels(self) -> usize {
        self.width * self.height
    }

    /// Column and row.
    pub fn place(self, pixel: usize) -> [usize; 2] {
        [pixel % self.width, pixel / self.width]
    }

    /// A pixel and those around it, up to `reach` to each side, row by row.
    pub fn around(self, pixel: usize, reach: usize) -> impl Iterator<Item = usize> + Clone {
        let (Self { width, height }, [x, y]) = (self, self.place(pixel));
        let columns = x.saturating_sub(reach)..width.min(x + reach + 1);
        (y.saturating_sub(reach)..height.min(y + reach + 1)).flat_map(move |y| columns.clone().map(move |x| y * width + x))
    }

    /// A pixel with those left, right, above and below.
    pub fn beside(self, pixel: usize) -> impl Iterator<Item = usize> {
        let [x, y] = self.place(pixel);
        self.around(pixel, 1).filter(move |i| self.place(*i)[0] == x || self.place(*i)[1] == y)
    }

    /// The pixel that a place lies in, where whole numbers are the centres of pixels; `None` beyond the picture.
    pub fn at(self, [x, y]: [f32; 2]) -> Option<usize> {
        let is_inside = |at: f32, side: usize| at >= -0.5 && at <= side as f32 - 0.5;
        let nearest = |at: f32, side: usize| (at.round() as usize).min(side - 1);
        (is_inside(x, self.width) && is_inside(y, self.height))
            .then(|| nearest(y, self.height) * self.width + nearest(x, self.width))
    }

    /// The four pixels around such a place, as far as they exist, each with its nearness.
    pub fn taps(self, [x, y]: [f32; 2]) -> impl Iterator<Item = (usize, f32)> {
        let Self { width, height } = self;
        let (left, top) = (x.floor(), y.floor());
        let tap = move |(dx, dy): (f32, f32)| {
            let (px, py) = (left + dx, top + dy);
            let is_inside = px >= 0.0 && py >= 0.0 && px < width as f32 && py < height as f32;
            is_inside.then(|| (py as usize * width + px as usize, (1.0 - (x - px).abs()) * (1.0 - (y - py).abs())))
        };
        [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].into_iter().filter_map(tap)
    }
}

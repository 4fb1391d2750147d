//! The screen of Xvfb: a file in the format of xwd that the server keeps up to date.

/// Words of the header, all of them big-endian.
const WIDTH: usize = 4;
const HEIGHT: usize = 5;
const BYTES_PER_LINE: usize = 12;
const COLOURS: usize = 19;
/// Bytes of a colour of the colour map, which lies between header and pixels.
const COLOUR_BYTES: usize = 12;

/// Pixels of a screen of 32 bits each, blue first.
pub struct Screen {
    width: usize,
    height: usize,
    rows: Vec<Vec<[u8; 3]>>,
}

impl Screen {
    /// Reads the file.
    pub fn parse(file: &[u8]) -> Self {
        let word = |i: usize| u32::from_be_bytes([file[4 * i], file[4 * i + 1], file[4 * i + 2], file[4 * i + 3]]) as usize;
        let (width, height, stride) = (word(WIDTH), word(HEIGHT), word(BYTES_PER_LINE));
        let start = word(0) + word(COLOURS) * COLOUR_BYTES;
        let row = |y: usize| {
            let bytes = &file[start + y * stride..][..4 * width];
            bytes.chunks_exact(4).map(|p| [p[2], p[1], p[0]]).collect()
        };
        Self { width, height, rows: (0..height).map(row).collect() }
    }

    /// The pixel at a point.
    pub fn pixel(&self, [x, y]: [f32; 2]) -> [u8; 3] {
        self.rows[(y as usize).min(self.height - 1)][(x as usize).min(self.width - 1)]
    }

    /// Mean difference of horizontal neighbours in a rectangle that reaches from one point to another.
    pub fn roughness(&self, from: [f32; 2], to: [f32; 2]) -> f64 {
        let (left, right) = (from[0] as usize, (to[0] as usize).min(self.width - 1));
        let (mut sum, mut count) = (0, 0);
        for y in from[1] as usize..(to[1] as usize).min(self.height) {
            for x in left..right {
                let [a, b] = [self.rows[y][x], self.rows[y][x + 1]];
                sum += a.iter().zip(b).map(|(a, b)| u64::from(a.abs_diff(b))).sum::<u64>();
                count += 1;
            }
        }
        sum as f64 / f64::from(count.max(1))
    }
}

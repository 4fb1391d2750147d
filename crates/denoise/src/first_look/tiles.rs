//! Noise in an image, told from what surfaces explain: in tiles where most pixels differ from those
//! beside them, and as much from the same place of the frame before, there is nothing but noise.

use crate::raster::Raster;

/// Side of a tile, pixels.
const TILE: usize = 16;
/// A pixel differs from those beside it where their deviation is above this share of their mean.
const DIFFERS: f32 = 0.02;
/// The least mean that a deviation is compared with.
const LEAST_MEAN: f32 = 0.01;
/// The share of such pixels in a noisy tile, of those with a value in or beside them.
const ROUGH: f32 = 0.5;
/// The least ratio of the change between frames to that between neighbours in a noisy tile.
const UNSTEADY: f32 = 0.7;
/// The share of pixels with a value in a tile that counts.
const LEAST_VALUED: f32 = 0.15;
/// The share of noisy tiles from which on those without a value are not counted: below, it may be a
/// flame or a screen, which changes as noise does.
const WORTH: f32 = 0.1;

/// What a part of an image has.
#[derive(Clone, Copy, PartialEq)]
enum Tile {
    /// Hardly a value that is not 0.
    Empty,
    Surface,
    Noise,
}

/// An image of one value a pixel, in two frames, with the motion from the second to the first.
pub struct Pair<'a> {
    pub extent: [u32; 2],
    pub values: [&'a [f32]; 2],
    pub motion_px: &'a [[f32; 2]],
}

impl Pair<'_> {
    /// The share of tiles that are noise: of those with a value, since a part of the light is nothing in
    /// most of the picture; of all, where those that are noise are few.
    pub fn noisy_share(&self) -> f32 {
        let [width, height] = self.extent.map(|side| side as usize);
        let (mut noisy, mut all, mut empty) = (0usize, 0usize, 0usize);
        for y in (0..height.saturating_sub(TILE - 1)).step_by(TILE) {
            for x in (0..width.saturating_sub(TILE - 1)).step_by(TILE) {
                if let Some(tile) = self.tile(x, y) {
                    all += 1;
                    noisy += usize::from(tile == Tile::Noise);
                    empty += usize::from(tile == Tile::Empty);
                }
            }
        }
        let of_all = noisy as f32 / all.max(1) as f32;
        if of_all < WORTH {
            of_all
        } else {
            noisy as f32 / (all - empty) as f32
        }
    }

    /// What a tile is; none where too little of it was there in the frame before.
    fn tile(&self, left: usize, top: usize) -> Option<Tile> {
        let (mut seen, mut valued, mut rough, mut between_frames, mut beside) = (0usize, 0usize, 0usize, 0.0, 0.0);
        for y in top..top + TILE {
            for x in left..left + TILE {
                let Some(change) = self.change(x, y) else { continue };
                seen += 1;
                let (mean, deviation) = self.around(x, y);
                valued += usize::from(mean != 0.0 || deviation > 0.0);
                if deviation > DIFFERS * mean.abs().max(LEAST_MEAN) {
                    rough += 1;
                    between_frames += change;
                    beside += deviation;
                }
            }
        }
        let is_noise = rough as f32 > ROUGH * valued as f32 && between_frames > UNSTEADY * beside;
        let tile = match (valued as f32) < LEAST_VALUED * seen as f32 {
            true => Tile::Empty,
            false if is_noise => Tile::Noise,
            false => Tile::Surface,
        };
        (2 * seen >= TILE * TILE).then_some(tile)
    }

    /// The difference of a pixel from its place in the frame before.
    fn change(&self, x: usize, y: usize) -> Option<f32> {
        let [width, height] = self.extent.map(|side| side as usize);
        let i = y * width + x;
        let [mx, my] = self.motion_px.get(i).copied().unwrap_or_default();
        let (px, py) = ((x as f32 + mx).round(), (y as f32 + my).round());
        let is_inside = px >= 0.0 && py >= 0.0 && px < width as f32 && py < height as f32;
        is_inside.then(|| (self.values[1][i] - self.values[0][py as usize * width + px as usize]).abs())
    }

    /// Mean and deviation of the 3x3 pixels around one.
    fn around(&self, x: usize, y: usize) -> (f32, f32) {
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
        for i in Raster::new(self.extent).around(y * self.extent[0] as usize + x, 1) {
            let v = self.values[1][i];
            (sum, squares, count) = (sum + v, squares + v * v, count + 1.0);
        }
        let mean: f32 = sum / count;
        (mean, (squares / count - mean * mean).max(0.0).sqrt())
    }
}

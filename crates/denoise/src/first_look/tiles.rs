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
/// Pixels to each side where a tile may be found in the frame before.
const SHIFT: i32 = 1;
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
    /// Pixels that do not count.
    pub skipped: Option<&'a [bool]>,
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

    /// What a tile is; none where too little of it counts or was there in the frame before.
    fn tile(&self, left: usize, top: usize) -> Option<Tile> {
        let (mut seen, mut valued, mut rough, mut beside) = (0usize, 0usize, Vec::new(), 0.0);
        for y in top..top + TILE {
            for x in left..left + TILE {
                if !self.counts(x, y) || self.change(x, y, [0; 2]).is_none() {
                    continue;
                }
                seen += 1;
                let (mean, deviation) = self.around(x, y);
                valued += usize::from(mean != 0.0 || deviation > 0.0);
                if deviation > DIFFERS * mean.abs().max(LEAST_MEAN) {
                    rough.push([x, y]);
                    beside += deviation;
                }
            }
        }
        let is_noise = rough.len() as f32 > ROUGH * valued as f32 && self.least_change(&rough) > UNSTEADY * beside;
        let tile = match (valued as f32) < LEAST_VALUED * seen as f32 {
            true => Tile::Empty,
            false if is_noise => Tile::Noise,
            false => Tile::Surface,
        };
        (2 * seen >= TILE * TILE).then_some(tile)
    }

    fn counts(&self, x: usize, y: usize) -> bool {
        self.skipped.is_none_or(|skipped| !skipped[y * self.extent[0] as usize + x])
    }

    /// The sum of differences of pixels from the frame before, for the shift that makes it least: a picture that moves in another way than its
    /// surface, or by parts of a pixel, is found again. Noise is not.
    fn least_change(&self, pixels: &[[usize; 2]]) -> f32 {
        let shifts = (-SHIFT..=SHIFT).flat_map(|y| (-SHIFT..=SHIFT).map(move |x| [x, y]));
        // Beyond the picture nothing is found.
        let changed = |shift| pixels.iter().map(|[x, y]| self.change(*x, *y, shift).unwrap_or(1.0)).sum::<f32>();
        shifts.map(changed).fold(f32::INFINITY, f32::min)
    }

    /// The difference of a pixel from its place in the frame before, or one beside that.
    fn change(&self, x: usize, y: usize, shift: [i32; 2]) -> Option<f32> {
        let [width, height] = self.extent.map(|side| side as usize);
        let i = y * width + x;
        let [mx, my] = self.motion_px.get(i).copied().unwrap_or_default();
        let (px, py) = ((x as f32 + mx).round() + shift[0] as f32, (y as f32 + my).round() + shift[1] as f32);
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

#[cfg(test)]
mod tests {
    use super::*;
    use atrous_synthetic::scene;

    const SIDE: usize = 3 * TILE;

    fn noisy_share(frames: [&dyn Fn(usize, usize) -> f32; 2], skipped: Option<&[bool]>) -> f32 {
        let values = frames.map(|value| (0..SIDE * SIDE).map(|i| value(i % SIDE, i / SIDE)).collect::<Vec<_>>());
        let motion_px = vec![[0.0; 2]; SIDE * SIDE];
        let [before, now] = values.each_ref().map(Vec::as_slice);
        Pair { extent: [SIDE as u32; 2], values: [before, now], motion_px: &motion_px, skipped }.noisy_share()
    }

    fn random(x: usize, y: usize, seed: u32) -> f32 {
        scene::random(x as u32, y as u32, seed)
    }

    #[test]
    fn a_print_that_moved_by_a_pixel_is_no_noise() {
        let noise = |seed| move |x, y| random(x, y, seed);
        assert_eq!(noisy_share([&noise(1), &noise(2)], None), 1.0);
        assert_eq!(noisy_share([&noise(1), &|x, y| random(x + 1, y + 1, 1)], None), 0.0);
        assert_eq!(noisy_share([&noise(1), &|x, y| random(x + 3, y, 1)], None), 1.0, "three pixels are too far");
    }

    #[test]
    fn pixels_that_are_skipped_do_not_count() {
        let is_striped = |x: usize| x % 8 < 3;
        let striped = |seed| move |x, y| if is_striped(x) { random(x, y, seed) } else { 0.5 };
        let skipped: Vec<bool> =
            (0..SIDE * SIDE).map(|i| is_striped((i + 1) % SIDE) || is_striped(i % SIDE) || is_striped((i + 7) % 8)).collect();
        assert_eq!(noisy_share([&striped(1), &striped(2)], None), 1.0);
        assert_eq!(noisy_share([&striped(1), &striped(2)], Some(&skipped)), 0.0);
    }
}

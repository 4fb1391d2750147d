//! An 8-bit RGB image in memory.

use crate::pictures::PictureError;

/// 268 million pixels, 805 MB: beyond what any viewer shows, and far below what overflows an index.
const MAX_PIXELS: u64 = 1 << 28;

/// An 8-bit sRGB image, at least 1x1 pixels, row by row from the top left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 3]>,
}

/// A rectangle of pixels; `x` and `y` are its top left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// Leftmost column.
    pub x: u32,
    /// Topmost row.
    pub y: u32,
    /// Columns, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
}

impl std::fmt::Display for Region {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the region of {}x{} pixels at ({}, {})", self.width, self.height, self.x, self.y)
    }
}

impl Picture {
    /// A picture of one colour.
    ///
    /// # Errors
    /// [`PictureError::Empty`] or [`PictureError::TooLarge`].
    pub fn filled(width: u32, height: u32, colour: [u8; 3]) -> Result<Self, PictureError> {
        let count = pixel_count(width, height)?;
        Ok(Self { width, height, pixels: vec![colour; count] })
    }

    /// A picture of `width * height` sRGB pixels, row by row from the top left.
    ///
    /// # Errors
    /// [`PictureError::Empty`], [`PictureError::TooLarge`], or [`PictureError::Length`] if the count is another.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<[u8; 3]>) -> Result<Self, PictureError> {
        check_length(width, height, pixels.len())?;
        Ok(Self { width, height, pixels })
    }

    /// Width in pixels, at least 1.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels, at least 1.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top left.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    pub(crate) fn into_pixels(self) -> Vec<[u8; 3]> {
        self.pixels
    }

    /// The pixel in column `x` and row `y`, if there is one.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        self.index(x.into(), y.into()).map(|i| self.pixels[i])
    }

    /// The pixels of a region as a picture of their own.
    ///
    /// # Errors
    /// [`PictureError::Region`] if the region is empty or leaves the picture.
    pub fn crop(&self, region: Region) -> Result<Self, PictureError> {
        self.check(region)?;
        let mut pixels = Vec::with_capacity(region.width as usize * region.height as usize);
        for y in region.y..region.y + region.height {
            let start = y as usize * self.width as usize + region.x as usize;
            pixels.extend_from_slice(&self.pixels[start..start + region.width as usize]);
        }
        Self::from_pixels(region.width, region.height, pixels)
    }

    /// The picture with each pixel repeated `factor` times in both directions: nothing is smoothed.
    ///
    /// # Errors
    /// [`PictureError::Zero`] if the factor is 0, or [`PictureError::TooLarge`].
    pub fn upscale(&self, factor: u32) -> Result<Self, PictureError> {
        let (width, height) = self.upscaled_extent(factor)?;
        let factor = factor as usize;
        let mut pixels = Vec::with_capacity(pixel_count(width, height)?);
        for row in self.pixels.chunks_exact(self.width as usize) {
            let start = pixels.len();
            pixels.extend(row.iter().flat_map(|&p| std::iter::repeat_n(p, factor)));
            let end = pixels.len();
            for _ in 1..factor {
                pixels.extend_from_within(start..end);
            }
        }
        Self::from_pixels(width, height, pixels)
    }

    pub(crate) fn upscaled_extent(&self, factor: u32) -> Result<(u32, u32), PictureError> {
        if factor == 0 {
            return Err(PictureError::Zero("the upscale factor"));
        }
        let grow = |side: u32| u64::from(side) * u64::from(factor);
        checked_extent(grow(self.width), grow(self.height))
    }

    /// Draws `other` with its top left corner at (`x`, `y`). What does not fit is cut off.
    pub fn paste(&mut self, other: &Picture, x: u32, y: u32) {
        let columns = other.width.min(self.width.saturating_sub(x)) as usize;
        let rows = other.height.min(self.height.saturating_sub(y)) as usize;
        for row in 0..rows {
            let from = row * other.width as usize;
            let to = (y as usize + row) * self.width as usize + x as usize;
            if columns > 0 {
                self.pixels[to..to + columns].copy_from_slice(&other.pixels[from..from + columns]);
            }
        }
    }

    /// Draws the outline of a region, `thickness` pixels wide and inside it. What does not fit is cut off.
    pub fn outline(&mut self, region: Region, colour: [u8; 3], thickness: u32) {
        let (right, bottom) = (region.x.saturating_add(region.width), region.y.saturating_add(region.height));
        for y in region.y..bottom.min(self.height) {
            for x in region.x..right.min(self.width) {
                let to_edge = (x - region.x).min(y - region.y).min(right - 1 - x).min(bottom - 1 - y);
                if to_edge < thickness {
                    self.set(x.into(), y.into(), colour);
                }
            }
        }
    }

    pub(crate) fn check(&self, region: Region) -> Result<(), PictureError> {
        let fits = |start: u32, length: u32, side: u32| length > 0 && start < side && length <= side - start;
        if fits(region.x, region.width, self.width) && fits(region.y, region.height, self.height) {
            return Ok(());
        }
        Err(PictureError::Region { region, width: self.width, height: self.height })
    }

    /// Sets a pixel; outside the picture nothing happens.
    pub(crate) fn set(&mut self, x: i64, y: i64, colour: [u8; 3]) {
        if let Some(i) = self.index(x, y) {
            self.pixels[i] = colour;
        }
    }

    fn index(&self, x: i64, y: i64) -> Option<usize> {
        let inside = (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        inside.then(|| y as usize * self.width as usize + x as usize)
    }
}

/// A size that was computed, as the size of a picture.
pub(crate) fn checked_extent(width: u64, height: u64) -> Result<(u32, u32), PictureError> {
    match (u32::try_from(width), u32::try_from(height)) {
        (Ok(w), Ok(h)) if pixel_count(w, h).is_ok() => Ok((w, h)),
        _ => Err(PictureError::TooLarge { width, height, max: MAX_PIXELS }),
    }
}

pub(crate) fn check_length(width: u32, height: u32, given: usize) -> Result<(), PictureError> {
    let needed = pixel_count(width, height)? as u64;
    if given as u64 == needed {
        return Ok(());
    }
    Err(PictureError::Length { width, height, given, needed })
}

fn pixel_count(width: u32, height: u32) -> Result<usize, PictureError> {
    if width == 0 || height == 0 {
        return Err(PictureError::Empty { width, height });
    }
    let count = u64::from(width) * u64::from(height);
    if count > MAX_PIXELS {
        return Err(PictureError::TooLarge { width: width.into(), height: height.into(), max: MAX_PIXELS });
    }
    Ok(count as usize)
}

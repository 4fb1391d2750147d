//! Text in bitmap fonts.

use crate::pictures::Picture;
use embedded_graphics::mono_font::iso_8859_1::{FONT_10X20, FONT_5X8, FONT_6X10, FONT_7X13, FONT_8X13, FONT_9X18};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::{DrawTarget, Drawable, OriginDimensions, Pixel, Point, Size};
use embedded_graphics::text::{Baseline, Text};
use std::convert::Infallible;

const FONTS: [&MonoFont<'static>; 6] = [&FONT_10X20, &FONT_9X18, &FONT_8X13, &FONT_7X13, &FONT_6X10, &FONT_5X8];

/// A font in which every character has the same size.
#[derive(Clone, Copy)]
pub(crate) struct Font {
    mono: &'static MonoFont<'static>,
    /// Pixels of the picture for each dot of a character, in both directions.
    scale: u32,
}

impl Font {
    /// Type of the axes and legends of plots.
    pub(crate) const PLOT: Self = Self { mono: &FONT_7X13, scale: 1 };
    /// Type of the titles of plots.
    pub(crate) const PLOT_TITLE: Self = Self { mono: &FONT_9X18, scale: 1 };

    /// The largest font in which `characters` fit into `width` pixels and which is no taller than `max_height`, with
    /// each dot enlarged `scale` times; the smallest font if there is none.
    pub(crate) fn fitting(characters: usize, width: u32, max_height: u32, scale: u32) -> Self {
        let sized = FONTS.map(|mono| Self { mono, scale });
        let fits = |font: &&Self| font.height() <= max_height && characters as u64 * u64::from(font.advance()) <= u64::from(width);
        sized.iter().find(fits).copied().unwrap_or(Self { mono: &FONT_5X8, scale })
    }

    pub(crate) fn width_of(self, text: &str) -> u32 {
        (text.chars().count() as u32).saturating_mul(self.advance())
    }

    pub(crate) fn height(self) -> u32 {
        self.mono.character_size.height * self.scale
    }

    fn advance(self) -> u32 {
        self.mono.character_size.width * self.scale
    }

    /// The text, or as much of its beginning as fits into `width` pixels, then with dots at its end.
    pub(crate) fn shortened(self, text: &str, width: u32) -> String {
        let room = (width / self.advance()) as usize;
        if text.chars().count() <= room {
            return text.into();
        }
        let dots = room.min(2);
        text.chars().take(room - dots).chain(std::iter::repeat_n('.', dots)).collect()
    }

    /// Draws one line with its top left corner at `origin`. Characters outside Latin-1 become a question mark.
    pub(crate) fn draw(self, picture: &mut Picture, text: &str, origin: [i32; 2], [r, g, b]: [u8; 3]) {
        let style = MonoTextStyle::new(self.mono, Rgb888::new(r, g, b));
        let mut dots = Dots { picture, origin: origin.map(i64::from), scale: i64::from(self.scale) };
        let Ok(_) = Text::with_baseline(text, Point::zero(), style, Baseline::Top).draw(&mut dots);
    }
}

/// The dots of enlarged characters, the first of them at `origin`.
struct Dots<'a> {
    picture: &'a mut Picture,
    origin: [i64; 2],
    scale: i64,
}

impl OriginDimensions for Dots<'_> {
    fn size(&self) -> Size {
        Size::new(self.picture.width(), self.picture.height())
    }
}

impl DrawTarget for Dots<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(dot, colour) in pixels {
            let [x, y] = [self.origin[0] + i64::from(dot.x) * self.scale, self.origin[1] + i64::from(dot.y) * self.scale];
            for (dx, dy) in (0..self.scale).flat_map(|dy| (0..self.scale).map(move |dx| (dx, dy))) {
                self.picture.set(x + dx, y + dy, [colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

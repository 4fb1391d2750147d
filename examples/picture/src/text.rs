//! Text in bitmap fonts.

use crate::Picture;
use embedded_graphics::mono_font::iso_8859_1::{
    FONT_10X20, FONT_5X8, FONT_6X10, FONT_7X13, FONT_8X13, FONT_9X18,
};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::{DrawTarget, Drawable, OriginDimensions, Pixel, Point, Size};
use embedded_graphics::text::{Baseline, Text};
use std::convert::Infallible;

const FONTS: [&MonoFont<'static>; 6] = [
    &FONT_10X20,
    &FONT_9X18,
    &FONT_8X13,
    &FONT_7X13,
    &FONT_6X10,
    &FONT_5X8,
];

/// A font in which every character has the same size.
#[derive(Clone, Copy)]
pub(crate) struct Font(&'static MonoFont<'static>);

impl Font {
    /// For the axes and legends of plots.
    pub(crate) const PLOT: Self = Self(&FONT_7X13);
    /// For the titles of plots.
    pub(crate) const PLOT_TITLE: Self = Self(&FONT_9X18);

    /// The largest font in which `characters` fit into `width` pixels and which is no taller than `max_height`; the
    /// smallest font if there is none.
    pub(crate) fn fitting(characters: usize, width: u32, max_height: u32) -> Self {
        let fits = |font: &&&MonoFont<'_>| {
            font.character_size.height <= max_height
                && characters as u64 * u64::from(font.character_size.width) <= u64::from(width)
        };
        Self(FONTS.iter().find(fits).copied().unwrap_or(&FONT_5X8))
    }

    pub(crate) fn width_of(self, text: &str) -> u32 {
        text.chars().count() as u32 * self.0.character_size.width
    }

    pub(crate) fn height(self) -> u32 {
        self.0.character_size.height
    }

    /// The text, or as much of its beginning as fits into `width` pixels, then with dots at its end.
    pub(crate) fn shortened(self, text: &str, width: u32) -> String {
        let room = (width / self.0.character_size.width) as usize;
        if text.chars().count() <= room {
            return text.into();
        }
        let dots = room.min(2);
        text.chars()
            .take(room - dots)
            .chain(std::iter::repeat_n('.', dots))
            .collect()
    }

    /// Draws one line with its top left corner at (`x`, `y`). Characters outside Latin-1 become a question mark.
    pub(crate) fn draw(
        self,
        picture: &mut Picture,
        text: &str,
        [x, y]: [i32; 2],
        [r, g, b]: [u8; 3],
    ) {
        let style = MonoTextStyle::new(self.0, Rgb888::new(r, g, b));
        let Ok(_) = Text::with_baseline(text, Point::new(x, y), style, Baseline::Top)
            .draw(&mut Target(picture));
    }
}

struct Target<'a>(&'a mut Picture);

impl OriginDimensions for Target<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Target<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(point, colour) in pixels {
            self.0.set(
                point.x.into(),
                point.y.into(),
                [colour.r(), colour.g(), colour.b()],
            );
        }
        Ok(())
    }
}

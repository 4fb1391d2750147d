//! Lets `plotters` draw on a [`Picture`], with this crate's bitmap fonts in place of system fonts.

use crate::pictures::text::Font;
use crate::pictures::Picture;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{BackendColor, BackendCoord, BackendTextStyle, DrawingBackend, DrawingErrorKind};
use std::convert::Infallible;

type Result<T> = std::result::Result<T, DrawingErrorKind<Infallible>>;

pub(crate) struct Canvas<'a>(pub(crate) &'a mut Picture);

impl DrawingBackend for Canvas<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (self.0.width(), self.0.height())
    }

    fn ensure_prepared(&mut self) -> Result<()> {
        Ok(())
    }

    fn present(&mut self) -> Result<()> {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Result<()> {
        let (Ok(column), Ok(row)) = (u32::try_from(x), u32::try_from(y)) else {
            return Ok(());
        };
        if let Some(below) = self.0.pixel(column, row) {
            let (r, g, b) = colour.rgb;
            let above = [r, g, b].map(f64::from);
            let mix = |c: usize| f64::from(below[c]) + (above[c] - f64::from(below[c])) * colour.alpha.clamp(0.0, 1.0);
            self.0.set(x.into(), y.into(), std::array::from_fn(|c| mix(c).round() as u8));
        }
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Result<()> {
        let (width, height) = (Font::PLOT.width_of(text) as i32, Font::PLOT.height() as i32);
        let left = match style.anchor().h_pos {
            HPos::Left => x,
            HPos::Center => x - width / 2,
            HPos::Right => x - width,
        };
        let top = match style.anchor().v_pos {
            VPos::Top => y,
            VPos::Center => y - height / 2,
            VPos::Bottom => y - height,
        };
        let (r, g, b) = style.color().rgb;
        Font::PLOT.draw(self.0, text, [left, top], [r, g, b]);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(&self, text: &str, _: &S) -> Result<(u32, u32)> {
        Ok((Font::PLOT.width_of(text), Font::PLOT.height()))
    }
}

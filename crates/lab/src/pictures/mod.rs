//! Pictures that the demo, the tools and the tests of `atrous` write.
//!
//! [`Picture`] is an 8-bit image made of radiance or of colours for a display, and read from and written to
//! PNG. [`Strip`] puts labelled pictures side by side, with enlarged insets. [`Legend`] says what colours stand for. [`LinePlot`] draws one line for each
//! denoiser over the frames, [`Scatter`] sets one value against another, [`StackedBars`] one bar for each with a segment for each part, and [`TextTable`] prints
//! numbers that can be pasted into Markdown. All text is drawn with bitmap fonts, so that no font has to be installed and
//! the same input gives the same bytes everywhere.
mod bars;
mod convert;
mod error;
mod legend;
mod picture;
mod plot;
mod plot_canvas;
mod png_file;
mod scatter;
mod strip;
mod strip_layout;
mod table;
mod text;

pub use bars::StackedBars;
pub use convert::{from_srgb_8bit, srgb_8bit, NOT_FINITE};
pub use error::PictureError;
pub use legend::{ColourBar, Legend};
pub use picture::{Picture, Region};
pub use plot::{value_axis, LinePlot, Series};
pub use scatter::Scatter;
pub use strip::Strip;
pub use table::{Column, TextTable};

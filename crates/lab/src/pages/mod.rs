//! Reports of the demo and the tools of `atrous`: one HTML file that needs nothing beside it.
//!
//! A [`Page`] has sections, and a section has text, tables ([`Table`]), pictures to compare pixel by pixel ([`Comparison`], with
//! [`HeatMap`] for errors) and curves over frames ([`Curves`]). Pictures, style and scripts are inside the file, which opens
//! from a folder, in a mail or on a phone, and loads nothing. The same input gives the same bytes.
//!
//! ```
//! use atrous_lab::pages::{Comparison, Curves, Page};
//! use atrous_lab::pictures::Picture;
//!
//! # fn main() -> Result<(), atrous_lab::pages::PageError> {
//! let mut page = Page::new("Cornell box, 64 frames");
//! page.introduction("What one sample per pixel becomes.");
//! let section = page.section("Last frame");
//! let mut comparison = Comparison::new("Frame 63");
//! comparison.picture("noisy", &Picture::filled(64, 36, [90, 80, 70])?)?;
//! comparison.picture("denoised", &Picture::filled(64, 36, [80, 80, 80])?)?;
//! section.comparison(comparison)?;
//! section.curves(Curves::new("RMSE").series("denoised", [0.12, 0.08, 0.05]))?;
//! assert!(page.html().starts_with("<!DOCTYPE html>"));
//! # Ok(())
//! # }
//! ```
mod anchor;
mod axis;
mod comparison;
mod curves;
mod error;
mod heat_map;
mod page;
mod section;
mod table;

pub use comparison::Comparison;
pub use curves::Curves;
pub use error::PageError;
pub use heat_map::HeatMap;
pub use page::Page;
pub use section::Section;
pub use table::{Best, Cell, Table};

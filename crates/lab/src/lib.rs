//! The laboratory: how good a picture is, and how it is shown. Hosts need none of it.
//!
//! [`scores`] says how far a frame is from its reference, [`pictures`] draws strips, plots and tables, and [`pages`] writes reports as
//! HTML. What measures the filters with them is the package `atrous-measure` beside it.

#![forbid(unsafe_code)]

pub mod pages;
pub mod pictures;
pub mod scores;

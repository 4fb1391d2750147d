//! The laboratory: how good a picture is, how it is shown, and what the filters make of the miniature engine. Hosts need none of it.
//!
//! [`scores`] says how far a frame is from its reference, [`pictures`] draws strips, plots and tables, and [`pages`] writes reports as
//! HTML. The feature `measure` has the rest: frames of the engine with their scores, the command `evaluate` of the demo, and the
//! programs `bench` and `shadow_edges`; the example `price` draws time against error.

#![forbid(unsafe_code)]

#[cfg(feature = "measure")]
mod error;
#[cfg(feature = "measure")]
pub mod evaluate;
#[cfg(feature = "measure")]
pub mod files;
#[cfg(feature = "measure")]
pub mod measure;
#[cfg(feature = "measure")]
pub mod options;
pub mod pages;
pub mod pictures;
#[cfg(feature = "measure")]
pub mod progress;
#[cfg(feature = "measure")]
pub mod report;
#[cfg(feature = "measure")]
pub mod running;
pub mod scores;
#[cfg(feature = "measure")]
pub mod shadows;
#[cfg(feature = "measure")]
mod times;
#[cfg(feature = "measure")]
pub mod volume;

#[cfg(feature = "measure")]
pub use error::{Error, Result};

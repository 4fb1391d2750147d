//! The formats that your images may have: class, size and aspects of a texel, and its samples.
//!
//! One table. Who sizes a buffer, who copies an image and who reads the copy ask the same row, so that none can differ.

mod decode;
mod table;

#[cfg(feature = "capture")]
pub(crate) use decode::Plane;
pub(crate) use table::{Class, Texel, ACCEPTED};

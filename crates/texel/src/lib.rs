//! The formats that an image of a host may have: class, size and aspects of a texel, and its samples.
//!
//! One table. Who sizes a buffer, who copies an image and who reads the copy ask the same row, so that none can differ.

#![forbid(unsafe_code)]

mod decode;
mod table;

pub use decode::Plane;
pub use table::{Class, Texel, ACCEPTED};

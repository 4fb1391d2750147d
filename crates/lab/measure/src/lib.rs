//! What the filters make of the miniature engine: frames with their scores, the command `evaluate` of the demo, and the programs
//! `bench` and `shadow_edges`; the example `price` draws time against error. Scores, pictures and pages are those of `atrous-lab`.

#![forbid(unsafe_code)]

pub mod apart;
mod error;
pub mod evaluate;
pub mod files;
pub mod measure;
pub mod moving_shadows;
pub mod progress;
pub mod report;
pub mod running;
pub mod shadows;
mod times;

pub use error::{Error, Result};

//! Denoises a sequence of EXR frames: `cargo run --release -p atrous-denoise -- FRAMES -o FOLDER`. See docs/denoise.md.
//!
//! [`tool::run`] is the whole run. The modules are public for the tests and examples of this package: nothing else builds on them.

#![forbid(unsafe_code)]

pub mod backend;
pub mod camera;
mod captured_config;
pub mod check;
pub mod cli;
pub mod conventions;
pub mod display_transform;
pub mod error;
mod exr_compression;
pub mod exr_header;
pub mod exr_read;
pub mod exr_write;
mod file_pattern;
pub mod first_look;
pub mod frame;
pub mod frame_files;
mod frame_images;
mod frame_names;
mod frame_source;
mod gaps;
pub mod layouts;
pub mod loader;
mod lobes;
pub mod mapping;
pub mod memory;
mod missing;
pub mod motion;
mod negative;
mod old_tunables;
pub mod options;
pub mod output_size;
mod panics;
mod paths;
mod pictures;
pub mod pipeline;
pub mod plan;
pub mod progress;
mod projection;
pub mod range;
mod raster;
pub mod record;
pub mod report;
pub mod results;
pub mod roles;
pub mod sampling;
pub mod saver;
pub mod score;
pub mod setup;
mod smooth;
pub mod terminal;
pub mod tool;
mod transmission;
mod unfiltered;
mod views;

//! Denoises a sequence of EXR frames: `cargo run --release --example denoise -- FRAMES -o FOLDER`. See docs/denoise.md.

mod backend;
mod backend_reference;
mod camera;
mod captured_config;
mod check;
mod cli;
mod conventions;
mod error;
mod exr_header;
mod exr_read;
mod exr_write;
mod frame;
mod frame_files;
mod frame_images;
mod frame_source;
mod layouts;
mod mapping;
mod motion;
mod panics;
mod pictures;
mod pipeline;
mod plan;
mod roles;
mod saver;
mod score;
mod setup;
mod tool;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    match tool::run(&cli::Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

//! The program: see the library of this package, and docs/denoise.md.

#![forbid(unsafe_code)]

use atrous_denoise::{cli::Cli, terminal, tool};
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    match tool::run(&Cli::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            terminal::tell(&format!("error: {error}"));
            ExitCode::FAILURE
        }
    }
}

//! Renders animated scenes with one path per pixel, denoises them, and writes pictures and tables.

mod capture;
mod error;
mod options;
mod run;

use std::process::ExitCode;

use atrous_engine::{Gpu, GpuOptions};
use atrous_measure::evaluate;
use clap::Parser;
use error::Result;
use options::{Command, Options};

fn main() -> ExitCode {
    match demo(&Options::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(count) => {
            eprintln!("error: {count} validation messages");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(feature = "window")]
fn window(options: &Options) -> Result<usize> {
    Ok(atrous_window::run(options.window())?)
}

#[cfg(not(feature = "window"))]
fn window(_: &Options) -> Result<usize> {
    Err(error::Error::NoWindowBuilt)
}

/// Gives the number of validation messages.
fn demo(options: &Options) -> Result<usize> {
    if options.list_devices {
        Gpu::list_devices()?.iter().for_each(|device| println!("{device}"));
        return Ok(0);
    }
    if let Some(Command::Evaluate(options)) = &options.command {
        return Ok(evaluate::run(options)?);
    }
    options.check()?;
    if options.window {
        return window(options);
    }
    let gpu = Gpu::new(&GpuOptions { device: options.device.clone(), validation: options.validate, ..GpuOptions::default() })?;
    println!("device {}", gpu.info());
    for scene in options.scenes() {
        run::run(options, &gpu, &scene)?;
    }
    println!("pictures and tables are in {}", options.out.display());
    let messages = gpu.validation_messages();
    messages.iter().for_each(|message| eprintln!("{message}"));
    Ok(messages.len())
}

//! Renders animated scenes with one path per pixel, denoises them, and writes pictures and tables.

mod capture;
mod evaluate;
mod files;
mod options;
mod progress;
mod run;
mod running;
mod times;

use std::process::ExitCode;

use atrous_demo::{Gpu, GpuOptions, Result};
use clap::Parser;
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
    atrous_demo::window::run(options.window())
}

#[cfg(not(feature = "window"))]
fn window(_: &Options) -> Result<usize> {
    Err(atrous_demo::Error::NoWindowBuilt)
}

/// Gives the number of validation messages.
fn demo(options: &Options) -> Result<usize> {
    if options.list_devices {
        Gpu::list_devices()?.iter().for_each(|device| println!("{device}"));
        return Ok(0);
    }
    if let Some(Command::Evaluate(options)) = &options.command {
        return evaluate::run(options);
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

//! What a driver's compiler makes of every shader.
use super::options::Options;
use std::error::Error;
use std::process::ExitCode;

pub fn run(_: &Options) -> Result<ExitCode, Box<dyn Error>> {
    Err("not yet".into())
}

//! Frames are captured from a session on a Vulkan device, read back by the modules of the example `denoise`, and filtered again.
//!
//! A harness of its own, as the suite has one: without a device these tests count as ignored.

#![allow(dead_code, reason = "the modules of the tool and of the suite have more than these tests use")]

#[path = "../../examples/denoise/backend.rs"]
mod backend;
#[path = "../../examples/denoise/backend_reference.rs"]
mod backend_reference;
#[path = "../../examples/denoise/camera.rs"]
mod camera;
#[path = "../../examples/denoise/captured_config.rs"]
mod captured_config;
#[path = "../../examples/denoise/conventions.rs"]
mod conventions;
#[path = "../../examples/denoise/error.rs"]
mod error;
#[path = "../../examples/denoise/exr_header.rs"]
mod exr_header;
#[path = "../../examples/denoise/exr_read.rs"]
mod exr_read;
#[path = "../../examples/denoise/frame.rs"]
mod frame;
#[path = "../../examples/denoise/frame_files.rs"]
mod frame_files;
#[path = "../../examples/denoise/frame_images.rs"]
mod frame_images;
#[path = "../../examples/denoise/frame_source.rs"]
mod frame_source;
#[path = "../../examples/denoise/layouts.rs"]
mod layouts;
#[path = "../../examples/denoise/mapping.rs"]
mod mapping;
#[path = "../../examples/denoise/panics.rs"]
mod panics;
#[path = "../../examples/denoise/roles.rs"]
mod roles;
#[path = "../../examples/denoise/setup.rs"]
mod setup;
#[path = "../support/mod.rs"]
mod support;

mod errors;
mod host_images;
mod replay;

use libtest_mimic::{Arguments, Failed, Trial};
use std::panic::{catch_unwind, AssertUnwindSafe};

/// A test that needs a device: a name and a function that panics where something is wrong.
pub type GpuTest = (&'static str, fn());

fn main() {
    let mut arguments = Arguments::from_args();
    arguments.test_threads.get_or_insert(2);
    let device = support::try_gpu();
    if let Err(error) = &device {
        eprintln!("GPU tests are ignored: {error}");
        assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {error}");
    }
    let tests = [replay::TESTS, errors::TESTS, host_images::TESTS].concat();
    let trial = |(name, test): (&'static str, fn())| Trial::test(name, move || run(test)).with_ignored_flag(device.is_err());
    libtest_mimic::run(&arguments, tests.into_iter().map(trial).collect()).exit();
}

fn run(test: fn()) -> Result<(), Failed> {
    catch_unwind(AssertUnwindSafe(test)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Failed::from(text.unwrap_or_default())
    })
}

//! Frames are captured from a session on a Vulkan device, read back by the tool, and filtered again.
//!
//! A harness of its own, as the suite of the crate has one: without a device these tests count as ignored.

mod host_images;
mod replay;
mod support;

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
    let tests = [replay::TESTS, host_images::TESTS].concat();
    let trial = |(name, test): (&'static str, fn())| Trial::test(name, move || run(test)).with_ignored_flag(device.is_err());
    libtest_mimic::run(&arguments, tests.into_iter().map(trial).collect()).exit();
}

fn run(test: fn()) -> Result<(), Failed> {
    catch_unwind(AssertUnwindSafe(test)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Failed::from(text.unwrap_or_default())
    })
}

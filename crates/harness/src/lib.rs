//! A harness for tests that run on a device: on a machine without one they count as ignored, and the output says so, instead of
//! passing. `ATROUS_REQUIRE_DEVICE=1` makes a missing device a failure.

#![forbid(unsafe_code)]

use libtest_mimic::{Arguments, Failed, Trial};
use std::fmt::Display;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// A test: a name and a function that panics where something is wrong.
pub type DeviceTest = (&'static str, fn());

/// Tests that share a prefix of their names.
pub struct Group {
    /// What stands before `::` in the name of each test; empty for none.
    pub name: &'static str,
    /// The tests.
    pub tests: &'static [DeviceTest],
    /// They are ignored without a device.
    pub needs_device: bool,
}

/// Runs the tests that the command line asks for, and ends the process. `device` is what opening the device gave.
pub fn run<D, E: Display>(groups: &[Group], device: &Result<D, E>) -> ! {
    let mut arguments = Arguments::from_args();
    // A frame keeps every core busy on a software device: more threads than two only cost memory.
    arguments.test_threads.get_or_insert(2);
    if let Err(error) = device {
        eprintln!("GPU tests are ignored: {error}");
        assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {error}");
    }
    let mut trials = Vec::new();
    for group in groups {
        for &(name, test) in group.tests {
            let name = if group.name.is_empty() { name.to_owned() } else { format!("{}::{name}", group.name) };
            let ignored = group.needs_device && device.is_err();
            trials.push(Trial::test(name, move || caught(test)).with_ignored_flag(ignored));
        }
    }
    libtest_mimic::run(&arguments, trials).exit()
}

fn caught(test: fn()) -> Result<(), Failed> {
    catch_unwind(AssertUnwindSafe(test)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Failed::from(text.unwrap_or_default())
    })
}

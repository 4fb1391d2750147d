//! Everything that runs the passes on a Vulkan device, under the validation layer with synchronisation validation.
//!
//! One program with a harness of its own, so that a machine without a device counts these tests as ignored, and says so, instead of passing them.
//! `ATROUS_REQUIRE_DEVICE=1` makes a missing device a failure.

mod allocation;
mod bad_input;
#[cfg(feature = "capture")]
mod capture;
mod checksums;
mod contract;
mod debug_views;
mod declarations;
mod documents;
mod eaw;
mod firefly;
mod gradients;
mod graphs;
mod host_header;
mod hosts;
#[cfg(feature = "hot-reload")]
mod hot_reload;
mod parity;
mod pattern;
mod percentile;
mod properties;
mod sequences;
mod support;
mod sync_validation;
mod volume;

use libtest_mimic::{Arguments, Failed, Trial};
use std::panic::{catch_unwind, AssertUnwindSafe};

/// A test that needs a device: a name and a function that panics where something is wrong.
pub type GpuTest = (&'static str, fn());

#[global_allocator]
static ALLOCATOR: allocation::Counting = allocation::Counting;

fn main() {
    if let Some(code) = hosts::run_as_host() {
        std::process::exit(code);
    }
    let mut arguments = Arguments::from_args();
    // A frame keeps every core busy on a software device: more threads than two only cost memory.
    arguments.test_threads.get_or_insert(2);
    let device = support::try_gpu();
    if let Err(error) = &device {
        eprintln!("GPU tests are ignored: {error}");
        assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {error}");
    }
    let groups: &[(&str, &[GpuTest], bool)] = &[
        ("allocation", allocation::TESTS, true),
        ("contract", contract::TESTS, false),
        ("declarations", declarations::TESTS, false),
        ("documents", documents::TESTS, false),
        ("host_header", host_header::TESTS, false),
        ("hosts", hosts::TESTS, true),
        #[cfg(feature = "hot-reload")]
        ("hot_reload", hot_reload::TESTS, true),
        ("bad_input", bad_input::TESTS, true),
        #[cfg(feature = "capture")]
        ("capture", capture::TESTS, true),
        ("checksums", checksums::TESTS, true),
        ("debug_views", debug_views::TESTS, true),
        ("eaw", eaw::TESTS, true),
        ("firefly", firefly::TESTS, true),
        ("properties", properties::TESTS, true),
        ("gradients", gradients::TESTS, true),
        ("graphs", graphs::TESTS, true),
        ("parity", parity::TESTS, true),
        ("pattern", pattern::TESTS, true),
        ("percentile", percentile::TESTS, true),
        ("sequences", sequences::TESTS, true),
        ("sync_validation", sync_validation::TESTS, true),
        ("volume", volume::TESTS, true),
    ];
    let mut trials = Vec::new();
    for &(group, tests, needs_gpu) in groups {
        for &(name, test) in tests {
            let trial = Trial::test(format!("{group}::{name}"), move || run(test)).with_ignored_flag(needs_gpu && device.is_err());
            trials.push(trial);
        }
    }
    libtest_mimic::run(&arguments, trials).exit();
}

fn run(test: fn()) -> Result<(), Failed> {
    catch_unwind(AssertUnwindSafe(test)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Failed::from(text.unwrap_or_default())
    })
}

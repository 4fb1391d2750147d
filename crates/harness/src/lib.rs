//! A harness for tests that need what not every machine has, such as a device or a browser: on a machine without it they count as
//! ignored, and the output says so, instead of passing. `ATROUS_REQUIRE_DEVICE=1` makes a missing device a failure; other needs have
//! variables of their own.

#![deny(unsafe_code)]

#[cfg(feature = "browser")]
pub mod browser;
#[cfg(feature = "faults")]
pub mod faults;

use libtest_mimic::{Arguments, Failed, Trial};
use std::fmt::Display;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::process::Command;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How many of the longest tests are named in the end, and from which time on: what to look at when a run takes too long.
const NAMED_LONGEST: usize = 10;
const LONG: Duration = Duration::from_secs(5);

/// Tests and how long they took.
type Times = Arc<Mutex<Vec<(Duration, String)>>>;

/// A test: a name and a function that panics where something is wrong.
pub type DeviceTest = (&'static str, fn());

/// Tests that share a prefix of their names.
pub struct Group {
    /// What stands before `::` in the name of each test; empty for none.
    pub name: &'static str,
    /// The tests.
    pub tests: &'static [DeviceTest],
    /// They are ignored without a device, or what else [`run_with`] was given.
    pub needs_device: bool,
}

/// What tests need of a machine.
pub struct Need {
    /// Tests that need it, as the message says it that they are ignored.
    pub tests: &'static str,
    /// Name of the environment variable that makes it a failure when it is missing.
    pub required_by: &'static str,
}

/// A Vulkan device.
pub const DEVICE: Need = Need { tests: "GPU tests", required_by: "ATROUS_REQUIRE_DEVICE" };

/// Environment of a program that runs many shaders for a few small frames each: software Vulkan compiles them for much longer than it runs
/// them. Without its optimiser, and with short vectors, that takes half the time, and has the same bits. Yours stays.
pub fn quick_shaders() -> impl Iterator<Item = (&'static str, &'static str)> {
    [("GALLIVM_PERF", "nopt"), ("LP_NATIVE_VECTOR_WIDTH", "128")].into_iter().filter(|(name, _)| std::env::var_os(name).is_none())
}

/// The same for this program, before it starts a thread.
pub fn compile_shaders_quickly() {
    quick_shaders().for_each(|(name, value)| std::env::set_var(name, value));
}

/// Threads that tests run on.
pub fn threads() -> usize {
    // A frame keeps every core busy on a software device: more threads than two only cost memory.
    Arguments::from_args().test_threads.unwrap_or(2)
}

/// Runs the tests that the command line asks for, and ends the process. `device` is what opening the device gave.
pub fn run<D, E: Display>(groups: &[Group], device: &Result<D, E>) -> ! {
    run_apart(&[], groups, device)
}

/// Runs tests as [`run`] does, those whose names begin as one of `apart` each in a process of its own. That is for tests that open or drop
/// devices under validation: layers of 2023 find the device of a call in a table without a lock, and crash where another thread changes
/// the table at that time.
pub fn run_apart<D, E: Display>(apart: &[&str], groups: &[Group], device: &Result<D, E>) -> ! {
    run_all(&DEVICE, apart, groups, device)
}

/// Runs tests as [`run`] does, with another need in place of the device. `found` is what looking for it gave.
pub fn run_with<D, E: Display>(need: &Need, groups: &[Group], found: &Result<D, E>) -> ! {
    run_all(need, &[], groups, found)
}

fn run_all<D, E: Display>(need: &Need, apart: &[&str], groups: &[Group], found: &Result<D, E>) -> ! {
    let mut arguments = Arguments::from_args();
    arguments.test_threads = Some(threads());
    let is_apart = std::env::var_os(APART).is_some();
    if let Err(error) = found {
        eprintln!("{} are ignored: {error}", need.tests);
        assert!(std::env::var_os(need.required_by).is_none(), "{} is set, but: {error}", need.required_by);
    }
    let chosen = take_filters(&mut arguments);
    let (mut trials, times) = (Vec::new(), Times::default());
    for group in groups {
        for &(name, test) in group.tests {
            let name = if group.name.is_empty() { name.to_owned() } else { format!("{}::{name}", group.name) };
            if !chosen.is_empty() && !chosen.iter().any(|part| name.contains(part)) {
                continue;
            }
            let ignored = group.needs_device && found.is_err();
            let (times, timed) = (times.clone(), name.clone());
            let to_start = !is_apart && apart.iter().any(|beginning| name.starts_with(beginning));
            let run = move || {
                let start = Instant::now();
                let result = if to_start { in_own_process(&timed) } else { caught(test) };
                times.lock().unwrap_or_else(PoisonError::into_inner).push((start.elapsed(), timed));
                result
            };
            trials.push(Trial::test(name, run).with_ignored_flag(ignored));
        }
    }
    let conclusion = libtest_mimic::run(&arguments, trials);
    name_longest(&mut times.lock().unwrap_or_else(PoisonError::into_inner));
    conclusion.exit()
}

/// Several filters, with commas between them, choose the tests of each. One alone stays with the library, which knows whole names, too.
fn take_filters(arguments: &mut Arguments) -> Vec<String> {
    let several = arguments.filter.take_if(|filter| filter.contains(','));
    several.map(|filter| filter.split(',').map(str::to_owned).collect()).unwrap_or_default()
}

/// Set in a process that runs one test alone.
const APART: &str = "ATROUS_TEST_APART";

fn in_own_process(name: &str) -> Result<(), Failed> {
    let program = std::env::current_exe()?;
    let output = Command::new(program).args(["--exact", name, "--test-threads", "1"]).env(APART, "1").output()?;
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    if !output.status.success() {
        return Err(format!("its process ended with {}\n{text}", output.status).into());
    }
    println!("{}", text.trim());
    Ok(())
}

fn name_longest(times: &mut [(Duration, String)]) {
    times.sort_unstable_by(|a, b| b.cmp(a));
    let long = times.iter().take(NAMED_LONGEST).take_while(|(time, _)| *time >= LONG);
    let named: Vec<_> = long.map(|(time, name)| format!("{name} {:.1} s", time.as_secs_f64())).collect();
    if !named.is_empty() {
        println!("longest: {}", named.join(", "));
    }
}

fn caught(test: fn()) -> Result<(), Failed> {
    catch_unwind(AssertUnwindSafe(test)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
        Failed::from(text.unwrap_or_default())
    })
}

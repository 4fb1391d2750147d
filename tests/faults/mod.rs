//! Calls of Vulkan that fail while a session lives: submitting, waiting, mapping, whatever returns a result.

mod forgotten;
mod life;

use super::support::{gpu, soak::is_on};
use ash::vk;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Validation};
use atrous::Error;
use atrous_harness::faults::{replacement, Fault, Faults};
use atrous_harness::DeviceTest;
use life::{Life, STEPS};
use std::sync::{Arc, Mutex, PoisonError};

pub const TESTS: &[DeviceTest] = &[
    ("a_call_that_fails_is_named_and_the_session_goes_on", a_call_that_fails_is_named_and_the_session_goes_on),
    ("a_session_that_cannot_be_opened_leaves_nothing_behind", a_session_that_cannot_be_opened_leaves_nothing_behind),
    ("a_lost_device_is_told_and_nothing_hangs", a_lost_device_is_told_and_nothing_hangs),
    ("a_new_device_goes_on_where_a_lost_one_ended", a_new_device_goes_on_where_a_lost_one_ended),
    ("what_a_failed_wait_leaves_running_is_kept", what_a_failed_wait_leaves_running_is_kept),
    ("an_image_whose_upload_failed_is_not_read", an_image_whose_upload_failed_is_not_read),
    ("what_was_recorded_and_never_ran_is_forgotten", forgotten::what_was_recorded_and_never_ran_is_forgotten),
    ("counters_that_never_ran_are_not_read", forgotten::counters_that_never_ran_are_not_read),
    #[cfg(feature = "capture")]
    ("a_captured_frame_that_never_ran_is_not_written", forgotten::a_captured_frame_that_never_ran_is_not_written),
];

const HOST: vk::Result = vk::Result::ERROR_OUT_OF_HOST_MEMORY;
const DEVICE: vk::Result = vk::Result::ERROR_OUT_OF_DEVICE_MEMORY;
const LOST: vk::Result = vk::Result::ERROR_DEVICE_LOST;

/// What Vulkan says that a function may return, but for the loss of the device.
fn results(call: &str) -> &'static [vk::Result] {
    match call {
        "vkMapMemory" => &[HOST, DEVICE, vk::Result::ERROR_MEMORY_MAP_FAILED],
        "vkResetFences" => &[DEVICE],
        _ => &[HOST, DEVICE],
    }
}

/// A device of its own whose calls can fail. What the validation layer says of it, to the very end, is looked at when it is dropped.
struct Faulty {
    // Dropped last: calls go through it until the device is gone.
    gpu: Option<Arc<HeadlessDevice>>,
    log: Arc<Mutex<Vec<String>>>,
    faults: Faults,
}

impl Faulty {
    fn new() -> Self {
        let _first = gpu();
        let mut gpu = HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() }).expect("a device");
        let faults = Faults::new(gpu.device());
        // SAFETY: the functions have the signatures of those that they stand for, and call them or fail as they may.
        unsafe { gpu.replace_functions(replacement) };
        Self { log: gpu.validation_log(), gpu: Some(Arc::new(gpu)), faults }
    }

    fn gpu(&self) -> Arc<HeadlessDevice> {
        self.gpu.clone().expect("it is there until the end")
    }

    fn assert_valid(&self, what: &str) {
        let errors = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        assert!(errors.is_empty(), "{what}: {} validation messages, the first:\n{}", errors.len(), errors[0]);
    }
}

impl Drop for Faulty {
    fn drop(&mut self) {
        self.faults.set(&[]);
        self.gpu = None;
        if !std::thread::panicking() {
            self.assert_valid("objects that are left");
        }
    }
}

/// Whether an error is that of the call that failed.
fn names(error: &Error, fault: Fault) -> bool {
    match error {
        Error::Vulkan { call, result } => (*call, *result) == (fault.call, fault.result),
        // The allocator tells no more.
        Error::OutOfMemory { .. } => matches!(fault.call, "vkAllocateMemory" | "vkMapMemory"),
        _ => false,
    }
}

/// Some of `count` calls: all of few, or the first, the last and some between.
fn some_of(count: u32) -> impl Iterator<Item = u32> {
    (0..count).filter(move |i| *i == 0 || i + 1 == count || is_on() || i % count.div_ceil(4) == 0)
}

fn a_call_that_fails_is_named_and_the_session_goes_on() {
    let device = Faulty::new();
    let mut life = Life::open(&device.gpu()).expect("a session");
    // Once to its end, for what is made in the first frame alone.
    life.live().expect("no call fails");
    device.faults.set(&[]);
    life.live().expect("no call fails");
    let (seen, expected) = (device.faults.seen(), life.first_frame());
    assert!(["vkQueueSubmit", "vkWaitForFences", "vkMapMemory"].iter().all(|call| seen.contains_key(call)), "{seen:?}");
    let mut count = 0;
    for (&call, &calls) in seen.iter().filter(|(call, _)| !call.ends_with("WaitIdle")) {
        for (after, &result) in some_of(calls).flat_map(|after| results(call).iter().map(move |result| (after, result))) {
            let fault = Fault { call, after, result };
            device.faults.set(&[fault]);
            let mut failed = 0;
            for (name, step) in STEPS {
                if let Err(error) = step(&mut life) {
                    assert!(names(&error, fault), "{fault:?}, {name}: {error}");
                    failed += 1;
                    step(&mut life).unwrap_or_else(|error| panic!("{fault:?}, {name}: not usable afterwards: {error}"));
                }
            }
            assert!(failed == 1 && device.faults.are_spent(), "{fault:?}: {failed} steps failed");
            assert!(life.first_frame() == expected, "{fault:?}: other bits afterwards");
            device.assert_valid(&format!("{fault:?}"));
            count += 1;
        }
    }
    println!("{count} calls failed, of {} functions", seen.len());
}

fn a_session_that_cannot_be_opened_leaves_nothing_behind() {
    let device = Faulty::new();
    drop(Life::open(&device.gpu()).expect("a session"));
    let seen = device.faults.seen();
    let mut count = 0;
    for (&call, &calls) in seen.iter().filter(|(call, _)| !call.ends_with("WaitIdle")) {
        for after in some_of(calls) {
            let fault = Fault { call, after, result: HOST };
            device.faults.set(&[fault]);
            // Each opening makes all pipelines.
            device.gpu().host().pipelines.expect("it has a store").clear();
            let error = Life::open(&device.gpu()).err().unwrap_or_else(|| panic!("{fault:?}: nothing failed"));
            assert!(names(&error, fault) && device.faults.are_spent(), "{fault:?}: {error}");
            count += 1;
        }
    }
    println!("{count} calls failed, of {} functions", seen.len());
}

fn a_lost_device_is_told_and_nothing_hangs() {
    let device = Faulty::new();
    let mut life = Life::open(&device.gpu()).expect("a session");
    life.live().expect("no call fails");
    device.faults.set(&[]);
    life.live().expect("no call fails");
    let seen = device.faults.seen();
    drop(life);
    for call in ["vkQueueSubmit", "vkWaitForFences", "vkGetQueryPoolResults"] {
        let calls = seen[call];
        for after in (0..calls).filter(|after| is_on() || *after == calls / 2) {
            let fault = Fault { call, after, result: LOST };
            let mut life = Life::open(&device.gpu()).expect("a session");
            life.live().expect("no call fails");
            device.faults.set(&[fault]);
            let error = life.live().expect_err("the device is lost");
            assert!(names(&error, fault), "{fault:?}: {error}");
            for (name, step) in STEPS {
                let error = step(&mut life).expect_err(name);
                assert!(matches!(error, Error::Vulkan { result: LOST, .. }), "{fault:?}, {name}: {error}");
            }
            drop(life);
            device.faults.set(&[]);
            device.assert_valid(&format!("{fault:?}"));
        }
    }
}

/// A host that loses a device makes another, and an executor on it that starts with the frame that was not finished: with the bits of one
/// that dropped its history there.
fn a_new_device_goes_on_where_a_lost_one_ended() {
    const FRAMES: u32 = 4;
    let mut undisturbed = Life::open(&gpu()).expect("a session");
    (0..FRAMES).for_each(|_| undisturbed.frame().expect("no call fails"));
    undisturbed.invalidate();
    let expected: Vec<_> = (0..3).map(|_| undisturbed.frame_bits().expect("no call fails")).collect();
    for call in ["vkQueueSubmit", "vkWaitForFences"] {
        let lost = Faulty::new();
        let mut life = Life::open(&lost.gpu()).expect("a session");
        (0..FRAMES).for_each(|_| life.frame().expect("no call fails"));
        lost.faults.set(&[Fault { call, after: 0, result: LOST }]);
        let error = life.frame().expect_err(call);
        assert!(error.to_string().contains("device is lost"), "{error}");
        let finished = life.finished();
        drop(life);
        let other = HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() }).expect("a device");
        let mut next = Life::open(&Arc::new(other)).expect("a session");
        next.go_on_from(finished);
        let bits: Vec<_> = (0..3).map(|_| next.frame_bits().expect("no call fails")).collect();
        assert_eq!(next.index(), u64::from(FRAMES) + 2, "{call}: numbers of frames go on");
        assert!(finished == FRAMES && bits == expected, "{call}: {finished} frames were finished");
    }
}

/// Waiting fails, and so does the second try by another call: whatever the submission uses may be neither written nor destroyed.
fn what_a_failed_wait_leaves_running_is_kept() {
    let device = Faulty::new();
    for (name, step) in STEPS {
        let mut life = Life::open(&device.gpu()).expect("a session");
        life.live().expect("no call fails");
        device.faults.set(&[]);
        let expected = life.first_frame();
        let idle = Fault { call: "vkQueueWaitIdle", after: 0, result: DEVICE };
        device.faults.set(&[Fault { call: "vkWaitForFences", after: 0, result: HOST }, idle, idle]);
        let error = life.frame().expect_err("the first wait");
        assert_eq!(error, Error::Vulkan { call: "vkWaitForFences", result: HOST }, "{name}");
        let error = step(&mut life).expect_err(name);
        assert_eq!(error, Error::Vulkan { call: "vkQueueWaitIdle", result: DEVICE }, "{name}");
        step(&mut life).unwrap_or_else(|error| panic!("{name}: not usable afterwards: {error}"));
        assert!(device.faults.are_spent() && life.first_frame() == expected, "{name}");
        device.assert_valid(name);
    }
}

fn an_image_whose_upload_failed_is_not_read() {
    let device = Faulty::new();
    let mut life = Life::open(&device.gpu()).expect("a session");
    // The first one that a frame uploads, so that none has the image.
    for call in ["vkMapMemory", "vkQueueSubmit", "vkWaitForFences"] {
        device.faults.set(&[Fault { call, after: 0, result: HOST }]);
        life.frame().expect_err(call);
        assert!(device.faults.are_spent(), "{call}");
        let error = life.frame_of_what_is_there().expect_err("nothing is bound");
        assert_eq!(error, Error::NotBound("depth".into()), "{call}");
    }
    life.frame().expect("everything is uploaded");
}

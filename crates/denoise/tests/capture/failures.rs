//! Calls of Vulkan that fail while the tool filters frames.

use super::replay::{capture, load};
use atrous::executor::{HeadlessDevice, HeadlessOptions, Validation};
use atrous::{Config, Tuning};
use atrous_denoise::backend::{Backend, Passes};
use atrous_harness::faults::{replacement, Fault, Faults};
use atrous_harness::DeviceTest;
use atrous_synthetic::scene::Scene;
use std::sync::Arc;

pub const TESTS: &[DeviceTest] =
    &[("a_call_that_fails_is_named_and_the_next_frame_is_good", a_call_that_fails_is_named_and_the_next_frame_is_good)];

fn a_call_that_fails_is_named_and_the_next_frame_is_good() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = Scene { speed: 0.05, ..Scene::new([16, 9]) };
    capture(folder.path(), &Config::new([16, 9]), &Tuning::default(), &scene, |_, _| {});
    let (setup, frames) = load(folder.path());
    let mut gpu = HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() }).expect("a device");
    let faults = Faults::new(gpu.device());
    // SAFETY: the functions have the signatures of those that they stand for, and call them or fail as they may.
    unsafe { gpu.replace_functions(replacement) };
    let log = gpu.validation_log();
    let mut backend = Passes::on(Arc::new(gpu), &setup.config).expect("passes");
    let first = backend.denoise(&frames[0], false).expect("a picture").radiance;
    let result = ash::vk::Result::ERROR_OUT_OF_HOST_MEMORY;
    for call in ["vkBeginCommandBuffer", "vkEndCommandBuffer", "vkResetFences", "vkQueueSubmit", "vkWaitForFences"] {
        faults.set(&[]);
        backend.denoise(&frames[1], false).expect("a picture");
        let calls = faults.seen()[call];
        for after in [0, calls / 2, calls - 1] {
            faults.set(&[Fault { call, after, result }]);
            let error = backend.denoise(&frames[2], false).expect_err(call).to_string();
            assert!(error.contains(call) && faults.are_spent(), "{call} {after}: {error}");
            assert!(backend.denoise(&frames[0], false).expect(call).radiance == first, "{call} {after}: other bits afterwards");
        }
    }
    drop(backend);
    assert_eq!(*log.lock().expect("messages"), Vec::<String>::new());
}

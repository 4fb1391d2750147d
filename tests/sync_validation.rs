//! Synchronisation validation is only worth something if it is listening.

use super::support::{frame, scene::Scene};
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;
use std::sync::Arc;

pub const TESTS: &[DeviceTest] =
    &[("a_missing_barrier_is_reported", a_missing_barrier_is_reported), ("a_frame_is_clean", a_frame_is_clean)];

fn errors_with(omit: Option<&str>) -> Vec<String> {
    let scene = Scene::new([36, 18]);
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() }).expect("device"));
    let config = Config::new(scene.extent);
    let declaration = config.declare().expect("valid");
    let omit_barriers_before = omit.map(|name| declaration.passes().iter().position(|p| p.name == name).expect("a pass"));
    let mut s =
        Session::new(gpu.clone(), config.declare().expect("valid"), SessionOptions { omit_barriers_before, ..Default::default() })
            .expect("session");
    for i in 0..2 {
        frame(&mut s, &scene.frame(0, i), &scene.params(0), &Tuning::default());
    }
    drop(s);
    gpu.validation_errors()
}

fn a_missing_barrier_is_reported() {
    for pass in ["temporal_accumulation", "atrous_2", "modulate"] {
        let errors = errors_with(Some(pass));
        assert!(errors.iter().any(|e| e.starts_with("SYNC-HAZARD-READ-AFTER-WRITE")), "{pass}: {errors:?}");
        let named = |name: &str| errors.iter().any(|e| e.contains(name));
        assert!(named(&format!("atrous: {pass}, slot ")) && named(", copy 0"), "objects have names: {errors:?}");
    }
}

fn a_frame_is_clean() {
    assert_eq!(errors_with(None), [] as [String; 0]);
}

//! Noise that comes again from frame to frame: counted, and said once.

use super::support::{assert_valid, scene::Scene, session, upload, upload_to_engine, warnings};
use atrous::reference::Engine;
use atrous::{Config, Counter, Statistics, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_seed_that_stays_is_said_once", a_seed_that_stays_is_said_once),
    ("another_seed_in_each_frame_is_not_counted", another_seed_in_each_frame_is_not_counted),
    ("the_cpu_engine_counts_alike", the_cpu_engine_counts_alike),
];

const EXTENT: [u32; 2] = [66, 36];
/// Frames after which the executor has read eight frames in a row of eight frames of history, and more.
const FRAMES: u32 = 24;

/// Counters of the last frame, and warnings.
fn run(seed: impl Fn(u32) -> u32) -> (Statistics, Vec<String>) {
    let (scene, before) = (Scene::new(EXTENT), warnings().len());
    let mut s = session(&Config::new(EXTENT));
    for i in 0..FRAMES {
        upload(&mut s, &scene.frame(i, seed(i)));
        s.run(&scene.params(i), &Tuning::default()).expect("frame");
    }
    assert_valid();
    (s.statistics().expect("counters"), warnings()[before..].to_vec())
}

fn share(statistics: &Statistics) -> f64 {
    f64::from(statistics[Counter::RepeatedSample]) / f64::from(statistics[Counter::HistoryKept])
}

fn a_seed_that_stays_is_said_once() {
    let (statistics, said) = run(|_| 0);
    assert!(share(&statistics) > 0.5, "{statistics:?}");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("seed") && said[0].contains("Tuning::sample_frames"), "{}", said[0]);
}

fn another_seed_in_each_frame_is_not_counted() {
    let (statistics, said) = run(|i| i);
    assert!(share(&statistics) < 0.05, "{statistics:?}");
    assert_eq!(said, [] as [String; 0]);
}

fn the_cpu_engine_counts_alike() {
    let scene = Scene::new(EXTENT);
    let config = Config::new(EXTENT);
    let mut engine = Engine::new(config.declare().expect("valid")).expect("twins");
    let mut s = session(&config);
    for i in 0..12 {
        let guides = scene.frame(i, 0);
        upload(&mut s, &guides);
        upload_to_engine(&mut engine, &guides);
        s.run(&scene.params(i), &Tuning::default()).expect("frame");
        engine.run(&scene.params(i), &Tuning::default()).expect("frame");
    }
    assert_valid();
    let [counted, twin] = [s.statistics(), engine.statistics()].map(|statistics| statistics.expect("counters"));
    let [counted, twin] = [counted, twin].map(|statistics| statistics[Counter::RepeatedSample]);
    assert!(counted > 1000 && counted.abs_diff(twin) <= counted / 50, "{counted}, the twin {twin}");
}

//! Surfaces that lose their history: counted by reason, and said where nearly all do.

use super::support::{assert_valid, scene::Guides, scene::Scene, session, upload, upload_to_engine, warnings};
use atrous::config::{Conventions, MotionUnit, Preset};
use atrous::executor::Session;
use atrous::reference::Engine;
use atrous::{Config, Counter, FrameParams, ResetReason, Statistics, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("motion_in_pixels_declared_as_uv_is_said_once", motion_in_pixels_declared_as_uv_is_said_once),
    ("good_guides_keep_their_history_and_nothing_is_said", good_guides_keep_their_history_and_nothing_is_said),
    ("the_reason_is_that_of_the_mistake", the_reason_is_that_of_the_mistake),
    ("frames_with_a_reset_count_nothing", frames_with_a_reset_count_nothing),
    ("the_cpu_engine_counts_alike", the_cpu_engine_counts_alike),
];

const EXTENT: [u32; 2] = [66, 36];
/// Frames after which the executor has read eight frames in a row, and more.
const FRAMES: u32 = 24;

/// A camera that moves by some pixels a frame.
fn moving() -> Scene {
    Scene { speed: 0.3, ..Scene::new(EXTENT) }
}

fn in_pixels(mut guides: Guides) -> Guides {
    guides.motion.iter_mut().for_each(|m| *m = [m[0] * EXTENT[0] as f32, m[1] * EXTENT[1] as f32, m[2], m[3]]);
    guides
}

/// Runs the frames, and gives the counters of the last one.
fn run(s: &mut Session, frames: u32, guides: impl Fn(u32) -> Guides, params: impl Fn(u32) -> FrameParams) -> Statistics {
    for i in 0..frames {
        upload(s, &guides(i));
        s.run(&params(i), &Tuning::default()).expect("frame");
    }
    assert_valid();
    s.statistics().expect("counters")
}

fn lost_share(statistics: &Statistics) -> f64 {
    statistics.history_lost() as f64 / statistics.history_sought() as f64
}

fn motion_in_pixels_declared_as_uv_is_said_once() {
    let scene = moving();
    for preset in [Preset::Svgf, Preset::Percentile, Preset::Best] {
        let before = warnings().len();
        let mut s = session(&Config { preset, ..Config::new(EXTENT) });
        let statistics = run(&mut s, FRAMES, |i| in_pixels(scene.frame(i, i)), |i| scene.params(i));
        assert!(lost_share(&statistics) > 0.9, "{preset}: {statistics:?}");
        assert!(u64::from(statistics[Counter::LostOffScreen]) > statistics.history_lost() / 2, "{preset}: {statistics:?}");
        let said = &warnings()[before..];
        assert_eq!(said.len(), 1, "{preset}: {said:?}");
        assert!(
            said[0].contains("motion leads out of the picture") && said[0].contains("atrous_conventions::check"),
            "{}",
            said[0]
        );
        assert!(s.executor().statistics().is_some_and(|s| lost_share(&s) > 0.9));
    }
}

fn good_guides_keep_their_history_and_nothing_is_said() {
    let scene = moving();
    let before = warnings().len();
    let declared_in_pixels = Conventions { motion_unit: MotionUnit::Pixels, ..Conventions::default() };
    for conventions in [Conventions::default(), declared_in_pixels] {
        let convert = if conventions.motion_unit == MotionUnit::Pixels { in_pixels } else { std::convert::identity };
        let mut s = session(&Config { conventions, ..Config::new(EXTENT) });
        let statistics = run(&mut s, FRAMES, |i| convert(scene.frame(i, i)), |i| scene.params(i));
        assert!(lost_share(&statistics) < 0.2, "{statistics:?}");
        assert!(statistics.history_sought() > 66 * 18 && statistics.history_sought() <= 66 * 36, "{statistics:?}");
    }
    assert_eq!(warnings()[before..], [] as [String; 0]);
}

fn the_reason_is_that_of_the_mistake() {
    let scene = Scene::new(EXTENT);
    for reason in [Counter::LostDepth, Counter::LostNormal, Counter::LostSurfaceId] {
        let before = warnings().len();
        let mut s = session(&Config { surface_id: true, ..Config::new(EXTENT) });
        let spoiled = |i| {
            let mut guides = scene.frame(i, i);
            if i % 2 == 0 {
                spoil(reason, &mut guides);
            }
            guides
        };
        let statistics = run(&mut s, FRAMES, spoiled, |i| scene.params(i));
        assert!(f64::from(statistics[reason]) > 0.9 * statistics.history_sought() as f64, "{reason}: {statistics:?}");
        assert_eq!(warnings()[before..].len(), 1, "{reason}");
    }
}

/// A mistake of every other frame.
fn spoil(reason: Counter, guides: &mut Guides) {
    match reason {
        Counter::LostDepth => guides.depth.iter_mut().for_each(|d| d[0] *= 1.5),
        Counter::LostNormal => guides.normal.iter_mut().for_each(|n| *n = n.map(|x| -x)),
        _ => guides.surface_id.iter_mut().for_each(|id| *id += 1),
    }
}

fn frames_with_a_reset_count_nothing() {
    let scene = moving();
    let before = warnings().len();
    let mut s = session(&Config::new(EXTENT));
    // Every fourth frame is a cut, and between them nothing is found either.
    let params = |i| FrameParams { reset: (i % 4 == 3).then_some(ResetReason::CameraCut), ..scene.params(i) };
    let statistics = run(&mut s, FRAMES, |i| in_pixels(scene.frame(i, i)), params);
    assert_eq!(statistics, Statistics::default(), "the last frame is a cut");
    assert_eq!(warnings()[before..], [] as [String; 0]);
}

fn the_cpu_engine_counts_alike() {
    let scene = moving();
    for preset in [Preset::Svgf, Preset::Percentile] {
        let config = Config { preset, ..Config::new(EXTENT) };
        let mut engine = Engine::new(config.declare().expect("valid")).expect("twins");
        let mut s = session(&config);
        for convert in [std::convert::identity, in_pixels] {
            let counted = run(&mut s, 3, |i| convert(scene.frame(i, i)), |i| scene.params(i));
            for i in 0..3 {
                upload_to_engine(&mut engine, &convert(scene.frame(i, i)));
                engine.run(&scene.params(i), &Tuning::default()).expect("frame");
            }
            let twin = engine.statistics().expect("counters");
            for counter in Counter::ALL {
                assert!(counted[counter].abs_diff(twin[counter]) <= 4, "{preset}, {counter}: {counted:?}, the twin {twin:?}");
            }
        }
    }
}

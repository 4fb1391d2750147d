//! The end of a transient in memory, and reads after it.

use super::super::super::test_scene::*;
use super::*;
use crate::config::{PostProcess, Preset};
use glam::Vec3;

const EXTENT: [u32; 2] = [13, 9];

fn config() -> Config {
    let post_process = PostProcess::ToneMapTaa;
    Config { preset: Preset::Percentile, surface_id: false, debug_view: true, post_process, ..Config::new(EXTENT) }
}

/// A host with its inputs, whose engine frees transients.
fn frugal() -> Host {
    let mut host = Host { engine: Engine::new(config().declare().expect("valid")).expect("twins") };
    host.upload(EXTENT, &noise(EXTENT, 1));
    host
}

fn params(debug_view: Option<DebugView>) -> FrameParams {
    FrameParams { debug_view, ..camera(EXTENT, Vec3::ZERO) }
}

fn transients(engine: &Engine) -> Vec<(ResourceId, usize, usize)> {
    engine.declaration.transients().collect()
}

#[test]
fn a_transient_has_memory_from_its_first_pass_to_its_last() {
    for debug_view in [None, Some(DebugView::Lambda)] {
        let mut engine = frugal().engine;
        assert!(transients(&engine).len() > 5);
        for _ in 0..2 {
            let frame = engine.state.begin(engine.declaration.setup(), &params(debug_view), &svgf_tuning()).expect("usable");
            for pass in 0..engine.declaration.passes().len() {
                engine.step(&frame, pass).expect("runs");
                for (id, first, last) in transients(&engine) {
                    let (name, is_live) = (&engine.declaration.resource(id).name, (first..last).contains(&pass));
                    let stored = engine.stored[id.0 as usize].iter().flatten().count();
                    assert_eq!(stored, usize::from(is_live), "{name} after pass {pass} of {first} to {last}");
                }
            }
        }
    }
}

#[test]
fn what_was_freed_says_how_to_keep_it() {
    let (mut frugal, mut keeping) = (frugal(), Host::new(&config()));
    let noisy = noise(EXTENT, 1);
    assert_eq!(keeping.engine.download("guide"), Err(Error::NoFrame("guide".into())), "before the first frame");
    for host in [&mut frugal, &mut keeping] {
        host.frame(&params(None), &noisy);
    }
    for (id, ..) in transients(&frugal.engine) {
        let name = frugal.engine.declaration.resource(id).name.clone();
        let error = frugal.engine.download(&name).expect_err("freed");
        assert_eq!(error, Error::NotKept(name.clone()));
        assert!(error.to_string().contains(&name) && error.to_string().contains("Engine::keep_transients"), "{error}");
        keeping.engine.download(&name).expect("kept");
    }
    for name in ["denoised_radiance", "history_confidence", "display", "luminance_history", "irradiance_history"] {
        assert_eq!(frugal.engine.download(name), keeping.engine.download(name), "{name} is no transient");
    }
}

#[test]
fn keeping_transients_changes_no_result() {
    let (mut frugal, mut keeping) = (frugal(), Host::new(&config()));
    for i in 0..3 {
        let params = FrameParams { debug_view: Some(DebugView::Alpha), ..camera(EXTENT, Vec3::new(0.1 * i as f32, 0.0, 0.0)) };
        frugal.frame(&params, &noise(EXTENT, i));
        keeping.frame(&params, &noise(EXTENT, i));
        for name in ["denoised_radiance", "display", "debug_view"] {
            assert_eq!(frugal.image(name), keeping.image(name), "{name}, frame {i}");
        }
    }
}

#[test]
fn a_view_after_the_frame_needs_what_it_shows() {
    let mut keeping = Host::new(&config());
    keeping.frame(&params(None), &noise(EXTENT, 1));
    for drawn in [None, Some(DebugView::Depth)] {
        let mut frugal = frugal();
        frugal.frame(&params(drawn), &noise(EXTENT, 1));
        let error = frugal.engine.debug_view(DebugView::Percentiles).expect_err("freed");
        assert!(matches!(error, Error::NotKept(_)), "{error}");
    }
    for view in keeping.engine.declaration.debug_views() {
        let mut drawn = Host::new(&config());
        drawn.frame(&params(Some(view)), &noise(EXTENT, 1));
        let shown = keeping.engine.debug_view(view).expect("kept");
        assert_eq!(shown, drawn.engine.download("debug_view").expect("drawn in the frame"), "{view:?}");
    }
    let without = Config { debug_view: false, ..config() };
    let mut without = Host::new(&without);
    without.frame(&params(None), &noise(EXTENT, 1));
    assert!(matches!(without.engine.debug_view(DebugView::Depth), Err(Error::UnknownResource { .. })));
}

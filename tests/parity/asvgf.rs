//! Sequences of the presets with temporal gradients.

use super::run;
use crate::support::{assert_valid, gpu, random, scene::Scene, session_with, upload};
use atrous::config::{GradientSource, MotionUnit, Preset, Signals};
use atrous::executor::{Session, SessionOptions};
use atrous::reference::InstanceTransform;
use atrous::{Config, Declaration, FrameParams, ResetReason, Tuning};

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Asvgf, levels: Some(2), ..Config::new(extent) }
}

/// Frames with a camera that moves and a light that jumps; `inputs` uploads what else the configuration has.
pub(super) fn sequence(config: &Config, extent: [u32; 2], inputs: impl Fn(&mut Session, u32, &Scene)) {
    graph_sequence(config.declare().expect("valid"), config, extent, inputs);
}

/// [`sequence`] of a graph for what a configuration says of the host.
pub(super) fn graph_sequence(graph: Declaration, config: &Config, extent: [u32; 2], inputs: impl Fn(&mut Session, u32, &Scene)) {
    let options = SessionOptions { poison: true, keep_transients: true, ..Default::default() };
    let mut s = Session::new(gpu(), graph, options).expect("a session");
    for i in 0..6 {
        let light = if i % 3 == 2 { 0.3 } else { 1.0 };
        let scene = Scene { speed: 0.12, light, allocated: config.allocated_extent, ..Scene::new(extent) };
        upload(&mut s, &scene.frame(i, i));
        inputs(&mut s, i, &scene);
        let jitter = [0.3 - 0.1 * i as f32, 0.05 * i as f32];
        let reset = (i == 4).then_some(ResetReason::CameraCut);
        let exposure_ratio = if i == 3 { 1.5 } else { 1.0 };
        let params = FrameParams { jitter, reset, exposure_ratio, reshaded: i != 5, ..scene.params(i) };
        run(&mut s, &params, &Tuning::for_preset(config.preset));
    }
    assert_valid();
}

pub fn forward_projected() {
    for signals in Signals::ALL {
        sequence(&Config { signals, ..config([67, 35]) }, [67, 35], |_, _, _| {});
    }
    sequence(&Config { surface_id: false, object_normal: true, ..config([40, 23]) }, [37, 21], |_, _, _| {});
}

pub fn strata_of_every_size() {
    for stratum_size in [2, 3, 4] {
        for extent in [[36, 24], [33, 25], [5, 3]] {
            sequence(&Config { stratum_size, ..config(extent) }, extent, |_, _, _| {});
        }
    }
}

pub fn one_pixel() {
    for stratum_size in [2, 3, 4] {
        sequence(&Config { stratum_size, ..config([1, 1]) }, [1, 1], |_, _, _| {});
    }
}

/// Transforms of an instance that moves, of one that is singular, of one that is not finite, and too few of them; forward motion
/// with holes.
pub fn transforms_and_forward_motion() {
    let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let moved = [[0.96, -0.28, 0.0, 0.1], [0.28, 0.96, 0.0, -0.05], [0.0, 0.0, 1.0, 0.02]];
    let singular = [[1.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0, 0.0, 1.0, 0.0]];
    let bad = [[f32::NAN; 4]; 3];
    let tables: [&[InstanceTransform]; 4] =
        [&[identity, identity, moved], &[identity], &[identity, singular, moved], &[identity, bad, bad]];
    for table in tables {
        sequence(&config([40, 23]), [40, 23], |s, _, _| {
            s.upload_buffer("instance_transforms", bytemuck::cast_slice(table)).expect("transforms");
        });
    }
    for motion_unit in [MotionUnit::Uv, MotionUnit::Pixels, MotionUnit::Ndc] {
        let is_ndc = motion_unit == MotionUnit::Ndc;
        let motion_scale = if is_ndc { 0.7 } else { 1.0 };
        let conventions = atrous::config::Conventions { motion_unit, motion_scale, motion_y_up: is_ndc, ..Default::default() };
        sequence(&Config { conventions, forward_motion: true, ..config([40, 23]) }, [40, 23], |s, i, scene| {
            let depth = scene.frame(i, i).depth;
            let motion = depth.iter().enumerate().map(|(k, z)| match k % 7 {
                0 => [f32::NAN, 0.0, 1.0, 0.0],
                1 => [0.0, 0.0, 0.0, 0.0],
                2 => [0.0, 0.0, f32::INFINITY, 0.0],
                _ => [0.02 * random(k as u32, i, 7), -0.01, z[0], 0.0],
            });
            s.upload("forward_motion", &motion.collect::<Vec<_>>()).expect("forward_motion");
        });
    }
}

pub fn reshaded() {
    for signals in Signals::ALL {
        reshaded_sequence(&Config { signals, ..config([67, 35]) });
    }
}

pub(super) fn reshaded_sequence(config: &Config) {
    let config = Config { gradient_source: GradientSource::Reshaded, ..*config };
    let width = config.allocated_extent[0] as usize;
    sequence(&config, config.allocated_extent, |s, i, scene| {
        // A part of the picture moves by itself.
        let mut motion = scene.frame(i, i).motion;
        let part = (10..30).flat_map(|y| (10..50).map(move |x| y * width + x));
        part.for_each(|at| motion[at][0] += 3.0 / width as f32);
        s.upload("motion", &motion).expect("motion");
        let mut again = scene.frame(i.saturating_sub(1), i.saturating_sub(1)).noisy_radiance;
        again[40] = [f32::NAN; 4];
        match i {
            3 => s.unbind("reshaded_radiance").expect("unbind"),
            _ => s.upload("reshaded_radiance", &again).expect("reshaded_radiance"),
        }
    });
}

pub fn compared() {
    compared_sequence(&config([67, 35]));
}

/// With light that is compared with its history, and shaded again nowhere; it changes its colour alone, too.
pub(super) fn compared_sequence(config: &Config) {
    for signals in Signals::ALL {
        let config = Config { signals, gradient_source: GradientSource::ChangeTest, ..*config };
        sequence(&config, config.allocated_extent, |s, i, scene| {
            if matches!(signals, Signals::Together | Signals::Mixed) && i > 0 {
                let tint = [1.6, 0.87, 0.5, 1.0];
                let noisy = scene.frame(i, i).noisy_radiance.into_iter();
                let tinted: Vec<[f32; 4]> = noisy.map(|texel| [0, 1, 2, 3].map(|c| texel[c] * tint[c])).collect();
                s.upload("noisy_radiance", &tinted).expect("noisy_radiance");
            }
        });
    }
}

pub fn sparse_and_confidence() {
    sparse_and_confidence_sequence(&config([40, 23]));
}

/// Of 40×23 pixels.
pub(super) fn sparse_and_confidence_sequence(config: &Config) {
    let sparse = Config { gradient_source: GradientSource::Sparse, ..*config };
    sequence(&sparse, [40, 23], |s, i, _| {
        let texels: Vec<_> = (0..14 * 8).map(|k| [random(k, i, 0) - 0.5, random(k, i, 1), 0.0, 0.0]).collect();
        s.upload("sparse_gradient", &texels).expect("sparse_gradient");
    });
    let confidence = Config { gradient_source: GradientSource::Confidence, reactive_mask: true, ..*config };
    sequence(&confidence, [40, 23], |s, i, _| {
        let texels: Vec<_> = (0..40 * 23).map(|k| [if k % 5 == 0 { f32::NAN } else { 1.5 * random(k, i, 0) - 0.2 }; 4]).collect();
        s.upload("confidence", &texels).expect("confidence");
    });
}

pub fn stabilize() {
    let sources =
        [(GradientSource::ForwardProjected, false), (GradientSource::Confidence, true), (GradientSource::ChangeTest, false)];
    for (gradient_source, firefly_filter) in sources {
        let config = Config { preset: Preset::Stabilize, gradient_source, firefly_filter, ..config([40, 23]) };
        sequence(&config, [40, 23], |s, i, scene| {
            if gradient_source == GradientSource::Confidence {
                let confidence: Vec<_> = (0..40 * 23).map(|k| [random(k, i, 3); 4]).collect();
                s.upload("confidence", &confidence).expect("confidence");
            }
            s.upload("other_denoised_radiance", &scene.frame(i, i + 100).noisy_radiance).expect("other_denoised_radiance");
        });
    }
}

/// The render extent grows and shrinks: strata of the previous frame are others than those of this one.
pub fn other_resolutions() {
    let config = config([66, 48]);
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for (i, extent) in (0..).zip([[66, 48], [40, 31], [66, 48], [33, 20], [33, 20]]) {
        let scene = Scene { allocated: [66, 48], ..Scene::new(extent) };
        upload(&mut s, &scene.frame(i, i));
        run(&mut s, &FrameParams { reshaded: true, ..scene.params(i) }, &Tuning::for_preset(config.preset));
    }
    assert_valid();
}

/// History times this ratio passes what a half float holds, and the ratio itself the largest float with the light's.
pub fn exposure_beyond_half_floats() {
    for preset in [Preset::Asvgf, Preset::Best] {
        let config = Config { preset, ..config([40, 23]) };
        let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        let scene = Scene::new([40, 23]);
        for (i, exposure_ratio) in (0..).zip([1.0, 1.0, 3e5, 1e-6, 3e38, 1.0]) {
            upload(&mut s, &scene.frame(i, i));
            run(&mut s, &FrameParams { exposure_ratio, reshaded: true, ..scene.params(i) }, &Tuning::for_preset(preset));
        }
    }
    assert_valid();
}

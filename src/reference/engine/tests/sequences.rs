//! Several frames: noise falls, resets, allocations, motion.

use super::super::super::test_scene::*;
use super::super::super::{round_to_half, Reason};
use super::*;
use crate::config::{PostProcess, Preset};
use crate::ResetReason;
use glam::Vec3;

const EXTENT: [u32; 2] = [32, 18];

fn host(allocated: [u32; 2]) -> Host {
    Host::new(&Config { preset: Preset::Svgf, post_process: PostProcess::ToneMapTaa, surface_id: false, ..Config::new(allocated) })
}

/// Overwrites both copies of every history with what is not finite; but the guide, for a pixel without a surface would have no history.
fn poison(engine: &mut Engine) {
    let Engine { declaration, stored, .. } = engine;
    for (resource, copies) in
        declaration.resources().iter().zip(stored).filter(|(r, _)| r.lifetime.is_history() && r.name != "guide")
    {
        let mut poisoned = 0;
        for texels in copies.iter_mut().flatten() {
            poisoned += 1;
            *texels = match texels {
                Texels::Colour(image) => Texels::Colour(image.map(|_| [f32::NAN; 4])),
                Texels::Scalar(image) => Texels::Scalar(image.map(|_| f32::NAN)),
                Texels::Packed(image) => Texels::Packed(image.map(|_| [0x7e00; 4])),
                Texels::Uint(image) => Texels::Uint(image.map(|_| u32::MAX)),
                Texels::Wide(image) => Texels::Wide(image.map(|_| [u32::MAX; 4])),
                Texels::Bytes(bytes) => Texels::Bytes(vec![0xff; bytes.len()]),
            };
        }
        assert_eq!(poisoned, resource.lifetime.copies(), "{}", resource.name);
    }
}

fn deviation(image: &Image<[f32; 4]>, mean: f32) -> f32 {
    let squares: f32 = image.texels().iter().map(|t| (t[0] - mean) * (t[0] - mean)).sum();
    (squares / image.texels().len() as f32).sqrt()
}

#[test]
fn noise_falls_and_the_mean_stays() {
    let mut host = host(EXTENT);
    for i in 0..12 {
        host.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, i));
        assert!(host.luminance_history().texels().iter().all(|m| m.history_length == (i + 1) as f32));
    }
    let (before, after) = (deviation(&noise(EXTENT, 0), 0.5), deviation(&host.image("denoised_radiance"), 0.5));
    assert!(before > 0.25 && after < 0.05, "{before} to {after}");
}

#[test]
fn a_constant_image_is_a_fixed_point_of_everything() {
    let mut host = host(EXTENT);
    let constant = Image::new(EXTENT, [0.3, 7.0, 90.0, 1.0].map(round_to_half));
    for i in 0..6 {
        let params = FrameParams { jitter: [0.25, -0.25], ..camera(EXTENT, Vec3::new(0.1 * i as f32, 0.0, 0.0)) };
        host.frame(&params, &constant);
        for (a, b) in host.image("denoised_radiance").texels().iter().zip(constant.texels()) {
            assert!((0..3).all(|k| (a[k] - b[k]).abs() <= b[k] * 1e-3), "frame {i}: {a:?} for {b:?}");
        }
    }
}

#[test]
fn a_reset_frame_is_a_first_frame() {
    let (mut used, mut fresh) = (host(EXTENT), host(EXTENT));
    for i in 0..3 {
        used.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, i));
    }
    let params = FrameParams { reset: Some(ResetReason::CameraCut), ..camera(EXTENT, Vec3::ONE) };
    poison(&mut used.engine);
    assert_eq!(used.frame(&params, &noise(EXTENT, 9)).reset, Some(ResetReason::CameraCut));
    fresh.frame(&FrameParams { reset: None, ..params }, &noise(EXTENT, 9));
    assert!(used.everything().len() > 10);
    assert_eq!(used.everything(), fresh.everything());
}

#[test]
fn history_that_is_lost_is_not_read() {
    let (mut used, mut fresh) = (host(EXTENT), host(EXTENT));
    used.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 0));
    poison(&mut used.engine);
    used.engine.invalidate();
    let params = camera(EXTENT, Vec3::ONE);
    assert_eq!(used.frame(&params, &noise(EXTENT, 9)).reset, Some(ResetReason::Created));
    fresh.frame(&params, &noise(EXTENT, 9));
    assert_eq!(used.everything(), fresh.everything());
}

#[test]
fn an_allocation_may_be_larger_and_the_render_extent_may_change() {
    let (mut tight, mut loose) = (host(EXTENT), host([45, 31]));
    for (i, extent) in [EXTENT, EXTENT, [20, 12], [20, 12], [31, 18], EXTENT].into_iter().enumerate() {
        let params = camera(extent, Vec3::new(0.05 * i as f32, 0.0, 0.0));
        let noisy = noise(extent, i as u32);
        tight.frame(&params, &noisy);
        loose.frame(&params, &noisy);
        for name in ["denoised_radiance", "display"] {
            let (a, b) = (crop(&tight.image(name), extent), crop(&loose.image(name), extent));
            assert!(all_finite(&a) && a == b, "{name}, frame {i}");
        }
        let (a, b) = (crop(&tight.luminance_history(), extent), crop(&loose.luminance_history(), extent));
        assert_eq!(a, b);
        assert!(i == 0 || a.texels().iter().any(|m| m.history_length > 1.5), "history survives the change");
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_the_frame() {
    let (mut early, mut late) = (host(EXTENT), host(EXTENT));
    late.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 99));
    for i in 0..4 {
        let reset = (i == 0).then_some(ResetReason::SceneLoad);
        let params = FrameParams { reset, ..camera(EXTENT, Vec3::new(0.0, 0.02 * i as f32, 0.0)) };
        early.frame(&params, &noise(EXTENT, i));
        late.frame(&params, &noise(EXTENT, i));
        assert_eq!(early.everything(), late.everything(), "frame {i}");
    }
}

#[test]
fn what_comes_into_view_has_no_history() {
    let mut host = host(EXTENT);
    host.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 0));
    // A shift by 8 of the 32 columns: 90 degrees over 18 pixels at depth 4 are 2.25 pixels a unit.
    host.frame(&camera(EXTENT, Vec3::new(8.0 / 2.25, 0.0, 0.0)), &noise(EXTENT, 1));
    let luminance_history = host.luminance_history();
    for x in 0..32 {
        let m = luminance_history.get(x, 9).expect("inside");
        if x < 23 {
            assert_eq!((m.history_length, m.reason), (2.0, Reason::None as u16), "{x}");
        } else if x > 24 {
            assert_eq!((m.history_length, m.reason), (1.0, Reason::OffScreen as u16), "{x}");
        }
    }
}

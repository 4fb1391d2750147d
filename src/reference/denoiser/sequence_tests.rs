//! Several frames: noise falls, resets, allocations, motion.

use super::super::test_scene::*;
use super::tests::{history_length, reasons};
use super::*;
use crate::{FrameParams, FrameState, ResetReason, Tuning};
use glam::Vec3;

const EXTENT: [u32; 2] = [32, 18];

fn config(allocated: [u32; 2]) -> Config {
    Config { post_process: PostProcess::ToneMapTaa, surface_id: false, ..Config::new(allocated) }
}

/// Denoises noisy frames of a plane in an allocation; outside the render extent there is poison.
struct Sequence {
    config: Config,
    state: FrameState,
    denoiser: Denoiser,
}

impl Sequence {
    fn new(allocated: [u32; 2]) -> Self {
        let config = config(allocated);
        Self { config, state: FrameState::default(), denoiser: Denoiser::new(config).expect("usable") }
    }

    fn frame(&mut self, params: &FrameParams, noisy: &Image<[f32; 4]>) -> DenoiserOutputs {
        let allocated = self.config.allocated_extent;
        let context = self.state.begin(&self.config, params, &Tuning::default()).expect("usable");
        let fill = |texel: [f32; 4]| embed(&Image::new(params.render_extent, texel), allocated, [f32::NAN; 4]);
        let (depth, normal, noisy) = (fill([4.0; 4]), fill([0.0, 0.0, 1.0, 0.0]), embed(noisy, allocated, [f32::NAN; 4]));
        let guides = ImportInputs::new(&depth, &normal);
        self.denoiser.frame(&context, &DenoiserInputs::new(guides, &[&noisy]), true).expect("usable")
    }
}

fn deviation(image: &Image<[f32; 4]>, mean: f32) -> f32 {
    let squares: f32 = image.texels().iter().map(|t| (t[0] - mean) * (t[0] - mean)).sum();
    (squares / image.texels().len() as f32).sqrt()
}

#[test]
fn noise_falls_and_the_mean_stays() {
    let mut sequence = Sequence::new(EXTENT);
    let mut output = None;
    for i in 0..12 {
        let denoised = sequence.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, i));
        assert!(history_length(denoised.views.as_ref().expect("asked for")).texels().iter().all(|n| *n == (i + 1) as f32));
        output = Some(denoised.denoised_radiance);
    }
    let output = output.expect("twelve frames");
    let (before, after) = (deviation(&noise(EXTENT, 0), 0.5), deviation(&output, 0.5));
    assert!(before > 0.25 && after < 0.05, "{before} to {after}");
}

#[test]
fn a_constant_image_is_a_fixed_point_of_everything() {
    let mut sequence = Sequence::new(EXTENT);
    let constant = Image::new(EXTENT, [0.3, 7.0, 90.0, 1.0].map(round_to_half));
    for i in 0..6 {
        let params = FrameParams { jitter: [0.25, -0.25], ..camera(EXTENT, Vec3::new(0.1 * i as f32, 0.0, 0.0)) };
        let output = sequence.frame(&params, &constant).denoised_radiance;
        for (a, b) in output.texels().iter().zip(constant.texels()) {
            assert!((0..3).all(|k| (a[k] - b[k]).abs() <= b[k] * 1e-3), "frame {i}: {a:?} for {b:?}");
        }
    }
}

#[test]
fn a_reset_frame_is_a_first_frame() {
    let mut sequence = Sequence::new(EXTENT);
    for i in 0..3 {
        sequence.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, i));
    }
    let params = FrameParams { reset: Some(ResetReason::CameraCut), ..camera(EXTENT, Vec3::ONE) };
    // Poisoned history: it must not even be read.
    let history = sequence.denoiser.history.as_mut().expect("three frames");
    history.guide = Image::new(EXTENT, [0xffff; 4]);
    history.irradiance[0] = Image::new(EXTENT, [f32::NAN; 4]);
    history.moments[0] = Image::new(EXTENT, [0x7e00; 4]);
    history.display = Some(Image::new(EXTENT, [f32::NAN; 4]));
    let reset = sequence.frame(&params, &noise(EXTENT, 9));
    let first = Sequence::new(EXTENT).frame(&FrameParams { reset: None, ..params }, &noise(EXTENT, 9));
    assert_eq!(reset, first);
}

#[test]
fn an_allocation_may_be_larger_and_the_render_extent_may_change() {
    let (mut tight, mut loose) = (Sequence::new(EXTENT), Sequence::new([45, 31]));
    for (i, extent) in [EXTENT, EXTENT, [20, 12], [20, 12], [31, 18], EXTENT].into_iter().enumerate() {
        let params = camera(extent, Vec3::new(0.05 * i as f32, 0.0, 0.0));
        let (a, b) = (tight.frame(&params, &noise(extent, i as u32)), loose.frame(&params, &noise(extent, i as u32)));
        assert!(all_finite(&a.denoised_radiance));
        assert_eq!(crop(&b.denoised_radiance, extent), crop(&a.denoised_radiance, extent));
        assert_eq!(b.display.map(|d| crop(&d, extent)), a.display.map(|d| crop(&d, extent)));
        let (a, b) = (a.views.expect("asked for"), b.views.expect("asked for"));
        assert_eq!(crop(&b.moments[0], extent), crop(&a.moments[0], extent));
        assert!(i == 0 || crop(&history_length(&a), extent).texels().iter().any(|n| *n > 1.5), "history survives the change");
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_the_frame() {
    let (mut early, mut late) = (Sequence::new(EXTENT), Sequence::new(EXTENT));
    late.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 99));
    for i in 0..4 {
        let reset = (i == 0).then_some(ResetReason::SceneLoad);
        let params = FrameParams { reset, ..camera(EXTENT, Vec3::new(0.0, 0.02 * i as f32, 0.0)) };
        assert_eq!(early.frame(&params, &noise(EXTENT, i)), late.frame(&params, &noise(EXTENT, i)));
    }
}

#[test]
fn what_comes_into_view_has_no_history() {
    let mut sequence = Sequence::new(EXTENT);
    sequence.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 0));
    // A shift by 8 of the 32 columns: 90 degrees over 18 pixels at depth 4 are 2.25 pixels a unit.
    let output = sequence.frame(&camera(EXTENT, Vec3::new(8.0 / 2.25, 0.0, 0.0)), &noise(EXTENT, 1));
    let views = output.views.expect("asked for");
    let (lengths, reasons) = (history_length(&views), reasons(&views));
    for x in 0..32 {
        let (length, reason) = (lengths.get(x, 9), reasons.get(x, 9));
        if x < 23 {
            assert_eq!((length, reason), (Some(&2.0), Some(&0)), "{x}");
        } else if x > 24 {
            assert_eq!((length, reason), (Some(&1.0), Some(&(Reason::OffScreen as u16))), "{x}");
        }
    }
}

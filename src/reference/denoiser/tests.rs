//! One frame: inputs, bad values, sky, errors.

use super::super::test_scene::*;
use super::*;
use crate::{FrameParams, FrameState, Tuning};

const EXTENT: [u32; 2] = [13, 9];

/// A host's images of a plane at depth 4 that faces the camera, with noisy grey radiance.
struct Host {
    depth: Image<[f32; 4]>,
    normal: Image<[f32; 4]>,
    noisy: Image<[f32; 4]>,
    albedo: Image<[f32; 4]>,
}

impl Host {
    fn new(extent: [u32; 2], seed: u32) -> Self {
        Self {
            depth: Image::new(extent, [4.0, 0.0, 0.0, 0.0]),
            normal: Image::new(extent, [0.0, 0.0, 1.0, 0.0]),
            noisy: noise(extent, seed),
            albedo: Image::new(extent, [0.5, 0.25, 0.125, 0.0]),
        }
    }

    fn guides(&self) -> ImportInputs<'_> {
        ImportInputs::new(&self.depth, &self.normal)
    }
}

/// Frames accumulated, of the first signal.
pub(super) fn history_length(views: &DenoiserViews) -> Image<f32> {
    views.moments[0].map(|m| unpack_moments(*m).history_length)
}

/// A [`Reason`] as a number, of the first signal.
pub(super) fn reasons(views: &DenoiserViews) -> Image<u16> {
    views.moments[0].map(|m| unpack_moments(*m).reason)
}

fn first_frame(config: &Config, inputs: &DenoiserInputs) -> DenoiserOutputs {
    let params = camera(config.allocated_extent, glam::Vec3::ZERO);
    let context = FrameState::default().begin(config, &params, &Tuning::default()).expect("usable");
    Denoiser::new(*config).expect("usable").frame(&context, inputs, true).expect("usable")
}

#[test]
fn the_sky_passes_untouched() {
    let mut host = Host::new(EXTENT, 1);
    host.depth = paint(EXTENT, |x, _| [if x < 6 { f32::INFINITY } else { 4.0 }; 4]);
    let noisy = round_image_to_half(&host.noisy);
    let noisy = [&noisy];
    let inputs = DenoiserInputs { albedo: Some(&host.albedo), ..DenoiserInputs::new(host.guides(), &noisy) };
    let output = first_frame(&Config::new(EXTENT), &inputs).denoised_radiance;
    let mut changed = 0;
    for y in 0..9 {
        for x in 0..13 {
            let (a, b) = (noisy[0].get(x, y).expect("inside"), output.get(x, y).expect("inside"));
            if x < 6 {
                assert_eq!(a[..3], b[..3]);
            } else {
                changed += usize::from(a[..3] != b[..3]);
            }
        }
    }
    assert!(changed > 50, "the surface is filtered");
}

#[test]
fn no_bad_value_of_any_input_reaches_an_output() {
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, 0.0, -1.0, 0.5, 4.0];
    let extent = [24, 16];
    let bad = |k: u32| paint(extent, move |x, y| [1, 3, 5, 7].map(|i| values[(x as u32 * k + y as u32 * i) as usize % 8]));
    let images: Vec<_> = (1..9).map(bad).collect();
    let ids = paint(extent, |x, _| x as u32 % 3);
    let guides = ImportInputs {
        depth: &images[0],
        normal: &images[1],
        motion: Some(&images[2]),
        surface_id: Some(&ids),
        roughness: Some(&images[3]),
        object_normal: None,
        instance_transforms: Some(&[[[f32::NAN; 4]; 3]; 2]),
    };
    let noisy = [&images[4], &images[5]];
    let inputs = DenoiserInputs {
        guides,
        noisy: &noisy,
        albedo: Some(&images[6]),
        emission: Some(&images[7]),
        gradients: GradientSources::default(),
        volume: None,
    };
    let config = Config { signals: Signals::Apart, post_process: PostProcess::ToneMapTaa, ..Config::new(extent) };
    let (mut state, mut denoiser) = (FrameState::default(), Denoiser::new(config).expect("usable"));
    for i in 0..3 {
        let params = FrameParams { exposure_ratio: 1e30, ..camera(extent, glam::Vec3::splat(i as f32)) };
        let context = state.begin(&config, &params, &Tuning::default()).expect("usable");
        let output = denoiser.frame(&context, &inputs, true).expect("usable");
        assert!(all_finite(&output.denoised_radiance) && all_finite(output.display.as_ref().expect("asked for")));
        let views = output.views.expect("asked for");
        assert!(views.levels.iter().flatten().chain(&views.accumulated).chain(&views.demodulated).all(all_finite));
        assert!(views.moments.iter().flat_map(|m| m.texels()).all(|m| {
            let m = unpack_moments(*m);
            [m.mean, m.deviation, m.history_length].iter().all(|x| x.is_finite() && *x >= 0.0)
        }));
        assert!(output.statistics[..6].iter().all(|n| *n > 0), "{:?}", output.statistics);
        assert_eq!(output.statistics[6..], [0, 0]);
    }
}

#[test]
fn a_wrong_image_is_named() {
    let (host, small) = (Host::new(EXTENT, 1), Image::new([4, 4], [1.0; 4]));
    let config = Config::new(EXTENT);
    let context = FrameState::default().begin(&config, &FrameParams::new(EXTENT), &Tuning::default()).expect("usable");
    let mut denoiser = Denoiser::new(config).expect("usable");
    let noisy = [&host.noisy];
    let good = DenoiserInputs::new(host.guides(), &noisy);
    let mut message = |inputs: &DenoiserInputs| denoiser.frame(&context, inputs, false).expect_err("wrong").to_string();
    assert!(message(&DenoiserInputs { albedo: Some(&small), ..good }).contains("albedo"));
    assert!(message(&DenoiserInputs { noisy: &[&small], ..good }).contains("noisy"));
    assert!(message(&DenoiserInputs { noisy: &[&host.noisy, &host.noisy], ..good }).contains("2 images"));
    let depth = ImportInputs { depth: &small, ..host.guides() };
    assert!(message(&DenoiserInputs { guides: depth, ..good }).contains("depth"));
    let larger = FrameState::default().begin(&Config::new([99, 99]), &FrameParams::new([99, 99]), &Tuning::default());
    assert!(denoiser.frame(&larger.expect("usable"), &good, false).is_err());
    assert!(Denoiser::new(Config::new([0, 1])).is_err());
}

#[test]
fn views_and_post_process_come_when_asked_for() {
    let host = Host::new(EXTENT, 1);
    let noisy = [&host.noisy];
    let inputs = DenoiserInputs { albedo: Some(&host.albedo), ..DenoiserInputs::new(host.guides(), &noisy) };
    let config = Config { levels: 3, ..Config::new(EXTENT) };
    let output = first_frame(&config, &inputs);
    let views = output.views.expect("asked for");
    assert_eq!(views.levels.len(), 3);
    assert!(history_length(&views).texels().iter().all(|n| *n == 1.0));
    assert!(reasons(&views).texels().iter().all(|r| *r == Reason::Reset as u16));
    assert!(views.standard_deviation[0].texels().iter().all(|d| *d > 0.0));
    assert!(output.display.is_none());
    let mapped = first_frame(&Config { post_process: PostProcess::ToneMap, ..config }, &inputs);
    let context = frame_with(&config, &FrameParams::new(EXTENT), &FrameParams::new(EXTENT));
    assert_eq!(mapped.display, Some(tone_map(&context, &Tuning::default(), &[&mapped.denoised_radiance])));
}

#[test]
fn one_pixel_is_an_image() {
    let host = Host::new([1, 1], 1);
    let noisy = [&host.noisy];
    let inputs = DenoiserInputs::new(host.guides(), &noisy);
    let config = Config { post_process: PostProcess::ToneMapTaa, ..Config::new([1, 1]) };
    let output = first_frame(&config, &inputs);
    assert_eq!(output.denoised_radiance.texels()[0][0], round_to_half(host.noisy.texels()[0][0]));
}

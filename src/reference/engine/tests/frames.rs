//! One frame: bad values, sky, what is between the stages.

use super::super::super::test_scene::*;
use super::super::super::{round_image_to_half, round_to_half, Reason};
use super::*;
use crate::config::{PostProcess, Preset, Signals};
use crate::nodes::tone_map::twin::tone_map;
use crate::Counter;
use glam::Vec3;

const EXTENT: [u32; 2] = [13, 9];

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Svgf, surface_id: false, ..Config::new(extent) }
}

#[test]
fn the_sky_passes_untouched() {
    let mut host = Host::new(&config(EXTENT));
    let noisy = round_image_to_half(&noise(EXTENT, 1));
    host.upload(EXTENT, &noisy);
    let depth = paint(EXTENT, |x, _| [if x < 6 { f32::INFINITY } else { 4.0 }; 4]);
    host.engine.upload("depth", depth.texels()).expect("depth");
    host.engine.upload("albedo", &[[0.5, 0.25, 0.125, 0.0]; 13 * 9]).expect("albedo");
    host.engine.run(&camera(EXTENT, Vec3::ZERO), &svgf_tuning()).expect("frame");
    let output = host.image("denoised_radiance");
    let mut changed = 0;
    for y in 0..9 {
        for x in 0..13 {
            let (a, b) = (noisy.get(x, y).expect("inside"), output.get(x, y).expect("inside"));
            if x < 6 {
                assert_eq!(a[..3], b[..3]);
            } else {
                changed += usize::from(a[..3] != b[..3]);
            }
        }
    }
    assert!(changed > 50, "the surface is filtered");
}

/// Values that no stage may let through: they stand in every component of every input.
fn bad_inputs(engine: &mut Engine, extent: [u32; 2]) {
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, 0.0, -1.0, 0.5, 4.0];
    let bad = |k: u32| paint(extent, move |x, y| [1, 3, 5, 7].map(|i| values[(x as u32 * k + y as u32 * i) as usize % 8]));
    let names = ["depth", "normal", "motion", "roughness", "noisy_direct", "noisy_indirect", "albedo", "emission"];
    for (k, name) in (1..).zip(names) {
        engine.upload(name, bad(k).texels()).expect(name);
    }
    engine.upload_ids("surface_id", paint(extent, |x, _| x as u32 % 3).texels()).expect("surface_id");
    let transforms = [[[f32::NAN; 4]; 3]; 2];
    engine.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("instance_transforms");
}

/// Asserts that everything that a pass wrote is finite, and that moments are not negative.
fn assert_good(engine: &Engine, frame: &FrameContext, pass: usize) {
    let declaration = &engine.declaration;
    for u in declaration.passes()[pass].uses.iter().filter(|u| u.access.writes()) {
        let what = format!("{} after {}", declaration.resource(u.resource).name, declaration.passes()[pass].name);
        match engine.stored[u.resource.0 as usize][declaration.copy(u, frame)].as_ref().expect(&what) {
            Texels::Colour(image) => assert!(all_finite(image), "{what}"),
            Texels::Uint(image) if what.starts_with("luminance_history") => assert!(
                image
                    .texels()
                    .iter()
                    .map(|m| unpack_luminance_history(*m))
                    .all(|m| { [m.mean, m.deviation, m.history_length].iter().all(|x| x.is_finite() && *x >= 0.0) }),
                "{what}"
            ),
            _ => {}
        }
    }
}

#[test]
fn no_bad_value_of_any_input_reaches_an_output() {
    let extent = [24, 16];
    let config =
        Config { preset: Preset::Svgf, signals: Signals::Apart, post_process: PostProcess::ToneMapTaa, ..Config::new(extent) };
    let mut host = Host::new(&config);
    bad_inputs(&mut host.engine, extent);
    for i in 0..3 {
        let params = FrameParams { exposure_ratio: 1e30, ..camera(extent, Vec3::splat(i as f32)) };
        // Pass by pass: what one works on in place, the next one overwrites.
        host.frame_by_pass(&params, assert_good);
        let engine = &host.engine;
        for name in ["denoised_radiance", "display"] {
            assert!(engine.download(name).expect(name).iter().flatten().all(|x| x.is_finite()), "{name}");
        }
        let counts = engine.statistics().expect("counters");
        assert!(Counter::ALL[..=Counter::Emission as usize].iter().all(|of| counts[*of] > 0), "{counts:?}");
        assert!(counts[Counter::Roughness] > 0, "{counts:?}");
        let [motion, scattering] = [Counter::ForwardMotion, Counter::ScatteringDepth].map(|of| counts[of]);
        assert_eq!((motion, scattering, counts[Counter::HitDistance]), (0, 0, 0));
    }
}

#[test]
fn what_is_between_the_stages_and_behind_them_can_be_read() {
    let config = Config { levels: Some(3), ..config(EXTENT) };
    let mut host = Host::new(&config);
    host.upload(EXTENT, &noise(EXTENT, 1));
    let mut levels = Vec::new();
    let mut deviations = None;
    host.frame_by_pass(&camera(EXTENT, Vec3::ZERO), |engine, frame, pass| {
        if engine.declaration.passes()[pass].name == "variance" {
            let estimate = engine.declaration.passes()[pass].use_of("estimate_0").expect("written").resource;
            let Some(Texels::Colour(image)) = &engine.stored[estimate.0 as usize][0] else { panic!("an image of colours") };
            deviations = Some(image.clone());
        }
        let written = engine.declaration.passes()[pass].use_of("output_0").filter(|u| u.access.writes());
        let Some(level) = written.map(|u| &engine.stored[u.resource.0 as usize][engine.declaration.copy(u, frame)]) else { return };
        let Some(Texels::Colour(image)) = level else { panic!("a level is an image of colours") };
        assert!(image.texels().iter().all(|t| t[0] > 0.0 && t[3] > 0.0), "level {}", levels.len());
        levels.push(image.clone());
    });
    assert!(levels.len() == 3 && levels[0] != levels[1] && levels[1] != levels[2]);
    assert_eq!(host.image("irradiance_history"), levels[0]);
    let luminance_history = host.luminance_history();
    assert!(luminance_history.texels().iter().all(|m| m.history_length == 1.0 && m.reason == Reason::Reset as u16));
    assert!(deviations.expect("a pass").texels().iter().all(|t| t[3] > 0.0), "the standard deviation");
    assert!(host.engine.download("display").expect_err("not asked for").to_string().contains("denoised_radiance"));
    let mut mapped = Host::new(&Config { post_process: PostProcess::ToneMap, ..config });
    mapped.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, 1));
    assert_eq!(mapped.image("display"), tone_map(EXTENT, &svgf_tuning(), &[&mapped.image("denoised_radiance")]));
    assert_eq!(mapped.image("denoised_radiance"), host.image("denoised_radiance"));
}

#[test]
fn one_pixel_is_an_image() {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..config([1, 1]) };
    let mut host = Host::new(&config);
    let noisy = noise([1, 1], 1);
    host.frame(&camera([1, 1], Vec3::ZERO), &noisy);
    assert_eq!(host.image("denoised_radiance").texels()[0][0], round_to_half(noisy.texels()[0][0]));
}

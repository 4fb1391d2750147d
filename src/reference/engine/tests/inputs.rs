//! Input that is wrong, or missing: an error that names it, and a history that is as before.

use super::super::super::test_scene::*;
use super::*;
use crate::config::{GradientSource, Preset, Signals};
use glam::Vec3;

const EXTENT: [u32; 2] = [13, 9];
const PIXELS: usize = 13 * 9;

fn assert_names(error: Error, wanted: &[&str]) {
    let message = error.to_string();
    for part in wanted {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

fn host() -> Host {
    Host::new(&Config::new(EXTENT))
}

#[test]
fn an_image_of_a_wrong_size_is_named() {
    let mut engine = host().engine;
    for name in ["depth", "normal", "motion", "roughness", "albedo", "emission", "noisy_radiance"] {
        let error = engine.upload(name, &[[1.0; 4]; 16]).expect_err("too few");
        assert_names(error, &[name, "16 texels", "117 texels (13x9)"]);
        assert!(engine.upload(name, &[[1.0; 4]; PIXELS + 1]).is_err(), "{name}: too many");
    }
    assert_names(engine.upload_ids("surface_id", &[1; PIXELS - 1]).expect_err("too few"), &["surface_id", "116 texels"]);
    assert!(matches!(Config::new([0, 1]).declare(), Err(Error::Extent { .. })));
}

#[test]
fn gradients_have_a_texel_a_stratum() {
    let config = Config { preset: Preset::Asvgf, gradient_source: GradientSource::Sparse, ..Config::new(EXTENT) };
    let mut engine = Host::new(&config).engine;
    assert_names(engine.upload("sparse_gradient", &[[0.0; 4]; PIXELS]).expect_err("a texel a pixel"), &["15 texels (5x3)"]);
    engine.upload("sparse_gradient", &[[0.0; 4]; 15]).expect("a texel a stratum");
}

#[test]
fn an_unknown_name_lists_the_known_ones() {
    let mut engine = host().engine;
    assert_names(engine.upload("dept", &[]).expect_err("misspelt"), &["`dept`", "depth, normal"]);
    assert_names(engine.upload("noisy_direct", &[]).expect_err("one signal"), &["`noisy_direct`", "noisy_radiance"]);
    assert!(matches!(engine.upload_ids("ids", &[]), Err(Error::UnknownResource { .. })));
    assert!(matches!(engine.upload_buffer("transforms", &[]), Err(Error::UnknownResource { .. })));
    assert!(matches!(engine.unbind("nothing"), Err(Error::UnknownResource { .. })));
    assert!(matches!(engine.download("nothing"), Err(Error::UnknownResource { .. })));
    assert!(matches!(engine.debug_view(DebugView::Depth), Err(Error::NoFrame(_))), "before the first frame");
}

#[test]
fn an_image_of_another_kind_is_named() {
    let mut engine = host().engine;
    assert_names(engine.upload_ids("depth", &[1; PIXELS]).expect_err("ids"), &["`depth`", "R32_UINT", "floating-point"]);
    assert_names(engine.upload("surface_id", &[[1.0; 4]; PIXELS]).expect_err("floats"), &["`surface_id`", "unsigned integer"]);
    for name in ["instance_transforms", "denoised_radiance", "luminance_history", "guide"] {
        assert!(
            matches!(engine.upload(name, &[[1.0; 4]; PIXELS]), Err(Error::WrongKind { resource, .. }) if resource == name),
            "{name}"
        );
        assert!(
            matches!(engine.upload_ids(name, &[1; PIXELS]), Err(Error::WrongKind { resource, .. }) if resource == name),
            "{name}"
        );
    }
    for name in ["depth", "statistics", "frame_constants"] {
        assert!(
            matches!(engine.upload_buffer(name, &[0; 4096]), Err(Error::WrongKind { resource, .. }) if resource == name),
            "{name}"
        );
    }
    assert_eq!(
        engine.unbind("luminance_history"),
        Err(Error::WrongKind { resource: "luminance_history".into(), needed: "an input" })
    );
}

#[test]
fn a_buffer_that_is_too_short_is_named() {
    let mut engine = host().engine;
    for length in [0, 12, 47] {
        let error = engine.upload_buffer("instance_transforms", &vec![0; length]).expect_err("too short");
        assert_names(error, &["instance_transforms", &format!("{length} bytes"), "at least 48 bytes"]);
    }
    engine.upload_buffer("instance_transforms", &[0; 48]).expect("one instance");
}

#[test]
fn a_required_input_that_is_missing_is_named_and_nothing_is_lost() {
    let surfaces = Config::new(EXTENT);
    let asvgf = Config { preset: Preset::Asvgf, forward_motion: true, ..surfaces };
    let stabilize = Config { preset: Preset::Stabilize, ..surfaces };
    for (config, names) in [
        (Config { signals: Signals::Apart, ..surfaces }, &["depth", "normal", "surface_id", "noisy_direct", "noisy_indirect"][..]),
        (Config { volume: true, ..surfaces }, &["noisy_radiance", "noisy_volume"]),
        (Config { preset: Preset::Volume, surface_id: false, ..surfaces }, &["noisy_volume"]),
        (asvgf, &["forward_motion"]),
        (stabilize, &["noisy_radiance", "other_denoised_radiance"]),
    ] {
        let (mut host, params, noisy) = (Host::new(&config), camera(EXTENT, Vec3::ZERO), noise(EXTENT, 1));
        let _ = host.engine.upload_ids("surface_id", &[1; PIXELS]);
        for name in ["forward_motion", "other_denoised_radiance"] {
            let _ = host.engine.upload(name, noisy.texels());
        }
        host.frame(&params, &noisy);
        for &name in names {
            host.engine.unbind(name).expect(name);
            assert_eq!(host.engine.run(&params, &svgf_tuning()), Err(Error::NotBound(name.into())));
            let again = match name {
                "surface_id" => host.engine.upload_ids(name, &[1; PIXELS]),
                _ => host.engine.upload(name, noisy.texels()),
            };
            again.expect(name);
            assert_eq!(host.frame(&params, &noisy).reset, None, "{name}: the history is as before");
        }
    }
}

#[test]
fn a_host_that_knows_what_changed_need_not_show_its_noise() {
    let config = Config { preset: Preset::Stabilize, gradient_source: GradientSource::Confidence, ..Config::new(EXTENT) };
    let config = Config { surface_id: false, ..config };
    assert!(config.declare().expect("valid").find("noisy_radiance").is_none());
    let (mut host, other) = (Host::new(&config), noise(EXTENT, 1));
    host.engine.upload("other_denoised_radiance", other.texels()).expect("other_denoised_radiance");
    host.engine.upload("confidence", &[[1.0; 4]; PIXELS]).expect("confidence");
    host.frame(&camera(EXTENT, Vec3::ZERO), &other);
    assert!(all_finite(&host.image("denoised_radiance")));
}

#[test]
fn a_frame_that_is_refused_leaves_the_history() {
    let config = Config { surface_id: false, ..Config::new(EXTENT) };
    let (mut used, mut fresh) = (Host::new(&config), Host::new(&config));
    let good = camera(EXTENT, Vec3::ZERO);
    used.frame(&good, &noise(EXTENT, 0));
    fresh.frame(&good, &noise(EXTENT, 0));
    let error = used.engine.run(&FrameParams::new([99, 99]), &svgf_tuning()).expect_err("too large");
    assert_eq!(error, Error::RenderExtent { render: [99, 99], allocated: EXTENT });
    let error = used.engine.run(&FrameParams { jitter: [0.0, 3.0], ..good }, &svgf_tuning()).expect_err("too far");
    assert_names(error, &["jitter"]);
    let error = used.engine.run(&good, &Tuning { sigma_n: f32::NAN, ..svgf_tuning() }).expect_err("not a number");
    assert_names(error, &["sigma_n is NaN"]);
    assert_eq!(used.frame(&good, &noise(EXTENT, 1)).reset, None);
    fresh.frame(&good, &noise(EXTENT, 1));
    assert_eq!(used.everything(), fresh.everything());
}

#[test]
fn an_optional_input_may_be_left_out_again() {
    let (mut with, mut without) = (host(), host());
    for host in [&mut with, &mut without] {
        host.engine.upload_ids("surface_id", &[1; PIXELS]).expect("surface_id");
    }
    with.engine.upload("emission", &[[3.0; 4]; PIXELS]).expect("emission");
    let params = camera(EXTENT, Vec3::ZERO);
    with.frame(&params, &noise(EXTENT, 0));
    without.frame(&params, &noise(EXTENT, 0));
    assert_ne!(with.image("denoised_radiance"), without.image("denoised_radiance"));
    assert_eq!(with.engine.download("motion"), Err(Error::NotBound("motion".into())), "an absent input");
    with.engine.unbind("emission").expect("optional");
    with.frame(&params, &noise(EXTENT, 1));
    without.frame(&params, &noise(EXTENT, 1));
    assert_eq!(with.image("denoised_radiance"), without.image("denoised_radiance"));
}

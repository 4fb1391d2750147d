//! Tests that need no device; `tests/hosts/` and `examples/host_cpp/` have the others.

use crate::status::guard;
use crate::*;
use atrous::config::Preset;
use atrous::{Config, Tuning};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

fn last_error() -> String {
    // SAFETY: the pointer is valid until the next failure on this thread.
    unsafe { CStr::from_ptr(atrous_last_error()) }.to_string_lossy().into_owned()
}

#[test]
fn a_panic_is_a_status() {
    assert_eq!(guard(|| panic!("on purpose")), AtrousStatus::Panicked);
    assert!(last_error().contains("on purpose"), "{}", last_error());
}

#[test]
fn defaults_are_those_of_the_crate() {
    let config = AtrousConfig::default_for([64, 36]).to_config().expect("valid");
    assert_eq!(config, Config::new([64, 36]));
    let three = AtrousConfig { levels: 3, ..AtrousConfig::default_for([64, 36]) }.to_config().expect("valid");
    assert_eq!(three.levels, Some(3));
    let params = AtrousFrameParams::default_for([64, 36]).to_params().expect("valid");
    assert_eq!(params, atrous::FrameParams::new([64, 36]));
}

#[test]
fn numbers_out_of_range_are_named() {
    type Case = (&'static str, fn(&mut AtrousConfig));
    let cases: [Case; 10] = [
        ("preset", |c| c.preset = 77),
        ("depth", |c| c.depth = 77),
        ("motion_y_up", |c| c.motion_y_up = 77),
        ("levels", |c| c.levels = 77),
        ("volume", |c| c.volume = 77),
        ("visibility", |c| c.visibility = 77),
        ("firefly_filter", |c| c.firefly_filter = 77),
        ("adaptive_rule", |c| c.adaptive_rule = 77),
        ("eaw_weights", |c| c.eaw_weights = 77),
        ("sampling", |c| c.sampling = 77),
    ];
    for (name, spoil) in cases {
        let mut config = AtrousConfig::default_for([64, 36]);
        spoil(&mut config);
        let failure = config.to_config().expect_err(name);
        assert!(failure.message.contains(name) && failure.message.contains("77"), "{}", failure.message);
    }
}

/// The fields of a frame that are choices, by what their documentation and their errors list. Those of the configuration are made
/// from its table.
#[test]
fn the_header_lists_every_choice_by_number_and_name() {
    use crate::convert::allowed_or_none;
    use atrous::{DebugView, ResetReason};
    let header =
        include_str!("structs.rs").split('\n').map(|line| line.trim().trim_start_matches("/// ")).collect::<Vec<_>>().join(" ");
    let lists = [("reset", allowed_or_none::<ResetReason>()), ("debug_view", allowed_or_none::<DebugView>())];
    for (field, list) in lists {
        let behind = header.split(&format!("{list}.")).nth(1).unwrap_or_else(|| panic!("{field}: no \"{list}.\""));
        let next = behind.split("pub ").nth(1).unwrap_or_default();
        assert!(next.starts_with(&format!("{field}: u32")), "the list of {field} stands before: {next:.20}");
    }
}

#[test]
fn choices_of_a_frame_are_those_of_the_crate() {
    use atrous::{DebugView, ResetReason};
    let given = |reset, debug_view| AtrousFrameParams { reset, debug_view, ..AtrousFrameParams::default_for([4, 4]) }.to_params();
    let params = given(6, 14).expect("valid");
    assert_eq!((params.reset, params.debug_view), (Some(ResetReason::ExposureJump), Some(DebugView::BadValues)));
    let params = given(1, 1).expect("valid");
    assert_eq!((params.reset, params.debug_view), (Some(ResetReason::Created), Some(DebugView::HistoryLength)));
    for (reset, debug_view, words) in
        [(7, 0, ["reset is 7", "0 (none), 1 (created)"]), (0, 21, ["debug_view is 21", "20 (penumbra)"])]
    {
        let failure = given(reset, debug_view).expect_err("out of range");
        assert!(words.iter().all(|word| failure.message.contains(word)), "{}", failure.message);
    }
    let failure = AtrousConfig { preset: 8, ..AtrousConfig::default_for([4, 4]) }.to_config().expect_err("out of range");
    assert!(failure.message.contains("preset is 8; allowed: 0 (svgf), 1 (asvgf)"), "{}", failure.message);
}

#[test]
fn every_choice_of_a_filter_is_reachable() {
    use atrous::config::{AdaptiveRule, EawWeights, Sampling};
    let given = AtrousConfig {
        preset: 4,
        volume: 1,
        visibility: 1,
        firefly_filter: 1,
        adaptive_rule: 1,
        eaw_weights: 0b101,
        sampling: 2,
        ..AtrousConfig::default_for([64, 36])
    };
    let expected = Config {
        preset: Preset::Eaw,
        volume: true,
        visibility: 1,
        firefly_filter: true,
        adaptive_rule: AdaptiveRule::Percentiles,
        eaw_weights: EawWeights { radiance: true, normal: false, position: true },
        sampling: Sampling::OneOf4x4,
        ..Config::new([64, 36])
    };
    assert_eq!(given.to_config().expect("valid"), expected);
}

#[test]
fn null_and_wrong_sizes_are_told() {
    let mut config = AtrousConfig::default_for([8, 8]);
    let mut handle = null_mut();
    // SAFETY: pointers are null or to live structs.
    unsafe {
        assert_eq!(atrous_config_default(null_mut(), 8, 8), AtrousStatus::InvalidArgument);
        config.struct_size = 12;
        assert_eq!(atrous_config_default(&mut config, 8, 8), AtrousStatus::InvalidArgument);
        assert!(last_error().contains("struct_size is 12"), "{}", last_error());
        assert_eq!(atrous_create(null(), &mut handle), AtrousStatus::InvalidArgument);
        assert_eq!(atrous_create(null(), null_mut()), AtrousStatus::InvalidArgument);
        for dead in [null_mut(), std::ptr::without_provenance_mut(64), std::ptr::without_provenance_mut(usize::MAX)] {
            assert_eq!(atrous_destroy(dead), AtrousStatus::InvalidHandle);
            assert_eq!(atrous_resize(dead, 8, 8), AtrousStatus::InvalidHandle);
            assert_eq!(atrous_counts(dead, null_mut(), null_mut()), AtrousStatus::InvalidHandle);
        }
        assert_eq!(atrous_set_tuning(null_mut(), null(), 0.0), AtrousStatus::InvalidArgument);
        assert_eq!(CStr::from_ptr(atrous_status_name(AtrousStatus::StaleFrame as u32)), c"stale frame");
        assert_eq!(CStr::from_ptr(atrous_status_name(99)), c"unknown status");
    }
}

#[test]
fn handles_of_a_binding_mean_one_thing() {
    use ash::vk::{Buffer, Handle, Image, ImageLayout, ImageView};
    use atrous::Binding;
    let (image, view, buffer, layout) = (Image::from_raw(1), ImageView::from_raw(2), Buffer::from_raw(3), ImageLayout::GENERAL);
    let none =
        AtrousBinding { image: Image::null(), view: ImageView::null(), layout, buffer: Buffer::null(), offset: 16, range: 32 };
    let bound = |given: AtrousBinding| {
        crate::record::binding(7, &given).map_err(|failure| {
            assert_eq!(failure.status, AtrousStatus::BadBindings);
            failure.message
        })
    };
    assert_eq!(bound(none), Ok(Binding::Absent));
    assert_eq!(bound(AtrousBinding { buffer, ..none }), Ok(Binding::Buffer { buffer, offset: 16, range: 32 }));
    assert_eq!(bound(AtrousBinding { view, ..none }), Ok(Binding::Image { view, layout }));
    for both in [AtrousBinding { image, ..none }, AtrousBinding { view, ..none }, AtrousBinding { image, view, ..none }] {
        let message = bound(AtrousBinding { buffer, ..both }).expect_err("two things");
        assert!(message.contains("binding 7 has both an image and a buffer"), "{message}");
    }
    assert_eq!(bound(AtrousBinding { image, view, ..none }), Ok(Binding::Image { view, layout }));
    let message = bound(AtrousBinding { image, ..none }).expect_err("no view");
    assert!(message.contains("binding 7 has an image without a view"), "{message}");
}

#[test]
fn names_and_uses_fit() {
    for preset in Preset::ALL.map(|preset| preset as u32) {
        let config = AtrousConfig { preset, object_normal: 1, ..AtrousConfig::default_for([64, 36]) }.to_config().expect("valid");
        assert_eq!(config.preset as u32, preset);
        let declaration = config.declare().expect("valid");
        let names =
            declaration.resources().iter().map(|r| r.name.as_str()).chain(declaration.passes().iter().map(|p| p.name.as_str()));
        assert!(names.chain(Tuning::FIELDS.iter().map(|f| f.name)).all(|n| n.len() < ATROUS_NAME_SIZE));
    }
    const { assert!(atrous_shader::MAX_BINDINGS <= ATROUS_MAX_USES) };
}

//! Input that is wrong: a clear error, or a defined picture; never a panic, never a value that is not finite.

use super::support::{self, assert_valid, frame, gpu, scene::Guides, scene::Scene, session};
use atrous::config::{Conventions, Signals};
use atrous::executor::{HeadlessDevice, HeadlessOptions};
use atrous::graph::Graph;
use atrous::{Binding, Config, Counter, Denoiser, Error, FrameParams, Setup, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("extents_that_are_zero_or_too_large_are_named", extents_that_are_zero_or_too_large_are_named),
    ("one_pixel_and_odd_extents_work", one_pixel_and_odd_extents_work),
    ("a_render_extent_beyond_the_allocation_is_refused", a_render_extent_beyond_the_allocation_is_refused),
    ("a_wrong_format_names_what_is_taken", a_wrong_format_names_what_is_taken),
    ("a_wrong_size_names_what_is_needed", a_wrong_size_names_what_is_needed),
    ("an_unknown_name_lists_the_known_ones", an_unknown_name_lists_the_known_ones),
    ("a_required_input_that_is_not_bound_is_named", a_required_input_that_is_not_bound_is_named),
    ("bindings_that_do_not_fit_are_refused_before_recording", bindings_that_do_not_fit_are_refused_before_recording),
    ("frame_parameters_out_of_range_are_named", frame_parameters_out_of_range_are_named),
    ("numbers_of_conventions_that_cannot_be_are_named", numbers_of_conventions_that_cannot_be_are_named),
    ("a_device_that_does_not_exist_lists_those_that_do", a_device_that_does_not_exist_lists_those_that_do),
    ("a_device_without_what_is_needed_is_told_so", a_device_without_what_is_needed_is_told_so),
    ("values_that_are_not_finite_are_counted_and_stop_here", values_that_are_not_finite_are_counted_and_stop_here),
    ("zero_normals_and_zero_albedo_give_a_picture", zero_normals_and_zero_albedo_give_a_picture),
    ("radiance_beyond_half_float_saturates", radiance_beyond_half_float_saturates),
];

fn extents_that_are_zero_or_too_large_are_named() {
    for extent in [[0, 8], [8, 0], [0, 0], [100_000, 8]] {
        let error = Config::new(extent).declare().expect_err("refused");
        assert!(matches!(error, Error::Extent { given, .. } if given == extent), "{error}");
        assert!(error.to_string().contains("16384"), "{error}");
    }
    let mut s = session(&Config::new([8, 8]));
    support::upload(&mut s, &Scene::new([8, 8]).frame(0, 0));
    let error = s.run(&FrameParams::new([0, 8]), &Tuning::default()).expect_err("refused");
    assert!(error.to_string().contains("render_extent is [0, 8]"), "{error}");
}

fn one_pixel_and_odd_extents_work() {
    for extent in [[1, 1], [1, 7], [3, 1], [17, 19], [33, 65]] {
        for signals in Signals::ALL {
            let scene = Scene { speed: 0.1, ..Scene::new(extent) };
            let mut s = session(&Config { signals, ..Config::new(extent) });
            for i in 0..3 {
                frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default());
            }
        }
    }
}

fn a_render_extent_beyond_the_allocation_is_refused() {
    let mut s = session(&Config::new([8, 8]));
    support::upload(&mut s, &Scene::new([8, 8]).frame(0, 0));
    let error = s.run(&FrameParams::new([8, 9]), &Tuning::default()).expect_err("refused");
    assert_eq!(error, Error::RenderExtent { render: [8, 9], allocated: [8, 8] });
}

fn a_wrong_format_names_what_is_taken() {
    let mut s = session(&Config::new([8, 8]));
    let error = s.upload_ids("depth", &[1; 64]).expect_err("refused").to_string();
    assert!(error.contains("`depth`") && error.contains("R32_UINT") && error.contains("floating-point"), "{error}");
    let error = s.upload("surface_id", &[[1.0; 4]; 64]).expect_err("refused").to_string();
    assert!(error.contains("unsigned integer"), "{error}");
}

fn a_wrong_size_names_what_is_needed() {
    let mut s = session(&Config::new([8, 8]));
    let error = s.upload("depth", &[[1.0; 4]; 63]).expect_err("refused").to_string();
    assert!(error.contains("63 texels") && error.contains("64 texels (8x8)"), "{error}");
    let error = s.upload_buffer("instance_transforms", &[0; 12]).expect_err("refused").to_string();
    assert!(error.contains("12 bytes") && error.contains("48 bytes"), "{error}");
}

fn an_unknown_name_lists_the_known_ones() {
    let mut s = session(&Config::new([8, 8]));
    let error = s.upload("dept", &[[1.0; 4]; 64]).expect_err("refused").to_string();
    assert!(error.contains("`dept`") && error.contains("depth, normal"), "{error}");
}

fn a_required_input_that_is_not_bound_is_named() {
    let mut s = session(&Config::new([8, 8]));
    s.upload("normal", &[[0.0, 0.0, 1.0, 0.0]; 64]).expect("normal");
    let error = s.run(&FrameParams::new([8, 8]), &Tuning::default()).expect_err("refused");
    assert_eq!(error, Error::NotBound("depth".into()));
}

fn bindings_that_do_not_fit_are_refused_before_recording() {
    let gpu = gpu();
    // SAFETY: the handles are live and outlive the denoiser.
    let mut denoiser = unsafe { Denoiser::new(gpu.host(), Config::new([8, 8]).declare().expect("valid")) }.expect("denoiser");
    let context = denoiser.begin_frame(&FrameParams::new([8, 8]), &Tuning::default()).expect("frame");
    let absent = [Binding::Absent; 11];
    let record = |pass: usize, bindings: &[Binding]| {
        // SAFETY: the bindings do not fit, so nothing is recorded and the null command buffer is never used.
        unsafe { denoiser.record(ash::vk::CommandBuffer::null(), &context, pass, bindings) }.expect_err("refused").to_string()
    };
    let few = record(1, &absent[..3]);
    assert!(few.contains("`import` was given 3 bindings, it needs 11"), "{few}");
    assert!(record(1, &absent).contains("`frame_constants`"));
    assert!(record(99, &absent).contains("index 99"));
}

fn frame_parameters_out_of_range_are_named() {
    let mut s = session(&Config::new([8, 8]));
    support::upload(&mut s, &Scene::new([8, 8]).frame(0, 0));
    let good = FrameParams::new([8, 8]);
    let cases = [
        ("view_from_world", FrameParams { view_from_world: [[0.0; 4]; 4], ..good }),
        ("clip_from_view", FrameParams { clip_from_view: [[f32::NAN; 4]; 4], ..good }),
        ("jitter", FrameParams { jitter: [0.0, 3.0], ..good }),
        ("exposure_ratio", FrameParams { exposure_ratio: 0.0, ..good }),
        ("lights", FrameParams { lights: [[0.0, 1.0, 0.0, f32::NAN]; 4], ..good }),
        ("lights", FrameParams { lights: [[0.0, 1.0, 0.0, 0.5]; 4], ..good }),
        ("frame_slot", FrameParams { frame_slot: 2, ..good }),
    ];
    for (name, params) in cases {
        let error = s.run(&params, &Tuning::default()).expect_err(name).to_string();
        assert!(error.contains(name), "{error}");
    }
    let error = s.run(&good, &Tuning { sigma_n: f32::NAN, ..Tuning::default() }).expect_err("tuning").to_string();
    assert!(error.contains("sigma_n is NaN"), "{error}");
    s.run(&good, &Tuning::default()).expect("nothing was changed by what was refused");
}

fn numbers_of_conventions_that_cannot_be_are_named() {
    for given in [f32::NAN, -1.0, 0.0, f32::NEG_INFINITY] {
        let conventions = Conventions { background_depth: given, ..Conventions::default() };
        let config = Config { conventions, ..Config::new([8, 8]) };
        for error in [config.validate(), config.declare().map(drop), config.setup().validate()] {
            let message = error.expect_err("refused").to_string();
            assert!(message.contains(&format!("background_depth is {given}")) && message.contains("above 0"), "{message}");
        }
        let graph = Graph::of(Setup { conventions, ..Setup::new([8, 8]) }).finish();
        assert!(matches!(graph, Err(Error::Conventions { .. })), "{given}");
    }
    for given in [f32::NAN, -1.0, 0.0, f32::INFINITY, 1e-40] {
        let conventions = Conventions { motion_scale: given, ..Conventions::default() };
        let message = Config { conventions, ..Config::new([8, 8]) }.declare().expect_err("refused").to_string();
        assert!(message.contains(&format!("motion_scale is {given}")) && message.contains("motion_direction"), "{message}");
    }
    let far = Conventions { background_depth: f32::INFINITY, ..Conventions::default() };
    Config { conventions: far, ..Config::new([8, 8]) }.declare().expect("no such distance");
}

fn a_device_that_does_not_exist_lists_those_that_do() {
    for wanted in ["no such device", "99"] {
        let options = HeadlessOptions { device: Some(wanted.into()), ..Default::default() };
        let error = HeadlessDevice::new(&options).err().expect("refused").to_string();
        assert!(error.contains(wanted) && error.contains(&format!("0: {}", gpu().name())), "{error}");
    }
}

fn a_device_without_what_is_needed_is_told_so() {
    let error = Error::Unsupported { missing: vec!["Vulkan 1.1 (it has 1.0.2)".into(), "a queue with COMPUTE".into()] };
    assert_eq!(error.to_string(), "this device cannot run the denoiser: Vulkan 1.1 (it has 1.0.2); a queue with COMPUTE");
    let gpu = gpu();
    let requirements = atrous::Requirements::new(&Config::new([16384, 16384]).declare().expect("valid"));
    let host = gpu.host();
    // SAFETY: the handles are live and belong together.
    let limits = unsafe { host.instance.get_physical_device_properties(host.physical_device) }.limits;
    // SAFETY: instance and physical device are live and belong together.
    let checked = unsafe { requirements.check(host.instance, host.physical_device) };
    assert_eq!(checked.is_ok(), limits.max_image_dimension2_d >= 16384);
}

fn values_that_are_not_finite_are_counted_and_stop_here() {
    let scene = Scene::new([36, 18]);
    let mut s = session(&Config::new(scene.extent));
    frame(&mut s, &scene.frame(0, 0), &scene.params(0), &Tuning::default());
    let mut bad = scene.frame(1, 1);
    // Pixels of the wall: 40 is in row 1, the sky reaches down to row 0 alone at this size.
    let pixels: Vec<usize> = (32 * 9..32 * 9 + 6).collect();
    for (k, value) in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY].into_iter().enumerate() {
        spoil(&mut bad, pixels[2 * k], value);
    }
    bad.depth[pixels[1]] = [f32::NAN; 4];
    frame(&mut s, &bad, &scene.params(1), &Tuning::default());
    let counts: Vec<u32> = s.download("statistics").expect("statistics").iter().map(|c| c[0] as u32).collect();
    assert_eq!(counts[..6], [1, 3, 3, 3, 3, 0], "depth, normal, motion, radiance, albedo, emission");
    assert!(counts[6..=Counter::OccluderDistance as usize].iter().all(|count| *count == 0), "{counts:?}");
    for i in 2..6 {
        frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default());
    }
}

fn spoil(g: &mut Guides, i: usize, value: f32) {
    g.normal[i] = [value; 4];
    g.motion[i] = [value; 4];
    g.albedo[i] = [value; 4];
    g.noisy_radiance[i] = [value; 4];
}

fn zero_normals_and_zero_albedo_give_a_picture() {
    let scene = Scene::new([36, 18]);
    let mut s = session(&Config::new(scene.extent));
    for i in 0..3 {
        let mut g = scene.frame(i, i);
        g.normal.fill([0.0; 4]);
        g.albedo.fill([0.0; 4]);
        let (_, image) = frame(&mut s, &g, &scene.params(i), &Tuning::default());
        let middle = image[32 * 9 + 16];
        assert!(middle[0] > 0.01, "black albedo made the picture black: {middle:?}");
    }
}

fn radiance_beyond_half_float_saturates() {
    let scene = Scene::new([19, 18]);
    let mut s = session(&Config::new(scene.extent));
    for i in 0..3 {
        let mut g = scene.frame(i, i);
        g.noisy_radiance.fill([1e30, 1e30, 1e30, 1.0]);
        frame(&mut s, &g, &scene.params(i), &Tuning::default());
    }
    assert_valid();
}

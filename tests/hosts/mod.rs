//! Hosts that share nothing but the contract give the same image, bit for bit, and none of them a validation message.
//!
//! Each is a program of its own, an example of this package or of `atrous-wgpu`: a host has no code for validation, so the layer is switched on from outside, and
//! reports on the standard output.

mod cpp;
mod fewer_features;
mod package;
mod submissions;

use super::support::{assert_valid, examples, session};
use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::{Config, FrameParams, Tuning};
use atrous_harness::DeviceTest;
use atrous_synthetic as synthetic;
use std::process::{Command, Output};
use std::sync::Arc;

pub const TESTS: &[DeviceTest] = &[
    ("the_layer_is_listening", the_layer_is_listening),
    ("plain_ash_gives_the_bits_of_the_executor", plain_ash_gives_the_bits_of_the_executor),
    ("vk_graph_gives_the_bits_of_the_executor", vk_graph_gives_the_bits_of_the_executor),
    ("vulkano_gives_the_bits_of_the_executor", vulkano_gives_the_bits_of_the_executor),
    ("wgpu_gives_the_bits_of_the_executor", wgpu_gives_the_bits_of_the_executor),
    ("a_graph_of_a_host_agrees_with_the_cpu_engine", a_graph_of_a_host_agrees_with_the_cpu_engine),
    ("cpp_gives_the_bits_of_the_executor", cpp::cpp_gives_the_bits_of_the_executor),
    ("cpp_with_an_executor_gives_the_bits_of_the_executor", cpp::cpp_with_an_executor_gives_the_bits_of_the_executor),
    ("cpp_captures_inputs_and_draws_views", cpp::cpp_captures_inputs_and_draws_views),
    ("cpp_is_told_of_wrong_guides_by_the_executor", cpp::cpp_is_told_of_wrong_guides_by_the_executor),
    ("graphs_of_c_and_cpp_give_the_bits_of_that_of_rust", cpp::graphs_of_c_and_cpp_give_the_bits_of_that_of_rust),
    ("cpp_gives_the_bits_of_the_executor_under_sanitizers", cpp::cpp_gives_the_bits_of_the_executor_under_sanitizers),
    ("prerecorded_command_buffers_give_the_bits_of_the_executor", cpp::prerecorded_command_buffers_give_the_bits_of_the_executor),
    ("four_threads_give_the_bits_of_the_executor", cpp::four_threads_give_the_bits_of_the_executor),
    ("a_c99_program_denoises_in_one_call", cpp::a_c99_program_denoises_in_one_call),
    ("cpp_is_told_of_wrong_conventions", cpp::cpp_is_told_of_wrong_conventions),
    ("phases_in_submissions_of_their_own_give_the_same_bits", submissions::phases_in_submissions_of_their_own_give_the_same_bits),
    ("the_boundary_names_what_crosses_between_phases", submissions::the_boundary_names_what_crosses_between_phases),
    (
        "a_device_without_synchronization2_runs_the_nodes_and_not_the_executor",
        fewer_features::a_device_without_synchronization2_runs_the_nodes_and_not_the_executor,
    ),
    ("a_session_runs_on_each_version_of_vulkan", fewer_features::a_session_runs_on_each_version_of_vulkan),
    ("a_machine_without_a_layer_or_a_driver_is_told_so", fewer_features::a_machine_without_a_layer_or_a_driver_is_told_so),
    ("a_layer_that_is_newer_than_the_loader_validates", fewer_features::a_layer_that_is_newer_than_the_loader_validates),
    ("an_instance_of_vulkan_1_0_is_told_what_to_ask_for", fewer_features::an_instance_of_vulkan_1_0_is_told_what_to_ask_for),
    ("a_device_with_everything_is_told_nothing", fewer_features::a_device_with_everything_is_told_nothing),
    ("the_c_abi_refuses_bad_input_under_address_sanitizer", cpp::the_c_abi_refuses_bad_input_under_address_sanitizer),
    ("a_host_of_the_first_header_gives_the_bits_of_the_executor", cpp::a_host_of_the_first_header_gives_the_bits_of_the_executor),
    ("cmake_finds_the_installed_library", package::cmake_finds_the_installed_library),
    ("pkg_config_finds_the_installed_library", package::pkg_config_finds_the_installed_library),
    ("the_installed_libraries_show_nothing_of_rust", package::the_installed_libraries_show_nothing_of_rust),
];

/// One configuration of every preset.
pub fn configurations() -> impl Iterator<Item = Config> {
    let presets = [Preset::Svgf, Preset::Asvgf, Preset::Stabilize, Preset::Percentile, Preset::Best];
    presets.into_iter().map(|preset| Config { preset, ..Config::new(synthetic::EXTENT) })
}

/// Set where a process of this program is a host instead of the tests.
const VARIABLE: &str = "ATROUS_TEST_HOST";

/// Runs the host that the environment asks for; `None`: the tests are to be run.
pub fn run_as_host() -> Option<i32> {
    let host = std::env::var(VARIABLE).ok()?;
    let open = |validation| HeadlessDevice::new(&HeadlessOptions { validation, ..Default::default() });
    let result: Result<(), Box<dyn std::error::Error>> = match host.as_str() {
        "a device" => open(Validation::Off).map(drop).map_err(Into::into),
        "a validated device" => open(Validation::On).map(drop).map_err(Into::into),
        _ => missing_barrier(),
    };
    Some(result.map_or_else(
        |error| {
            eprintln!("{error}");
            1
        },
        |()| 0,
    ))
}

/// Switches the validation layer on, with synchronisation validation and across submissions.
pub fn validated(command: &mut Command) -> &mut Command {
    let enables = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    command
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_ENABLES", enables)
        .env("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1")
}

/// The lines with checksums; fails where the host did, or where the layer said anything.
pub fn checksums(name: &str, output: &Output) -> Vec<String> {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{name}: {}\n{out}\n{err}", output.status);
    assert!(!out.lines().chain(err.lines()).any(complaint), "{name}:\n{out}\n{err}");
    out.lines().filter(|l| l.contains("checksum")).map(str::to_owned).collect()
}

/// Whether a line is a message of the layer. An engine asks for the properties that the driver offers; a layer older than the driver
/// does not know all of their structures.
fn complaint(line: &str) -> bool {
    let unknown =
        line.contains("PhysicalDeviceProperties2-pNext") && line.contains("includes a structure with unknown VkStructureType");
    line.contains("Validation") && !unknown
}

fn of_example(name: &str) -> Vec<String> {
    checksums(name, &validated(&mut Command::new(examples::program(name))).output().expect("a process"))
}

/// The example fails by itself where too many pixels differ, or where the layer says anything.
fn a_graph_of_a_host_agrees_with_the_cpu_engine() {
    let output = validated(&mut Command::new(examples::program("custom_graph"))).output().expect("a process");
    checksums("custom_graph", &output);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let frames = text.lines().filter(|line| line.contains("pixels differ")).count();
    assert_eq!(frames, synthetic::FRAMES as usize, "{text}");
}

/// A frame that lacks a barrier, on a device that knows nothing of validation.
fn missing_barrier() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions::default())?);
    let config = Config::new(synthetic::EXTENT);
    let pass = config.declare()?.passes().iter().position(|p| p.name == "atrous_2");
    let mut s = Session::new(gpu, config.declare()?, SessionOptions { omit_barriers_before: pass, ..Default::default() })?;
    executor_frames(&mut s);
    Ok(())
}

fn the_layer_is_listening() {
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    let output = validated(command.env(VARIABLE, "missing_barrier")).output().expect("a process");
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(text.contains("SYNC-HAZARD-READ-AFTER-WRITE") && text.contains("Validation"), "{text}");
}

/// What the built-in executor gives.
pub fn of_executor() -> Vec<String> {
    let lines = executor_frames(&mut session(&Config::new(synthetic::EXTENT)));
    assert_valid();
    lines
}

fn executor_frames(s: &mut Session) -> Vec<String> {
    let mut lines = Vec::new();
    for index in 0..synthetic::FRAMES {
        upload(s, index);
        s.run(&params(index), &Tuning::default()).expect("frame");
        let image = s.download_bytes("denoised_radiance", atrous::UseFrame::Current).expect("denoised_radiance");
        lines.push(synthetic::report(index, &image));
    }
    lines
}

fn upload(s: &mut Session, index: u32) {
    let input = synthetic::Frame::new(index);
    for (name, texels) in synthetic::NAMES.iter().zip(&input.images) {
        s.upload(name, texels).expect(name);
    }
    s.upload_ids("surface_id", &input.surface_id).expect("surface_id");
}

/// The parameters of a frame of the sequence.
pub fn params(index: u32) -> FrameParams {
    FrameParams {
        frame_slot: index % 2,
        view_from_world: synthetic::view_from_world(index),
        clip_from_view: synthetic::clip_from_view(),
        ..FrameParams::new(synthetic::EXTENT)
    }
}

fn plain_ash_gives_the_bits_of_the_executor() {
    assert_eq!(of_example("host_ash"), of_executor());
}

fn wgpu_gives_the_bits_of_the_executor() {
    assert_eq!(of_example("host_wgpu"), of_executor());
}

fn vulkano_gives_the_bits_of_the_executor() {
    assert_eq!(of_example("host_vulkano"), of_executor());
}

fn vk_graph_gives_the_bits_of_the_executor() {
    assert_eq!(of_example("host_vk_graph"), of_executor());
}

//! The program on whatever Vulkan device there is, under the validation layer with synchronisation validation: the bits of the executor.

use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, FrameParams, Tuning, UseFrame};
use atrous_synthetic as synthetic;
use std::process::Command;
use std::sync::Arc;

fn of_executor() -> Vec<String> {
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions::default()).expect("a device"));
    let declaration = Config::new(synthetic::EXTENT).declare().expect("valid");
    let mut s = Session::new(gpu, declaration, SessionOptions::default()).expect("a session");
    let frame = |index: u32| {
        let input = synthetic::Frame::new(index);
        for (name, texels) in synthetic::NAMES.iter().zip(&input.images) {
            s.upload(name, texels).expect(name);
        }
        s.upload_ids("surface_id", &input.surface_id).expect("surface_id");
        let params = FrameParams {
            view_from_world: synthetic::view_from_world(index),
            clip_from_view: synthetic::clip_from_view(),
            ..FrameParams::new(synthetic::EXTENT)
        };
        s.run(&params, &Tuning::default()).expect("a frame");
        synthetic::report(index, &s.download_bytes("denoised_radiance", UseFrame::Current).expect("output"))
    };
    (0..synthetic::FRAMES).map(frame).collect()
}

#[test]
fn blade_gives_the_bits_of_the_executor() {
    let enables = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    let mut command = Command::new(env!("CARGO_BIN_EXE_host_blade"));
    command
        .env("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation")
        .env("VK_LAYER_ENABLES", enables)
        .env("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1");
    let output = command.output().expect("a process");
    let text = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned()).concat();
    assert!(output.status.success() && !text.contains("Validation"), "{}\n{text}", output.status);
    let checksums: Vec<_> = text.lines().filter(|line| line.contains("checksum")).map(str::to_owned).collect();
    assert_eq!(checksums, of_executor(), "{text}");
}

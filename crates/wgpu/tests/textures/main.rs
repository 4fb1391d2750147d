//! Textures that wgpu's own passes write and read, under the validation layer with synchronisation validation.

mod capture;
mod host;
mod outputs;

use atrous::{FrameParams, Phase, ResetReason, Tuning};
use atrous_harness::{DeviceTest, Group};
use atrous_wgpu::Error;
use host::{assert_valid, gpu, keep, of_session, texture, Host, EXTENT};
use wgpu::{TextureFormat as Format, TextureUsages as Usage};

const TESTS: &[DeviceTest] = &[
    ("what_render_passes_wrote_is_denoised", what_render_passes_wrote_is_denoised),
    ("what_does_not_fit_is_named", what_does_not_fit_is_named),
    ("a_slot_that_was_not_submitted_is_refused", a_slot_that_was_not_submitted_is_refused),
    ("another_extent_makes_outputs_anew", another_extent_makes_outputs_anew),
];

fn main() {
    host::listen();
    let group = |name, tests| Group { name, tests, needs_device: true };
    atrous_harness::run(&[group("", TESTS), group("capture", capture::TESTS), group("outputs", outputs::TESTS)], &gpu());
}

fn what_render_passes_wrote_is_denoised() {
    let mut host = Host::new();
    for frames in 1..=5 {
        host.frame();
        if frames == 1 {
            assert_eq!(host.result(), of_session(1), "the first read must not clear the output");
        }
    }
    assert_eq!(host.result(), of_session(5));
    drop(host);
    assert_valid();
}

fn what_does_not_fit_is_named() {
    let mut host = Host::new();
    let bad = |host: &mut Host, name: &str, format, usage| {
        let texture = texture(&host.device, format, usage);
        host.denoiser.set_input(name, &texture).expect_err("refused").to_string()
    };
    let unsampled = bad(&mut host, "depth", Format::R32Float, Usage::COPY_DST);
    assert!(unsampled.contains("`depth`") && unsampled.contains("TEXTURE_BINDING"), "{unsampled}");
    let vague = bad(&mut host, "depth", Format::Depth24Plus, Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT);
    assert!(vague.contains("Depth24Plus") && vague.contains("Depth32Float"), "{vague}");
    let integer = bad(&mut host, "normal", Format::R32Uint, Usage::TEXTURE_BINDING);
    assert!(integer.contains("`normal`") && integer.contains("R32_UINT"), "{integer}");
    let output = bad(&mut host, "denoised_radiance", Format::Rgba16Float, Usage::TEXTURE_BINDING | Usage::STORAGE_BINDING);
    assert!(output.contains("WgpuDenoiser::set_output"), "{output}");
    let unknown = bad(&mut host, "colour", Format::Rgba16Float, Usage::TEXTURE_BINDING);
    assert!(unknown.contains("`colour`") && unknown.contains("noisy_radiance"), "{unknown}");
    assert!(host.denoiser.output("depth").is_none() && host.denoiser.output("colour").is_none());
    assert_valid();
}

fn a_slot_that_was_not_submitted_is_refused() {
    let mut host = Host::new();
    host.draw(|_| true);
    let params = FrameParams::new(EXTENT);
    let mut held = Vec::new();
    for _ in 0..2 {
        let frame = host.denoiser.begin_frame(&params, &Tuning::default()).expect("a frame");
        for phase in Phase::ALL {
            // SAFETY: submitted below, in this order.
            held.push(unsafe { host.denoiser.encode(&frame, phase) }.expect("encoded"));
        }
    }
    let refused = host.denoiser.begin_frame(&params, &Tuning::default()).expect_err("both slots are taken");
    assert!(matches!(refused, Error::NotSubmitted { slot: 0 }), "{refused}");
    host.queue.submit(held.into_iter().flatten());
    host.denoiser.begin_frame(&params, &Tuning::default()).expect("a slot that is free again");
    drop(host);
    assert_valid();
}

fn another_extent_makes_outputs_anew() {
    let mut host = Host::new();
    host.frame();
    host.denoiser.resize([EXTENT[0] / 2, EXTENT[1]]).expect("another extent");
    let size = host.denoiser.output("denoised_radiance").expect("an output").size();
    assert_eq!([size.width, size.height], [EXTENT[0] / 2, EXTENT[1]]);
    let params = FrameParams::new([EXTENT[0] / 2, EXTENT[1]]);
    let missing = host.denoiser.begin_frame(&params, &Tuning::default()).expect_err("inputs are given again").to_string();
    assert!(missing.contains("`depth`"), "{missing}");
    keep(host.denoiser.output("denoised_radiance"));
    host.denoiser.resize(EXTENT).expect("another extent");
    keep(host.denoiser.output("denoised_radiance"));
    for (name, texture, _) in host.inputs.clone() {
        host.denoiser.set_input(name, &texture).expect(name);
    }
    let frame = host.denoiser.begin_frame(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
    assert_eq!(frame.reset, Some(ResetReason::Resize));
    drop(host);
    assert_valid();
}

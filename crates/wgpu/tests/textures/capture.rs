//! Captures of textures of wgpu, replayed by the tool.

use super::host::{assert_valid, keep, texture, Host};
use atrous_denoise::backend::{Backend, Passes};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{frame, frame_files};
use atrous_harness::DeviceTest;
use std::path::Path;
use wgpu::{TextureFormat as Format, TextureUsages as Usage};

pub const TESTS: &[DeviceTest] = &[
    ("a_replay_has_the_live_bits", a_replay_has_the_live_bits),
    ("a_texture_that_cannot_be_copied_is_named", a_texture_that_cannot_be_copied_is_named),
];

const FRAMES: u32 = 3;

/// RGB of the frames of a folder, filtered by the tool on the GPU.
fn replay(folder: &Path) -> Vec<Vec<[f32; 3]>> {
    let files = frame_files::find(&[folder.to_owned()]).expect("frames");
    let setup = Setup::new(&files, &Options::default()).expect("a set-up");
    let mut passes = Passes::gpu(None, &setup.config).expect("a device");
    let frames = files.iter().map(|file| frame::load(file, &setup).expect("a frame"));
    frames.map(|frame| passes.denoise(&frame, false).expect("a picture").radiance).collect()
}

/// Each frame has a light of its own, so that one frame's texels in another's file would show.
fn a_replay_has_the_live_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Host::new();
    host.denoiser.capture(folder.path(), FRAMES).expect("a capture");
    let mut live = Vec::new();
    for i in 0..FRAMES {
        let light = 0.5 + 0.37 * f64::from(i);
        host.inputs[3].2 = wgpu::Color { r: light, g: 0.5 * light, b: 0.25, a: 1.0 };
        host.frame();
        let half = |bytes: &[u8]| half::f16::from_le_bytes([bytes[0], bytes[1]]).to_f32();
        let rgb = |texel: &[u8]| [half(texel), half(&texel[2..]), half(&texel[4..])];
        live.push(host.result().chunks_exact(8).map(rgb).collect::<Vec<_>>());
    }
    assert_eq!(host.denoiser.finish_capture().expect("written"), FRAMES);
    assert_eq!(host.denoiser.frames_to_capture(), 0);
    assert_eq!(replay(folder.path()), live);
    drop(host);
    assert_valid();
}

fn a_texture_that_cannot_be_copied_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Host::new();
    let unreadable = texture(&host.device, Format::R32Float, Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT);
    keep(Some(&unreadable));
    let depth = host.inputs[0].1.clone();
    host.denoiser.set_input("depth", &unreadable).expect("an input");
    let refused = host.denoiser.capture(folder.path(), FRAMES).expect_err("refused").to_string();
    assert!(refused.contains("`depth`") && refused.contains("COPY_SRC"), "{refused}");
    host.denoiser.set_input("depth", &depth).expect("an input");
    host.denoiser.capture(folder.path(), FRAMES).expect("a capture");
    let refused = host.denoiser.set_input("depth", &unreadable).expect_err("refused").to_string();
    assert!(refused.contains("`depth`") && refused.contains("COPY_SRC"), "{refused}");
    drop(host);
    assert_valid();
}

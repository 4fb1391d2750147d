//! Bevy's Solari without a window, denoised: a closed room with a lamp, matte, glossy and metal balls, and a camera that moves.
//!
//! It prints the errors of noisy and denoised pictures against the mean of many frames of Solari, and writes them beside each other:
//! `cargo run -- FOLDER`.

mod scene;

use bevy::prelude::*;
use bevy::solari::prelude::SolariPlugins;
use bevy_atrous::{Capture, DenoisePlugin};
use host_bevy::{denoiser, difference, headless, print_replay, readback, shown, Pictures, Result};
use scene::{Captured, Frame, Target, EXTENT};
use std::path::PathBuf;

/// Frames in which the camera moves.
const FRAMES: u32 = 24;
/// Frames at the last place of the camera, whose mean is the reference.
const REFERENCE: u32 = 128;

fn noisy(app: &mut App) -> Result<Vec<[f32; 3]>> {
    let (world, view) = denoiser(app)?;
    readback::radiance(world, &view.noisy)
}

fn main() -> Result<()> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let mut app = headless();
    let captured = tempfile::tempdir()?;
    app.insert_resource(Captured(Capture { folder: captured.path().to_owned(), frames: FRAMES }));
    app.add_plugins((SolariPlugins, DenoisePlugin, scene::ScenePlugin));
    app.finish();
    app.cleanup();
    for time in 0..FRAMES {
        app.world_mut().resource_mut::<Frame>().0 = time;
        app.update();
    }
    let light = noisy(&mut app)?;
    let (world, view) = denoiser(&mut app)?;
    let denoised = readback::radiance(world, view.denoised().ok_or("no output")?)?;
    let target = app.world().resource::<Target>().0.clone();
    let shown = shown(&app, &target)?;
    println!("Bevy shows the denoised picture, off by at most {} of 255", difference(&shown, &denoised));

    let mut reference = vec![[0.0; 3]; light.len()];
    for _ in 0..REFERENCE {
        app.update();
        let light = noisy(&mut app)?;
        reference.iter_mut().flatten().zip(light.iter().flatten()).for_each(|(mean, light)| *mean += light / REFERENCE as f32);
    }
    print_replay(captured.path(), &denoised)?;
    let pictures = Pictures { extent: EXTENT, noisy: &light, denoised: &denoised, reference: &reference, shown };
    pictures.report("Bevy's Solari", &format!("mean of {REFERENCE} frames"), folder.map(|folder| (folder, "solari")))
}

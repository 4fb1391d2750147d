//! Bevy's Solari without a window, denoised: a closed room with a lamp, matte, glossy and metal balls, and a camera that moves.
//!
//! It prints the errors of noisy and denoised pictures against the mean of many frames of Solari, and writes them beside each other:
//! `cargo run -- FOLDER`.

mod scene;

use atrous_lab::pictures::{Picture, Strip};
use bevy::prelude::*;
use bevy::render::render_asset::RenderAssets;
use bevy::render::texture::GpuImage;
use bevy::render::RenderApp;
use bevy::solari::prelude::SolariPlugins;
use bevy_atrous::{Capture, DenoisePlugin};
use host_bevy::{denoiser, difference, headless, picture, print_replay, readback, rmse, Result};
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
    let world = app.sub_app(RenderApp).world();
    let image = world.resource::<RenderAssets<GpuImage>>().get(&target).ok_or("no target")?;
    let shown: Vec<[u8; 3]> = readback::texture(world, &image.texture)?.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect();
    println!("Bevy shows the denoised picture, off by at most {} of 255", difference(&shown, &denoised));

    let mut reference = vec![[0.0; 3]; light.len()];
    for _ in 0..REFERENCE {
        app.update();
        let light = noisy(&mut app)?;
        reference.iter_mut().flatten().zip(light.iter().flatten()).for_each(|(mean, light)| *mean += light / REFERENCE as f32);
    }
    print_replay(captured.path(), &denoised)?;
    let errors = [rmse(&light, &reference), rmse(&denoised, &reference)];
    println!("RMSE noisy {:.4}\nRMSE denoised {:.4}", errors[0], errors[1]);
    if let Some(folder) = folder {
        std::fs::create_dir_all(&folder)?;
        let strip = Strip::new("Bevy's Solari")
            .panel(format!("noisy\nRMSE {:.4}", errors[0]), picture(EXTENT, &light)?)
            .panel(format!("denoised\nRMSE {:.4}", errors[1]), picture(EXTENT, &denoised)?)
            .panel(format!("reference\nmean of {REFERENCE} frames"), picture(EXTENT, &reference)?);
        strip.render()?.write_png(folder.join("solari.png"))?;
        Picture::from_pixels(EXTENT[0], EXTENT[1], shown)?.write_png(folder.join("solari_shown.png"))?;
    }
    Ok(())
}

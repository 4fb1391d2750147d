//! What programs of Bevy without a window share: an app that draws when it is told to, textures as numbers, and errors.

pub mod readback;

use atrous_denoise::backend::{Backend, Passes};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{frame, frame_files};
use atrous_lab::pictures::{Picture, Strip};
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::render_asset::RenderAssets;
use bevy::render::settings::{Backends, InstanceFlags, RenderCreation, WgpuSettings};
use bevy::render::texture::GpuImage;
use bevy::render::{RenderApp, RenderPlugin};
use bevy::window::ExitCondition;
use bevy_atrous::ViewDenoiser;
use std::path::{Path, PathBuf};

/// As Bevy's systems fail.
pub type Result<T> = std::result::Result<T, BevyError>;

/// Bevy's plugins without a window, on Vulkan. Pipelines are ready in the first frame.
pub fn headless() -> App {
    let settings = WgpuSettings {
        backends: Some(Backends::VULKAN),
        // Validation is switched on from outside, or not at all.
        instance_flags: InstanceFlags::empty(),
        ..default()
    };
    let render = RenderPlugin {
        render_creation: RenderCreation::Automatic(Box::new(settings)),
        synchronous_pipeline_compilation: true,
        ..default()
    };
    let window = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    let mut app = App::new();
    app.add_plugins(DefaultPlugins.set(render).set(window).disable::<LogPlugin>());
    app
}

/// The denoiser of the only camera.
pub fn denoiser(app: &mut App) -> Result<(&World, &ViewDenoiser)> {
    let world = app.sub_app_mut(RenderApp).world_mut();
    let entity = world.query_filtered::<Entity, With<ViewDenoiser>>().single(world)?;
    let world: &World = world;
    Ok((world, world.get(entity).ok_or("no denoiser")?))
}

/// Root of the mean square error.
fn rmse(image: &[[f32; 3]], reference: &[[f32; 3]]) -> f64 {
    let squares = image.iter().flatten().zip(reference.iter().flatten()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / (3 * reference.len()) as f64).sqrt()
}

/// The largest difference between what Bevy shows and a picture without tone mapping.
pub fn difference(shown: &[[u8; 3]], radiance: &[[f32; 3]]) -> u8 {
    let encode = |linear: f32| {
        let x = linear.clamp(0.0, 1.0);
        let curve = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        (255.0 * curve).round() as u8
    };
    let pairs = shown.iter().flatten().zip(radiance.iter().flatten());
    pairs.map(|(shown, linear)| shown.abs_diff(encode(*linear))).max().unwrap_or(u8::MAX)
}

/// What Bevy shows in a texture.
pub fn shown(app: &App, target: &Handle<Image>) -> Result<Vec<[u8; 3]>> {
    let world = app.sub_app(RenderApp).world();
    let image = world.resource::<RenderAssets<GpuImage>>().get(target).ok_or("no target")?;
    Ok(readback::texture(world, &image.texture)?.chunks_exact(4).map(|p| [p[0], p[1], p[2]]).collect())
}

/// A frame before and after the denoiser, and what both are measured against.
pub struct Pictures<'a> {
    /// Width and height.
    pub extent: [u32; 2],
    /// As it was traced.
    pub noisy: &'a [[f32; 3]],
    /// As it came out.
    pub denoised: &'a [[f32; 3]],
    /// As it would be with many paths.
    pub reference: &'a [[f32; 3]],
    /// As Bevy shows it.
    pub shown: Vec<[u8; 3]>,
}

impl Pictures<'_> {
    /// Prints the errors, and writes the pictures beside each other into a folder, under a name.
    pub fn report(self, title: &str, of_reference: &str, to: Option<(PathBuf, &str)>) -> Result<()> {
        let Self { extent, noisy, denoised, reference, shown } = self;
        let errors = [rmse(noisy, reference), rmse(denoised, reference)];
        println!("RMSE noisy {:.4}\nRMSE denoised {:.4}", errors[0], errors[1]);
        let Some((folder, name)) = to else { return Ok(()) };
        std::fs::create_dir_all(&folder)?;
        let strip = Strip::new(title)
            .panel(format!("noisy\nRMSE {:.4}", errors[0]), picture(extent, noisy)?)
            .panel(format!("denoised\nRMSE {:.4}", errors[1]), picture(extent, denoised)?)
            .panel(format!("reference\n{of_reference}"), picture(extent, reference)?);
        strip.render()?.write_png(folder.join(format!("{name}.png")))?;
        Picture::from_pixels(extent[0], extent[1], shown)?.write_png(folder.join(format!("{name}_shown.png")))?;
        Ok(())
    }
}

/// A picture of linear colours without exposure.
fn picture([width, height]: [u32; 2], radiance: &[[f32; 3]]) -> Result<Picture> {
    Ok(Picture::from_linear(width, height, radiance, 1.0)?)
}

/// The last frame of a capture, as `atrous-denoise` filters it.
fn replay(folder: &Path) -> Result<Vec<[f32; 3]>> {
    let files = frame_files::find(&[folder.to_owned()])?;
    let setup = Setup::new(&files, &Options::default())?;
    let mut passes = Passes::gpu(None, &setup.config)?;
    let mut last = Vec::new();
    for file in &files {
        last = passes.denoise(&frame::load(file, &setup)?, false)?.radiance;
    }
    Ok(last)
}

/// Says in how many pixels the replay of a capture is what was shown.
pub fn print_replay(folder: &Path, denoised: &[[f32; 3]]) -> Result<()> {
    let replayed = replay(folder)?;
    let alike = replayed.iter().zip(denoised).filter(|(a, b)| a == b).count();
    println!("replayed by atrous-denoise: {alike} of {} pixels have the same bits", denoised.len());
    Ok(())
}

//! The denoisers of `atrous` as a plugin of Bevy: behind Solari as it is, or behind a path tracer of your own.
//!
//! ```no_run
//! # use bevy::prelude::*;
//! use bevy_atrous::{Denoise, DenoisePlugin, Source};
//!
//! # let mut app = App::new();
//! app.add_plugins(DenoisePlugin);
//! # fn spawn(mut commands: Commands) {
//! // Beside `SolariLighting`, whose light is in the main texture of the camera:
//! commands.spawn((Camera3d::default(), Denoise { source: Source::MainTexture, ..default() }));
//! # }
//! ```
//!
//! Guides are Bevy's prepass as it is. Normals, albedo and roughness come from the deferred G-buffer, where the camera has one: with
//! the roughness, reflections are followed where they move (`Signals::Mixed`).

mod shaders;
mod view;

pub use view::{conventions, DenoiseSystems, ViewDenoiser};

use atrous::config::Preset;
use atrous::{DebugView, Tuning};
use bevy::camera::{CameraMainTextureUsages, Hdr};
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass, MotionVectorPrepass};
use bevy::core_pipeline::{Core3d, Core3dSystems};
use bevy::ecs::lifecycle::HookContext;
use bevy::ecs::world::DeferredWorld;
use bevy::prelude::*;
use bevy::render::sync_world::RenderEntity;
use bevy::render::{ExtractSchedule, MainWorld, Render, RenderApp, RenderSystems};
use std::path::PathBuf;
use wgpu::TextureUsages;

/// Where the noisy light of a camera is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Source {
    /// Your path tracer writes it into [`ViewDenoiser::noisy`], in [`DenoiseSystems::PathTrace`].
    #[default]
    PathTracer,
    /// It is in the main texture of the camera, as Solari leaves it: copied from there behind [`Core3dSystems::MainPass`].
    MainTexture,
}

/// Denoises what this camera shows. It has a prepass of normals (`NormalPrepass`) or the deferred G-buffer (`DeferredPrepass`, as
/// `SolariLighting` has), and its viewport is the whole target.
#[derive(Component, Clone, Debug, Default)]
#[require(Hdr, DepthPrepass, MotionVectorPrepass, Msaa, CameraMainTextureUsages)]
#[component(on_add = prepare_camera)]
pub struct Denoise {
    /// The filter. Default: [`Preset::Best`].
    pub preset: Preset,
    /// Its numbers. `None`: those of the preset.
    pub tuning: Option<Tuning>,
    /// Where the noisy light is. Default: [`Source::PathTracer`].
    pub source: Source,
    /// Shows this instead of the picture, where the preset has it.
    pub debug_view: Option<DebugView>,
    /// Drops the history in the next frame: set it at a cut of the camera. The plugin takes it back.
    pub reset: bool,
    /// Writes the inputs of the next frames for a report: set it once. The plugin takes it back.
    pub capture: Option<Capture>,
}

/// A folder that `atrous-denoise FOLDER` replays. With `reset` in the same frame the replay has the bits of what you saw.
#[derive(Clone, Debug)]
pub struct Capture {
    /// Is made where there is none; it holds no other capture.
    pub folder: PathBuf,
    /// As many files, the last of which are written while the frames behind are drawn. What goes wrong stands in the log.
    pub frames: u32,
}

/// Usages of a camera's main texture, which the denoiser reads and writes. [`Denoise`] adds them to its camera, and switches
/// multisampling off.
pub fn main_texture_usages() -> TextureUsages {
    TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC | TextureUsages::COPY_DST
}

/// A camera has components of its own by default, which go before those that are required here.
fn prepare_camera(mut world: DeferredWorld, context: HookContext) {
    if let Some(mut usages) = world.get_mut::<CameraMainTextureUsages>(context.entity) {
        usages.0 |= main_texture_usages();
    }
    if let Some(mut msaa) = world.get_mut::<Msaa>(context.entity) {
        *msaa = Msaa::Off;
    }
}

/// The camera has the deferred G-buffer, in the render world.
#[derive(Component)]
struct Deferred;

/// See [`Denoise`].
pub struct DenoisePlugin;

impl Plugin for DenoisePlugin {
    fn build(&self, app: &mut App) {
        #[cfg(feature = "solari")]
        app.add_systems(PostUpdate, follow_solari);
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        let order = (DenoiseSystems::Import, DenoiseSystems::PathTrace, DenoiseSystems::Filter).chain();
        render_app
            .add_systems(ExtractSchedule, extract)
            .add_systems(Render, view::prepare.in_set(RenderSystems::PrepareResources))
            .configure_sets(Core3d, order.after(Core3dSystems::MainPass).before(Core3dSystems::PostProcess))
            .add_systems(Core3d, (view::import.in_set(DenoiseSystems::Import), view::filter.in_set(DenoiseSystems::Filter)));
    }

    fn finish(&self, app: &mut App) {
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        shaders::Shaders::insert(render_app.world_mut());
    }
}

fn extract(mut main_world: ResMut<MainWorld>, mut commands: Commands) {
    let mut cameras = main_world.query::<(RenderEntity, &Camera, Has<DeferredPrepass>, Option<&mut Denoise>)>();
    for (entity, camera, is_deferred, denoise) in cameras.iter_mut(&mut main_world) {
        let Ok(mut rendered) = commands.get_entity(entity) else { continue };
        match denoise.filter(|_| camera.is_active) {
            Some(mut denoise) => {
                rendered.insert(denoise.clone());
                match is_deferred {
                    true => rendered.insert(Deferred),
                    false => rendered.remove::<Deferred>(),
                };
                if denoise.reset || denoise.capture.is_some() {
                    (denoise.reset, denoise.capture) = (false, None);
                }
            }
            None => {
                rendered.remove::<(Denoise, Deferred, ViewDenoiser)>();
            }
        }
    }
}

/// Before Solari takes its own reset back, when it is extracted.
#[cfg(feature = "solari")]
fn follow_solari(mut cameras: Query<(&bevy::solari::prelude::SolariLighting, &mut Denoise)>) {
    for (solari, mut denoise) in &mut cameras {
        if solari.reset {
            denoise.reset = true;
        }
    }
}

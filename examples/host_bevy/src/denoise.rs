//! The plugin: what a path tracer wrote for a camera is denoised into the texture that Bevy goes on with.
//!
//! Guides are Bevy's prepass as it is; [`conventions`] says how it is encoded.

use atrous::config::{Config, Conventions, DepthEncoding, MotionDirection, NormalEncoding, Preset};
use atrous::{FrameContext, FrameParams, Phase, ResetReason, Tuning};
use atrous_wgpu::WgpuDenoiser;
use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::core_pipeline::{Core3d, Core3dSystems};
use bevy::math::{Mat4, Vec3};
use bevy::prelude::*;
use bevy::render::camera::TemporalJitter;
use bevy::render::extract_component::{ExtractComponent, ExtractComponentPlugin};
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{ExtractedView, ViewTarget};
use bevy::render::{Render, RenderApp, RenderSystems};
use wgpu::{TextureFormat, TextureUsages};

/// Denoises what a path tracer writes into [`ViewDenoiser::noisy`] of this camera. The camera has the prepasses of depth, normals and
/// motion vectors, [`Hdr`](bevy::camera::Hdr), [`Msaa::Off`] and [`main_texture_usages`], and its viewport is the whole target.
#[derive(Component, Clone, Copy, Default, ExtractComponent)]
#[extract_component_sync_target((Self, ViewDenoiser))]
#[extract_app(RenderApp)]
pub struct Denoise {
    /// Drops the history: set it for the one frame behind a cut of the camera.
    pub reset: bool,
}

/// What the denoiser needs of a camera's main texture, which it writes.
pub fn main_texture_usages() -> bevy::camera::CameraMainTextureUsages {
    bevy::camera::CameraMainTextureUsages::default().with(TextureUsages::STORAGE_BINDING)
}

/// The denoiser of a camera, in the render world.
#[derive(Component)]
pub struct ViewDenoiser {
    denoiser: WgpuDenoiser,
    frame: Option<FrameContext>,
    extent: [u32; 2],
    /// Linear radiance; a path tracer writes it in [`DenoiseSystems::PathTrace`].
    pub noisy: wgpu::Texture,
    /// Albedo of the surfaces; likewise.
    pub albedo: wgpu::Texture,
    /// Matrices of the frame.
    pub params: FrameParams,
}

/// The order of a frame, between Bevy's main pass and its post-processing.
#[derive(SystemSet, Clone, Debug, PartialEq, Eq, Hash)]
pub enum DenoiseSystems {
    /// The guides are read.
    Import,
    /// The path tracer of the host writes radiance and albedo.
    PathTrace,
    /// The radiance is denoised.
    Filter,
}

/// See [`Denoise`].
pub struct DenoisePlugin;

impl Plugin for DenoisePlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(ExtractComponentPlugin::<Denoise>::default());
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        let order = (DenoiseSystems::Import, DenoiseSystems::PathTrace, DenoiseSystems::Filter).chain();
        render_app
            .add_systems(Render, prepare.in_set(RenderSystems::PrepareResources))
            .configure_sets(Core3d, order.after(Core3dSystems::MainPass).before(Core3dSystems::PostProcess))
            .add_systems(Core3d, (import.in_set(DenoiseSystems::Import), filter.in_set(DenoiseSystems::Filter)));
    }
}

/// How Bevy encodes its prepass: a reversed, infinite depth buffer, world normals as v·0.5 + 0.5, and motion vectors that are this
/// frame's position minus the previous one's, in UV with y down, without jitter.
pub fn conventions() -> Conventions {
    Conventions {
        depth: DepthEncoding::Device,
        normal: NormalEncoding::XyzUnorm,
        motion_direction: MotionDirection::CurrentMinusPrevious,
        ..Conventions::default()
    }
}

/// The path tracer shades nothing again, so that the change test tells where light changes.
const PRESET: Preset = Preset::Best;

/// The prepass has no ids: edges are found by depth and normals.
fn config(extent: [u32; 2]) -> Config {
    Config { preset: PRESET, surface_id: false, conventions: conventions(), ..Config::new(extent) }
}

/// The matrices of a view, without jitter, and its jitter. y of Bevy's clip space points up, Vulkan's points down.
fn params(view: &ExtractedView, jitter: Option<&TemporalJitter>, extent: [u32; 2]) -> FrameParams {
    let clip_from_view = Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0)) * view.clip_from_view;
    FrameParams {
        view_from_world: view.world_from_view.to_matrix().inverse().to_cols_array_2d(),
        clip_from_view: clip_from_view.to_cols_array_2d(),
        jitter: jitter.map_or([0.0; 2], |jitter| jitter.offset.to_array()),
        ..FrameParams::new(extent)
    }
}

fn texture(device: &wgpu::Device, label: &str, [width, height]: [u32; 2], format: TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

impl ViewDenoiser {
    fn new(device: &wgpu::Device, extent: [u32; 2]) -> Result<Self, BevyError> {
        let mut denoiser = WgpuDenoiser::new(device, config(extent).declare()?)?;
        let noisy = texture(device, "noisy radiance", extent, TextureFormat::Rgba16Float);
        let albedo = texture(device, "albedo", extent, TextureFormat::Rgba8Unorm);
        denoiser.set_input("noisy_radiance", &noisy)?;
        denoiser.set_input("albedo", &albedo)?;
        Ok(Self { denoiser, frame: None, extent, noisy, albedo, params: FrameParams::new(extent) })
    }

    /// Where the last frame was denoised to.
    pub fn denoised(&self) -> Option<&wgpu::Texture> {
        self.denoiser.output("denoised_radiance")
    }
}

/// Makes a denoiser for each camera that asks for one, and anew where its size changed.
fn prepare(
    mut commands: Commands,
    device: Res<RenderDevice>,
    views: Query<(Entity, &ViewTarget, Option<&ViewDenoiser>), With<Denoise>>,
) -> Result<(), BevyError> {
    for (entity, target, known) in &views {
        let size = target.main_texture().size();
        let extent = [size.width, size.height];
        if known.is_none_or(|known| known.extent != extent) {
            commands.entity(entity).insert(ViewDenoiser::new(device.wgpu_device(), extent)?);
        }
    }
    Ok(())
}

/// What the denoiser takes of a camera.
type View = (
    &'static Denoise,
    &'static ExtractedView,
    Option<&'static TemporalJitter>,
    &'static ViewTarget,
    &'static ViewPrepassTextures,
    &'static mut ViewDenoiser,
);

/// The first phase, behind the prepass.
fn import(view: ViewQuery<View>, mut context: RenderContext) -> Result<(), BevyError> {
    let (asked, view, jitter, target, prepass, mut this) = view.into_inner();
    let this = &mut *this;
    let (Some(depth), Some(normal), Some(motion)) = (&prepass.depth, &prepass.normal, &prepass.motion_vectors) else {
        return Err("a camera with `Denoise` needs DepthPrepass, NormalPrepass and MotionVectorPrepass".into());
    };
    this.denoiser.set_input("depth", &depth.texture.texture)?;
    this.denoiser.set_input("normal", &normal.texture.texture)?;
    this.denoiser.set_input("motion", &motion.texture.texture)?;
    // Bevy takes one of two textures, and goes on with the one that the denoiser wrote.
    this.denoiser.set_output("denoised_radiance", target.main_texture())?;
    let reset = asked.reset.then_some(ResetReason::CameraCut);
    this.params = FrameParams { reset, ..params(view, jitter, this.extent) };
    let frame = this.denoiser.begin_frame(&this.params, &Tuning::for_preset(PRESET))?;
    this.frame = Some(frame);
    // SAFETY: Bevy submits what a system added in its order, once, and behind the prepass.
    let recorded = unsafe { this.denoiser.encode(&frame, Phase::BeforeLighting)? };
    recorded.into_iter().for_each(|buffer| context.add_command_buffer(buffer));
    Ok(())
}

/// The second phase, behind the path tracer.
fn filter(view: ViewQuery<&mut ViewDenoiser, With<Denoise>>, mut context: RenderContext) -> Result<(), BevyError> {
    let mut this = view.into_inner();
    let Some(frame) = this.frame.take() else { return Ok(()) };
    // SAFETY: as in `import`, behind the path tracer.
    let recorded = unsafe { this.denoiser.encode(&frame, Phase::AfterLighting)? };
    recorded.into_iter().for_each(|buffer| context.add_command_buffer(buffer));
    Ok(())
}

//! The denoiser of a camera in the render world, and its phases.

use crate::shaders::Shaders;
use crate::{Capture, Deferred, Denoise, Source};
use atrous::config::{Config, Conventions, DepthEncoding, MotionDirection, NormalEncoding, Preset, Signals};
use atrous::{FrameContext, FrameParams, Phase, ResetReason, Tuning};
use atrous_wgpu::WgpuDenoiser;
use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::math::{Mat4, Vec3};
use bevy::prelude::*;
use bevy::render::camera::TemporalJitter;
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{ExtractedView, ViewTarget};
use wgpu::{TextureFormat, TextureUsages};

/// The denoiser of a camera, in the render world.
#[derive(Component)]
pub struct ViewDenoiser {
    denoiser: WgpuDenoiser,
    frame: Option<FrameContext>,
    made_for: MadeFor,
    /// Linear radiance; a path tracer writes it in [`DenoiseSystems::PathTrace`]. `Rgba16Float`.
    pub noisy: wgpu::Texture,
    /// Linear albedo of the surfaces; likewise, unless the camera has the deferred G-buffer, which has that of the base here.
    /// `Rgba16Float`.
    pub albedo: wgpu::Texture,
    /// With the deferred G-buffer: normal, albedo of the specular lobe, roughness.
    unpacked: Option<[wgpu::Texture; 3]>,
    /// Of depth, normal and motion, while they are captured.
    copies: Option<[wgpu::Texture; 3]>,
    /// Matrices of the frame.
    pub params: FrameParams,
}

/// The order of a frame, between Bevy's main pass and its post-processing.
#[derive(SystemSet, Clone, Debug, PartialEq, Eq, Hash)]
pub enum DenoiseSystems {
    /// The guides are read.
    Import,
    /// The path tracer of the host writes radiance, and albedo where there is no deferred G-buffer.
    PathTrace,
    /// The radiance is denoised into the main texture.
    Filter,
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

/// A change of any of these asks for another denoiser.
#[derive(Clone, Copy, PartialEq)]
struct MadeFor {
    extent: [u32; 2],
    preset: Preset,
    shows_views: bool,
    /// The roughness of the deferred G-buffer tells what is mirrored in the light of both lobes.
    has_roughness: bool,
}

impl MadeFor {
    /// The prepass has no ids: edges are found by depth and normals.
    fn config(self) -> Config {
        let Self { extent, preset, shows_views, has_roughness } = self;
        let signals = if has_roughness { Signals::Mixed } else { Signals::Together };
        Config { preset, signals, surface_id: false, conventions: conventions(), debug_view: shows_views, ..Config::new(extent) }
    }
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
        usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC | TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

impl ViewDenoiser {
    fn new(device: &wgpu::Device, made_for: MadeFor) -> Result<Self, BevyError> {
        let extent = made_for.extent;
        let mut denoiser = WgpuDenoiser::new(device, made_for.config().declare()?)?;
        let [noisy, albedo] = ["noisy radiance", "albedo"].map(|label| texture(device, label, extent, TextureFormat::Rgba16Float));
        denoiser.set_input("noisy_radiance", &noisy)?;
        denoiser.set_input("albedo", &albedo)?;
        let unpacked = made_for.has_roughness.then(|| {
            let formats = [TextureFormat::Rgba16Float, TextureFormat::Rgba16Float, TextureFormat::R32Float];
            formats.map(|format| texture(device, "unpacked G-buffer", extent, format))
        });
        if let Some([_, specular, roughness]) = &unpacked {
            denoiser.set_input("specular_albedo", specular)?;
            denoiser.set_input("roughness", roughness)?;
        }
        Ok(Self { denoiser, frame: None, made_for, noisy, albedo, unpacked, copies: None, params: FrameParams::new(extent) })
    }

    /// Gives the guides of the prepass to the denoiser: those of the deferred G-buffer unpacked, and all as copies while they are
    /// captured.
    fn set_guides(
        &mut self,
        prepass: &ViewPrepassTextures,
        shaders: &Shaders,
        context: &mut RenderContext,
        is_captured: bool,
    ) -> Result<(), BevyError> {
        let (Some(depth), Some(depth_view), Some(motion)) = (&prepass.depth, prepass.depth_only_view(), &prepass.motion_vectors)
        else {
            return Err("a camera with `Denoise` needs DepthPrepass and MotionVectorPrepass".into());
        };
        let (device, extent) = (context.render_device().wgpu_device().clone(), self.made_for.extent);
        let normal = match (prepass.deferred_view(), &self.unpacked, &prepass.normal) {
            (Some(gbuffer), Some([normal, specular, roughness]), _) => {
                let written = [&self.albedo, normal, specular, roughness];
                shaders.unpack(&device, context.command_encoder(), [gbuffer, depth_view], written);
                normal
            }
            (_, None, Some(normal)) => &normal.texture.texture,
            _ => return Err("a camera with `Denoise` needs NormalPrepass or DeferredPrepass".into()),
        };
        let guides = [("depth", &*depth.texture.texture), ("normal", normal), ("motion", &*motion.texture.texture)];
        if !is_captured && self.denoiser.frames_to_capture() == 0 {
            self.copies = None;
            return guides.into_iter().try_for_each(|(name, texture)| Ok(self.denoiser.set_input(name, texture)?));
        }
        let formats = [TextureFormat::R32Float, TextureFormat::Rgba32Float, TextureFormat::Rgba16Float];
        let copies =
            self.copies.get_or_insert_with(|| formats.map(|format| texture(&device, "copy of the prepass", extent, format)));
        let [normal, motion] = [normal, guides[2].1].map(|texture| texture.create_view(&default()));
        shaders.copy(&device, context.command_encoder(), [depth_view, &normal, &motion], copies.each_ref());
        guides.iter().zip(copies).try_for_each(|((name, _), copy)| Ok(self.denoiser.set_input(name, copy)?))
    }

    /// Where the last frame was denoised to.
    pub fn denoised(&self) -> Option<&wgpu::Texture> {
        self.denoiser.output("denoised_radiance")
    }
}

/// A camera that asks for a denoiser, and the one that it has.
type Asking = (Entity, &'static Denoise, &'static ExtractedView, &'static ViewTarget, Has<Deferred>, Option<&'static ViewDenoiser>);

/// Makes a denoiser for each camera that asks for one, and anew where its size, its preset or the wish for views changed.
pub fn prepare(mut commands: Commands, device: Res<RenderDevice>, views: Query<Asking>) -> Result<(), BevyError> {
    for (entity, asked, view, target, has_roughness, known) in &views {
        let texture = target.main_texture();
        let (size, usage) = (texture.size(), texture.usage());
        let needed = crate::main_texture_usages();
        if !usage.contains(needed) {
            return Err(format!(
                "the main texture of a camera with `Denoise` lacks usages: {:?}; add them to its CameraMainTextureUsages",
                needed.difference(usage)
            )
            .into());
        }
        if view.viewport != UVec4::new(0, 0, size.width, size.height) {
            return Err(format!(
                "the viewport of a camera with `Denoise` is {}, and its target {}x{}: give it the whole target",
                view.viewport, size.width, size.height
            )
            .into());
        }
        let extent = [size.width, size.height];
        let made_for = MadeFor { extent, preset: asked.preset, shows_views: asked.debug_view.is_some(), has_roughness };
        if known.is_none_or(|known| known.made_for != made_for) {
            commands.entity(entity).insert(ViewDenoiser::new(device.wgpu_device(), made_for)?);
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
pub fn import(view: ViewQuery<View>, shaders: Res<Shaders>, mut context: RenderContext) -> Result<(), BevyError> {
    let (asked, view, jitter, target, prepass, mut this) = view.into_inner();
    let this = &mut *this;
    this.set_guides(prepass, &shaders, &mut context, asked.capture.is_some())?;
    // Bevy takes one of two textures, and goes on with the one that the denoiser wrote.
    this.denoiser.set_output("denoised_radiance", target.main_texture())?;
    if let Some(Capture { folder, frames }) = &asked.capture {
        if let Err(error) = this.denoiser.capture(folder, *frames) {
            log::error!("nothing is captured: {error}");
        }
    }
    let reset = asked.reset.then_some(ResetReason::CameraCut);
    let params = params(view, jitter, this.made_for.extent);
    this.params = FrameParams { reset, debug_view: asked.debug_view, ..params };
    let tuning = asked.tuning.unwrap_or_else(|| Tuning::for_preset(asked.preset));
    let frame = this.denoiser.begin_frame(&this.params, &tuning)?;
    this.frame = Some(frame);
    // SAFETY: Bevy submits what a system added in its order, once, and behind the prepass.
    let recorded = unsafe { this.denoiser.encode(&frame, Phase::BeforeLighting)? };
    recorded.into_iter().for_each(|buffer| context.add_command_buffer(buffer));
    Ok(())
}

/// The second phase, behind the path tracer, and the view if one is asked for.
pub fn filter(view: ViewQuery<(&Denoise, &ViewTarget, &mut ViewDenoiser)>, mut context: RenderContext) -> Result<(), BevyError> {
    let (asked, target, mut this) = view.into_inner();
    let Some(frame) = this.frame.take() else { return Ok(()) };
    let copy = |encoder: &mut wgpu::CommandEncoder, from: &wgpu::Texture, to: &wgpu::Texture| {
        encoder.copy_texture_to_texture(from.as_image_copy(), to.as_image_copy(), from.size());
    };
    if asked.source == Source::MainTexture {
        copy(context.command_encoder(), target.main_texture(), &this.noisy);
    }
    let views: &[Phase] = if this.made_for.shows_views { &[Phase::PostProcess] } else { &[] };
    for phase in [Phase::AfterLighting].iter().chain(views) {
        // SAFETY: as in `import`, behind the path tracer.
        let recorded = unsafe { this.denoiser.encode(&frame, *phase)? };
        recorded.into_iter().for_each(|buffer| context.add_command_buffer(buffer));
    }
    if let Some(shown) = this.denoiser.output("debug_view").filter(|_| asked.debug_view.is_some()) {
        copy(context.command_encoder(), shown, target.main_texture());
    }
    Ok(())
}

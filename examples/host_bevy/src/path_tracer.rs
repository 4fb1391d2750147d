//! A path tracer of the host: it takes its primary surfaces from Bevy's prepass.

use crate::scene::{LikeSolari, Scene, LIGHT, SPHERES};
use bevy::core_pipeline::prepass::ViewPrepassTextures;
use bevy::core_pipeline::Core3d;
use bevy::math::Vec4Swizzles;
use bevy::prelude::*;
use bevy::render::camera::TemporalJitter;
use bevy::render::renderer::{RenderContext, RenderDevice, ViewQuery};
use bevy::render::view::{ExtractedView, ViewTarget};
use bevy::render::{Extract, ExtractSchedule, RenderApp};
use bevy_atrous::{DenoiseSystems, ViewDenoiser};
use wgpu::util::DeviceExt;

/// Writes the noisy radiance of each camera that is denoised.
pub struct PathTracerPlugin;

impl Plugin for PathTracerPlugin {
    fn build(&self, app: &mut App) {
        let like_solari = *app.world().resource::<LikeSolari>();
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .insert_resource(Scene::default())
            .insert_resource(like_solari)
            .add_systems(ExtractSchedule, |scene: Extract<Res<Scene>>, mut rendered: ResMut<Scene>| *rendered = scene.clone())
            .add_systems(Core3d, trace.in_set(DenoiseSystems::PathTrace));
    }

    fn finish(&self, app: &mut App) {
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        let pipeline = PathTracer::new(render_app.world().resource::<RenderDevice>().wgpu_device());
        render_app.insert_resource(pipeline);
    }
}

#[derive(Resource)]
struct PathTracer(wgpu::ComputePipeline);

/// What the path tracer wrote.
#[derive(Resource)]
pub struct Traced {
    /// Depth, normal and motion of each pixel, as the shader read them in the prepass.
    pub guides: wgpu::Buffer,
    /// Albedo.
    pub albedo: wgpu::Texture,
}

fn texture(device: &wgpu::Device, label: &str, size: wgpu::Extent3d) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

impl PathTracer {
    fn new(device: &wgpu::Device) -> Self {
        let source = wgpu::ShaderSource::Wgsl(include_str!("path_tracer.wgsl").into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("path tracer"), source });
        Self(device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("path tracer"),
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            cache: None,
        }))
    }
}

/// `Frame` of the shader.
fn constants(view: &ExtractedView, jitter: Option<&TemporalJitter>, scene: &Scene) -> Vec<u8> {
    let world_from_view = view.world_from_view.to_matrix();
    let mut clip_from_view = view.clip_from_view;
    if let Some(jitter) = jitter {
        jitter.jitter_projection(&mut clip_from_view, view.viewport.zw().as_vec2());
        // as the prepass is drawn
    }
    let mut words: Vec<u32> = Vec::new();
    let floats = |words: &mut Vec<u32>, values: &[f32]| words.extend(values.iter().map(|value| value.to_bits()));
    floats(&mut words, &(world_from_view * clip_from_view.inverse()).to_cols_array());
    floats(&mut words, &view.world_from_view.translation().extend(1.0).to_array());
    floats(&mut words, &LIGHT);
    words.extend([scene.index, scene.paths, 0, 0]);
    for (sphere, centre) in SPHERES.iter().zip(scene.centres()) {
        floats(&mut words, &centre.extend(sphere.radius).to_array());
        floats(&mut words, &[sphere.albedo[0], sphere.albedo[1], sphere.albedo[2], 0.0]);
    }
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn trace(
    view: ViewQuery<(&ExtractedView, Option<&TemporalJitter>, &ViewPrepassTextures, &ViewDenoiser, &ViewTarget)>,
    like_solari: Res<LikeSolari>,
    mut own: Local<Option<[wgpu::Texture; 2]>>,
    scene: Res<Scene>,
    tracer: Res<PathTracer>,
    mut commands: Commands,
    mut context: RenderContext,
) -> Result<(), BevyError> {
    let (view, jitter, prepass, denoiser, target) = view.into_inner();
    let (Some(depth), Some(normal), Some(motion)) =
        (prepass.depth_only_view(), prepass.normal_view(), prepass.motion_vectors_view())
    else {
        return Err("the path tracer needs DepthPrepass, NormalPrepass and MotionVectorPrepass".into());
    };
    let device = context.render_device().wgpu_device().clone();
    let size = denoiser.noisy.size();
    let contents = constants(view, jitter, &scene);
    let usage = wgpu::BufferUsages::UNIFORM;
    let constants = device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents: &contents, usage });
    let guides = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("guides"),
        size: u64::from(size.width * size.height) * 48,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    // As Solari, which knows of no denoiser: the light goes into the main texture, and the albedo nowhere.
    if like_solari.0 && own.is_none() {
        *own = Some(["light", "albedo"].map(|label| texture(&device, label, size)));
    }
    let [light, traced_albedo] = own.as_ref().map_or([&denoiser.noisy, &denoiser.albedo], |[light, albedo]| [light, albedo]);
    let (noisy, albedo) = (light.create_view(&default()), traced_albedo.create_view(&default()));
    let resources = [
        constants.as_entire_binding(),
        wgpu::BindingResource::TextureView(depth),
        wgpu::BindingResource::TextureView(normal),
        wgpu::BindingResource::TextureView(motion),
        wgpu::BindingResource::TextureView(&noisy),
        wgpu::BindingResource::TextureView(&albedo),
        guides.as_entire_binding(),
    ];
    let entries: Vec<_> =
        resources.into_iter().zip(0..).map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource }).collect();
    let layout = tracer.0.get_bind_group_layout(0);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut pass = context.command_encoder().begin_compute_pass(&default());
    pass.set_pipeline(&tracer.0);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(size.width.div_ceil(8), size.height.div_ceil(8), 1);
    drop(pass);
    if like_solari.0 {
        context.command_encoder().copy_texture_to_texture(light.as_image_copy(), target.main_texture().as_image_copy(), size);
    }
    commands.insert_resource(Traced { guides, albedo: traced_albedo.clone() });
    Ok(())
}

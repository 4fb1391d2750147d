//! The plugin's own shaders: albedo, roughness and normals from Bevy's deferred G-buffer, and copies of the prepass for captures.

use bevy::prelude::*;
use bevy::render::renderer::RenderDevice;
use wgpu::{BindGroupEntry, BindingResource, ComputePipeline, ShaderSource, Texture, TextureView};

/// Their pipelines.
#[derive(Resource)]
pub struct Shaders {
    unpack: ComputePipeline,
    copy: ComputePipeline,
}

impl Shaders {
    pub fn insert(world: &mut World) {
        let device = world.resource::<RenderDevice>().wgpu_device();
        let unpack = pipeline(device, "atrous: G-buffer", include_str!("gbuffer.wgsl"));
        let copy = pipeline(device, "atrous: copies of the prepass", include_str!("copies.wgsl"));
        world.insert_resource(Self { unpack, copy });
    }

    /// Writes of each pixel: linear albedo of the base; normal, xyz·0.5 + 0.5, world space; linear albedo of the specular lobe; perceptual
    /// roughness.
    pub fn unpack(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        [gbuffer, depth]: [&TextureView; 2],
        written: [&Texture; 4],
    ) {
        run(&self.unpack, device, encoder, &[gbuffer, depth], &written);
    }

    /// Writes depth, normal and motion as they are.
    pub fn copy(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        prepass: [&TextureView; 3],
        written: [&Texture; 3],
    ) {
        run(&self.copy, device, encoder, &prepass, &written);
    }
}

fn pipeline(device: &wgpu::Device, label: &str, source: &'static str) -> ComputePipeline {
    let (label, source) = (Some(label), ShaderSource::Wgsl(source.into()));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: default(),
        cache: None,
    })
}

/// Bindings are the textures that are read, then those that are written, of one size.
fn run(
    pipeline: &ComputePipeline,
    device: &wgpu::Device,
    encoder: &mut wgpu::CommandEncoder,
    read: &[&TextureView],
    written: &[&Texture],
) {
    let size = written[0].size();
    let written: Vec<TextureView> = written.iter().map(|texture| texture.create_view(&default())).collect();
    let views = read.iter().copied().chain(&written);
    let entries: Vec<_> =
        (0..).zip(views).map(|(binding, view)| BindGroupEntry { binding, resource: BindingResource::TextureView(view) }).collect();
    let layout = pipeline.get_bind_group_layout(0);
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut pass = encoder.begin_compute_pass(&default());
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(size.width.div_ceil(8), size.height.div_ceil(8), 1);
}

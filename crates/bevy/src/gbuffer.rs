//! Albedo and normals from Bevy's deferred G-buffer.

use bevy::prelude::*;
use bevy::render::renderer::RenderDevice;
use wgpu::{BindGroupEntry, BindingResource, ShaderSource, TextureView};

/// The pipeline that unpacks.
#[derive(Resource)]
pub struct Unpack(wgpu::ComputePipeline);

impl Unpack {
    pub fn insert(world: &mut World) {
        let device = world.resource::<RenderDevice>().wgpu_device();
        let source = ShaderSource::Wgsl(include_str!("gbuffer.wgsl").into());
        let label = Some("atrous: G-buffer");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: default(),
            cache: None,
        });
        world.insert_resource(Self(pipeline));
    }

    /// Writes albedo and normals of each pixel: linear; xyz·0.5 + 0.5, world space.
    pub fn record(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        [gbuffer, depth]: [&TextureView; 2],
        [albedo, normal]: [&wgpu::Texture; 2],
    ) {
        let size = albedo.size();
        let written = [albedo, normal].map(|texture| texture.create_view(&default()));
        let views = [gbuffer, depth, &written[0], &written[1]];
        let entries: Vec<_> = (0..).zip(views).map(|(binding, view)| entry(binding, view)).collect();
        let layout = self.0.get_bind_group_layout(0);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let mut pass = encoder.begin_compute_pass(&default());
        pass.set_pipeline(&self.0);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(size.width.div_ceil(8), size.height.div_ceil(8), 1);
    }
}

fn entry(binding: u32, view: &TextureView) -> BindGroupEntry<'_> {
    BindGroupEntry { binding, resource: BindingResource::TextureView(view) }
}

//! Outputs in textures of the host.

use super::host::{assert_valid, keep, of_session, texture, Host, EXTENT};
use atrous_harness::DeviceTest;
use wgpu::{TextureFormat as Format, TextureUsages as Usage};

pub const TESTS: &[DeviceTest] = &[
    ("a_texture_of_the_host_has_the_bits_from_the_first_frame_on", a_texture_of_the_host_has_the_bits_from_the_first_frame_on),
    ("passes_stand_before_and_behind_a_texture_of_the_host", passes_stand_before_and_behind_a_texture_of_the_host),
    ("what_does_not_fit_is_named", what_does_not_fit_is_named),
    ("after_a_resize_the_output_is_the_denoisers_own", after_a_resize_the_output_is_the_denoisers_own),
];

const OUTPUT: &str = "denoised_radiance";
const NEEDED: Usage = Usage::STORAGE_BINDING.union(Usage::TEXTURE_BINDING).union(Usage::COPY_SRC);

/// A pass that samples the output and writes what it found.
const COPY: &str = "
@group(0) @binding(0) var output: texture_2d<f32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    textureStore(copied, id.xy, textureLoad(output, id.xy, 0));
}
";

impl Host {
    fn output(&self, usage: Usage) -> wgpu::Texture {
        let texture = texture(&self.device, Format::Rgba16Float, usage);
        keep(Some(&texture));
        texture
    }

    fn copy_pipeline(&self) -> wgpu::ComputePipeline {
        // Not as text, which wgpu would write into the SPIR-V: older validation layers do not know that language.
        let module = naga::front::wgsl::parse_str(COPY).expect("valid WGSL");
        let source = wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module));
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            cache: None,
        })
    }

    /// What a pass behind the denoiser finds in a texture.
    fn sampled(&self, pipeline: &wgpu::ComputePipeline, texture: &wgpu::Texture) -> Vec<u8> {
        let target = self.output(Usage::STORAGE_BINDING | Usage::COPY_SRC);
        let views = [texture, &target].map(|texture| texture.create_view(&Default::default()));
        let entry = |i: usize| wgpu::BindGroupEntry { binding: i as u32, resource: wgpu::BindingResource::TextureView(&views[i]) };
        let layout = pipeline.get_bind_group_layout(0);
        let group = wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &[entry(0), entry(1)] };
        let group = self.device.create_bind_group(&group);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(EXTENT[0].div_ceil(8), EXTENT[1].div_ceil(8), 1);
        drop(pass);
        self.queue.submit([encoder.finish()]);
        self.texels(&target)
    }

    /// A render pass that fills a texture, and keeps that or not.
    fn fill(&self, texture: &wgpu::Texture, store: wgpu::StoreOp) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let view = texture.create_view(&Default::default());
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::GREEN), store };
        let colour = wgpu::RenderPassColorAttachment { view: &view, depth_slice: None, resolve_target: None, ops };
        drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor { color_attachments: &[Some(colour)], ..Default::default() }));
        self.queue.submit([encoder.finish()]);
    }
}

/// Two textures in turn, so that two frames are the first of a texture.
fn a_texture_of_the_host_has_the_bits_from_the_first_frame_on() {
    let mut host = Host::new();
    let textures = [host.output(NEEDED), host.output(NEEDED)];
    for (texture, frames) in textures.iter().cycle().zip(1..=5) {
        host.denoiser.set_output(OUTPUT, texture).expect("an output");
        assert_eq!(host.denoiser.output(OUTPUT), Some(texture));
        host.frame();
        assert_eq!(host.texels(texture), of_session(frames), "frame {frames}");
    }
    drop(host);
    assert_valid();
}

/// In every second frame wgpu does not keep what the pass before wrote, and would clear the texture at its next read.
fn passes_stand_before_and_behind_a_texture_of_the_host() {
    let mut host = Host::new();
    let (texture, pipeline) = (host.output(NEEDED | Usage::RENDER_ATTACHMENT), host.copy_pipeline());
    host.denoiser.set_output(OUTPUT, &texture).expect("an output");
    for frames in 1..=4 {
        if frames > 1 {
            host.fill(&texture, if frames % 2 == 0 { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store });
        }
        host.frame();
        assert_eq!(host.sampled(&pipeline, &texture), of_session(frames), "frame {frames}");
    }
    drop(host);
    assert_valid();
}

fn what_does_not_fit_is_named() {
    let mut host = Host::new();
    let own = host.denoiser.output(OUTPUT).cloned();
    let bad = |host: &mut Host, name: &str, texture: &wgpu::Texture, said: [&str; 3]| {
        let message = host.denoiser.set_output(name, texture).expect_err("refused").to_string();
        assert!(said.iter().all(|said| message.contains(said)), "{message}");
    };
    let made = |host: &Host, size: [u32; 3], dimension, mip_level_count, format, usage| {
        let size = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: size[2] };
        let (label, view_formats, sample_count) = (None, &[][..], 1);
        let descriptor =
            wgpu::TextureDescriptor { label, size, mip_level_count, sample_count, dimension, format, usage, view_formats };
        host.device.create_texture(&descriptor)
    };
    let ([width, height], d2, half) = (EXTENT, wgpu::TextureDimension::D2, Format::Rgba16Float);
    let fits = made(&host, [width, height, 1], d2, 1, half, NEEDED);

    let texture = made(&host, [width, height, 1], d2, 1, half, Usage::STORAGE_BINDING | Usage::COPY_SRC);
    bad(
        &mut host,
        OUTPUT,
        &texture,
        ["`denoised_radiance`", "its usage is TextureUsages(COPY_SRC | STORAGE_BINDING)", "needs TextureUsages(TEXTURE_BINDING)"],
    );
    let texture = made(&host, [width, height, 1], d2, 1, Format::Rgba32Float, NEEDED);
    bad(&mut host, OUTPUT, &texture, ["`denoised_radiance`", "R32G32B32A32_SFLOAT", "R16G16B16A16_SFLOAT"]);
    let texture = made(&host, [width, height - 1, 1], d2, 1, half, NEEDED);
    bad(&mut host, OUTPUT, &texture, ["`denoised_radiance`", "60x32 pixels", "60x33 pixels"]);
    let texture = made(&host, [width, height, 1], d2, 2, half, NEEDED);
    bad(&mut host, OUTPUT, &texture, ["`denoised_radiance`", "2 levels", "one of each"]);
    let texture = made(&host, [width, height, 2], d2, 1, half, NEEDED);
    bad(&mut host, OUTPUT, &texture, ["`denoised_radiance`", "2 layers", "one of each"]);
    let texture = made(&host, [width, height, 1], wgpu::TextureDimension::D3, 1, half, NEEDED);
    bad(&mut host, OUTPUT, &texture, ["`denoised_radiance`", "D3", "D2"]);
    bad(&mut host, "depth", &fits, ["`depth`", "no output", "WgpuDenoiser::set_input"]);
    bad(&mut host, "colour", &fits, ["`colour`", "denoised_radiance", ""]);
    host.denoiser.set_input("noisy_radiance", &fits).expect("an input");
    bad(&mut host, OUTPUT, &fits, ["`denoised_radiance`", "`noisy_radiance`", "a texture of its own"]);

    assert_eq!(host.denoiser.output(OUTPUT), own.as_ref(), "what was refused replaces nothing");
    assert_valid();
}

fn after_a_resize_the_output_is_the_denoisers_own() {
    let mut host = Host::new();
    let texture = host.output(NEEDED);
    host.denoiser.set_output(OUTPUT, &texture).expect("an output");
    host.frame();
    host.denoiser.resize([EXTENT[0] * 2, EXTENT[1]]).expect("another extent");
    let own = host.denoiser.output(OUTPUT).expect("an output").clone();
    keep(Some(&own));
    assert_eq!([own.width(), own.height()], [EXTENT[0] * 2, EXTENT[1]]);
    let refused = host.denoiser.set_output(OUTPUT, &texture).expect_err("too small now").to_string();
    assert!(refused.contains("60x33 pixels") && refused.contains("120x33 pixels"), "{refused}");
    drop(host);
    assert_valid();
}

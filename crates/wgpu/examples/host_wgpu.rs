//! A wgpu program with the denoiser between its own passes: copies into the guides before, a copy out of the result behind.
//!
//! Prints a checksum of every denoised frame: `cargo run -p atrous-wgpu --example host_wgpu`.

use atrous::{Config, FrameParams, Phase, Tuning};
use atrous_synthetic as synthetic;
use atrous_wgpu::WgpuDenoiser;
use std::future::Future;
use std::task::{Context, Poll, Waker};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const EXTENT: wgpu::Extent3d =
    wgpu::Extent3d { width: synthetic::EXTENT[0], height: synthetic::EXTENT[1], depth_or_array_layers: 1 };
/// Bytes of a row of the result in a buffer, which wgpu wants aligned.
const ROW: u32 = (EXTENT.width * 8).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);

/// The outcome of a future that is ready at once, as all of wgpu's are on Vulkan.
fn now<T>(future: impl Future<Output = T>) -> Result<T> {
    match std::pin::pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(outcome) => Ok(outcome),
        Poll::Pending => Err("the future is not ready".into()),
    }
}

struct Host {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Inputs by name, and their bytes per texel.
    inputs: Vec<(&'static str, wgpu::Texture, u32)>,
    result: wgpu::Buffer,
    denoiser: WgpuDenoiser,
}

impl Host {
    fn new() -> Result<Self> {
        let descriptor = wgpu::InstanceDescriptor {
            backends: wgpu::Backends::VULKAN,
            flags: wgpu::InstanceFlags::empty(),
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        };
        let adapter = now(wgpu::Instance::new(descriptor).request_adapter(&Default::default()))??;
        let (device, queue) = now(adapter.request_device(&Default::default()))??;
        let size = u64::from(ROW * EXTENT.height);
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let result = device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
        // The denoiser: everything that it has is made here.
        let mut denoiser = WgpuDenoiser::new(&device, Config::new(synthetic::EXTENT).declare()?)?;
        let mut inputs = Vec::new();
        for name in synthetic::NAMES.into_iter().chain(["surface_id"]) {
            let is_id = name == "surface_id";
            let format = if is_id { wgpu::TextureFormat::R32Uint } else { wgpu::TextureFormat::Rgba32Float };
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(name),
                size: EXTENT,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            denoiser.set_input(name, &texture)?;
            inputs.push((name, texture, if is_id { 4 } else { 16 }));
        }
        Ok(Self { device, queue, inputs, result, denoiser })
    }

    fn frame(&mut self, index: u32) -> Result<Vec<u8>> {
        let input = synthetic::Frame::new(index);
        let (view_from_world, clip_from_view) = (synthetic::view_from_world(index), synthetic::clip_from_view());
        let params = FrameParams { view_from_world, clip_from_view, ..FrameParams::new(synthetic::EXTENT) };
        let frame = self.denoiser.begin_frame(&params, &Tuning::default())?;
        self.write(|name| name != "noisy_radiance", &input);
        // SAFETY: each phase is submitted right here, once, behind the passes that write its inputs.
        self.queue.submit(unsafe { self.denoiser.encode(&frame, Phase::BeforeLighting)? });
        self.write(|name| name == "noisy_radiance", &input); // here stands the path tracer
                                                             // SAFETY: as above.
        self.queue.submit(unsafe { self.denoiser.encode(&frame, Phase::AfterLighting)? });
        let denoised = self.denoiser.output("denoised_radiance").ok_or("no output")?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(ROW), rows_per_image: None };
        let target = wgpu::TexelCopyBufferInfo { buffer: &self.result, layout };
        encoder.copy_texture_to_buffer(denoised.as_image_copy(), target, EXTENT);
        self.queue.submit([encoder.finish()]);
        self.result.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: None })?;
        let rows = self.result.get_mapped_range(..)?;
        let texels = rows.chunks_exact(ROW as usize).flat_map(|row| &row[..EXTENT.width as usize * 8]).copied().collect();
        drop(rows);
        self.result.unmap();
        Ok(texels)
    }

    /// Passes of the host that write inputs.
    fn write(&self, is_wanted: impl Fn(&str) -> bool, input: &synthetic::Frame) {
        for (i, (_, texture, texel)) in self.inputs.iter().enumerate().filter(|(_, (name, ..))| is_wanted(name)) {
            let ids = || input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
            let bytes: Vec<u8> = input.images.get(i).map_or_else(ids, |texels| synthetic::bytes(texels));
            let bytes_per_row = Some(texel * EXTENT.width);
            let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row, rows_per_image: None };
            self.queue.write_texture(texture.as_image_copy(), &bytes, layout, EXTENT);
        }
    }
}

fn main() -> Result<()> {
    let mut host = Host::new()?;
    for index in 0..synthetic::FRAMES {
        println!("{}", synthetic::report(index, &host.frame(index)?));
    }
    Ok(())
}

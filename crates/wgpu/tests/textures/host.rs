//! A device of wgpu under the validation layer, and a lit wall for the denoiser on it.

use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions};
use atrous::{Config, FrameParams, Phase, Tuning, UseFrame};
use atrous_wgpu::WgpuDenoiser;
use std::future::Future;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::task::{Context, Poll, Waker};
use wgpu::{TextureFormat as Format, TextureUsages as Usage};

pub const EXTENT: [u32; 2] = [60, 33];
const DEPTH: f32 = 0.75;
const LIGHT: f64 = 0.625;

static GPU: OnceLock<Result<(wgpu::Device, wgpu::Queue), String>> = OnceLock::new();
static ERRORS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Textures of every test. wgpu waits by timeline semaphores, which older validation layers do not follow: to them, what was done to
/// a texture is still going on when its memory goes to another one.
static KEPT: Mutex<Vec<wgpu::Texture>> = Mutex::new(Vec::new());

pub fn keep(texture: Option<&wgpu::Texture>) {
    KEPT.lock().unwrap_or_else(PoisonError::into_inner).extend(texture.cloned());
}

struct Listener;

impl log::Log for Listener {
    fn enabled(&self, metadata: &log::Metadata) -> bool {
        metadata.level() <= log::Level::Error
    }

    fn log(&self, record: &log::Record) {
        if self.enabled(record.metadata()) {
            ERRORS.lock().unwrap_or_else(PoisonError::into_inner).push(record.args().to_string());
        }
    }

    fn flush(&self) {}
}

/// Listens to the validation layer. Before anything of Vulkan is called.
pub fn listen() {
    let enables = "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";
    std::env::set_var("VK_LAYER_ENABLES", enables);
    std::env::set_var("VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "1");
    log::set_logger(&Listener).expect("no other logger");
    log::set_max_level(log::LevelFilter::Error);
}

fn now<T>(future: impl Future<Output = T>) -> T {
    let Poll::Ready(outcome) = std::pin::pin!(future).poll(&mut Context::from_waker(Waker::noop())) else {
        panic!("the future is not ready");
    };
    outcome
}

pub fn gpu() -> Result<(wgpu::Device, wgpu::Queue), String> {
    let open = || {
        let flags = wgpu::InstanceFlags::VALIDATION | wgpu::InstanceFlags::DEBUG;
        let backends = wgpu::Backends::VULKAN;
        let descriptor = wgpu::InstanceDescriptor { backends, flags, ..wgpu::InstanceDescriptor::new_without_display_handle() };
        let adapter = now(wgpu::Instance::new(descriptor).request_adapter(&Default::default())).map_err(|e| e.to_string())?;
        now(adapter.request_device(&Default::default())).map_err(|e| e.to_string())
    };
    GPU.get_or_init(open).clone()
}

pub fn assert_valid() {
    let errors = ERRORS.lock().unwrap_or_else(PoisonError::into_inner);
    assert!(errors.is_empty(), "{} validation messages, the first:\n{}", errors.len(), errors[0]);
}

pub fn texture(device: &wgpu::Device, format: Format, usage: Usage) -> wgpu::Texture {
    let [width, height] = EXTENT;
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// A lit wall, drawn by render passes.
pub struct Host {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub denoiser: WgpuDenoiser,
    pub inputs: Vec<(&'static str, wgpu::Texture, wgpu::Color)>,
}

impl Host {
    pub fn new() -> Self {
        let (device, queue) = gpu().expect("tests that need a device are ignored without one");
        let declaration = Config::new(EXTENT).declare().expect("valid");
        let mut denoiser = WgpuDenoiser::new(&device, declaration).expect("a denoiser");
        let colour = |rgb: f64, b: f64| wgpu::Color { r: rgb, g: rgb, b, a: 1.0 };
        let kinds = [
            ("depth", Format::Depth32Float, colour(0.0, 0.0)),
            ("normal", Format::Rgba16Float, colour(0.0, 1.0)),
            ("surface_id", Format::R32Uint, colour(1.0, 0.0)),
            ("noisy_radiance", Format::Rgba16Float, colour(LIGHT, LIGHT)),
        ];
        let usage = Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC;
        let inputs: Vec<_> =
            kinds.into_iter().map(|(name, format, value)| (name, texture(&device, format, usage), value)).collect();
        for (name, texture, _) in &inputs {
            denoiser.set_input(name, texture).expect(name);
            keep(Some(texture));
        }
        keep(denoiser.output("denoised_radiance"));
        Self { device, queue, denoiser, inputs }
    }

    pub fn draw(&self, wanted: impl Fn(&str) -> bool) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        for (_, texture, value) in self.inputs.iter().filter(|(name, ..)| wanted(name)) {
            let view = texture.create_view(&Default::default());
            let (store, is_depth) = (wgpu::StoreOp::Store, texture.format().is_depth_stencil_format());
            let colour = wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(*value), store },
            };
            let depth = wgpu::RenderPassDepthStencilAttachment {
                view: &view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(DEPTH), store }),
                stencil_ops: None,
            };
            let colours = [Some(colour)];
            drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: if is_depth { &[] } else { &colours },
                depth_stencil_attachment: is_depth.then_some(depth),
                ..Default::default()
            }));
        }
        self.queue.submit([encoder.finish()]);
    }

    /// A frame without waiting for it.
    pub fn frame(&mut self) {
        let frame = self.denoiser.begin_frame(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
        self.draw(|name| name != "noisy_radiance");
        for phase in Phase::ALL {
            if phase == Phase::AfterLighting {
                self.draw(|name| name == "noisy_radiance");
            }
            // SAFETY: submitted right here, once, behind the passes that write the inputs.
            self.queue.submit(unsafe { self.denoiser.encode(&frame, phase) }.expect("encoded"));
        }
    }

    /// The texels of the result, tightly packed.
    pub fn result(&self) -> Vec<u8> {
        self.texels(self.denoiser.output("denoised_radiance").expect("an output"))
    }

    /// The texels of four half floats.
    pub fn texels(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let row = (EXTENT[0] * 8).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let (size, usage) = (u64::from(row * EXTENT[1]), wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.wait();
        let rows = buffer.get_mapped_range(..).expect("mapped");
        rows.chunks_exact(row as usize).flat_map(|row| &row[..EXTENT[0] as usize * 8]).copied().collect()
    }

    pub fn wait(&self) {
        self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: None }).expect("a live device");
    }
}

/// The same wall through a session of `atrous`.
pub fn of_session(frames: u32) -> Vec<u8> {
    let gpu = Arc::new(HeadlessDevice::new(&HeadlessOptions::default()).expect("a device"));
    let declaration = Config::new(EXTENT).declare().expect("valid");
    let mut s = Session::new(gpu, declaration, SessionOptions::default()).expect("a session");
    let texels = (EXTENT[0] * EXTENT[1]) as usize;
    let light = LIGHT as f32;
    for _ in 0..frames {
        s.upload("depth", &vec![[DEPTH, 0.0, 0.0, 0.0]; texels]).expect("depth");
        s.upload("normal", &vec![[0.0, 0.0, 1.0, 1.0]; texels]).expect("normal");
        s.upload_ids("surface_id", &vec![1; texels]).expect("surface_id");
        s.upload("noisy_radiance", &vec![[light, light, light, 1.0]; texels]).expect("noisy_radiance");
        s.run(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
    }
    s.download_bytes("denoised_radiance", UseFrame::Current).expect("an output")
}

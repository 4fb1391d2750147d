//! Compares recording a frame through the C ABI with recording it in Rust, and opening a denoiser with a warm pipeline cache or with
//! shared pipelines with opening it cold: `cargo run --release -p atrous-capi --example cost`. Times are those of the CPU, the least of
//! a few batches.

use ash::vk;
use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, HeadlessOptions};
use atrous::{Binding, Config, Declaration, Denoiser, Device, FrameParams, Shape, SharedPipelines, Tuning};
use atrous_capi::*;
use cpu_time::ProcessTime;
use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

const EXTENT: [u32; 2] = [64, 36];
const BATCHES: usize = 40;
const FRAMES_IN_BATCH: u32 = 50;
const STARTS: usize = 5;

/// An image for each format and one buffer: nothing is ever submitted, so that all resources may share them.
struct Objects<'g> {
    gpu: &'g HeadlessDevice,
    views: BTreeMap<i32, (vk::Image, vk::ImageView)>,
    buffer: vk::Buffer,
    memory: Vec<vk::DeviceMemory>,
}

impl<'g> Objects<'g> {
    fn new(gpu: &'g HeadlessDevice, declaration: &Declaration) -> Result<Self, vk::Result> {
        let mut made = Self { gpu, views: BTreeMap::new(), buffer: vk::Buffer::null(), memory: Vec::new() };
        let usage =
            vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_DST;
        let info = vk::BufferCreateInfo::default().size(1 << 16).usage(usage);
        // SAFETY: the device is live; the buffer is bound to memory of its own.
        unsafe {
            made.buffer = gpu.device().create_buffer(&info, None)?;
            let memory = made.allocate(gpu.device().get_buffer_memory_requirements(made.buffer))?;
            gpu.device().bind_buffer_memory(made.buffer, memory, 0)?;
        }
        for resource in declaration.resources() {
            if let Shape::Image { format, .. } = resource.shape {
                let (atrous::ImageFormat::Exactly(format) | atrous::ImageFormat::Any(_, format)) = format;
                if !made.views.contains_key(&format.as_raw()) {
                    let image = made.image(format)?;
                    made.views.insert(format.as_raw(), image);
                }
            }
        }
        Ok(made)
    }

    fn allocate(&mut self, needs: vk::MemoryRequirements) -> Result<vk::DeviceMemory, vk::Result> {
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(needs.size)
            .memory_type_index(needs.memory_type_bits.trailing_zeros());
        // SAFETY: the device is live, and the memory is freed with `self`.
        let memory = unsafe { self.gpu.device().allocate_memory(&info, None)? };
        self.memory.push(memory);
        Ok(memory)
    }

    fn image(&mut self, format: vk::Format) -> Result<(vk::Image, vk::ImageView), vk::Result> {
        let device = self.gpu.device();
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: EXTENT[0], height: EXTENT[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::STORAGE);
        let range = vk::ImageSubresourceRange {
            aspect_mask: vk::ImageAspectFlags::COLOR,
            level_count: 1,
            layer_count: 1,
            ..Default::default()
        };
        // SAFETY: the device is live; the image is bound to memory of its own before its view is made.
        unsafe {
            let image = device.create_image(&info, None)?;
            let memory = self.allocate(device.get_image_memory_requirements(image))?;
            device.bind_image_memory(image, memory, 0)?;
            let view = vk::ImageViewCreateInfo::default().image(image).view_type(vk::ImageViewType::TYPE_2D).format(format);
            Ok((image, device.create_image_view(&view.subresource_range(range), None)?))
        }
    }

    /// Bindings of every pass.
    fn bindings(&self, declaration: &Declaration) -> Vec<Vec<Binding>> {
        let of = |u: &atrous::Use| match declaration.resource(u.resource).shape {
            Shape::Buffer { size } => Binding::Buffer { buffer: self.buffer, offset: 0, range: size },
            Shape::Image { format, .. } => {
                let (atrous::ImageFormat::Exactly(format) | atrous::ImageFormat::Any(_, format)) = format;
                let view = self.views.get(&format.as_raw()).map_or(vk::ImageView::null(), |(_, view)| *view);
                Binding::Image { view, layout: u.access.image().layout }
            }
        };
        declaration.passes().iter().map(|pass| pass.uses.iter().map(of).collect()).collect()
    }
}

impl Drop for Objects<'_> {
    fn drop(&mut self) {
        let device = self.gpu.device();
        // SAFETY: nothing was submitted, so nothing is in use.
        unsafe {
            for (image, view) in self.views.values() {
                device.destroy_image_view(*view, None);
                device.destroy_image(*image, None);
            }
            device.destroy_buffer(self.buffer, None);
            self.memory.iter().for_each(|memory| device.free_memory(*memory, None));
        }
    }
}

/// Microseconds of a frame: the least of the batches of either, which take turns.
fn take_turns(mut first: impl FnMut(u32), mut second: impl FnMut(u32)) -> [f64; 2] {
    let mut least = [f64::INFINITY; 2];
    for batch in 0..BATCHES {
        for (which, least) in least.iter_mut().enumerate() {
            let start = Instant::now();
            for index in 0..FRAMES_IN_BATCH {
                if which == 0 {
                    first(index)
                } else {
                    second(index)
                }
            }
            let took = start.elapsed().as_secs_f64() * 1e6 / f64::from(FRAMES_IN_BATCH);
            if batch > 0 {
                *least = least.min(took);
            }
        }
    }
    least
}

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = HeadlessDevice::new(&HeadlessOptions::default())?;
    println!("{}", gpu.name());
    recording(&gpu)?;
    start(&gpu)
}

/// Opens a denoiser without a pipeline cache, with an empty one, with that which is full then, and beside one whose pipelines it shares.
fn start(gpu: &HeadlessDevice) -> Result<(), Box<dyn Error>> {
    let declaration = Config { preset: Preset::Best, ..Config::new(EXTENT) }.declare()?;
    let mut least = [f64::INFINITY; 4];
    let shared = SharedPipelines::default();
    // SAFETY: the device is live, and outlives the denoiser.
    let _first = unsafe { Denoiser::new(Device { pipelines: Some(&shared), ..gpu.host() }, declaration.clone())? };
    for _ in 0..STARTS {
        // SAFETY: the device is live, and the cache is destroyed behind the denoisers.
        unsafe {
            let cache = gpu.device().create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None)?;
            let null = vk::PipelineCache::null();
            let ways = [(null, None), (cache, None), (cache, None), (null, Some(&shared))];
            for ((pipeline_cache, pipelines), least) in ways.into_iter().zip(&mut least) {
                let start = ProcessTime::now();
                let denoiser = Denoiser::new(Device { pipeline_cache, pipelines, ..gpu.host() }, declaration.clone())?;
                *least = least.min(start.elapsed().as_secs_f64() * 1e3);
                drop(denoiser);
            }
            gpu.device().destroy_pipeline_cache(cache, None);
        }
    }
    let [none, cold, warm, shared] = least;
    println!(
        "Denoiser::new of best, CPU: without a cache {none:.1} ms, cold {cold:.1} ms, warm {warm:.1} ms: {:.2} of cold; shared {shared:.2} ms",
        warm / cold
    );
    Ok(())
}

/// What a call of C answered, as an error.
fn ok(status: AtrousStatus) -> Result<(), Box<dyn Error>> {
    match status {
        AtrousStatus::Ok => Ok(()),
        // SAFETY: the message is valid until the next failure on this thread.
        _ => Err(unsafe { std::ffi::CStr::from_ptr(atrous_last_error()) }.to_string_lossy().into()),
    }
}

fn recording(gpu: &HeadlessDevice) -> Result<(), Box<dyn Error>> {
    let config = Config { preset: Preset::Best, ..Config::new(EXTENT) };
    let declaration = config.declare()?;
    let objects = Objects::new(gpu, &declaration)?;
    let bindings = objects.bindings(&declaration);
    let of_c: Vec<Vec<AtrousBinding>> = bindings.iter().map(|pass| pass.iter().map(AtrousBinding::from).collect()).collect();
    let device = gpu.device();
    let (mut in_rust, in_c) = denoisers(gpu, &config)?;
    // SAFETY: the pool and its command buffer are destroyed below; nothing is submitted.
    let (pool, cmd) = unsafe {
        let flags = vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER;
        let pool = device
            .create_command_pool(&vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family()).flags(flags), None)?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        (pool, device.allocate_command_buffers(&info)?[0])
    };
    // SAFETY: the command buffer is idle, since nothing is submitted.
    let recorded = |record: &mut dyn FnMut() -> Result<(), Box<dyn Error>>| unsafe {
        device.begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begin");
        record().expect("a frame");
        device.end_command_buffer(cmd).expect("end");
    };
    let rust = |index: u32| {
        recorded(&mut || {
            let params = FrameParams { frame_slot: index % 2, ..FrameParams::new(EXTENT) };
            let frame = in_rust.begin_frame(&params, &Tuning::default())?;
            for (pass, bindings) in bindings.iter().enumerate() {
                // SAFETY: the command buffer is recording, and nothing is submitted.
                unsafe { in_rust.record(cmd, &frame, pass, bindings)? };
            }
            Ok(())
        });
    };
    let c = |index: u32| {
        recorded(&mut || {
            // SAFETY: the structs are filled by the library, and have their sizes; the command buffer is recording.
            unsafe {
                let mut params: AtrousFrameParams = std::mem::zeroed();
                params.struct_size = size_of::<AtrousFrameParams>() as u32;
                ok(atrous_frame_params_default(&mut params, EXTENT[0], EXTENT[1]))?;
                params.frame_slot = index % 2;
                let mut frame: AtrousFrame = std::mem::zeroed();
                frame.struct_size = size_of::<AtrousFrame>() as u32;
                ok(atrous_begin_frame(in_c, &params, &mut frame))?;
                for (pass, bindings) in of_c.iter().enumerate() {
                    ok(atrous_record(in_c, &frame, cmd, pass as u32, bindings.as_ptr(), bindings.len() as u32))?;
                }
            }
            Ok(())
        });
    };
    let [rust, c] = take_turns(rust, c);
    println!("a frame of best, {} passes: Rust {rust:.1} us, C {c:.1} us: {:.2} times", bindings.len(), c / rust);
    // SAFETY: nothing was submitted, so nothing is in use.
    unsafe {
        device.destroy_command_pool(pool, None);
        ok(atrous_destroy(in_c))
    }
}

/// The same denoiser twice, without the checks of debug builds.
fn denoisers(gpu: &HeadlessDevice, config: &Config) -> Result<(Denoiser, *mut AtrousDenoiser), Box<dyn Error>> {
    let Device { instance, physical_device, device, .. } = gpu.host();
    // SAFETY: the handles are live and belong together; structs have their sizes.
    unsafe {
        let mut in_rust = Denoiser::new(Device { pipelines: None, ..gpu.host() }, config.declare()?)?;
        in_rust.checks.on = false;
        let mut of_c: AtrousConfig = std::mem::zeroed();
        of_c.struct_size = size_of::<AtrousConfig>() as u32;
        ok(atrous_config_default(&mut of_c, EXTENT[0], EXTENT[1]))?;
        of_c.preset = config.preset as u32;
        let mut info: AtrousCreateInfo = std::mem::zeroed();
        info.struct_size = size_of::<AtrousCreateInfo>() as u32;
        info.get_instance_proc_addr = Some(ash::Entry::load()?.static_fn().get_instance_proc_addr);
        (info.instance, info.physical_device, info.device) = (instance.handle(), physical_device, device.handle());
        (info.config, info.checks) = (&of_c, 2);
        let mut in_c = std::ptr::null_mut();
        ok(atrous_create(&info, &mut in_c))?;
        Ok((in_rust, in_c))
    }
}

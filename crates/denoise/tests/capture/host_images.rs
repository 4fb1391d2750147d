//! Images of a host in its own formats and layout, with two frames in flight.

use super::support::{assert_valid, gpu};
use ash::vk;
use atrous::config::NormalEncoding;
use atrous::executor::{Executor, ExecutorOptions, HostImage};
use atrous::{Config, Error, FrameParams, Phase, Subresource, Tuning};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{frame, frame_files};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("formats_of_a_host_are_decoded_with_two_frames_in_flight", formats_of_a_host_are_decoded_with_two_frames_in_flight),
    ("whatever_can_be_bound_can_be_captured", whatever_can_be_bound_can_be_captured),
];

const EXTENT: [u32; 2] = [5, 3];
const COLOUR: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

/// A host of few words: images that are cleared to one colour per frame.
struct Host {
    device: ash::Device,
    images: Vec<(HostImage, vk::DeviceMemory)>,
    pool: vk::CommandPool,
}

impl Host {
    fn new() -> Self {
        let gpu = gpu();
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family());
        // SAFETY: the device is live.
        let pool = unsafe { gpu.device().create_command_pool(&info, None) }.expect("a pool");
        Self { device: gpu.device().clone(), images: Vec::new(), pool }
    }

    /// Larger than the frame, as a host's may be.
    fn image(&mut self, format: vk::Format) -> HostImage {
        let extent = [EXTENT[0] + 3, EXTENT[1] + 2];
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: extent[0], height: extent[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(usage);
        let d = &self.device;
        // SAFETY: the device is live; memory fits the image, and both live as long as the host.
        let (image, memory, view) = unsafe {
            let image = d.create_image(&info, None).expect("an image");
            let needed = d.get_image_memory_requirements(image);
            let index = needed.memory_type_bits.trailing_zeros();
            let info = vk::MemoryAllocateInfo::default().allocation_size(needed.size).memory_type_index(index);
            let memory = d.allocate_memory(&info, None).expect("memory");
            d.bind_image_memory(image, memory, 0).expect("bound");
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(format)
                .subresource_range(range(format));
            (image, memory, d.create_image_view(&info, None).expect("a view"))
        };
        let (stage, access) = (vk::PipelineStageFlags2::ALL_TRANSFER, vk::AccessFlags2::TRANSFER_WRITE);
        let (subresource, layout) = (Subresource::default(), vk::ImageLayout::GENERAL);
        let host = HostImage { image, view, subresource, format, extent, layout, stage, access };
        self.images.push((host, memory));
        host
    }

    /// Clears an image behind everything that was recorded before.
    fn clear(&self, cmd: vk::CommandBuffer, host: &HostImage, value: [f32; 4]) {
        let barrier = vk::ImageMemoryBarrier2::default()
            .image(host.image)
            .subresource_range(range(host.format))
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_TRANSFER)
            .dst_access_mask(vk::AccessFlags2::TRANSFER_WRITE)
            .new_layout(vk::ImageLayout::GENERAL);
        let (layout, ranges) = (vk::ImageLayout::GENERAL, [range(host.format)]);
        // SAFETY: the command buffer is recording; the image is live and in the layout that the barrier brings it to.
        unsafe {
            self.device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&[barrier]));
            match host.format {
                vk::Format::D32_SFLOAT => {
                    let value = vk::ClearDepthStencilValue { depth: value[0], stencil: 0 };
                    self.device.cmd_clear_depth_stencil_image(cmd, host.image, layout, &value, &ranges);
                }
                vk::Format::R16_UINT => {
                    let value = vk::ClearColorValue { uint32: value.map(|v| v as u32) };
                    self.device.cmd_clear_color_image(cmd, host.image, layout, &value, &ranges);
                }
                _ => self.device.cmd_clear_color_image(cmd, host.image, layout, &vk::ClearColorValue { float32: value }, &ranges),
            }
        }
    }

    fn begin(&self) -> vk::CommandBuffer {
        let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
        // SAFETY: the pool is live and used by this thread alone.
        unsafe {
            let cmd = self.device.allocate_command_buffers(&info).expect("a command buffer")[0];
            self.device.begin_command_buffer(cmd, &vk::CommandBufferBeginInfo::default()).expect("begun");
            cmd
        }
    }

    fn submit(&self, cmd: vk::CommandBuffer) -> vk::Fence {
        let gpu = gpu();
        let queue = gpu.queue();
        // SAFETY: the command buffer is recorded, and the queue is locked.
        unsafe {
            self.device.end_command_buffer(cmd).expect("ended");
            let fence = self.device.create_fence(&vk::FenceCreateInfo::default(), None).expect("a fence");
            self.device.queue_submit(*queue, &[vk::SubmitInfo::default().command_buffers(&[cmd])], fence).expect("submitted");
            fence
        }
    }

    fn wait(&self, fence: vk::Fence) {
        // SAFETY: the fence is of a submission.
        unsafe {
            self.device.wait_for_fences(&[fence], true, u64::MAX).expect("waited");
            self.device.destroy_fence(fence, None);
        }
    }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: every submission was waited for.
        unsafe {
            for (host, memory) in &self.images {
                self.device.destroy_image_view(host.view, None);
                self.device.destroy_image(host.image, None);
                self.device.free_memory(*memory, None);
            }
            self.device.destroy_command_pool(self.pool, None);
        }
    }
}

fn range(format: vk::Format) -> vk::ImageSubresourceRange {
    match format {
        vk::Format::D32_SFLOAT => vk::ImageSubresourceRange { aspect_mask: vk::ImageAspectFlags::DEPTH, ..COLOUR },
        _ => COLOUR,
    }
}

fn executor(config: &Config) -> Executor {
    // SAFETY: the device outlives every test, and the tests wait for their work.
    unsafe { Executor::new(gpu().host(), config.declare().expect("valid"), ExecutorOptions::default()) }.expect("an executor")
}

/// Name, format, and colour in a frame.
type Input = (&'static str, vk::Format, fn(f32) -> [f32; 4]);

/// Values that each format holds exactly.
fn inputs() -> [Input; 7] {
    [
        ("depth", vk::Format::D32_SFLOAT, |i| [0.1 + i * 0.1, 0.0, 0.0, 0.0]),
        ("normal", vk::Format::R16G16_SNORM, |_| [0.0, -1.0, 0.0, 0.0]),
        ("motion", vk::Format::R16G16_SFLOAT, |i| [0.25 * i, -0.5, 0.0, 0.0]),
        ("albedo", vk::Format::R8G8B8A8_UNORM, |i| [1.0, (i * 17.0) / 255.0, 0.0, 1.0]),
        ("surface_id", vk::Format::R16_UINT, |i| [1000.0 + i, 0.0, 0.0, 0.0]),
        ("noisy_radiance", vk::Format::B10G11R11_UFLOAT_PACK32, |i| [1.0 + i, 0.5, 2.0, 0.0]),
        ("roughness", vk::Format::R8_UNORM, |_| [1.0, 0.0, 0.0, 0.0]),
    ]
}

fn formats_of_a_host_are_decoded_with_two_frames_in_flight() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut config = Config::new(EXTENT);
    config.conventions.normal = NormalEncoding::Octahedral;
    let mut host = Host::new();
    let mut executor = executor(&config);
    let images = inputs().map(|(name, format, colour)| (name, host.image(format), colour));
    for (name, image, _) in &images {
        executor.bind_image(name, *image).expect(name);
    }
    let mut in_flight = std::collections::VecDeque::new();
    for i in 0..8u32 {
        if i == 2 {
            executor.capture(folder.path(), 4).expect("a capture");
        }
        if in_flight.len() == 2 {
            host.wait(in_flight.pop_front().expect("two"));
        }
        let params = FrameParams { frame_slot: i % 2, ..FrameParams::new(EXTENT) };
        let context = executor.begin_frame(&params, &Tuning::default()).expect("begun");
        let cmd = host.begin();
        for (_, image, colour) in &images {
            host.clear(cmd, image, colour(i as f32));
        }
        for phase in Phase::ALL {
            // SAFETY: the command buffer is recording, and work of this slot was waited for.
            unsafe { executor.record(cmd, &context, phase) }.expect("recorded");
        }
        in_flight.push_back(host.submit(cmd));
    }
    assert_eq!(executor.frames_to_capture(), 0, "frames 6 and 7 wrote what their slots held");
    in_flight.into_iter().for_each(|fence| host.wait(fence));
    // SAFETY: all work was waited for.
    assert_eq!(unsafe { executor.finish_capture() }.expect("written"), 4);
    assert_valid();

    let files = frame_files::find(&[folder.path().to_owned()]).expect("frames");
    let setup = Setup::new(&files, &Options::default()).expect("a set-up");
    assert_eq!(files.len(), 4);
    for (file, i) in files.iter().zip(2u8..) {
        let frame = frame::load(file, &setup).expect("a frame");
        for (name, _, colour) in inputs() {
            let expected = colour(f32::from(i));
            if name == "surface_id" {
                assert_eq!(frame.surface_id, Some(vec![expected[0] as u32; 15]));
                continue;
            }
            // One channel of a file stands for whichever the conventions name.
            let [r, g, b] = if name == "roughness" { [expected[0]; 3] } else { [expected[0], expected[1], expected[2]] };
            assert!(frame.images[name].iter().all(|t| t[..3] == [r, g, b]), "{name} {:?} {expected:?}", frame.images[name][0]);
        }
    }
}

fn whatever_can_be_bound_can_be_captured() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Host::new();
    let mut executor = executor(&Config::new(EXTENT));
    let mut image = host.image(vk::Format::E5B9G9R9_UFLOAT_PACK32);
    executor.bind_image("noisy_radiance", image).expect("bound");
    executor.capture(folder.path().join("new"), 1).expect("taken");
    assert_eq!(executor.frames_to_capture(), 1);
    image.format = vk::Format::R64_SFLOAT;
    let error = executor.bind_image("noisy_radiance", image).expect_err("refused");
    assert!(matches!(&error, Error::Format { given: vk::Format::R64_SFLOAT, .. }), "{error}");
    assert!(error.to_string().contains("noisy_radiance"), "{error}");
}

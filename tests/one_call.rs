//! A frame in one call, on images that a host lends, against the executor phase by phase; barriers without synchronization2; a device
//! that is loaded from handles.

use super::hosts::{of_executor, params};
use super::support::rig::{whole, Rig, UPLOADED};
use super::support::{assert_valid, gpu, session};
use ash::vk;
use ash::vk::Handle;
use atrous::config::PostProcess;
use atrous::executor::{ExecutorOptions, HostImage, LentImage};
use atrous::{
    Access, Config, Device, Error, FrameContext, FrameParams, Phase, ResetReason, ResourceState, Subresource, Tuning, UseFrame,
};
use atrous_harness::DeviceTest;
use atrous_synthetic as synthetic;
use std::ffi::c_void;

pub const TESTS: &[DeviceTest] = &[
    ("a_frame_in_one_call_gives_the_bits_of_the_executor", a_frame_in_one_call_gives_the_bits_of_the_executor),
    ("one_layer_and_mip_level_of_larger_images_gives_the_same_bits", one_layer_and_mip_level_of_larger_images_gives_the_same_bits),
    ("inputs_that_are_layers_of_one_image_give_the_same_bits", inputs_that_are_layers_of_one_image_give_the_same_bits),
    ("images_that_stay_in_general_give_the_same_bits", images_that_stay_in_general_give_the_same_bits),
    ("a_depth_image_is_sampled_in_its_read_only_layout", a_depth_image_is_sampled_in_its_read_only_layout),
    ("an_output_is_handed_back_behind_the_last_phase", an_output_is_handed_back_behind_the_last_phase),
    ("what_is_not_lent_is_left_out", what_is_not_lent_is_left_out),
    ("another_extent_starts_anew", another_extent_starts_anew),
    ("legacy_barriers_give_the_same_bits", legacy_barriers_give_the_same_bits),
    ("a_device_loaded_from_handles_gives_the_same_bits", a_device_loaded_from_handles_gives_the_same_bits),
    ("a_null_handle_is_named", a_null_handle_is_named),
];

const TEXELS: usize = (synthetic::EXTENT[0] * synthetic::EXTENT[1]) as usize;
const DEPTH_READ: ResourceState = ResourceState::new(
    vk::PipelineStageFlags2::COMPUTE_SHADER,
    vk::AccessFlags2::SHADER_SAMPLED_READ,
    vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL,
);

/// A host with images of its own.
struct Host {
    rig: Rig,
    images: Vec<(&'static str, HostImage)>,
    output: HostImage,
    staging: (vk::Buffer, *mut u8),
    result: (vk::Buffer, *mut u8),
}

impl Host {
    fn new(rig: Rig, depth: vk::Format) -> Self {
        Self::at(rig, depth, Subresource::default())
    }

    /// A host whose images are one layer and mip level of larger ones.
    fn at(mut rig: Rig, depth: vk::Format, subresource: Subresource) -> Self {
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
        let mut images = Vec::new();
        for name in synthetic::NAMES.into_iter().chain(["surface_id"]) {
            let (format, aspect) = match name {
                "depth" if depth == vk::Format::D32_SFLOAT => (depth, vk::ImageAspectFlags::DEPTH),
                "surface_id" => (vk::Format::R32_UINT, vk::ImageAspectFlags::COLOR),
                _ => (vk::Format::R32G32B32A32_SFLOAT, vk::ImageAspectFlags::COLOR),
            };
            let is_depth = aspect == vk::ImageAspectFlags::DEPTH;
            let attachment = if is_depth { vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT } else { vk::ImageUsageFlags::empty() };
            let image = rig.image_at(name, format, synthetic::EXTENT, aspect, usage | attachment, subresource);
            let ResourceState { stage, access, layout, .. } = DEPTH_READ;
            images.push((name, if is_depth { HostImage { stage, access, layout, ..image } } else { image }));
        }
        let (format, colour) = (vk::Format::R16G16B16A16_SFLOAT, vk::ImageAspectFlags::COLOR);
        let written = usage | vk::ImageUsageFlags::STORAGE;
        let output = rig.image_at("denoised_radiance", format, synthetic::EXTENT, colour, written, subresource);
        let ResourceState { stage, access, layout, .. } = ResourceState::UNDEFINED;
        let (staging, result) = (rig.staging((images.len() + 1) * TEXELS * 16), rig.staging(TEXELS * 8));
        Self { rig, images, output: HostImage { stage, access, layout, ..output }, staging, result }
    }

    fn on_gpu(options: ExecutorOptions) -> Self {
        let rig = Rig::with_options(gpu(), &Config::new(synthetic::EXTENT), 1, options);
        Self::new(rig, vk::Format::UNDEFINED)
    }

    /// Uploads the inputs, and lets `record` denoise and copy the result out.
    fn frame(&mut self, index: u32, record: impl FnOnce(&mut Self, vk::CommandBuffer, &FrameParams)) -> String {
        let commands = self.rig.commands[0];
        let device = self.rig.gpu.device().clone();
        // SAFETY: the command buffer is idle, since the device is waited for behind it.
        unsafe { device.begin_command_buffer(commands, &vk::CommandBufferBeginInfo::default()) }.expect("begin");
        self.upload(commands, index);
        record(self, commands, &params(index));
        // SAFETY: everything lives as long as the rig; the result is mapped, and its copy complete.
        unsafe {
            device.end_command_buffer(commands).expect("end");
            let (queue, list) = (self.rig.gpu.queue(), [commands]);
            let submit = [vk::SubmitInfo::default().command_buffers(&list)];
            device.queue_submit(*queue, &submit, vk::Fence::null()).expect("submit");
            device.queue_wait_idle(*queue).expect("wait");
            synthetic::report(index, std::slice::from_raw_parts(self.result.1, TEXELS * 8))
        }
    }

    fn upload(&mut self, cmd: vk::CommandBuffer, index: u32) {
        if self.output.layout != vk::ImageLayout::UNDEFINED {
            let ready = ResourceState::new(self.output.stage, self.output.access, self.output.layout);
            self.barrier(cmd, &self.output, vk::ImageAspectFlags::COLOR, ResourceState::UNDEFINED, ready);
        }
        let input = synthetic::Frame::new(index);
        let images = self.images.clone();
        for (i, (name, image)) in images.iter().enumerate() {
            let is_depth = image.format == vk::Format::D32_SFLOAT;
            let bytes: Vec<u8> = match *name {
                "surface_id" => input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect(),
                _ if is_depth => input.images[i].iter().flat_map(|texel| texel[0].to_le_bytes()).collect(),
                _ => synthetic::bytes(&input.images[i]),
            };
            // SAFETY: this part of the staging buffer is the image's own.
            unsafe { self.staging.1.add(i * TEXELS * 16).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len()) };
            let aspect = if is_depth { vk::ImageAspectFlags::DEPTH } else { vk::ImageAspectFlags::COLOR };
            let (stage, access, layout) = UPLOADED;
            let uploaded = ResourceState::new(stage, access, layout);
            self.barrier(cmd, image, aspect, ResourceState::UNDEFINED, uploaded);
            let region = region(image, aspect, i * TEXELS * 16);
            let device = self.rig.gpu.device();
            // SAFETY: the command buffer is recording; the image is live and in this layout.
            unsafe { device.cmd_copy_buffer_to_image(cmd, self.staging.0, image.image, layout, &[region]) };
            let lent = ResourceState::new(image.stage, image.access, image.layout);
            if lent != uploaded {
                self.barrier(cmd, image, aspect, uploaded, lent);
            }
        }
    }

    fn barrier(
        &self,
        cmd: vk::CommandBuffer,
        image: &HostImage,
        aspect_mask: vk::ImageAspectFlags,
        from: ResourceState,
        to: ResourceState,
    ) {
        let barrier = vk::ImageMemoryBarrier2::default()
            .image(image.image)
            .subresource_range(vk::ImageSubresourceRange {
                aspect_mask,
                base_array_layer: image.subresource.layer,
                base_mip_level: image.subresource.level,
                ..whole()
            })
            .src_stage_mask(from.stage)
            .src_access_mask(from.access)
            .old_layout(from.layout)
            .dst_stage_mask(to.stage)
            .dst_access_mask(to.access)
            .new_layout(to.layout);
        let info = vk::DependencyInfo::default();
        // SAFETY: the command buffer is recording; the image is live, and in the state named.
        unsafe { self.rig.gpu.device().cmd_pipeline_barrier2(cmd, &info.image_memory_barriers(&[barrier])) };
    }

    /// What the host lends: every image but those named, each to be left as the source of a copy, but the depth as it is.
    fn lent(&self, without: &[&str]) -> Vec<LentImage<'static>> {
        let inputs = self.images.iter().filter(|(name, _)| !without.contains(name));
        let all = inputs.copied().chain([("denoised_radiance", self.output)]);
        all.map(|(name, image)| LentImage {
            after: (image.layout != DEPTH_READ.layout).then_some(ResourceState::COPY_SOURCE),
            ..LentImage::new(name, image)
        })
        .collect()
    }

    /// One call, and copies of what was lent without any barrier: the validation layer knows in which state each was left.
    fn denoise(&mut self, cmd: vk::CommandBuffer, params: &FrameParams, without: &[&str]) -> FrameContext {
        let lent = self.lent(without);
        // SAFETY: the command buffer is recording; every image is live and in the state that is given.
        let frame = unsafe { self.rig.executor.denoise(cmd, params, &Tuning::default(), &lent) }.expect("a frame");
        let device = self.rig.gpu.device();
        let free = (self.staging.0, self.images.len() * TEXELS * 16);
        for (name, (target, offset)) in [("normal", free), ("denoised_radiance", (self.result.0, 0))] {
            let Some(left) = lent.iter().find(|image| image.name == name) else { continue };
            let region = region(&left.image, vk::ImageAspectFlags::COLOR, offset);
            // SAFETY: the command buffer is recording, and the buffer has room for the image.
            unsafe { device.cmd_copy_image_to_buffer(cmd, left.image.image, ResourceState::COPY_SOURCE.layout, target, &[region]) };
        }
        frame
    }

    fn frames(&mut self) -> Vec<String> {
        (0..synthetic::FRAMES)
            .map(|index| {
                self.frame(index, |host, cmd, params| {
                    host.denoise(cmd, params, &[]);
                })
            })
            .collect()
    }
}

fn region(image: &HostImage, aspect: vk::ImageAspectFlags, offset: usize) -> vk::BufferImageCopy {
    let [width, height] = synthetic::EXTENT;
    let Subresource { layer, level } = image.subresource;
    let layers = vk::ImageSubresourceLayers { aspect_mask: aspect, mip_level: level, base_array_layer: layer, layer_count: 1 };
    let region = vk::BufferImageCopy::default().buffer_offset(offset as u64).image_subresource(layers);
    region.image_extent(vk::Extent3D { width, height, depth: 1 })
}

fn a_frame_in_one_call_gives_the_bits_of_the_executor() {
    assert_eq!(Host::on_gpu(ExecutorOptions::default()).frames(), of_executor());
    assert_valid();
}

/// The others are undefined, so that a barrier or a copy that names one of them is invalid.
fn one_layer_and_mip_level_of_larger_images_gives_the_same_bits() {
    for (legacy_barriers, depth) in [(false, vk::Format::UNDEFINED), (true, vk::Format::D32_SFLOAT)] {
        let options = ExecutorOptions { legacy_barriers, poison: !legacy_barriers, ..Default::default() };
        let rig = Rig::with_options(gpu(), &Config::new(synthetic::EXTENT), 1, options);
        let mut host = Host::at(rig, depth, Subresource { layer: 2, level: 1 });
        assert_eq!(host.frames(), of_executor());
    }
    assert_valid();
}

/// A G-buffer in the layers of one image, as Blade has it: each is in the state of its own use.
fn inputs_that_are_layers_of_one_image_give_the_same_bits() {
    for (stay_in_general, layout) in [(false, vk::ImageLayout::TRANSFER_DST_OPTIMAL), (true, vk::ImageLayout::GENERAL)] {
        let mut host = Host::on_gpu(ExecutorOptions { stay_in_general, ..Default::default() });
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
        let count = synthetic::NAMES.len() as u32;
        let layers = host.rig.layers(vk::Format::R32G32B32A32_SFLOAT, synthetic::EXTENT, usage, count);
        for ((_, image), layer) in host.images.iter_mut().zip(layers) {
            *image = HostImage { layout, ..layer };
        }
        assert_eq!(host.frames(), of_executor());
    }
    assert_valid();
}

/// An engine with one layout for all images.
fn images_that_stay_in_general_give_the_same_bits() {
    for poison in [false, true] {
        let mut host = Host::on_gpu(ExecutorOptions { stay_in_general: true, poison, ..Default::default() });
        let (stage, access) =
            (vk::PipelineStageFlags2::ALL_COMMANDS, vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE);
        let layout = vk::ImageLayout::GENERAL;
        host.images.iter_mut().for_each(|(_, image)| *image = HostImage { stage, access, layout, ..*image });
        host.output = HostImage { stage, access, layout, ..host.output };
        assert_eq!(host.frames(), of_executor());
    }
    assert_valid();
}

fn a_depth_image_is_sampled_in_its_read_only_layout() {
    let rig = Rig::with_options(gpu(), &Config::new(synthetic::EXTENT), 1, ExecutorOptions::default());
    assert_eq!(Host::new(rig, vk::Format::D32_SFLOAT).frames(), of_executor());
    assert_valid();
}

/// The tone map reads in its phase what the phase before has written.
fn an_output_is_handed_back_behind_the_last_phase() {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..Config::new(synthetic::EXTENT) };
    let rig = Rig::with_options(gpu(), &config, 1, ExecutorOptions::default());
    let mut host = Host::new(rig, vk::Format::UNDEFINED);
    let ResourceState { stage, access, layout, .. } = ResourceState::of(Access::StorageWrite);
    host.output = HostImage { stage, access, layout, ..host.output };
    assert_eq!(host.frames(), of_executor());
    assert_valid();
}

fn what_is_not_lent_is_left_out() {
    let mut host = Host::on_gpu(ExecutorOptions::default());
    host.frame(0, |host, cmd, params| {
        host.denoise(cmd, params, &[]);
    });
    let without = host.frame(1, |host, cmd, params| {
        let params = FrameParams { reset: Some(ResetReason::CameraCut), ..*params };
        host.denoise(cmd, &params, &["albedo"]);
        let none = host.lent(&["noisy_radiance"]);
        // SAFETY: an input is missing, so that nothing is recorded.
        let refused = unsafe { host.rig.executor.denoise(cmd, &params, &Tuning::default(), &none) };
        assert_eq!(refused.err(), Some(Error::NotBound("noisy_radiance".into())));
    });
    let mut s = session(&Config::new(synthetic::EXTENT));
    let input = synthetic::Frame::new(1);
    for (name, texels) in synthetic::NAMES.iter().zip(&input.images).filter(|(name, _)| **name != "albedo") {
        s.upload(name, texels).expect(name);
    }
    s.upload_ids("surface_id", &input.surface_id).expect("surface_id");
    s.run(&params(1), &Tuning::default()).expect("frame");
    let expected = synthetic::report(1, &s.download_bytes("denoised_radiance", UseFrame::Current).expect("an output"));
    assert_eq!(without, expected);
    assert_valid();
}

fn another_extent_starts_anew() {
    let mut host = Host::on_gpu(ExecutorOptions::default());
    host.frame(0, |host, cmd, params| {
        host.denoise(cmd, params, &[]);
    });
    let [width, height] = synthetic::EXTENT;
    for extent in [[width - 8, height - 8], synthetic::EXTENT] {
        // SAFETY: every frame was waited for.
        unsafe { host.rig.executor.resize(extent) }.expect("another extent");
    }
    host.frame(0, |host, cmd, params| assert_eq!(host.denoise(cmd, params, &[]).reset, Some(ResetReason::Resize)));
    host.rig.executor.invalidate();
    host.rig.executor.restart_at(0);
    assert_eq!(host.frames(), of_executor());
    assert_valid();
}

fn legacy_barriers_give_the_same_bits() {
    let options = ExecutorOptions { legacy_barriers: true, timestamps: gpu().has_timestamps(), ..Default::default() };
    let mut host = Host::on_gpu(options);
    assert_eq!(host.frames(), of_executor());
    assert_eq!(host.rig.executor.times().is_empty(), !gpu().has_timestamps());
    assert_valid();
}

/// The handles of the device that the tests share, as another version of ash would give them.
fn handles() -> (*const c_void, [u64; 3]) {
    let gpu = gpu();
    let host = gpu.host();
    // SAFETY: the loader stays as long as the program, since the device of the tests has loaded it as well.
    let entry = unsafe { ash::Entry::load() }.expect("a loader");
    let raw = [host.instance.handle().as_raw(), host.physical_device.as_raw(), host.device.handle().as_raw()];
    (entry.static_fn().get_instance_proc_addr as *const c_void, raw)
}

fn a_device_loaded_from_handles_gives_the_same_bits() {
    let (function, [instance, physical_device, device]) = handles();
    // SAFETY: the handles are those of the device that the tests share.
    let loaded = unsafe { Device::from_raw(function, instance, physical_device, device) }.expect("a device");
    let options = ExecutorOptions { extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC, ..Default::default() };
    let rig = Rig::on(loaded.device(), gpu(), &Config::new(synthetic::EXTENT), 1, options);
    let mut host = Host::new(rig, vk::Format::UNDEFINED);
    for (name, image) in host.images.clone() {
        host.rig.executor.bind_image(name, image).expect(name);
    }
    for name in ["roughness", "emission"] {
        host.rig.executor.unbind(name).expect(name);
    }
    let lines: Vec<_> = (0..synthetic::FRAMES).map(|index| host.frame(index, phase_by_phase)).collect();
    assert_eq!(lines, of_executor());
    assert_valid();
}

fn phase_by_phase(host: &mut Host, cmd: vk::CommandBuffer, params: &FrameParams) {
    let frame = host.rig.executor.begin_frame(params, &Tuning::default()).expect("a frame");
    for phase in Phase::ALL {
        // SAFETY: the command buffer is recording, and every input is in the state that it was bound with.
        unsafe { host.rig.executor.record(cmd, &frame, phase) }.expect("a phase");
    }
    // SAFETY: as above, and the buffer has room for the image.
    unsafe { host.rig.executor.record_copy(cmd, &frame, "denoised_radiance", UseFrame::Current, host.result.0) }.expect("a copy");
}

fn a_null_handle_is_named() {
    let (function, [instance, physical_device, device]) = handles();
    let null = std::ptr::null();
    for (name, f, [i, p, d]) in [
        ("get_instance_proc_addr", null, [instance, physical_device, device]),
        ("instance", function, [0, physical_device, device]),
        ("physical_device", function, [instance, 0, device]),
        ("device", function, [instance, physical_device, 0]),
    ] {
        // SAFETY: one is null, so that none is used.
        let refused = unsafe { Device::from_raw(f, i, p, d) };
        assert_eq!(refused.err(), Some(Error::NullHandle(name)));
    }
}

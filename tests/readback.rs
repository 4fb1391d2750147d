//! Copies of a host's images: every format that can be bound is read back with its size, and nothing is written behind it.

use super::support::rig::{whole, Rig, UPLOADED};
use super::support::{assert_valid, gpu};
use ash::vk;
use atrous::executor::{HeadlessDevice, Readback};
use atrous::graph::Graph;
use atrous::{Component, Config, Error, FrameParams, ImageFormat, Tuning, UseFrame};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("every_format_is_read_back_with_its_size", every_format_is_read_back_with_its_size),
    ("what_cannot_be_read_back_cannot_be_bound", what_cannot_be_read_back_cannot_be_bound),
    ("bytes_that_are_cut_or_not_aligned_are_no_panic", bytes_that_are_cut_or_not_aligned_are_no_panic),
];

/// Odd, so that no size is a multiple of four by chance.
const EXTENT: [u32; 2] = [5, 3];
const TEXELS: usize = (EXTENT[0] * EXTENT[1]) as usize;
/// What lies behind the texels, more than the largest texel takes.
const CANARY: [u8; 256] = [0xa5; 256];

fn is_supported(gpu: &HeadlessDevice, format: vk::Format) -> bool {
    let host = gpu.host();
    // SAFETY: the handles are live and belong together.
    let properties = unsafe { host.instance.get_physical_device_format_properties(host.physical_device, format) };
    let needed =
        vk::FormatFeatureFlags::SAMPLED_IMAGE | vk::FormatFeatureFlags::TRANSFER_SRC | vk::FormatFeatureFlags::TRANSFER_DST;
    properties.optimal_tiling_features.contains(needed)
}

/// The formats that an image may have, and whether it holds unsigned integers.
fn formats() -> impl Iterator<Item = (vk::Format, bool)> {
    let takes = |component, format| ImageFormat::Any(component, format).accepts(format);
    let all = (0..=vk::Format::ASTC_12X12_SRGB_BLOCK.as_raw()).map(vk::Format::from_raw);
    all.filter_map(move |format| {
        let is_uint = takes(Component::Uint, format);
        (is_uint || takes(Component::Float, format)).then_some((format, is_uint))
    })
}

/// Every aspect of a format, and the one that is copied.
fn aspects(format: vk::Format) -> [vk::ImageAspectFlags; 2] {
    let (depth, stencil) = (vk::ImageAspectFlags::DEPTH, vk::ImageAspectFlags::STENCIL);
    match format {
        vk::Format::D24_UNORM_S8_UINT | vk::Format::D32_SFLOAT_S8_UINT => [depth | stencil, depth],
        vk::Format::D16_UNORM | vk::Format::D32_SFLOAT | vk::Format::X8_D24_UNORM_PACK32 => [depth; 2],
        _ => [vk::ImageAspectFlags::COLOR; 2],
    }
}

/// Bytes that are other in each texel, and a valid depth where they are one.
fn content(format: vk::Format, count: usize) -> Vec<u8> {
    match format {
        vk::Format::D32_SFLOAT | vk::Format::D32_SFLOAT_S8_UINT => {
            (0..TEXELS).flat_map(|i| (i as f32 / TEXELS as f32).to_ne_bytes()).collect()
        }
        _ => (0..count).map(|i| (i * 37 % 251) as u8).collect(),
    }
}

/// Uploads to an input of this format, and reads it back. Gives the bytes before and after, and those behind the copy.
fn round_trip(rig: &mut Rig, name: &str, format: vk::Format) -> (Readback, [Vec<u8>; 3]) {
    let [all_aspects, copied_aspect] = aspects(format);
    let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
    let host = rig.image(name, format, EXTENT, copied_aspect, usage);
    rig.executor.bind_image(name, host).expect("a format that is accepted");
    let frame = rig.executor.begin_frame(&FrameParams::new(EXTENT), &Tuning::default()).expect("a frame");
    let copy = rig.executor.readback(name, &frame, UseFrame::Current).expect("a format that is known");
    let bytes = content(format, copy.bytes as usize);
    let (source, target) = (rig.staging(bytes.len()), rig.staging(16 * TEXELS + CANARY.len()));
    // SAFETY: both buffers are mapped, with room for what is written, and no GPU work uses them yet.
    unsafe {
        source.1.copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
        target.1.write_bytes(CANARY[0], 16 * TEXELS + CANARY.len());
    }
    let (stage, access, layout) = UPLOADED;
    let range = vk::ImageSubresourceRange { aspect_mask: all_aspects, ..whole() };
    let barrier = vk::ImageMemoryBarrier2::default()
        .image(host.image)
        .subresource_range(range)
        .dst_stage_mask(stage)
        .dst_access_mask(access)
        .new_layout(layout);
    let layers = vk::ImageSubresourceLayers::default().aspect_mask(copied_aspect).layer_count(1);
    let [width, height] = EXTENT;
    let region = vk::BufferImageCopy::default().image_subresource(layers).image_extent(vk::Extent3D { width, height, depth: 1 });
    // SAFETY: the command buffer is recording; image and buffers are live and large enough, and the image is in the layout named.
    rig.submit(|rig, cmd| unsafe {
        let device = rig.gpu.device();
        device.cmd_pipeline_barrier2(cmd, &vk::DependencyInfo::default().image_memory_barriers(&[barrier]));
        device.cmd_copy_buffer_to_image(cmd, source.0, host.image, layout, &[region]);
        rig.executor.record_copy(cmd, &frame, name, UseFrame::Current, target.0).expect("a copy");
    });
    // SAFETY: the buffer is mapped and this large, and the copy into it is complete.
    let all = unsafe { std::slice::from_raw_parts(target.1, 16 * TEXELS + CANARY.len()) };
    let (copied, behind) = all.split_at(copy.bytes as usize);
    (copy, [bytes, copied.to_vec(), behind.to_vec()])
}

fn every_format_is_read_back_with_its_size() {
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    let (mut read, mut lacking) = (0, Vec::new());
    for (format, is_uint) in formats() {
        if !is_supported(&rig.gpu, format) {
            lacking.push(format);
            continue;
        }
        let name = if is_uint { "surface_id" } else { "depth" };
        let (copy, [bytes, copied, behind]) = round_trip(&mut rig, name, format);
        assert_eq!((copy.format, copy.bytes as usize), (format, bytes.len()));
        assert!(behind.iter().all(|&b| b == CANARY[0]), "{format:?}: the copy wrote behind its end");
        // Bits that a format does not use are undefined in a copy.
        let samples = |bytes: &[u8]| format!("{:?}", copy.to_floats(bytes));
        assert_eq!(samples(&copied), samples(&bytes), "{format:?}");
        assert_eq!(copy.to_floats(&copied).len(), TEXELS, "{format:?}");
        read += 1;
    }
    println!("{read} formats were read back; this device has no {lacking:?}");
    assert!(read >= 30, "{read} formats were read back; this device has no {lacking:?}");
    assert_valid();
}

fn what_cannot_be_read_back_cannot_be_bound() {
    let mut rig = Rig::new(gpu(), &Config::new(EXTENT), 1);
    let aspect = vk::ImageAspectFlags::COLOR;
    let mut host = rig.image("depth", vk::Format::R32_SFLOAT, EXTENT, aspect, vk::ImageUsageFlags::SAMPLED);
    for raw in 0..=vk::Format::ASTC_12X12_SRGB_BLOCK.as_raw() {
        host.format = vk::Format::from_raw(raw);
        let bound = ["depth", "surface_id"].map(|name| rig.executor.bind_image(name, host));
        assert_eq!(bound.iter().any(Result::is_ok), formats().any(|(format, _)| format == host.format), "{:?}", host.format);
        for error in bound.into_iter().filter_map(Result::err) {
            let message = error.to_string();
            assert!(matches!(error, Error::Format { .. }) && message.contains(&format!("{:?}", host.format)), "{message}");
        }
    }
    for (format, divisor, words) in [(vk::Format::R64_SFLOAT, 1, "R64_SFLOAT"), (vk::Format::R32_SFLOAT, 0, "divisor is 0")] {
        let mut g = Graph::new(EXTENT);
        g.transient("mine", format, divisor);
        let message = g.finish().expect_err("refused").to_string();
        assert!(message.contains("mine") && message.contains(words), "{message}");
    }
}

fn bytes_that_are_cut_or_not_aligned_are_no_panic() {
    let bytes: Vec<u8> = (0..64).collect();
    for (format, _) in formats().chain([(vk::Format::UNDEFINED, false)]) {
        let copy = Readback { format, bytes: 64 };
        let [whole, shifted] = [&bytes[..], &bytes[1..]].map(|bytes| copy.to_floats(bytes).len());
        assert!(whole > 0 && [whole, whole - 1].contains(&shifted), "{format:?}: {shifted} texels of {whole}");
        assert_eq!(copy.to_floats(&[]).len(), 0, "{format:?}");
    }
    let floats = Readback { format: vk::Format::R16_SFLOAT, bytes: 3 }.to_floats(&[0, 0x3c, 7]);
    assert_eq!(floats, [[1.0, 0.0, 0.0, 0.0]]);
}

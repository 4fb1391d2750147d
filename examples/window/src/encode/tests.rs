//! The encoding against a twin on the CPU, and the twin against numbers that are known.

use ash::vk;

use crate::surface_format::{Encoding, SDR_WHITE_NITS};
use crate::target::Target;
use atrous_engine::gpu::Image;
use atrous_engine::testing::Validated;

/// The inverse EOTF of SMPTE ST 2084, written from its rational constants.
fn pq(nits: f64) -> f64 {
    let (m1, m2) = (2610.0 / 16384.0, 2523.0 / 4096.0 * 128.0);
    let (c1, c2, c3) = (3424.0 / 4096.0, 2413.0 / 4096.0 * 32.0, 2392.0 / 4096.0 * 32.0);
    let p = (nits / 10000.0).powf(m1);
    ((c1 + c2 * p) / (1.0 + c3 * p)).powf(m2)
}

/// The EOTF: cd/m².
fn nits(signal: f64) -> f64 {
    let (m1, m2) = (2610.0 / 16384.0, 2523.0 / 4096.0 * 128.0);
    let (c1, c2, c3) = (3424.0 / 4096.0, 2413.0 / 4096.0 * 32.0, 2392.0 / 4096.0 * 32.0);
    let p = signal.powf(1.0 / m2);
    10000.0 * ((p - c1).max(0.0) / (c2 - c3 * p)).powf(1.0 / m1)
}

/// Rec. 709 to Rec. 2020, from the chromaticities of both [ITU-R BT.709, BT.2020] and white D65.
fn bt2020(rgb: [f32; 3]) -> [f64; 3] {
    use glam::{DMat3, DVec3};
    let to_xyz = |primaries: [[f64; 2]; 3]| {
        let xyz = |[x, y]: [f64; 2]| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let columns = DMat3::from_cols(xyz(primaries[0]), xyz(primaries[1]), xyz(primaries[2]));
        columns * DMat3::from_diagonal(columns.inverse() * xyz([0.3127, 0.3290]))
    };
    let bt709 = to_xyz([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]]);
    let bt2020 = to_xyz([[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]]);
    (bt2020.inverse() * bt709 * DVec3::from_array(rgb.map(f64::from))).to_array()
}

fn hdr10(rgb: [f32; 3]) -> [f64; 3] {
    let (white, peak) = (f64::from(SDR_WHITE_NITS), f64::from(Encoding::Hdr10.peak()));
    bt2020(rgb).map(|c| pq(c.clamp(0.0, peak) * white))
}

fn srgb(x: f32) -> f64 {
    let x = f64::from(x.clamp(0.0, 1.0));
    if x <= 0.003_130_8 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    }
}

#[test]
fn the_twin_has_the_known_pairs() {
    for (luminance, signal) in [(10000.0, 1.0), (1000.0, 0.7518), (203.0, 0.5807), (100.0, 0.5081), (0.0, 0.0)] {
        assert!((pq(luminance) - signal).abs() < 1e-4, "{luminance} cd/m²: {}", pq(luminance));
    }
    for luminance in [0.01, 1.0, 48.0, 100.0, 203.0, 1000.0, 4000.0, 10000.0] {
        assert!((nits(pq(luminance)) / luminance - 1.0).abs() < 1e-9, "{luminance}");
    }
    for (primary, mixed) in [([1.0, 0.0, 0.0], [0.6274, 0.0691, 0.0164]), ([1.0; 3], [1.0; 3])] {
        assert!(bt2020(primary).iter().zip(mixed).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-4), "{:?}", bt2020(primary));
    }
}

/// Black, greys, white, primaries, brighter than white, brighter than the display, outside of BT.709, outside of everything.
const COLOURS: [[f32; 3]; 12] = [
    [0.0; 3],
    [0.001; 3],
    [0.012; 3],
    [0.18; 3],
    [1.0; 3],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [3.0, 2.0, 0.5],
    [40.0; 3],
    [-0.05, 0.5, 0.2],
    [-2.0, -1.0, 9.0],
];

/// Draws the colours side by side into the canvas, and has them encoded into an image of this format.
fn encode(gpu: &Validated, encoding: Encoding, format: vk::Format) -> Image {
    let layout = vk::ImageLayout::GENERAL;
    let extent = vk::Extent2D { width: COLOURS.len() as u32, height: 1 };
    let surface_format = vk::SurfaceFormatKHR { format, ..Default::default() };
    let mut target = Target::new(gpu, surface_format, encoding, layout).expect("a target");
    let canvas = target.canvas(extent).expect("a canvas");
    target.point_at(canvas.as_ref());
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
    let image = Image::with_usage(gpu, "encoded", format, extent, usage).expect("an image");
    let framebuffer = target.framebuffer(image.view, canvas.as_ref(), extent).expect("a framebuffer");
    let draw = |cmd| {
        target.begin(cmd, framebuffer, extent, 0.0);
        for (x, [r, g, b]) in (0..).zip(COLOURS) {
            let clear_value = vk::ClearValue { color: vk::ClearColorValue { float32: [r, g, b, 1.0] } };
            let aspect_mask = vk::ImageAspectFlags::COLOR;
            let clear = [vk::ClearAttachment { aspect_mask, color_attachment: 0, clear_value }];
            let pixel = vk::Rect2D { offset: vk::Offset2D { x, y: 0 }, extent: vk::Extent2D { width: 1, height: 1 } };
            let pixel = [vk::ClearRect { rect: pixel, base_array_layer: 0, layer_count: 1 }];
            // SAFETY: `cmd` is recording in subpass 0, and the pixel is in the canvas.
            unsafe { gpu.device().cmd_clear_attachments(cmd, &clear, &pixel) };
        }
        target.end(cmd, extent);
        Ok(())
    };
    // Twice: a frame follows another on the same canvas.
    gpu.submit(|cmd| draw(cmd).and_then(|()| draw(cmd))).expect("a submit");
    // SAFETY: ours, and the submit was waited for.
    unsafe { gpu.device().destroy_framebuffer(framebuffer, None) };
    image
}

#[test]
fn the_shader_encodes_as_the_twin() {
    let Some(gpu) = Validated::new() else { return };
    for encoding in [Encoding::Hdr10, Encoding::Unorm] {
        let image = encode(&gpu, encoding, vk::Format::R32G32B32A32_SFLOAT);
        for (given, rgb) in gpu.read_image(&image).expect("pixels").iter().zip(COLOURS) {
            let wanted = if encoding == Encoding::Hdr10 { hdr10(rgb) } else { rgb.map(srgb) };
            // A quarter of a step of 10 bits: the canvas is of half floats.
            let near = (0..3).all(|c| (f64::from(given[c]) - wanted[c]).abs() < 0.25 / 1023.0);
            assert!(near, "{encoding:?} of {rgb:?}: {given:?}, not {wanted:?}");
        }
    }
}

#[test]
fn ten_bits_hold_the_signal() {
    let Some(gpu) = Validated::new() else { return };
    let image = encode(&gpu, Encoding::Hdr10, vk::Format::A2B10G10R10_UNORM_PACK32);
    for (bits, rgb) in gpu.read_image_u32(&image).expect("pixels").iter().zip(COLOURS) {
        let steps = [0, 10, 20].map(|shift| f64::from(bits >> shift & 1023));
        let wanted = hdr10(rgb).map(|c| 1023.0 * c);
        // A device may round to either neighbour.
        assert!((0..3).all(|c| (steps[c] - wanted[c]).abs() < 1.0), "{rgb:?}: {steps:?}, not {wanted:?}");
    }
}

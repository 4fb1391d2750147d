//! Pictures of what the passes give, for the eye only.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use ash::vk;
use atrous_demo::{Error, Gpu, Image, PathTracer, Result};

/// Writes the noisy radiance and the G-buffer of the last frame.
pub fn write_outputs(gpu: &Gpu, tracer: &PathTracer, folder: &Path) -> Result<()> {
    let outputs = tracer.outputs();
    let extent = tracer.extent();
    let read = |image: &Image| gpu.read_image(image);
    let parts = [
        read(&outputs.direct)?,
        read(&outputs.indirect)?,
        read(&outputs.emission)?,
    ];
    let radiance: Vec<_> = (0..parts[0].len())
        .map(|i| [0, 1, 2].map(|c| parts.iter().map(|part| part[i][c]).sum()))
        .collect();
    write_radiance(&folder.join("noisy.png"), extent, &radiance)?;
    let depth = read(&outputs.depth)?;
    let far = depth.iter().fold(1e-6, |far: f32, d| far.max(d[0]));
    let views: [(&str, Vec<[f32; 3]>); 4] = [
        ("depth", depth.iter().map(|d| [d[0] / far; 3]).collect()),
        (
            "normal",
            read(&outputs.normal)?
                .iter()
                .map(|n| [0, 1, 2].map(|c| 0.5 * n[c] + 0.5))
                .collect(),
        ),
        (
            "albedo",
            read(&outputs.albedo)?
                .iter()
                .map(|a| [a[0], a[1], a[2]])
                .collect(),
        ),
        (
            "motion",
            read(&outputs.motion)?
                .iter()
                .map(|m| [0.5 + 0.05 * m[0], 0.5 + 0.05 * m[1], 0.5])
                .collect(),
        ),
    ];
    for (name, pixels) in views {
        write_png(
            &folder.join(format!("{name}.png")),
            extent,
            pixels.into_iter().map(|p| p.map(byte)),
        )?;
    }
    Ok(())
}

/// Writes linear radiance through a filmic curve.
pub fn write_radiance(path: &Path, extent: vk::Extent2D, radiance: &[[f32; 3]]) -> Result<()> {
    write_png(
        path,
        extent,
        radiance
            .iter()
            .map(|pixel| pixel.map(|value| byte(srgb(film(value))))),
    )
}

/// Narkowicz's fit of the ACES curve.
fn film(x: f32) -> f32 {
    let x = 0.7 * x.max(0.0);
    (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0)
}

fn srgb(x: f32) -> f32 {
    if x <= 0.0031308 {
        12.92 * x
    } else {
        1.055 * x.powf(1.0 / 2.4) - 0.055
    }
}

fn byte(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

fn write_png(
    path: &Path,
    extent: vk::Extent2D,
    pixels: impl Iterator<Item = [u8; 3]>,
) -> Result<()> {
    let failed = |problem: String| Error::Picture {
        path: path.to_path_buf(),
        problem,
    };
    let file = File::create(path).map_err(|e| failed(e.to_string()))?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), extent.width, extent.height);
    encoder.set_color(png::ColorType::Rgb);
    let data: Vec<u8> = pixels.flatten().collect();
    let mut writer = encoder.write_header().map_err(|e| failed(e.to_string()))?;
    writer
        .write_image_data(&data)
        .map_err(|e| failed(e.to_string()))
}

//! The inputs of a graph, in the formats that its declaration prefers, so that traffic is what a host has.

use super::content::Content;
use ash::vk;
use atrous::executor::{InputSet, Session};
use atrous::{Declaration, Input, Lifetime, ResourceDecl, Shape, TexelGrid};
use atrous_synthetic::moving::Pixel;
use half::f16;
use std::error::Error;
use std::ops::Range;

/// Optional inputs that are given, as most hosts have them.
const GIVEN: [&str; 7] =
    ["motion", "albedo", "scattering_depth", "roughness", "specular_albedo", "specular_hit_distance", "occluder_distance"];

/// Whether a pass finds something at a resource: an optional input may be left out.
pub fn is_given(resource: &ResourceDecl) -> bool {
    resource.lifetime != Lifetime::Input { optional: true } || GIVEN.contains(&resource.name.as_str())
}

/// Image that is to be made.
struct Image {
    name: String,
    format: vk::Format,
    side: u32,
}

/// Adds what a session needs and a set lacks, and binds all of it.
pub fn complete(set: &mut InputSet, session: &mut Session, content: Content, frame: u32) -> Result<(), Box<dyn Error>> {
    session.bind_inputs(set)?;
    let declaration = session.executor().denoiser().declaration();
    let size = declaration.allocated_extent();
    let images = missing(set, declaration);
    for (image, bytes) in images.iter().zip(make(&images, content, size, frame)?) {
        session.upload_bytes(&image.name, &bytes)?;
    }
    Ok(set.add(session)?)
}

fn missing(set: &InputSet, declaration: &Declaration) -> Vec<Image> {
    let setup = declaration.setup();
    let wanted = declaration.resources().iter().filter(|r| matches!(r.lifetime, Lifetime::Input { .. }) && is_given(r));
    let lacking = wanted.filter(|r| !set.contains(&r.name));
    lacking
        .filter_map(|r| match r.shape {
            Shape::Image { format, texels: TexelGrid::Rendered(side) } => {
                Some(Image { name: r.name.clone(), format: format.preferred(), side })
            }
            Shape::Image { format, texels: TexelGrid::Light(side) } => {
                let ratio = setup.light_extent.map_or(1, |light| setup.allocated_extent[0] / light[0]);
                Some(Image { name: r.name.clone(), format: format.preferred(), side: side * ratio })
            }
            Shape::Image { .. } | Shape::Buffer { .. } => None,
        })
        .collect()
}

/// The texels of every image, made by as many threads as there are cores.
fn make(images: &[Image], content: Content, size: [u32; 2], frame: u32) -> Result<Vec<Vec<u8>>, Box<dyn Error>> {
    let known = [vk::Format::R16G16B16A16_SFLOAT, vk::Format::R32_SFLOAT, vk::Format::R32_UINT];
    if let Some(image) = images.iter().find(|image| !known.contains(&image.format)) {
        return Err(format!("the input `{}` has the format {:?}; the benchmark makes {known:?}", image.name, image.format).into());
    }
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u32).min(size[1]);
    let band = |i: u32| size[1] * i / threads..size[1] * (i + 1) / threads;
    let mut whole = vec![Vec::new(); images.len()];
    std::thread::scope(|scope| {
        let bands: Vec<_> = (0..threads).map(|i| scope.spawn(move || rows(images, content, size, frame, band(i)))).collect();
        for band in bands {
            let part = band.join().map_err(|_| "a thread that makes inputs failed")?;
            whole.iter_mut().zip(part).for_each(|(whole, part)| whole.extend(part));
        }
        Ok(whole)
    })
}

fn rows(images: &[Image], content: Content, size: [u32; 2], frame: u32, rows: Range<u32>) -> Vec<Vec<u8>> {
    let mut bytes = vec![Vec::new(); images.len()];
    for y in rows {
        let pixels: Vec<Pixel> = (0..size[0]).map(|x| content.pixel(size, frame, x, y)).collect();
        for (image, bytes) in images.iter().zip(&mut bytes) {
            if y % image.side == 0 {
                // Each light has shadows of its own.
                let aside = Input::by_name(&image.name).map_or(0, |input| input.light) * pixels.len() / 4;
                let row = pixels.iter().cycle().skip(aside).take(pixels.len());
                row.step_by(image.side as usize).for_each(|pixel| write(image, pixel, bytes));
            }
        }
    }
    bytes
}

fn write(image: &Image, pixel: &Pixel, bytes: &mut Vec<u8>) {
    let texel = texel(&image.name, pixel);
    match image.format {
        vk::Format::R32_UINT => bytes.extend(pixel.surface_id.to_ne_bytes()),
        vk::Format::R32_SFLOAT => bytes.extend(texel[0].to_ne_bytes()),
        _ => texel.iter().for_each(|v| bytes.extend(f16::from_f32(*v).to_bits().to_ne_bytes())),
    }
}

/// The texel of an input by its name; one of another name has the radiance.
fn texel(name: &str, p: &Pixel) -> [f32; 4] {
    let colour = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    match name {
        "depth" => [p.depth; 4],
        "normal" | "object_normal" => colour(p.normal),
        "motion" => [p.motion[0], p.motion[1], 0.0, 0.0],
        "albedo" => colour(p.albedo),
        "noisy_direct" => colour(p.direct),
        "noisy_indirect" => colour(p.indirect),
        "noisy_volume" => colour(p.volume),
        "scattering_depth" => [p.scattering_depth; 4],
        // From a mirror to plaster.
        "roughness" => [[0.05, 0.2, 0.5, 1.0][p.surface_id as usize % 4]; 4],
        "specular_albedo" => colour([0.1; 3]),
        "specular_hit_distance" => [p.scattering_depth; 4],
        _ if name.starts_with("occluder_distance") => [p.scattering_depth; 4],
        // What is in the way is of green glass.
        _ if name.starts_with("noisy_visibility") => {
            if p.visibility == 0.0 {
                [0.0, 0.75, 0.25, 0.0]
            } else {
                [1.0; 4]
            }
        }
        "confidence" => [0.9; 4],
        _ => colour([0, 1, 2].map(|i| p.direct[i] + p.indirect[i])),
    }
}

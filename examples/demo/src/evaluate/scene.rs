//! One scene: every filter on the same frames, and what they are worth.

use std::path::Path;
use std::sync::Arc;

use atrous_demo::measure::{Frame, Scores};
use atrous_demo::{FrameDenoiser, Gpu, PathTracer, Result, Scene, TracerOptions};
use atrous_picture::{Picture, PictureError};
use atrous_quality::{flip_map, Rgb};
use indicatif::ProgressBar;

use super::contenders::{self, NOISY};
use super::references::References;
use super::results::Row;
use super::settings::Settings;
use crate::running::{self, Running};

/// Name of the reference among pictures.
pub const REFERENCE: &str = "reference";

/// What is summed up over the frames.
#[derive(Default)]
struct Measured {
    scores: Vec<Vec<Scores>>,
    light: Vec<f64>,
    reference_light: f64,
}

/// Steps that [`measure`] reports: one for each frame, and one for each measured frame again.
pub fn steps(settings: &Settings) -> u64 {
    u64::from(settings.frames + settings.measured)
}

/// Renders, denoises and measures a scene, and leaves the pictures of its last frame in a folder, which exists.
pub fn measure(
    gpu: &Gpu,
    scene: &Arc<Scene>,
    settings: &Settings,
    references: &References,
    folder: &Path,
    bar: &ProgressBar,
) -> Result<Vec<Row>> {
    let (width, height) = settings.size;
    let options = TracerOptions { seed: settings.seed, noise: settings.noise, ..TracerOptions::default() };
    let mut tracer = PathTracer::new(gpu, scene, ash::vk::Extent2D { width, height }, options)?;
    let wanted = contenders::all().into_iter().filter(|c| settings.filters.iter().any(|name| name == c.name));
    let start = |c: contenders::Contender| Running::new(gpu, &tracer, c.name, &c.options);
    let mut filters = wanted.map(start).collect::<Result<Vec<_>>>()?;
    let frames = sequence(gpu, settings, &mut tracer, &mut filters, bar)?;
    let names = names(settings);
    let measured = score(frames, scene, &mut tracer, references, &names, folder, bar)?;
    let row = |(index, name): (usize, &String)| {
        let filter = index.checked_sub(1).map(|i| &filters[i]);
        Row {
            name: name.clone(),
            frames: measured.scores.iter().map(|of_frame| of_frame[index]).collect(),
            energy: measured.light[index] / measured.reference_light,
            milliseconds: filter.map(|f| f.times.of_a_frame()).filter(|ms| ms.is_finite()),
            bytes_per_pixel: filter.map(|f| bytes_per_pixel(&f.denoiser)),
        }
    };
    Ok(names.iter().enumerate().map(row).collect())
}

/// Names of the pictures in the order of [`Frame::pictures`].
fn names(settings: &Settings) -> Vec<String> {
    std::iter::once(NOISY.to_owned()).chain(settings.filters.iter().cloned()).collect()
}

/// Runs the animation; gives the frames that are measured.
fn sequence(
    gpu: &Gpu,
    settings: &Settings,
    tracer: &mut PathTracer,
    filters: &mut [Running],
    bar: &ProgressBar,
) -> Result<Vec<Frame>> {
    let mut measured = Vec::new();
    for index in 0..settings.frames {
        running::render(gpu, tracer, filters, index)?;
        if settings.measured_frames().contains(&index) {
            measured.push(running::read(gpu, tracer, filters)?);
        }
        bar.inc(1);
    }
    Ok(measured)
}

fn score(
    frames: Vec<Frame>,
    scene: &Scene,
    tracer: &mut PathTracer,
    references: &References,
    names: &[String],
    folder: &Path,
    bar: &ProgressBar,
) -> Result<Measured> {
    let mut measured = Measured::default();
    let mut previous: Option<Frame> = None;
    let last = frames.len() - 1;
    for (number, mut frame) in frames.into_iter().enumerate() {
        let reference = references.of_frame(tracer, scene, frame.index)?;
        measured.reference_light += light(&reference);
        let of_pictures: Vec<_> = frame.pictures().map(light).collect();
        measured.light.resize(of_pictures.len(), 0.0);
        measured.light.iter_mut().zip(of_pictures).for_each(|(sum, light)| *sum += light);
        frame.reference = Some(reference);
        measured.scores.extend(frame.scores(previous.as_ref())?);
        if number == last {
            write_pictures(&frame, names, folder)?;
        }
        previous = Some(frame);
        bar.inc(1);
    }
    Ok(measured)
}

fn light(pixels: &[[f32; 3]]) -> f64 {
    pixels.iter().flatten().map(|value| f64::from(*value)).sum()
}

fn bytes_per_pixel(denoiser: &FrameDenoiser) -> f64 {
    let declaration = denoiser.executor().denoiser().declaration();
    let ([width, height], memory) = (declaration.allocated_extent(), declaration.memory());
    (memory.history + memory.transient) as f64 / (f64::from(width) * f64::from(height))
}

/// Every picture, the reference, and the FLIP of each against it as grey values.
fn write_pictures(frame: &Frame, names: &[String], folder: &Path) -> Result<()> {
    let [width, height] = frame.extent;
    let Some(reference) = &frame.reference else { return Ok(()) };
    Picture::from_linear(width, height, reference, 1.0)?.write_png(picture(folder, REFERENCE))?;
    let reference = Rgb::new(width, height, reference)?;
    for (name, pixels) in names.iter().zip(frame.pictures()) {
        Picture::from_linear(width, height, pixels, 1.0)?.write_png(picture(folder, name))?;
        let grey = flip_map(Rgb::new(width, height, pixels)?, reference)?.into_iter().map(|error| [(255.0 * error + 0.5) as u8; 3]);
        Picture::from_pixels(width, height, grey.collect())?.write_png(error_picture(folder, name))?;
    }
    Ok(())
}

/// File of the last frame's picture.
pub fn picture(folder: &Path, name: &str) -> std::path::PathBuf {
    folder.join(format!("{}.png", name.replace([' ', ','], "_")))
}

fn error_picture(folder: &Path, name: &str) -> std::path::PathBuf {
    folder.join(format!("{}_flip.png", name.replace([' ', ','], "_")))
}

/// FLIP of a filter's last picture, 0 to 1 for each pixel.
///
/// # Errors
/// A file that cannot be read.
pub fn read_error(folder: &Path, name: &str) -> std::result::Result<Vec<f32>, PictureError> {
    let grey = Picture::read_png(error_picture(folder, name))?;
    Ok(grey.pixels().iter().map(|[value, ..]| f32::from(*value) / 255.0).collect())
}

//! One scene: every filter on the same frames, and what they are worth.

use std::path::Path;
use std::sync::Arc;

use crate::measure::{Frame, Scores};
use crate::Result;
use atrous::executor::{HeadlessDevice, HeadlessOptions};
use atrous_engine::{FrameDenoiser, Gpu, PathTracer, Scene, TracerOptions};
use atrous_lab::pictures::{Picture, PictureError};
use atrous_lab::scores::{flip_map, Rgb};
use indicatif::ProgressBar;

use super::contenders::{Contender, NOISY};
use super::references::References;
use super::results::{Memory, Row};
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

/// Where and how is measured.
#[derive(Clone, Copy)]
pub struct Lab<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// Sizes, frames, seed.
    pub settings: &'a Settings,
    /// References.
    pub references: &'a References,
    /// Gets longer by the steps of what is measured.
    pub bar: &'a ProgressBar,
}

impl Lab<'_> {
    /// A path tracer of a scene.
    ///
    /// # Errors
    /// A scene that is too large, or no memory.
    pub fn tracer(&self, scene: &Arc<Scene>, options: TracerOptions) -> Result<PathTracer> {
        let [width, height] = self.settings.size;
        let options = TracerOptions { seed: self.settings.seed, noise: self.settings.noise, ..options };
        Ok(PathTracer::new(self.gpu, scene, ash::vk::Extent2D { width, height }, options)?)
    }

    /// The device once more, for sessions that take slices.
    ///
    /// # Errors
    /// A device that cannot be opened.
    pub fn headless(&self) -> Result<Arc<HeadlessDevice>> {
        let options = HeadlessOptions { device: Some(self.gpu.info().name.clone()), ..HeadlessOptions::default() };
        Ok(Arc::new(HeadlessDevice::new(&options)?))
    }

    /// Filters that read the images of a tracer.
    ///
    /// # Errors
    /// A device without what a filter needs, or no memory.
    pub fn start(&self, tracer: &PathTracer, contenders: &[Contender]) -> Result<Vec<Running>> {
        let mut filters: Vec<Running> = Vec::new();
        for contender in contenders {
            let mut filter = Running::new(self.gpu, tracer, contender.name, &contender.options)?;
            if let Some(other) = filters.iter_mut().find(|other| contender.over == Some(other.name)) {
                filter.denoiser.follow(&mut other.denoiser, tracer.extent())?;
            }
            filters.push(filter);
        }
        Ok(filters)
    }
}

/// Renders, denoises and measures a scene, and leaves the pictures of its last frame in a folder, which exists.
///
/// # Errors
/// A lost device, or a folder that cannot be written.
pub fn measure(lab: &Lab, scene: &Arc<Scene>, options: TracerOptions, contenders: &[Contender], folder: &Path) -> Result<Vec<Row>> {
    lab.bar.inc_length(u64::from(lab.settings.frames + lab.settings.measured));
    let mut tracer = lab.tracer(scene, options)?;
    let mut filters = lab.start(&tracer, contenders)?;
    let frames = sequence(lab, &mut tracer, &mut filters)?;
    let names: Vec<_> = std::iter::once(NOISY).chain(contenders.iter().map(|c| c.name)).collect();
    let measured = score(lab, frames, scene, &mut tracer, &names, folder)?;
    let row = |(index, name): (usize, &&str)| {
        let filter = index.checked_sub(1).map(|i| &filters[i]);
        Row {
            name: (*name).to_owned(),
            frames: measured.scores.iter().map(|of_frame| of_frame[index]).collect(),
            energy: measured.light[index] / measured.reference_light,
            stages: filter.map_or(Vec::new(), |f| f.times.stages()),
            memory: filter.map(|f| memory(&f.denoiser)),
        }
    };
    Ok(names.iter().enumerate().map(row).collect())
}

/// Runs the animation; gives the frames that are measured.
fn sequence(lab: &Lab, tracer: &mut PathTracer, filters: &mut [Running]) -> Result<Vec<Frame>> {
    let mut measured = Vec::new();
    for index in 0..lab.settings.frames {
        running::render(lab.gpu, tracer, filters, index)?;
        if lab.settings.measured_frames().contains(&index) {
            measured.push(running::read(lab.gpu, tracer, filters)?);
        }
        lab.bar.inc(1);
    }
    Ok(measured)
}

fn score(lab: &Lab, frames: Vec<Frame>, scene: &Scene, tracer: &mut PathTracer, names: &[&str], folder: &Path) -> Result<Measured> {
    let mut measured = Measured::default();
    let mut previous: Option<Frame> = None;
    let last = frames.len() - 1;
    for (number, mut frame) in frames.into_iter().enumerate() {
        let halves = lab.references.of_frame(tracer, scene, frame.index)?;
        measured.reference_light += halves.iter().map(|half| 0.5 * light(half)).sum::<f64>();
        let of_pictures: Vec<_> = frame.pictures().map(light).collect();
        measured.light.resize(of_pictures.len(), 0.0);
        measured.light.iter_mut().zip(of_pictures).for_each(|(sum, light)| *sum += light);
        frame.set_halves(halves);
        measured.scores.extend(frame.scores(previous.as_ref())?);
        if number == last {
            write_pictures(&frame, names, folder)?;
        }
        previous = Some(frame);
        lab.bar.inc(1);
    }
    Ok(measured)
}

fn light(pixels: &[[f32; 3]]) -> f64 {
    pixels.iter().flatten().map(|value| f64::from(*value)).sum()
}

fn memory(denoiser: &FrameDenoiser) -> Memory {
    let declaration = denoiser.executor().denoiser().declaration();
    let ([width, height], memory) = (declaration.allocated_extent(), declaration.memory());
    let per_pixel = |bytes: u64| bytes as f64 / (f64::from(width) * f64::from(height));
    Memory { history: per_pixel(memory.history), transient: per_pixel(memory.transient) }
}

/// Every picture, the reference, and the FLIP of each against it as grey values.
fn write_pictures(frame: &Frame, names: &[&str], folder: &Path) -> Result<()> {
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

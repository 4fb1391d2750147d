//! The volume of a frame by itself: what the medium scatters, without the surfaces behind it.

use std::path::Path;

use atrous_lab::pictures::{Column, Picture, PictureError, Strip, TextTable};
use atrous_lab::scores::{rmse, Rgb};

use crate::measure::rgb;
use crate::Result;
use atrous_engine::{FrameDenoiser, Gpu, PathTracer};

/// Radiance of the medium.
pub struct VolumeFrame {
    /// Width and height in pixels.
    pub extent: [u32; 2],
    /// At one sample per pixel.
    pub noisy: Vec<[f32; 3]>,
    /// What came out, in the order of the denoisers.
    pub denoised: Vec<Vec<[f32; 3]>>,
    /// The converged one, where it was rendered.
    pub reference: Option<Vec<[f32; 3]>>,
}

impl VolumeFrame {
    /// The noisy volume; `None` in a scene without a medium.
    pub(crate) fn read(gpu: &Gpu, tracer: &PathTracer) -> Result<Option<Self>> {
        let Some(volume) = tracer.volume() else { return Ok(None) };
        let extent = [tracer.extent().width, tracer.extent().height];
        let noisy = rgb(gpu.read_image(&volume.noisy_volume)?);
        Ok(Some(Self { extent, noisy, denoised: Vec::new(), reference: None }))
    }

    /// Adds what a denoiser made of it.
    pub(crate) fn read_denoised(&mut self, denoiser: &mut FrameDenoiser) -> Result<&[[f32; 3]]> {
        self.denoised.push(rgb(denoiser.read("denoised_volume")?));
        Ok(self.denoised.last().map_or(&[], Vec::as_slice))
    }

    /// Root mean square errors of the noisy volume, then of each denoised one; `None` without a reference.
    ///
    /// # Errors
    /// A picture with values that are not finite.
    pub fn errors(&self) -> Result<Option<Vec<f64>>> {
        let Some(reference) = &self.reference else { return Ok(None) };
        let [w, h] = self.extent;
        let reference = Rgb::new(w, h, reference)?;
        let error = |image: &Vec<[f32; 3]>| Ok(rmse(Rgb::new(w, h, image)?, reference)?);
        std::iter::once(&self.noisy).chain(&self.denoised).map(error).collect::<Result<_>>().map(Some)
    }
}

/// Noisy, each denoised volume, the reference where there is one, and the composite of each with its surfaces. With labels: `names` are those
/// of the denoisers.
///
/// # Errors
/// A file that cannot be written.
pub fn write_strip(path: &Path, title: &str, volume: &VolumeFrame, names: &[&str], composites: &[&[[f32; 3]]]) -> Result<()> {
    let [w, h] = volume.extent;
    let errors = volume.errors()?;
    let mut strip = Strip::new(title);
    let titles = ["volume, 1 sample per pixel"].iter().chain(names);
    for (i, (name, pixels)) in titles.zip(std::iter::once(&volume.noisy).chain(&volume.denoised)).enumerate() {
        let label = match errors.as_ref().and_then(|e| e.get(i)) {
            Some(error) => format!("{name}\nRMSE {error:.4}"),
            None => (*name).to_owned(),
        };
        strip = strip.panel(label, Picture::from_linear(w, h, pixels, 1.0)?);
    }
    if let Some(reference) = &volume.reference {
        strip = strip.panel("volume, reference", Picture::from_linear(w, h, reference, 1.0)?);
    }
    for (name, pixels) in names.iter().zip(composites) {
        strip = strip.panel(format!("{name}, with surfaces"), Picture::from_linear(w, h, pixels, 1.0)?);
    }
    Ok(strip.columns(4).render()?.write_png(path)?)
}

/// The error of the volume in every frame that was measured: a column for each name, the noisy one first.
///
/// # Errors
/// Another number of errors than names.
pub fn error_table(names: &[&str], frames: &[(u32, Vec<f64>)]) -> std::result::Result<TextTable, PictureError> {
    let mut table = TextTable::new("RMSE of the volume, frame", names.iter().map(|name| Column::new(*name, 4)));
    for (index, errors) in frames {
        table.row(index.to_string(), errors)?;
    }
    let noisy: f64 = frames.iter().filter_map(|(_, errors)| errors.first()).sum();
    let share = |i: usize| frames.iter().filter_map(|(_, errors)| errors.get(i)).sum::<f64>() / noisy;
    table.row("share of the noisy one", &(0..names.len()).map(share).collect::<Vec<_>>())?;
    Ok(table)
}

//! What a frame has apart from the light of surfaces, by itself: the volume, the visibility of lamps, ambient occlusion.

use std::path::Path;

use atrous_lab::pictures::{Column, Picture, PictureError, Strip, TextTable};
use atrous_lab::scores::{rmse, Rgb};

use crate::measure::{every_pixel, rgb};
use crate::Result;
use atrous_engine::{FrameDenoiser, Gpu, PathTracer};

/// One signal of a frame.
pub struct Apart {
    /// Its name in strips and tables.
    pub name: String,
    /// The denoisers' output.
    output: String,
    /// Width and height in pixels.
    pub extent: [u32; 2],
    /// At one sample per pixel.
    pub noisy: Vec<[f32; 3]>,
    /// What came out, in the order of the denoisers.
    pub denoised: Vec<Vec<[f32; 3]>>,
    /// The converged one, where it was rendered.
    pub reference: Option<Vec<[f32; 3]>>,
}

impl Apart {
    /// The noisy volume; `None` in a scene without a medium.
    pub(crate) fn volume(gpu: &Gpu, tracer: &PathTracer) -> Result<Option<Self>> {
        let Some(volume) = tracer.volume() else { return Ok(None) };
        let noisy = rgb(every_pixel(tracer, gpu.read_image(&volume.noisy_volume)?));
        Ok(Some(Self::new(tracer, "volume".to_owned(), "denoised_volume".to_owned(), noisy)))
    }

    /// The noisy visibility of each lamp that is apart, and ambient occlusion.
    pub(crate) fn shadows(gpu: &Gpu, tracer: &PathTracer) -> Result<Vec<Self>> {
        let mut all = Vec::new();
        for (number, lamp) in tracer.lamps_apart().iter().enumerate() {
            let output = if number == 0 { "denoised_visibility".to_owned() } else { format!("denoised_visibility_{number}") };
            let coloured = tracer.scene().has_glass();
            let texel = |[r, g, b, _]: [f32; 4]| if coloured { [r, g, b] } else { [r; 3] };
            let noisy = every_pixel(tracer, gpu.read_image(&lamp.noisy_visibility)?).into_iter().map(texel).collect();
            all.push(Self::new(tracer, format!("visibility of lamp {number}"), output, noisy));
        }
        if let Some(ambient) = tracer.ambient() {
            let noisy = grey(every_pixel(tracer, gpu.read_image(&ambient.noisy_ambient)?));
            all.push(Self::new(tracer, "ambient occlusion".to_owned(), "denoised_ambient".to_owned(), noisy));
        }
        Ok(all)
    }

    fn new(tracer: &PathTracer, name: String, output: String, noisy: Vec<[f32; 3]>) -> Self {
        let extent = [tracer.extent().width, tracer.extent().height];
        Self { name, output, extent, noisy, denoised: Vec::new(), reference: None }
    }

    /// Adds what a denoiser made of it.
    pub(crate) fn read_denoised(&mut self, denoiser: &mut FrameDenoiser) -> Result<&[[f32; 3]]> {
        let texels = denoiser.read(&self.output)?;
        // An output of one channel has nothing in the others.
        let is_grey = self.noisy.iter().all(|[r, g, b]| r == g && g == b);
        self.denoised.push(if is_grey { grey(texels) } else { rgb(texels) });
        Ok(self.denoised.last().map_or(&[], Vec::as_slice))
    }

    /// Root mean square errors of the noisy signal, then of each denoised one; `None` without a reference.
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

/// Noisy, each denoised signal, the reference where there is one, and what each is composed with. With labels: `names` are those
/// of the denoisers.
///
/// # Errors
/// A file that cannot be written.
pub fn write_strip(path: &Path, title: &str, signal: &Apart, names: &[&str], composites: &[&[[f32; 3]]]) -> Result<()> {
    let [w, h] = signal.extent;
    let errors = signal.errors()?;
    let mut strip = Strip::new(title);
    let first = format!("{}, 1 sample per pixel", signal.name);
    let titles = [first.as_str()].into_iter().chain(names.iter().copied());
    for (i, (name, pixels)) in titles.zip(std::iter::once(&signal.noisy).chain(&signal.denoised)).enumerate() {
        let label = match errors.as_ref().and_then(|e| e.get(i)) {
            Some(error) => format!("{name}\nRMSE {error:.4}"),
            None => name.to_owned(),
        };
        strip = strip.panel(label, Picture::from_linear(w, h, pixels, 1.0)?);
    }
    if let Some(reference) = &signal.reference {
        strip = strip.panel(format!("{}, reference", signal.name), Picture::from_linear(w, h, reference, 1.0)?);
    }
    for (name, pixels) in names.iter().zip(composites) {
        strip = strip.panel(format!("{name}, with surfaces"), Picture::from_linear(w, h, pixels, 1.0)?);
    }
    Ok(strip.columns(4).render()?.write_png(path)?)
}

/// The error of the signal in every frame that was measured: a column for each name, the noisy one first.
///
/// # Errors
/// Another number of errors than names.
pub fn error_table(signal: &str, names: &[&str], frames: &[(u32, Vec<f64>)]) -> std::result::Result<TextTable, PictureError> {
    let mut table = TextTable::new(format!("RMSE of the {signal}, frame"), names.iter().map(|name| Column::new(*name, 4)));
    for (index, errors) in frames {
        table.row(index.to_string(), errors)?;
    }
    let noisy: f64 = frames.iter().filter_map(|(_, errors)| errors.first()).sum();
    let share = |i: usize| frames.iter().filter_map(|(_, errors)| errors.get(i)).sum::<f64>() / noisy;
    table.row("share of the noisy one", &(0..names.len()).map(share).collect::<Vec<_>>())?;
    Ok(table)
}

fn grey(texels: Vec<[f32; 4]>) -> Vec<[f32; 3]> {
    texels.into_iter().map(|[v, ..]| [v; 3]).collect()
}

//! The error of a filter against the reference, as a heat map of FLIP with its numbers. Measured on a thread of its own, since FLIP takes
//! longer than a frame: what is shown is of the last frame that was measured.

use std::sync::Arc;
use std::thread::JoinHandle;

use ash::vk;
use atrous::config::Preset;
use atrous_lab::pages::HeatMap;
use atrous_lab::pictures::from_srgb_8bit;
use atrous_lab::scores::{flip_map, rmse, Rgb};

use super::panes::{PaneWriter, Panes, Source};
use super::shared::ErrorReport;
use crate::error::Result;
use atrous_engine::gpu::{Gpu, Image};

/// Called when something was measured.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// The errors that are shown.
pub struct ErrorViews {
    /// The two pictures that are compared, as they are read back.
    compared: Panes,
    views: Vec<ErrorView>,
}

/// That of one filter.
struct ErrorView {
    preset: Preset,
    image: Image,
    report: Option<ErrorReport>,
    /// The frame, and the paths of the reference, that were measured last or are being measured.
    of: Option<(u32, u32)>,
    work: Option<JoinHandle<Result<Measured>>>,
}

/// What was measured.
struct Measured {
    report: ErrorReport,
    /// Display-referred, linear.
    colours: Vec<[f32; 4]>,
}

impl ErrorViews {
    /// None yet.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, extent: vk::Extent2D) -> Result<Self> {
        Ok(Self { compared: Panes::new(gpu, extent)?, views: Vec::new() })
    }

    /// Shows those of these filters from now on.
    ///
    /// # Errors
    /// No memory.
    pub fn keep(&mut self, gpu: &Gpu, presets: &[Preset]) -> Result<()> {
        self.views.retain(|view| presets.contains(&view.preset));
        for preset in presets {
            if self.views.iter().all(|view| view.preset != *preset) {
                let image = Image::new(gpu, "error view", vk::Format::R16G16B16A16_SFLOAT, self.compared.extent())?;
                super::panes::prepare(gpu, &[&image])?;
                gpu.write_half_texels(&image, &[])?;
                self.views.push(ErrorView { preset: *preset, image, report: None, of: None, work: None });
            }
        }
        Ok(())
    }

    /// Takes what is measured, and measures the error of a filter in a frame unless it is known or another one is being measured. Both
    /// pictures are linear radiance.
    ///
    /// # Errors
    /// A lost device, or pictures that cannot be compared: with values that are not finite.
    pub fn measure(
        &mut self,
        gpu: &Gpu,
        writer: &mut PaneWriter,
        preset: Preset,
        (frame, paths): (u32, u32),
        pictures: [&Source; 2],
        wake: &Wake,
    ) -> Result<()> {
        let Some(view) = self.views.iter_mut().find(|view| view.preset == preset) else { return Ok(()) };
        view.take(gpu)?;
        if view.work.is_some() || view.of == Some((frame, paths)) || paths == 0 {
            return Ok(());
        }
        for (side, source) in pictures.into_iter().enumerate() {
            writer.write(gpu, &self.compared, side, source)?;
        }
        let read = |side: usize| -> Result<Vec<[f32; 3]>> {
            Ok(gpu.read_image(&self.compared.images[side])?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
        };
        let (picture, reference) = (read(0)?, read(1)?);
        let vk::Extent2D { width, height } = self.compared.extent();
        let wake = wake.clone();
        view.of = Some((frame, paths));
        view.work = Some(std::thread::spawn(move || {
            let measured = measured([width, height], &picture, &reference, preset, paths);
            wake();
            measured
        }));
        Ok(())
    }

    /// The heat map of a filter's error; black before the first was measured.
    pub fn source(&self, preset: Preset) -> Option<Source<'_>> {
        self.views.iter().find(|view| view.preset == preset).map(|view| Source::of(&view.image))
    }

    /// The numbers of those that were measured.
    pub fn reports(&self) -> Vec<ErrorReport> {
        self.views.iter().filter_map(|view| view.report).collect()
    }
}

impl ErrorView {
    fn take(&mut self, gpu: &Gpu) -> Result<()> {
        let Some(work) = self.work.take_if(|work| work.is_finished()) else { return Ok(()) };
        // A panic was printed; the next frame is measured.
        let Ok(measured) = work.join() else { return Ok(()) };
        let Measured { report, colours } = measured?;
        gpu.write_half_texels(&self.image, &colours)?;
        self.report = Some(report);
        Ok(())
    }
}

fn measured(extent: [u32; 2], picture: &[[f32; 3]], reference: &[[f32; 3]], preset: Preset, paths: u32) -> Result<Measured> {
    let [width, height] = extent;
    let (picture, reference) = (Rgb::new(width, height, picture)?, Rgb::new(width, height, reference)?);
    let map = flip_map(picture, reference)?;
    let flip = map.iter().map(|error| f64::from(*error)).sum::<f64>() / map.len() as f64;
    let report = ErrorReport { preset, rmse: rmse(picture, reference)?, flip, paths };
    let colour = |rgb: &[u8; 3]| {
        let [r, g, b] = rgb.map(from_srgb_8bit);
        [r, g, b, 1.0]
    };
    let colours = HeatMap::of_flip(width, height, &map)?.picture().pixels().iter().map(colour).collect();
    Ok(Measured { report, colours })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_bright_where_it_is_and_has_its_numbers() {
        let grey = vec![[0.5; 3]; 64 * 32];
        let mut wrong = grey.clone();
        (0..32).for_each(|y| wrong[y * 64 + 10..y * 64 + 20].fill([2.0, 0.5, 0.5]));
        let of = |picture: &[[f32; 3]]| measured([64, 32], picture, &grey, Preset::Svgf, 8).expect("measured");
        let (same, other) = (of(&grey), of(&wrong));
        assert_eq!((same.report.rmse, same.report.flip, same.report.paths), (0.0, 0.0, 8));
        // A tenth and a half of the pixels are off by 1.5 in one of three channels.
        assert!((other.report.rmse - 1.5 * (10.0f64 / 64.0 / 3.0).sqrt()).abs() < 1e-6, "{}", other.report.rmse);
        let light = |x: usize| other.colours[16 * 64 + x][..3].iter().sum::<f32>();
        assert!(light(15) > 0.5 && light(50) < 0.1, "{} {}", light(15), light(50));
        assert!(measured([64, 32], &vec![[f32::NAN; 3]; 64 * 32], &grey, Preset::Svgf, 8).is_err());
    }
}

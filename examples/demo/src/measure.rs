//! What a frame is measured with: its pictures on the CPU, and their scores against the reference.

use atrous::quality::{psnr, rel_mse, rmse, ssim, temporal_error, QualityError, Rgb, TemporalGuides};

use crate::{FrameDenoiser, Gpu, PathTracer, Result};

/// One frame, read back.
pub struct Frame {
    /// Index.
    pub index: u32,
    /// Width and height in pixels.
    pub extent: [u32; 2],
    /// Radiance at one path per pixel.
    pub noisy: Vec<[f32; 3]>,
    /// Radiance after the denoiser.
    pub denoised: Vec<[f32; 3]>,
    /// The converged radiance, where it was rendered.
    pub reference: Option<Vec<[f32; 3]>>,
    /// Frames accumulated.
    pub history_length: Vec<f32>,
    /// Standard deviation of luminance after the first level of the filter.
    pub deviation: Vec<f32>,
    motion: Vec<[f32; 2]>,
    expected_previous_depth: Vec<f32>,
    depth: Vec<f32>,
    surface_id: Vec<u32>,
}

/// Scores of one picture against the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scores {
    /// Root mean square error.
    pub rmse: f64,
    /// Relative mean square error.
    pub rel_mse: f64,
    /// Peak signal-to-noise ratio of tone-mapped values, decibels.
    pub psnr: f64,
    /// Structural similarity of tone-mapped values.
    pub ssim: f64,
    /// Motion-compensated change that the reference does not have; NaN without the frame before.
    pub temporal_error: f64,
}

impl Frame {
    /// Reads a frame back.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read(gpu: &Gpu, tracer: &PathTracer, denoiser: &mut FrameDenoiser) -> Result<Self> {
        let outputs = tracer.outputs();
        let colour = |texels: Vec<[f32; 4]>| texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect::<Vec<_>>();
        let (scattered, emission) = (gpu.read_image(&outputs.scattered)?, gpu.read_image(&outputs.emission)?);
        let noisy = scattered.iter().zip(&emission).map(|(s, e)| [s[0] + e[0], s[1] + e[1], s[2] + e[2]]).collect();
        let suffix = if denoiser.executor().denoiser().declaration().find("moments").is_some() { "" } else { "_direct" };
        let moments = denoiser.read(&format!("moments{suffix}"))?;
        let history = denoiser.read(&format!("irradiance_history{suffix}"))?;
        let motion = gpu.read_image(&outputs.motion)?;
        Ok(Self {
            index: tracer.frame(),
            extent: [tracer.extent().width, tracer.extent().height],
            noisy,
            denoised: colour(denoiser.read("denoised_radiance")?),
            reference: None,
            history_length: moments.iter().map(|m| half::f16::from_bits(m[2] as u16).to_f32()).collect(),
            deviation: history.iter().map(|t| t[3]).collect(),
            motion: motion.iter().map(|m| [m[0], m[1]]).collect(),
            expected_previous_depth: motion.iter().map(|m| m[2]).collect(),
            depth: gpu.read_image(&outputs.depth)?.iter().map(|d| d[0]).collect(),
            surface_id: gpu.read_image_u32(&outputs.surface_id)?,
        })
    }

    /// Scores of the noisy and of the denoised picture; `None` without a reference.
    ///
    /// # Errors
    /// A picture with values that are not finite.
    pub fn scores(&self, previous: Option<&Frame>) -> Result<Option<[Scores; 2]>> {
        let Some(reference) = &self.reference else { return Ok(None) };
        let reference = self.view(reference)?;
        let score = |image: &Vec<[f32; 3]>, before: fn(&Frame) -> &Vec<[f32; 3]>| -> Result<Scores> {
            let image = self.view(image)?;
            Ok(Scores {
                rmse: rmse(image, reference)?,
                rel_mse: rel_mse(image, reference)?,
                psnr: psnr(image, reference)?,
                ssim: ssim(image, reference)?,
                temporal_error: self.temporal_error(image, reference, previous, before)?,
            })
        };
        Ok(Some([score(&self.noisy, |f| &f.noisy)?, score(&self.denoised, |f| &f.denoised)?]))
    }

    fn view<'a>(&self, pixels: &'a [[f32; 3]]) -> std::result::Result<Rgb<'a>, QualityError> {
        Rgb::new(self.extent[0], self.extent[1], pixels)
    }

    fn temporal_error(
        &self,
        image: Rgb,
        reference: Rgb,
        previous: Option<&Frame>,
        before: fn(&Frame) -> &Vec<[f32; 3]>,
    ) -> Result<f64> {
        let Some((previous, previous_reference)) = previous.and_then(|p| Some((p, p.reference.as_ref()?))) else {
            return Ok(f64::NAN);
        };
        let guides = TemporalGuides {
            motion_px: &self.motion,
            expected_previous_depth: &self.expected_previous_depth,
            previous_depth: &previous.depth,
            surface_id: &self.surface_id,
            previous_surface_id: &previous.surface_id,
        };
        match temporal_error(image, self.view(before(previous))?, reference, self.view(previous_reference)?, &guides) {
            Err(QualityError::NoCommonSurface) => Ok(f64::NAN),
            other => Ok(other?),
        }
    }
}

//! What a frame is measured with: its pictures on the CPU, and their scores against the reference.

use atrous::DebugView;
use atrous_lab::scores::{flip, psnr, temporal_error, QualityError, Rgb, TemporalGuides};
use atrous_lab::scores::{unbiased_rel_mse, unbiased_rmse, unbiased_ssim, unbiased_temporal_rmse};

use serde::{Deserialize, Serialize};

use crate::apart::Apart;
use crate::Result;
use atrous_engine::{FrameDenoiser, Gpu, PathTracer, Reference};

/// One frame, read back.
pub struct Frame {
    /// Index.
    pub index: u32,
    /// Width and height in pixels.
    pub extent: [u32; 2],
    /// Radiance at one path per pixel, as the last denoiser had it.
    pub noisy: Vec<[f32; 3]>,
    /// What came out, in the order of the denoisers.
    pub denoised: Vec<Denoised>,
    /// The converged radiance, where it was rendered.
    pub reference: Option<Vec<[f32; 3]>>,
    /// Two pictures with independent noise, whose mean is the reference: its noise is left out of errors then.
    pub halves: Option<[Vec<[f32; 3]>; 2]>,
    /// The part of it all that a medium scattered, where the scene has one.
    pub volume: Option<Apart>,
    /// Visibility of lamps and ambient occlusion, where they are apart.
    pub shadows: Vec<Apart>,
    motion: Vec<[f32; 2]>,
    expected_previous_depth: Vec<f32>,
    depth: Vec<f32>,
    surface_id: Vec<u32>,
}

/// What a denoiser made of a frame.
pub struct Denoised {
    /// Radiance.
    pub radiance: Vec<[f32; 3]>,
    /// Whatever else it can show, as [`FrameDenoiser::view`] gives it.
    pub views: Vec<(DebugView, Vec<[f32; 4]>)>,
}

/// Views of a strip. What is left out shows the inputs, or single passes.
const SHOWN: [DebugView; 5] =
    [DebugView::HistoryLength, DebugView::Deviation, DebugView::Gradient, DebugView::Lambda, DebugView::Alpha];

/// Scores of one picture against the reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Root mean square error.
    pub rmse: f64,
    /// Relative mean square error.
    pub rel_mse: f64,
    /// Peak signal-to-noise ratio of tone-mapped values, decibels.
    pub psnr: f64,
    /// Structural similarity of tone-mapped values.
    pub ssim: f64,
    /// Difference that an eye sees, HDR-FLIP.
    pub flip: f64,
    /// Motion-compensated change that the reference does not have: its root mean square where the reference has halves, otherwise its mean
    /// absolute value. NaN without the frame before.
    #[serde(with = "nan_as_null")]
    pub temporal_error: f64,
}

impl Denoised {
    /// Surfaces, and with them the volume, which is noted down by itself as well.
    fn read(denoiser: &mut FrameDenoiser, volume: Option<&mut Apart>, shadows: &mut [Apart]) -> Result<Self> {
        let mut views = denoiser.executor().denoiser().declaration().debug_views();
        views.retain(|view| SHOWN.contains(view));
        let views = views.into_iter().map(|view| Ok((view, denoiser.view(view)?))).collect::<Result<_>>()?;
        let mut radiance = rgb(denoiser.read("denoised_radiance")?);
        if let Some(volume) = volume {
            add(&mut radiance, volume.read_denoised(denoiser)?);
        }
        for signal in shadows {
            signal.read_denoised(denoiser)?;
        }
        Ok(Self { radiance, views })
    }
}

impl Frame {
    /// Reads a frame back, with what each denoiser made of it.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read<'a>(gpu: &Gpu, tracer: &PathTracer, denoisers: impl IntoIterator<Item = &'a mut FrameDenoiser>) -> Result<Self> {
        let outputs = tracer.outputs();
        let (scattered, emission) = (every_pixel(tracer, gpu.read_image(&outputs.scattered)?), gpu.read_image(&outputs.emission)?);
        let mut noisy = scattered.iter().zip(&emission).map(|(s, e)| [s[0] + e[0], s[1] + e[1], s[2] + e[2]]).collect::<Vec<_>>();
        for lamp in tracer.lamps_apart() {
            let seen = every_pixel(tracer, gpu.read_image(&lamp.noisy_visibility)?);
            let light = gpu.read_image(&lamp.unshadowed_direct)?;
            add(&mut noisy, &seen.iter().zip(&light).map(|(v, l)| [v[0] * l[0], v[1] * l[1], v[2] * l[2]]).collect::<Vec<_>>());
        }
        let (mut volume, mut shadows) = (Apart::volume(gpu, tracer)?, Apart::shadows(gpu, tracer)?);
        if let Some(volume) = &volume {
            add(&mut noisy, &volume.noisy);
        }
        let denoised = denoisers.into_iter().map(|d| Denoised::read(d, volume.as_mut(), &mut shadows)).collect::<Result<_>>()?;
        let motion = gpu.read_image(&outputs.motion)?;
        Ok(Self {
            index: tracer.frame(),
            extent: [tracer.extent().width, tracer.extent().height],
            noisy,
            denoised,
            reference: None,
            halves: None,
            volume,
            shadows,
            motion: motion.iter().map(|m| [m[0], m[1]]).collect(),
            expected_previous_depth: motion.iter().map(|m| m[2]).collect(),
            depth: gpu.read_image(&outputs.depth)?.iter().map(|d| d[0]).collect(),
            surface_id: gpu.read_image_u32(&outputs.surface_id)?,
        })
    }

    /// Keeps what the frame is measured against.
    pub fn set_reference(&mut self, reference: Reference) {
        self.reference = Some(reference.radiance());
        if let Some(volume) = &mut self.volume {
            volume.reference = reference.volume;
        }
    }

    /// Renders what shadows and ambient occlusion are measured against, by `samples` rays a pixel. The tracer's G-buffer is that of the frame.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn read_references_apart(&mut self, tracer: &PathTracer, samples: u32) -> Result<()> {
        let lamps = tracer.lamps_apart().len();
        for (number, signal) in (0u32..).zip(self.shadows.iter_mut().take(lamps)) {
            signal.reference = tracer.lamp_reference(number, samples)?;
        }
        if tracer.ambient().is_some() {
            let open = tracer.ambient_reference(samples)?.into_iter().map(|v| [v; 3]).collect();
            self.shadows[lamps].reference = Some(open);
        }
        Ok(())
    }

    /// Keeps what the frame is measured against: two pictures with independent noise.
    pub fn set_halves(&mut self, halves: [Vec<[f32; 3]>; 2]) {
        let [a, b] = &halves;
        self.reference = Some(a.iter().zip(b).map(|(a, b)| std::array::from_fn(|c| 0.5 * (a[c] + b[c]))).collect());
        self.halves = Some(halves);
    }

    /// Scores of the noisy picture, then of each denoised one; `None` without a reference.
    ///
    /// # Errors
    /// A picture with values that are not finite.
    pub fn scores(&self, previous: Option<&Frame>) -> Result<Option<Vec<Scores>>> {
        let Some(reference) = &self.reference else { return Ok(None) };
        let (reference, halves) = (self.view(reference)?, self.half_views()?);
        // One reference twice gives the plain errors.
        let references = halves.unwrap_or([reference; 2]);
        let score = |(i, image): (usize, &[[f32; 3]])| -> Result<Scores> {
            let image = self.view(image)?;
            Ok(Scores {
                rmse: unbiased_rmse(image, references)?,
                rel_mse: unbiased_rel_mse(image, references)?,
                psnr: psnr(image, reference)?,
                ssim: unbiased_ssim(image, references)?,
                flip: flip(image, reference)?,
                temporal_error: self.temporal_error(image, reference, previous, i)?,
            })
        };
        self.pictures().enumerate().map(score).collect::<Result<_>>().map(Some)
    }

    /// The noisy picture, then each denoised one.
    pub fn pictures(&self) -> impl Iterator<Item = &[[f32; 3]]> {
        std::iter::once(&self.noisy[..]).chain(self.denoised.iter().map(|d| &d.radiance[..]))
    }

    fn view<'a>(&self, pixels: &'a [[f32; 3]]) -> std::result::Result<Rgb<'a>, QualityError> {
        Rgb::new(self.extent[0], self.extent[1], pixels)
    }

    fn half_views(&self) -> std::result::Result<Option<[Rgb<'_>; 2]>, QualityError> {
        self.halves.as_ref().map(|[a, b]| Ok([self.view(a)?, self.view(b)?])).transpose()
    }

    /// `picture`: as numbered by [`Self::pictures`].
    fn temporal_error(&self, image: Rgb, reference: Rgb, previous: Option<&Frame>, picture: usize) -> Result<f64> {
        let before = previous.and_then(|p| Some((p, p.reference.as_ref()?, p.pictures().nth(picture)?)));
        let Some((previous, previous_reference, previous_image)) = before else { return Ok(f64::NAN) };
        let guides = TemporalGuides {
            motion_px: &self.motion,
            expected_previous_depth: &self.expected_previous_depth,
            previous_depth: &previous.depth,
            surface_id: &self.surface_id,
            previous_surface_id: &previous.surface_id,
        };
        let previous_image = self.view(previous_image)?;
        let error = match (self.half_views()?, previous.half_views()?) {
            (Some(halves), Some(before)) => unbiased_temporal_rmse(image, previous_image, halves, before, &guides),
            _ => temporal_error(image, previous_image, reference, self.view(previous_reference)?, &guides),
        };
        match error {
            Err(QualityError::NoCommonSurface) => Ok(f64::NAN),
            other => Ok(other?),
        }
    }
}

/// Light of fewer pixels, each shown in all pixels that it stands for.
pub(crate) fn every_pixel(tracer: &PathTracer, light: Vec<[f32; 4]>) -> Vec<[f32; 4]> {
    let (extent, from) = (tracer.extent(), tracer.light_extent());
    if from == extent {
        return light;
    }
    let pixels = (0..extent.height).flat_map(|y| (0..extent.width).map(move |x| (x, y)));
    pixels.map(|(x, y)| light[(y * from.height / extent.height * from.width + x * from.width / extent.width) as usize]).collect()
}

fn add(sum: &mut [[f32; 3]], other: &[[f32; 3]]) {
    sum.iter_mut().zip(other).for_each(|(s, o)| (0..3).for_each(|c| s[c] += o[c]));
}

pub(crate) fn rgb(texels: Vec<[f32; 4]>) -> Vec<[f32; 3]> {
    texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect()
}

/// Luminance of linear Rec. 709.
pub fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Sums of luminance over the squares around all pixels, `radius` pixels to each side; less of them at the border.
pub fn luminance_around(pixels: &[[f32; 3]], [width, height]: [u32; 2], radius: i32) -> Vec<f32> {
    let (width, height) = (width as i32, height as i32);
    let around = |x: i32, y: i32| {
        let rows = (y - radius).max(0)..(y + radius + 1).min(height);
        let columns = (x - radius).max(0)..(x + radius + 1).min(width);
        rows.flat_map(|y| columns.clone().map(move |x| (y * width + x) as usize)).map(|i| luminance(pixels[i])).sum()
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| around(x, y)).collect()
}

/// JSON has no NaN.
mod nan_as_null {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        (!value.is_nan()).then_some(*value).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of grey pixels in which nothing moves; the reference's halves are as far above and below `reference`.
    fn frame(noisy: f32, reference: f32, noise: f32) -> Frame {
        let count = 8 * 8;
        let grey = |value| vec![[value; 3]; count];
        let mut frame = Frame {
            index: 0,
            extent: [8, 8],
            noisy: grey(noisy),
            denoised: vec![Denoised { radiance: grey(reference), views: Vec::new() }],
            reference: None,
            halves: None,
            volume: None,
            shadows: Vec::new(),
            motion: vec![[0.0; 2]; count],
            expected_previous_depth: vec![4.0; count],
            depth: vec![4.0; count],
            surface_id: vec![1; count],
        };
        frame.set_halves([grey(reference + noise), grey(reference - noise)]);
        frame
    }

    #[test]
    fn halves_leave_the_noise_of_the_reference_out() {
        let (before, now) = (frame(0.5, 0.5, 0.0), frame(0.6, 0.5, 0.01));
        assert!(now.reference.iter().flatten().flatten().all(|value| (value - 0.5).abs() < 1e-6), "the mean of both halves");
        let scores = now.scores(Some(&before)).expect("finite pictures").expect("a reference");
        let near = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-6, "{value} instead of {expected}");
        // Errors of 0.09 and 0.11 against the halves.
        near(scores[0].rmse, (0.09_f64 * 0.11).sqrt());
        near(scores[1].rmse, 0.0);
        assert!(scores[1].temporal_error < 1e-6 && scores[0].temporal_error > 0.01, "{scores:?}");
    }
}

//! Ground truth of the current frame: the lighting pass's estimator over many samples of each pixel.
//!
//! The samples are Owen-scrambled Sobol' points instead of independent numbers, so the error falls faster than one over
//! the root of their count; counts that are powers of two are best. Sums are kept in float32 images.

use std::time::{Duration, Instant};

use ash::vk;

use super::barriers::{general_barrier, memory_barrier};
use super::{shaders, PathTracer};
use crate::error::{Error, Result};
use crate::gpu::{storage_images, DescriptorSet, Image, Pipeline, SetLayout};

/// A submit should take about this long: short enough for a driver's watchdog, long enough to waste nothing.
const SUBMIT_TIME: Duration = Duration::from_millis(300);
const LARGEST_BATCH: u32 = 64;
/// Tells the reference's random numbers from the noisy picture's.
const REFERENCE_SEED: u32 = 0x5bd1_e995;

/// Means over all samples, row by row, linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Light that was scattered once.
    pub direct: Vec<[f32; 3]>,
    /// Light that was scattered twice.
    pub indirect: Vec<[f32; 3]>,
    /// Emitters and environment seen directly.
    pub emission: Vec<[f32; 3]>,
    /// Light that the medium scattered once towards the eye, where the scene has one.
    pub volume: Option<Vec<[f32; 3]>>,
    /// Samples for each pixel.
    pub samples: u32,
}

impl Reference {
    /// The picture: all light together.
    pub fn radiance(&self) -> Vec<[f32; 3]> {
        let of_medium = |i: usize| self.volume.as_ref().map_or([0.0; 3], |volume| volume[i]);
        let sum = |(i, ((d, e), n)): (usize, ((&[f32; 3], &[f32; 3]), &[f32; 3]))| {
            let v = of_medium(i);
            [0, 1, 2].map(|c| d[c] + n[c] + e[c] + v[c])
        };
        self.direct.iter().zip(&self.emission).zip(&self.indirect).enumerate().map(sum).collect()
    }
}

impl PathTracer {
    /// Renders `samples` paths for each pixel of the current frame, and calls `progress(done, samples)` now and then.
    /// Overwrites [`PathTracer::outputs`] with what the frame's two passes write.
    ///
    /// # Errors
    /// Zero samples, no memory, or a lost device.
    pub fn render_reference(&mut self, samples: u32, mut progress: impl FnMut(u32, u32)) -> Result<Reference> {
        if samples == 0 {
            return Err(Error::NoSamples);
        }
        let gpu = self.gpu.clone();
        let sums = [
            Image::new(&gpu, "direct_sum", vk::Format::R32G32B32A32_SFLOAT, self.extent)?,
            Image::new(&gpu, "indirect_sum", vk::Format::R32G32B32A32_SFLOAT, self.extent)?,
        ];
        let images = [&self.outputs.visibility, &self.outputs.seed, &sums[0], &sums[1]].map(|image| image.view);
        let layout = SetLayout::new(&gpu, &storage_images(4))?;
        let set = DescriptorSet::of_images(&gpu, &layout, &images)?;
        let pipeline = Pipeline::new(&gpu, shaders::REFERENCE, &[&self.scene_layout, &layout], 12)?;
        gpu.submit(|cmd| {
            self.record_gbuffer(cmd);
            self.record_lighting(cmd);
            general_barrier(gpu.device(), cmd, &[&sums[0], &sums[1]]);
            Ok(())
        })?;
        self.accumulate(&pipeline, &set, samples, |done| progress(done, samples))?;
        Ok(Reference {
            direct: self.mean(&sums[0], samples)?,
            indirect: self.mean(&sums[1], samples)?,
            emission: self.mean(&self.outputs.emission, 1)?,
            volume: self.volume_reference(samples)?,
            samples,
        })
    }

    /// Adds samples to sums, in submits of a bearable length. The pipeline's constants: first sample, their number, seed.
    pub(super) fn accumulate(
        &self,
        pipeline: &Pipeline,
        set: &DescriptorSet,
        samples: u32,
        mut progress: impl FnMut(u32),
    ) -> Result<()> {
        let gpu = &self.gpu;
        let (mut done, mut batch) = (0, 1);
        while done < samples {
            let count = batch.min(samples - done);
            let constants = [done, count, REFERENCE_SEED];
            let start = Instant::now();
            gpu.submit(|cmd| {
                let compute = vk::PipelineStageFlags::COMPUTE_SHADER;
                let (written, used) = (vk::AccessFlags::MEMORY_WRITE, vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE);
                memory_barrier(gpu.device(), cmd, (vk::PipelineStageFlags::ALL_COMMANDS, written), (compute, used));
                pipeline.record(cmd, &[&self.scene_set, set], bytemuck::cast_slice(&constants), self.extent);
                Ok(())
            })?;
            done += count;
            progress(done);
            batch = next_batch(count, start.elapsed());
        }
        Ok(())
    }

    pub(super) fn mean(&self, sum: &Image, samples: u32) -> Result<Vec<[f32; 3]>> {
        let scale = 1.0 / samples as f32;
        Ok(self.gpu.read_image(sum)?.into_iter().map(|[r, g, b, _]| [r * scale, g * scale, b * scale]).collect())
    }
}

/// The sums do not depend on how the samples are split, so measured time may choose the split.
fn next_batch(count: u32, took: Duration) -> u32 {
    let fitting = f64::from(count) * SUBMIT_TIME.as_secs_f64() / took.as_secs_f64().max(1e-4);
    (fitting as u32).clamp(1, LARGEST_BATCH.min(2 * count))
}

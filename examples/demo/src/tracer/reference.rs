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
    /// Samples for each pixel.
    pub samples: u32,
}

impl Reference {
    /// The picture: all light together.
    pub fn radiance(&self) -> Vec<[f32; 3]> {
        let sum = |((d, i), e): ((&[f32; 3], &[f32; 3]), &[f32; 3])| [0, 1, 2].map(|c| d[c] + i[c] + e[c]);
        self.direct.iter().zip(&self.indirect).zip(&self.emission).map(sum).collect()
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
        let (mut done, mut batch) = (0, 1);
        while done < samples {
            let count = batch.min(samples - done);
            let constants = [done, count, REFERENCE_SEED];
            let start = Instant::now();
            gpu.submit(|cmd| {
                let compute = vk::PipelineStageFlags::COMPUTE_SHADER;
                let (written, used) = (vk::AccessFlags::MEMORY_WRITE, vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE);
                memory_barrier(gpu.device(), cmd, (vk::PipelineStageFlags::ALL_COMMANDS, written), (compute, used));
                pipeline.record(cmd, &[&self.scene_set, &set], bytemuck::cast_slice(&constants), self.extent);
                Ok(())
            })?;
            done += count;
            progress(done, samples);
            batch = next_batch(count, start.elapsed());
        }
        let mean = |image: &Image, count: u32| -> Result<Vec<[f32; 3]>> {
            let scale = 1.0 / count as f32;
            Ok(gpu.read_image(image)?.into_iter().map(|[r, g, b, _]| [r * scale, g * scale, b * scale]).collect())
        };
        Ok(Reference {
            direct: mean(&sums[0], samples)?,
            indirect: mean(&sums[1], samples)?,
            emission: mean(&self.outputs.emission, 1)?,
            samples,
        })
    }
}

/// The sums do not depend on how the samples are split, so measured time may choose the split.
fn next_batch(count: u32, took: Duration) -> u32 {
    let fitting = f64::from(count) * SUBMIT_TIME.as_secs_f64() / took.as_secs_f64().max(1e-4);
    (fitting as u32).clamp(1, LARGEST_BATCH.min(2 * count))
}

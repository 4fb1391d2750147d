//! Ground truth of the current frame: the lighting pass's estimator over many samples of each pixel.
//!
//! The samples are Owen-scrambled Sobol' points instead of independent numbers, so the error falls faster than one over
//! the root of their count; counts that are powers of two are best. Sums are kept in float32 images.

use std::time::{Duration, Instant};

use ash::vk;

use super::barriers::{general_barrier, memory_barrier};
use super::{shaders, PathTracer, AMBIENT_REACH};
use crate::error::{Error, Result};
use crate::gpu::{storage_images, DescriptorSet, Gpu, Image, Pipeline, SetLayout, Shader, WHOLE_IMAGE};

/// A submit should take about this long: short enough for a driver's watchdog, long enough to waste nothing.
const SUBMIT_TIME: Duration = Duration::from_millis(300);
const LARGEST_BATCH: u32 = 64;

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
        let mut layers = vec![&self.direct, &self.indirect, &self.emission];
        layers.extend(&self.volume);
        let sum = |i: usize| [0, 1, 2].map(|c| layers.iter().map(|layer| layer[i][c]).sum());
        (0..self.direct.len()).map(sum).collect()
    }
}

/// A reference that grows.
pub struct ReferenceSums<const N: usize> {
    /// Sums of radiance, and samples in them, `R32G32B32A32_SFLOAT`.
    pub sums: [Image; N],
    samples: u32,
    batch: u32,
    set: DescriptorSet,
    pipeline: Pipeline,
    constants: Vec<u8>,
}

impl<const N: usize> ReferenceSums<N> {
    /// Samples for each pixel so far.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// The next samples are the first ones.
    pub fn restart(&mut self) {
        self.samples = 0;
    }

    /// Gives it other code; whether it runs that shader.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        self.pipeline.replace(shader)
    }

    /// Adds samples of the tracer's frame, whose G-buffer was drawn: as many as take about `time`, at most `limit` in all. Waits for them.
    ///
    /// # Errors
    /// A lost device.
    pub fn add(&mut self, tracer: &PathTracer, time: Duration, limit: u32) -> Result<()> {
        let count = self.batch.min(limit.saturating_sub(self.samples));
        if count == 0 {
            return Ok(());
        }
        let (gpu, start) = (&tracer.gpu, Instant::now());
        gpu.submit(|cmd| {
            if self.samples == 0 {
                self.clear(gpu, cmd);
            }
            let compute = vk::PipelineStageFlags::COMPUTE_SHADER;
            let (written, used) = (vk::AccessFlags::MEMORY_WRITE, vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE);
            for _ in 0..count {
                memory_barrier(gpu.device(), cmd, (vk::PipelineStageFlags::ALL_COMMANDS, written), (compute, used));
                self.pipeline.record(cmd, &[&tracer.scene_set, &self.set], &self.constants, tracer.extent);
            }
            Ok(())
        })?;
        self.samples += count;
        self.batch = next_batch(count, start.elapsed(), time);
        Ok(())
    }

    fn clear(&self, gpu: &Gpu, cmd: vk::CommandBuffer) {
        let used = (vk::PipelineStageFlags::ALL_COMMANDS, vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE);
        let cleared = (vk::PipelineStageFlags::TRANSFER, vk::AccessFlags::TRANSFER_WRITE);
        memory_barrier(gpu.device(), cmd, used, cleared);
        for sum in &self.sums {
            let zero = vk::ClearColorValue { float32: [0.0; 4] };
            // SAFETY: `cmd` is recording; the image is alive, has the usage, and is in GENERAL.
            unsafe { gpu.device().cmd_clear_color_image(cmd, sum.handle, vk::ImageLayout::GENERAL, &zero, &[WHOLE_IMAGE]) };
        }
    }

    /// Linear radiance, row by row.
    fn means(&self, gpu: &Gpu) -> Result<[Vec<[f32; 3]>; N]> {
        let scale = 1.0 / self.samples as f32;
        let mut means = [const { Vec::new() }; N];
        for (mean, sum) in means.iter_mut().zip(&self.sums) {
            *mean = gpu.read_image(sum)?.into_iter().map(|[r, g, b, _]| [r * scale, g * scale, b * scale]).collect();
        }
        Ok(means)
    }
}

impl PathTracer {
    /// Sums without a sample of light that was scattered once, and twice. They read the images of this tracer.
    ///
    /// # Errors
    /// No memory.
    pub fn reference_sums(&self) -> Result<ReferenceSums<2>> {
        let shader = if self.scene.has_glass() { &shaders::REFERENCE_GLASS } else { &shaders::REFERENCE };
        self.sums(["direct_sum", "indirect_sum"], [&self.outputs.visibility, &self.outputs.seed], shader, &[])
    }

    /// The same of light that the medium scattered, where there is one.
    ///
    /// # Errors
    /// No memory.
    pub fn volume_sums(&self) -> Result<Option<ReferenceSums<1>>> {
        if self.volume.is_none() {
            return Ok(None);
        }
        self.sums(["volume_sum"], [&self.outputs.seed, &self.outputs.depth], &shaders::VOLUME_REFERENCE, &[]).map(Some)
    }

    /// Share of a lamp that each pixel of the current frame sees, by colour: the mean of `samples` shadow rays. Nothing for a lamp that the scene does
    /// not have. The visibility pass of the frame has run.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn lamp_reference(&self, lamp: u32, samples: u32) -> Result<Option<Vec<[f32; 3]>>> {
        if lamp as usize >= self.scene.lamps.len() || samples == 0 {
            return Ok(None);
        }
        self.apart("lamp_sum", &shaders::LAMP_REFERENCE, &lamp.to_ne_bytes(), samples).map(Some)
    }

    /// Ambient occlusion of each pixel of the current frame: the mean of `samples` rays. The visibility pass of the frame has run.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn ambient_reference(&self, samples: u32) -> Result<Vec<f32>> {
        let open = self.apart("ambient_sum", &shaders::AMBIENT_REFERENCE, &AMBIENT_REACH.to_ne_bytes(), samples.max(1))?;
        Ok(open.into_iter().map(|[v, ..]| v).collect())
    }

    fn apart(&self, name: &'static str, shader: &'static Shader, constants: &[u8], samples: u32) -> Result<Vec<[f32; 3]>> {
        let mut sums = self.sums([name], [&self.outputs.visibility, &self.outputs.seed], shader, constants)?;
        while sums.samples < samples {
            sums.add(self, SUBMIT_TIME, samples)?;
        }
        let [means] = sums.means(&self.gpu)?;
        Ok(means)
    }

    fn sums<const N: usize>(
        &self,
        names: [&'static str; N],
        read: [&Image; 2],
        shader: &'static Shader,
        constants: &[u8],
    ) -> Result<ReferenceSums<N>> {
        let gpu = &self.gpu;
        let sum = |name| Image::new(gpu, name, vk::Format::R32G32B32A32_SFLOAT, self.extent);
        let sums = names.into_iter().map(sum).collect::<Result<Vec<_>>>()?;
        let images: Vec<_> = read.into_iter().chain(&sums).map(|image| image.view).collect();
        let layout = SetLayout::new(gpu, &storage_images(images.len()))?;
        let set = DescriptorSet::of_images(gpu, &layout, &images)?;
        let pipeline = Pipeline::new(gpu, shader, &[&self.scene_layout, &layout], constants.len() as u32)?;
        gpu.submit(|cmd| {
            general_barrier(gpu.device(), cmd, &sums.iter().collect::<Vec<_>>());
            Ok(())
        })?;
        let mut sums = sums.into_iter();
        let sums = std::array::from_fn(|_| sums.next().expect("an image for each name"));
        Ok(ReferenceSums { sums, samples: 0, batch: 1, set, pipeline, constants: constants.to_vec() })
    }

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
        let mut sums = self.reference_sums()?;
        gpu.submit(|cmd| {
            self.record_gbuffer(cmd);
            self.record_lighting(cmd);
            Ok(())
        })?;
        while sums.samples < samples {
            sums.add(self, SUBMIT_TIME, samples)?;
            progress(sums.samples, samples);
        }
        let [direct, indirect] = sums.means(&gpu)?;
        let emission = gpu.read_image(&self.outputs.emission)?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect();
        Ok(Reference { direct, indirect, emission, volume: self.volume_reference(samples)?, samples })
    }

    /// Mean radiance of the medium, where there is one. The visibility pass of the frame has run.
    fn volume_reference(&self, samples: u32) -> Result<Option<Vec<[f32; 3]>>> {
        let Some(mut sums) = self.volume_sums()? else { return Ok(None) };
        while sums.samples < samples {
            sums.add(self, SUBMIT_TIME, samples)?;
        }
        let [volume] = sums.means(&self.gpu)?;
        Ok(Some(volume))
    }
}

/// The sums do not depend on how the samples are split, so measured time may choose the split.
fn next_batch(count: u32, took: Duration, wanted: Duration) -> u32 {
    let fitting = f64::from(count) * wanted.as_secs_f64() / took.as_secs_f64().max(1e-4);
    (fitting as u32).clamp(1, LARGEST_BATCH.min(2 * count))
}

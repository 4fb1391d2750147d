//! Lighting that shades gradient samples again \[ASVGF 3.1\]: the surface and the seed of a pixel of the previous frame, in this frame's light.
//!
//! What a sample is stays with it: its place on a triangle, which moves along with the object, its seed, and the eye that saw it, in
//! world space. The denoiser takes no pixel twice in a row; a host that did would find the same record in the pixel that took it over,
//! however old.

use ash::vk;
use clap::ValueEnum;

use super::barriers::general_barrier;
use super::{lit_images, shaders, PathTracer, LIT_IMAGES};
use crate::error::Result;
use crate::gpu::{storage_images, DescriptorSet, Image, Pipeline, SetLayout};

/// The eye for which samples of the previous frame are shaded again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SampleEye {
    /// That of the frame \[ASVGF\]: highlights that move with the camera are seen, too.
    Current,
    /// The one that saw the sample first: nothing is seen but changes of the scene.
    Kept,
}

/// What belongs to one A-SVGF denoiser on a tracer: the lighting pass's other variant, and two copies of every pixel's sample.
pub struct Reshading {
    /// Written by the denoiser before lighting: `R16G16B16A16_UINT`, one texel a stratum.
    pub gradient_samples: Image,
    /// `R32G32B32A32_UINT` each: surfaces, and seeds with the eye. The copy that was written last is at `newest`.
    samples: [[Image; 2]; 2],
    /// Set `i` writes copy `i` and reads the other.
    sets: [DescriptorSet; 2],
    newest: usize,
    pipeline: Pipeline,
    stratum_size: u32,
    eye: SampleEye,
}

#[cfg(feature = "hot-reload")]
impl Reshading {
    /// Gives its pass other code; whether it runs that shader.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn replace_shader(&mut self, shader: &crate::hot_reload::Compiled) -> Result<bool> {
        self.pipeline.replace(shader)
    }
}

impl PathTracer {
    /// Makes what it takes to shade gradient samples again, one for strata of `stratum_size`² pixels.
    ///
    /// # Errors
    /// No memory.
    pub fn reshading(&self, stratum_size: u32, eye: SampleEye) -> Result<Reshading> {
        let (gpu, extent) = (&self.gpu, self.light_extent());
        let strata = vk::Extent2D { width: extent.width.div_ceil(stratum_size), height: extent.height.div_ceil(stratum_size) };
        let gradient_samples = Image::new(gpu, "gradient_samples", vk::Format::R16G16B16A16_UINT, strata)?;
        let image = |name| Image::new(gpu, name, vk::Format::R32G32B32A32_UINT, extent);
        let copy = || -> Result<[Image; 2]> { Ok([image("sample_surfaces")?, image("sample_seeds")?]) };
        let samples = [copy()?, copy()?];
        let mut kinds = storage_images(LIT_IMAGES);
        kinds.extend([vk::DescriptorType::SAMPLED_IMAGE; 3]);
        kinds.extend(storage_images(2));
        let layout = SetLayout::new(gpu, &kinds)?;
        let set = |newest: usize| {
            let mut images = lit_images(&self.outputs).to_vec();
            images.push(&gradient_samples);
            images.extend(&samples[1 - newest]);
            images.extend(&samples[newest]);
            let views: Vec<_> = images.iter().map(|image| image.view).collect();
            DescriptorSet::of_images(gpu, &layout, &views)
        };
        let sets = [set(0)?, set(1)?];
        let pipeline = Pipeline::new(gpu, &shaders::PATH_TRACE_RESHADED, &[&self.scene_layout, &layout], 8)?;
        gpu.submit(|cmd| {
            let all: Vec<&Image> = samples.iter().flatten().chain([&gradient_samples]).collect();
            general_barrier(gpu.device(), cmd, &all);
            Ok(())
        })?;
        Ok(Reshading { gradient_samples, samples, sets, newest: 0, pipeline, stratum_size, eye })
    }

    /// As [`PathTracer::record_lighting`], with the gradient samples shaded again. The denoiser has written
    /// [`Reshading::gradient_samples`], in this command buffer or earlier.
    pub fn record_lighting_reshaded(&mut self, cmd: vk::CommandBuffer, reshading: &mut Reshading) {
        reshading.newest = 1 - reshading.newest;
        // Gradient samples have another seed.
        self.is_lit = false;
        self.prepare_lighting(cmd);
        general_barrier(self.gpu.device(), cmd, &reshading.samples[reshading.newest].each_ref());
        let sets = [&self.scene_set, &reshading.sets[reshading.newest]];
        let constants = [reshading.stratum_size, u32::from(reshading.eye == SampleEye::Kept)];
        reshading.pipeline.record(cmd, &sets, bytemuck::bytes_of(&constants), self.light_extent());
        self.record_apart(cmd);
    }
}

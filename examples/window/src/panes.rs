//! The two halves of the split screen as images, and the pass that fills them.

use ash::vk;

use atrous_engine::gpu::{DescriptorSet, Gpu, Image, Pipeline, SetLayout, WHOLE_IMAGE};
use atrous_engine::tracer::barriers::{general_barrier, memory_barrier, Scope};
use atrous_engine::Doing;
use atrous_engine::Result;

pub(crate) mod shaders {
    use atrous_engine::gpu::Shader;
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
pub use shaders::{ENCODE_FRAG, PRESENT_FRAG, PRESENT_VERT};

/// Left and right, `R16G16B16A16_SFLOAT`, in layout `GENERAL`. The engine writes them and the window reads them; both do so behind a barrier on
/// the same queue, so that the order of submissions is all they need.
pub struct Panes {
    /// Left and right.
    pub images: [Image; 2],
}

/// What a pane is the weighted sum of.
pub struct Source<'a> {
    /// Images in layout `GENERAL`.
    images: [&'a Image; 4],
    /// Their weights; those of weight 0 are not read.
    weights: [f32; 4],
}

impl<'a> Source<'a> {
    /// One image as it is.
    pub fn of(image: &'a Image) -> Self {
        Self { images: [image; 4], weights: [1.0, 0.0, 0.0, 0.0] }
    }

    /// An image with its weight, and as many more as there are, three at most.
    pub fn sum(first: (&'a Image, f32), more: impl IntoIterator<Item = (&'a Image, f32)>) -> Self {
        let mut sum = Self { images: [first.0; 4], weights: [first.1, 0.0, 0.0, 0.0] };
        let places = sum.images.iter_mut().zip(&mut sum.weights).skip(1);
        for ((image, weight), part) in places.zip(more) {
            (*image, *weight) = part;
        }
        sum
    }
}

impl Panes {
    /// Black ones.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, extent: vk::Extent2D) -> Result<Self> {
        let image = |name| Image::new(gpu, name, vk::Format::R16G16B16A16_SFLOAT, extent);
        let panes = Self { images: [image("left pane")?, image("right pane")?] };
        gpu.submit(|cmd| {
            general_barrier(gpu.device(), cmd, &[&panes.images[0], &panes.images[1]]);
            let compute = (vk::PipelineStageFlags::COMPUTE_SHADER, vk::AccessFlags::SHADER_WRITE);
            let clear = (vk::PipelineStageFlags::TRANSFER, vk::AccessFlags::TRANSFER_WRITE);
            memory_barrier(gpu.device(), cmd, compute, clear);
            for image in &panes.images {
                let (layout, black) = (vk::ImageLayout::GENERAL, vk::ClearColorValue::default());
                // SAFETY: `cmd` is recording; the image was brought to this layout, and the barrier lies between.
                unsafe { gpu.device().cmd_clear_color_image(cmd, image.handle, layout, &black, &[WHOLE_IMAGE]) };
            }
            Ok(())
        })?;
        Ok(panes)
    }

    /// Its size in pixels.
    pub fn extent(&self) -> vk::Extent2D {
        self.images[0].extent
    }
}

/// Fills panes.
pub struct PaneWriter {
    layout: SetLayout,
    pipeline: Pipeline,
    /// Left and right.
    sets: [DescriptorSet; 2],
}

impl PaneWriter {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// No memory.
    pub fn new(gpu: &Gpu, panes: &Panes) -> Result<Self> {
        let mut kinds = vec![vk::DescriptorType::STORAGE_IMAGE];
        kinds.resize(5, vk::DescriptorType::SAMPLED_IMAGE);
        let layout = SetLayout::new(gpu, &kinds)?;
        let pipeline = Pipeline::new(gpu, &shaders::PANE, &[&layout], 16)?;
        let set = |side: usize| DescriptorSet::of_images(gpu, &layout, &[panes.images[side].view; 5]);
        let sets = [set(0)?, set(1)?];
        Ok(Self { layout, pipeline, sets })
    }

    /// Gives it other code; whether it runs that shader.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &atrous_engine::hot_reload::Compiled) -> Result<bool> {
        self.pipeline.replace(shader)
    }

    /// Fills one pane in a submission of its own.
    ///
    /// # Errors
    /// No memory, or a lost device.
    pub fn write(&mut self, gpu: &Gpu, panes: &Panes, side: usize, source: &Source) -> Result<()> {
        let pane = &panes.images[side];
        let [a, b, c, d] = source.images.map(|image| image.view);
        // Every submission of the engine waits, so it is not in use.
        let set = &self.sets[side];
        set.point_at(&self.layout, &[pane.view, a, b, c, d]);
        gpu.submit(|cmd| {
            let everything: Scope =
                (vk::PipelineStageFlags::ALL_COMMANDS, vk::AccessFlags::MEMORY_WRITE | vk::AccessFlags::MEMORY_READ);
            let compute = (vk::PipelineStageFlags::COMPUTE_SHADER, vk::AccessFlags::SHADER_READ | vk::AccessFlags::SHADER_WRITE);
            memory_barrier(gpu.device(), cmd, everything, compute);
            self.pipeline.record(cmd, &[set], bytemuck::cast_slice(&source.weights), pane.extent);
            Ok(())
        })
    }
}

/// Brings new images to `GENERAL`.
///
/// # Errors
/// A lost device.
pub fn prepare(gpu: &Gpu, images: &[&Image]) -> Result<()> {
    gpu.submit(|cmd| {
        general_barrier(gpu.device(), cmd, images);
        Ok(())
    })
}

/// The same barrier for the window: what the engine wrote last is seen by fragment shaders, and what it writes next comes after.
pub fn before_reading(gpu: &Gpu, cmd: vk::CommandBuffer) {
    let written = (vk::PipelineStageFlags::ALL_COMMANDS, vk::AccessFlags::MEMORY_WRITE);
    memory_barrier(gpu.device(), cmd, written, (vk::PipelineStageFlags::FRAGMENT_SHADER, vk::AccessFlags::SHADER_READ));
}

/// A shader module, for as long as pipelines are made of it.
///
/// # Errors
/// No memory.
pub fn shader_module(gpu: &Gpu, spirv: &[u8]) -> Result<vk::ShaderModule> {
    let words: Vec<u32> = bytemuck::pod_collect_to_vec(spirv);
    // SAFETY: the words are SPIR-V that shaderc made for Vulkan 1.1.
    unsafe { gpu.device().create_shader_module(&vk::ShaderModuleCreateInfo::default().code(&words), None) }
        .doing("create a shader module")
}

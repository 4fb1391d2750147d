//! The glue between Blade and the denoiser.

use ash::vk;
use atrous::executor::{Executor, ExecutorOptions, HostImage, LentImage};
use atrous::{Config, Device, Error, FrameParams, Subresource, Tuning};
use blade_graphics as gpu;

/// A layer of a texture.
#[derive(Clone, Copy)]
pub struct Layer {
    pub texture: gpu::Texture,
    pub view: gpu::TextureView,
    pub layer: u32,
    pub format: gpu::TextureFormat,
    pub extent: [u32; 2],
}

impl Layer {
    /// The layer as the source or target of a copy.
    pub fn piece(&self) -> gpu::TexturePiece {
        gpu::TexturePiece { texture: self.texture, mip_level: 0, array_layer: self.layer, origin: [0; 3] }
    }

    /// Blade keeps every texture in `GENERAL`, and orders its passes by barriers of all memory.
    fn lent(&self) -> HostImage {
        HostImage {
            image: self.texture.vulkan_image(),
            view: self.view.vulkan_view(),
            subresource: Subresource { layer: self.layer, level: 0 },
            format: match self.format {
                gpu::TextureFormat::R32Uint => vk::Format::R32_UINT,
                gpu::TextureFormat::Rgba16Float => vk::Format::R16G16B16A16_SFLOAT,
                _ => vk::Format::R32G32B32A32_SFLOAT,
            },
            extent: self.extent,
            layout: vk::ImageLayout::GENERAL,
            stage: vk::PipelineStageFlags2::ALL_COMMANDS,
            access: vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
        }
    }
}

/// Names of the inputs, in the order of the layers.
const INPUTS: [&str; 6] = ["depth", "normal", "motion", "albedo", "noisy_radiance", "surface_id"];

pub struct Denoise(Executor);

impl Denoise {
    pub fn new(context: &gpu::Context, extent: [u32; 2]) -> Result<Self, Error> {
        let (instance, physical_device, device) = context.vulkan_device();
        let host = Device { instance, physical_device, device, pipeline_cache: vk::PipelineCache::null(), pipelines: None };
        let options = ExecutorOptions { legacy_barriers: true, stay_in_general: true, ..Default::default() };
        // SAFETY: the handles are those of one device, which outlives this, and its work is waited for.
        unsafe { Executor::new(host, Config::new(extent).declare()?, options).map(Self) }
    }

    /// Denoises between two passes of Blade.
    pub fn record(
        &mut self,
        encoder: &gpu::CommandEncoder,
        params: &FrameParams,
        inputs: &[Layer],
        to: &Layer,
    ) -> Result<(), Error> {
        let inputs = INPUTS.iter().zip(inputs).map(|(name, layer)| LentImage::new(name, layer.lent()));
        let lent: Vec<_> = inputs.chain([LentImage::new("denoised_radiance", to.lent())]).collect();
        // SAFETY: the command buffer is recording outside a render pass; textures are live and in the states that are given.
        unsafe { self.0.denoise(encoder.vulkan_command_buffer(), params, &Tuning::default(), &lent).map(drop) }
    }
}

//! Textures that stand for inputs and outputs.

use crate::format::{to_vulkan, to_wgpu};
use crate::Error;
use ash::vk;
use atrous::executor::HostImage;
use atrous::{Declaration, Lifetime, ResourceDecl, Shape};
use wgpu::hal::api::Vulkan;
use wgpu::hal::{Device as _, MemoryFlags};
use wgpu::{TextureUsages, TextureUses};

/// A texture with the view that passes read or write it through.
#[derive(Clone, Debug)]
pub struct Bound {
    pub texture: wgpu::Texture,
    /// Keeps the view alive that the denoiser has the handle of.
    _view: wgpu::TextureView,
    pub image: HostImage,
    /// The state that wgpu brings it to before a phase.
    pub state: TextureUses,
    pub is_output: bool,
    /// Made by you, not by [`make_output`].
    pub is_of_host: bool,
}

/// The stages and accesses that wgpu's own barriers have for a texture which shaders read or write.
const SHADERS: vk::PipelineStageFlags2 = vk::PipelineStageFlags2::from_raw(
    vk::PipelineStageFlags2::VERTEX_SHADER.as_raw()
        | vk::PipelineStageFlags2::FRAGMENT_SHADER.as_raw()
        | vk::PipelineStageFlags2::COMPUTE_SHADER.as_raw(),
);

/// Uses of an output by passes of the denoiser, and by [`Seen::mark`].
const OUTPUT_USAGES: TextureUsages =
    TextureUsages::STORAGE_BINDING.union(TextureUsages::TEXTURE_BINDING).union(TextureUsages::COPY_SRC);

/// Bytes: four floats.
const LARGEST_TEXEL: u64 = 16;

impl Bound {
    /// A texture for a resource, after a check.
    pub fn new(name: &str, resource: &ResourceDecl, texture: &wgpu::Texture, is_of_host: bool) -> Result<Self, Error> {
        let refused = |problem: String| Err(Error::Texture { name: name.to_owned(), problem });
        let is_output = resource.lifetime == Lifetime::Output;
        let needed = if is_output { OUTPUT_USAGES } else { TextureUsages::TEXTURE_BINDING };
        if !texture.usage().contains(needed) {
            return refused(format!("its usage is {:?}; it needs {:?} as well", texture.usage(), needed - texture.usage()));
        }
        if texture.dimension() != wgpu::TextureDimension::D2 {
            return refused(format!("its dimension is {:?}; D2 is allowed", texture.dimension()));
        }
        let (levels, layers, samples) = (texture.mip_level_count(), texture.depth_or_array_layers(), texture.sample_count());
        if (levels, layers, samples) != (1, 1, 1) {
            return refused(format!("it has {levels} levels, {layers} layers and {samples} samples; one of each is allowed"));
        }
        let format = texture.format();
        let Some(vulkan) = to_vulkan(format) else {
            return refused(format!(
                "the format {format:?} is not known here; a plain one, such as Rgba16Float or Depth32Float, is"
            ));
        };
        let is_depth = format.is_depth_stencil_format();
        let aspect = if is_depth { wgpu::TextureAspect::DepthOnly } else { wgpu::TextureAspect::All };
        let view = texture.create_view(&wgpu::TextureViewDescriptor { aspect, ..Default::default() });
        // SAFETY: the guard goes before the next is asked for; the handle lives as long as the texture, which is kept.
        let image = unsafe { texture.as_hal::<Vulkan>().map(|texture| texture.raw_handle()) }.ok_or(Error::NotVulkan)?;
        // SAFETY: as above, with the view.
        let handle = unsafe { view.as_hal::<Vulkan>().map(|view| view.raw_handle()) }.ok_or(Error::NotVulkan)?;
        let (layout, access, state) = match (is_output, is_depth) {
            (false, true) => {
                (vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL, vk::AccessFlags2::SHADER_READ, TextureUses::RESOURCE)
            }
            (false, false) => (vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL, vk::AccessFlags2::SHADER_READ, TextureUses::RESOURCE),
            (true, _) => (vk::ImageLayout::GENERAL, vk::AccessFlags2::SHADER_WRITE, TextureUses::STORAGE_WRITE_ONLY),
        };
        let extent = [texture.width(), texture.height()];
        let subresource = atrous::Subresource::default();
        let image = HostImage { image, view: handle, subresource, format: vulkan, extent, layout, stage: SHADERS, access };
        Ok(Self { texture: texture.clone(), _view: view, image, state, is_output, is_of_host })
    }
}

/// Marks textures that raw commands write as seen by wgpu, which would otherwise clear them at its
/// first read.
pub struct Seen {
    texel: wgpu::Buffer,
}

impl Seen {
    pub fn new(device: &wgpu::Device) -> Self {
        let (size, usage) = (LARGEST_TEXEL, wgpu::BufferUsages::COPY_DST);
        let label = Some("atrous: a texel of an output");
        Self { texel: device.create_buffer(&wgpu::BufferDescriptor { label, size, usage, mapped_at_creation: false }) }
    }

    /// Reads one texel, so that wgpu clears the texture now if it has to. Called before every
    /// phase, since command buffers may be dropped, and a render pass of yours may discard the
    /// texture.
    pub fn mark(&self, encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture) {
        let one = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 };
        let target = wgpu::TexelCopyBufferInfo { buffer: &self.texel, layout: wgpu::TexelCopyBufferLayout::default() };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), target, one);
    }
}

/// A texture for an output. wgpu considers it written, so that its first read does not clear it.
pub fn make_output(device: &wgpu::Device, declaration: &Declaration, resource: &ResourceDecl) -> Result<wgpu::Texture, Error> {
    let name = resource.name.as_str();
    let (Shape::Image { format, .. }, Some([width, height])) = (resource.shape, resource.extent(declaration.setup())) else {
        return Err(Error::Texture { name: name.to_owned(), problem: "it is a buffer".to_owned() });
    };
    let vulkan = format.preferred();
    let format = to_wgpu(vulkan)
        .ok_or_else(|| Error::Texture { name: name.to_owned(), problem: format!("wgpu has no name for the format {vulkan:?}") })?;
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let raw = wgpu::hal::TextureDescriptor {
        label: Some(name),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUses::RESOURCE | TextureUses::STORAGE_WRITE_ONLY | TextureUses::COPY_SRC | TextureUses::COPY_DST,
        memory_flags: MemoryFlags::empty(),
        view_formats: Vec::new(),
    };
    let texture = {
        // SAFETY: nothing is destroyed through the guard, which goes before the next is asked for.
        let hal = unsafe { device.as_hal::<Vulkan>() }.ok_or(Error::NotVulkan)?;
        // SAFETY: the device is live, and has the format, which the declaration was checked for.
        unsafe { hal.create_texture(&raw) }?
    };
    let descriptor = wgpu::TextureDescriptor {
        label: Some(name),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: OUTPUT_USAGES | TextureUsages::COPY_DST,
        view_formats: &[],
    };
    // SAFETY: the texture was made by this device from the same description. Nobody reads it before a phase has written it, and the
    // phase that writes it needs no old content.
    Ok(unsafe { device.create_texture_from_hal::<Vulkan>(texture, &descriptor, TextureUses::UNINITIALIZED) })
}

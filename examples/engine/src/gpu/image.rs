//! Two-dimensional images with one mip level.

use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;

use super::memory::Memory;
use super::{Gpu, Shared};
use crate::error::{Doing, Error, Result};

/// An image, its view and its memory.
pub struct Image {
    /// The image.
    pub handle: vk::Image,
    /// A view of all of it.
    pub view: vk::ImageView,
    /// Its format.
    pub format: vk::Format,
    /// Its size in pixels.
    pub extent: vk::Extent2D,
    /// Its debug name.
    pub name: &'static str,
    memory: Option<Memory>,
    shared: Arc<Shared>,
}

/// Every image here has one level and one layer.
pub const WHOLE_IMAGE: vk::ImageSubresourceRange = vk::ImageSubresourceRange {
    aspect_mask: vk::ImageAspectFlags::COLOR,
    base_mip_level: 0,
    level_count: 1,
    base_array_layer: 0,
    layer_count: 1,
};

impl Image {
    /// Makes an image for shaders and copies; its content and layout are undefined.
    ///
    /// # Errors
    /// An extent of zero or beyond the device's limit, or no memory.
    pub fn new(gpu: &Gpu, name: &'static str, format: vk::Format, extent: vk::Extent2D) -> Result<Self> {
        use vk::ImageUsageFlags as U;
        Self::with_usage(gpu, name, format, extent, U::STORAGE | U::SAMPLED | U::TRANSFER_SRC | U::TRANSFER_DST)
    }

    /// The same for other uses.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_usage(
        gpu: &Gpu,
        name: &'static str,
        format: vk::Format,
        extent: vk::Extent2D,
        usage: vk::ImageUsageFlags,
    ) -> Result<Self> {
        check_extent(gpu, extent)?;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(extent.into())
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(usage);
        // SAFETY: the device is alive and the extent is within its limits.
        let handle = unsafe { gpu.device().create_image(&info, None) }.doing("create an image")?;
        // From here on, dropping `image` frees whatever was made.
        let mut image =
            Self { handle, view: vk::ImageView::null(), format, extent, name, memory: None, shared: gpu.shared.clone() };
        // SAFETY: the image was just made by this device.
        let requirements = unsafe { gpu.device().get_image_memory_requirements(handle) };
        let of_device = Memory::new(&gpu.shared, name, requirements, MemoryLocation::GpuOnly, false)?;
        let (memory, offset) = image.memory.insert(of_device).place();
        // SAFETY: fresh memory of the size and kind that the image asked for, bound once.
        unsafe { gpu.device().bind_image_memory(handle, memory, offset) }.doing("bind an image's memory")?;
        let view = vk::ImageViewCreateInfo::default()
            .image(handle)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(WHOLE_IMAGE);
        // SAFETY: the image has memory, and the view has its format.
        image.view = unsafe { gpu.device().create_image_view(&view, None) }.doing("create an image view")?;
        Ok(image)
    }

    /// Bytes of one texel, for the formats that the demo makes.
    pub fn texel_bytes(&self) -> u64 {
        match self.format {
            vk::Format::R32_SFLOAT | vk::Format::R32_UINT | vk::Format::R8G8B8A8_UNORM => 4,
            vk::Format::A2B10G10R10_UNORM_PACK32 => 4,
            vk::Format::R16G16B16A16_SFLOAT | vk::Format::R16G16B16A16_UINT => 8,
            _ => 16,
        }
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: the owner keeps an image until the work that uses it is complete (every submit here waits).
        unsafe {
            self.shared.device.destroy_image_view(self.view, None);
            self.shared.device.destroy_image(self.handle, None);
        }
    }
}

fn check_extent(gpu: &Gpu, extent: vk::Extent2D) -> Result<()> {
    let limit = gpu.limits().max_image_dimension2_d;
    let allowed = 1..=limit;
    if allowed.contains(&extent.width) && allowed.contains(&extent.height) {
        return Ok(());
    }
    Err(Error::Extent { width: extent.width, height: extent.height, limit })
}

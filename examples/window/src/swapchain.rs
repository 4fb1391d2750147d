//! The swapchain with what belongs to each of its images. Made anew whenever the window or the wishes change.

use ash::vk;

use super::target::Target;
use atrous_engine::gpu::{Gpu, Image, WHOLE_IMAGE};
use atrous_engine::Doing;
use atrous_engine::Result;

/// The surface of a window.
pub struct Surface {
    pub functions: ash::khr::surface::Instance,
    pub handle: vk::SurfaceKHR,
    // The instance outlives it.
    _gpu: Gpu,
}

impl Surface {
    /// # Safety
    /// `handle` is a surface of the device's instance, is owned by the result, and the window outlives it.
    pub unsafe fn new(gpu: &Gpu, handle: vk::SurfaceKHR) -> Self {
        Self { functions: ash::khr::surface::Instance::new(gpu.entry(), gpu.instance()), handle, _gpu: gpu.clone() }
    }

    /// Its size, and what it allows.
    pub fn capabilities(&self, gpu: &Gpu) -> Result<vk::SurfaceCapabilitiesKHR> {
        // SAFETY: the surface is alive.
        unsafe { self.functions.get_physical_device_surface_capabilities(gpu.physical_device(), self.handle) }
            .doing("query the window")
    }

    /// Formats that the window can have.
    pub fn formats(&self, gpu: &Gpu) -> Result<Vec<vk::SurfaceFormatKHR>> {
        // SAFETY: the surface is alive.
        unsafe { self.functions.get_physical_device_surface_formats(gpu.physical_device(), self.handle) }
            .doing("list the formats of the window")
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: ours, and every swapchain on it is gone.
        unsafe { self.functions.destroy_surface(self.handle, None) };
    }
}

/// Options of a swapchain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SwapchainOptions {
    /// Window pixels.
    pub extent: [u32; 2],
    /// Wait for the display.
    pub vsync: bool,
    /// Brighter than white.
    pub hdr: bool,
}

/// What comes before a frame.
#[derive(Clone, Debug)]
pub enum Step {
    /// Nothing: the swapchain fits.
    Draw,
    /// A new swapchain of this size.
    Make(vk::Extent2D, vk::SurfaceCapabilitiesKHR),
    /// The window has no pixels, since it is minimised: nothing is made, nothing is drawn, and what there is stays for the next frame.
    Rest,
}

/// `made_for`: the options that the swapchain was made for, if there is one that still fits the window.
///
/// # Errors
/// Those of `query`, which is not asked where nothing has changed.
pub fn next_step(
    made_for: Option<SwapchainOptions>,
    options: SwapchainOptions,
    query: impl FnOnce() -> Result<vk::SurfaceCapabilitiesKHR>,
) -> Result<Step> {
    if options.extent.contains(&0) {
        return Ok(Step::Rest);
    }
    if made_for == Some(options) {
        return Ok(Step::Draw);
    }
    let capabilities = query()?;
    let extent = clamped(&capabilities, options.extent);
    Ok(if extent.width == 0 || extent.height == 0 { Step::Rest } else { Step::Make(extent, capabilities) })
}

/// A swapchain for one size of the window.
pub struct Swapchain {
    functions: ash::khr::swapchain::Device,
    pub handle: vk::SwapchainKHR,
    pub extent: vk::Extent2D,
    pub options: SwapchainOptions,
    views: Vec<vk::ImageView>,
    pub framebuffers: Vec<vk::Framebuffer>,
    /// Where the target has one.
    pub canvas: Option<Image>,
    /// One for each image: it is free again when the image comes back.
    pub drawn: Vec<vk::Semaphore>,
    gpu: Gpu,
}

impl Swapchain {
    /// Of a size that [`next_step`] gave. `old` is taken over and destroyed; nothing may use it any more.
    ///
    /// # Errors
    /// A surface that is lost, or no memory.
    pub fn new(
        gpu: &Gpu,
        surface: &Surface,
        target: &Target,
        options: SwapchainOptions,
        (extent, capabilities): (vk::Extent2D, vk::SurfaceCapabilitiesKHR),
        old: Option<Swapchain>,
    ) -> Result<Self> {
        let most = if capabilities.max_image_count == 0 { u32::MAX } else { capabilities.max_image_count };
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface.handle)
            .min_image_count((capabilities.min_image_count + 1).clamp(2, most.max(2)))
            .image_format(target.format.format)
            .image_color_space(target.format.color_space)
            .image_extent(extent)
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::COLOR_ATTACHMENT)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(opaque(capabilities.supported_composite_alpha))
            .present_mode(present_mode(gpu, surface, options.vsync)?)
            .clipped(true)
            .old_swapchain(old.as_ref().map_or(vk::SwapchainKHR::null(), |old| old.handle));
        let functions = ash::khr::swapchain::Device::new(gpu.instance(), gpu.device());
        // SAFETY: surface and old swapchain are alive, and what is asked for is within the capabilities.
        let handle = unsafe { functions.create_swapchain(&info, None) }.doing("create a swapchain")?;
        drop(old);
        let mut made = Self {
            functions,
            handle,
            extent,
            options,
            views: Vec::new(),
            framebuffers: Vec::new(),
            canvas: target.canvas(extent)?,
            drawn: Vec::new(),
            gpu: gpu.clone(),
        };
        made.add_images(target)?;
        Ok(made)
    }

    fn add_images(&mut self, target: &Target) -> Result<()> {
        let device = self.gpu.device();
        // SAFETY: the swapchain is alive.
        let images = unsafe { self.functions.get_swapchain_images(self.handle) }.doing("list the images of the swapchain")?;
        for image in images {
            let info = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D)
                .format(target.format.format)
                .subresource_range(WHOLE_IMAGE);
            // SAFETY: the image is the swapchain's, of this format.
            let view = unsafe { device.create_image_view(&info, None) }.doing("create a view of the window")?;
            self.views.push(view);
            self.framebuffers.push(target.framebuffer(view, self.canvas.as_ref(), self.extent)?);
            // SAFETY: the device is alive.
            let semaphore = unsafe { device.create_semaphore(&vk::SemaphoreCreateInfo::default(), None) };
            self.drawn.push(semaphore.doing("create a semaphore")?);
        }
        Ok(())
    }

    /// The next image to draw into; `acquired` is signalled when it may be drawn into. `Ok(None)`: none is free yet.
    pub fn acquire(&self, acquired: vk::Semaphore, nanoseconds: u64) -> std::result::Result<Option<(u32, bool)>, vk::Result> {
        // SAFETY: the swapchain is alive, and the semaphore is not in use.
        match unsafe { self.functions.acquire_next_image(self.handle, nanoseconds, acquired, vk::Fence::null()) } {
            Ok(image) => Ok(Some(image)),
            Err(vk::Result::NOT_READY | vk::Result::TIMEOUT) => Ok(None),
            Err(result) => Err(result),
        }
    }

    /// Hands an image to the window system. `Ok(true)`: it fits no longer as well as it could.
    pub fn present(&self, image: u32) -> std::result::Result<bool, vk::Result> {
        let (semaphores, swapchains, images) = ([self.drawn[image as usize]], [self.handle], [image]);
        let info = vk::PresentInfoKHR::default().wait_semaphores(&semaphores).swapchains(&swapchains).image_indices(&images);
        let queue = self.gpu.queue();
        // SAFETY: the queue is locked, the image was acquired and drawn, and the semaphore is signalled by that.
        unsafe { self.functions.queue_present(*queue, &info) }
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        let device = self.gpu.device();
        // Presenting has no fence: only an idle queue says that the semaphores are free.
        let queue = self.gpu.queue();
        // SAFETY: the queue is locked and then idle, so that nothing is in use any more.
        unsafe {
            let _ = device.queue_wait_idle(*queue);
            self.framebuffers.iter().for_each(|f| device.destroy_framebuffer(*f, None));
            self.views.iter().for_each(|v| device.destroy_image_view(*v, None));
            self.drawn.iter().for_each(|s| device.destroy_semaphore(*s, None));
            self.functions.destroy_swapchain(self.handle, None);
        }
    }
}

/// A surface either has a size of its own, or takes that of the swapchain.
fn clamped(capabilities: &vk::SurfaceCapabilitiesKHR, wanted: [u32; 2]) -> vk::Extent2D {
    if capabilities.current_extent.width != u32::MAX {
        return capabilities.current_extent;
    }
    let (min, max) = (capabilities.min_image_extent, capabilities.max_image_extent);
    vk::Extent2D {
        width: wanted[0].clamp(min.width, max.width.max(min.width)),
        height: wanted[1].clamp(min.height, max.height.max(min.height)),
    }
}

fn opaque(supported: vk::CompositeAlphaFlagsKHR) -> vk::CompositeAlphaFlagsKHR {
    use vk::CompositeAlphaFlagsKHR as C;
    let known = [C::OPAQUE, C::INHERIT, C::PRE_MULTIPLIED, C::POST_MULTIPLIED];
    known.into_iter().find(|alpha| supported.contains(*alpha)).unwrap_or(C::OPAQUE)
}

/// FIFO is always there; without waiting for the display, what tears least.
fn present_mode(gpu: &Gpu, surface: &Surface, vsync: bool) -> Result<vk::PresentModeKHR> {
    use vk::PresentModeKHR as P;
    // SAFETY: the surface is alive.
    let found = unsafe { surface.functions.get_physical_device_surface_present_modes(gpu.physical_device(), surface.handle) }
        .doing("list the ways to present")?;
    let wanted = if vsync { P::FIFO } else { P::MAILBOX };
    let known = [wanted, P::IMMEDIATE, P::FIFO];
    Ok(known.into_iter().find(|mode| found.contains(mode) && !(vsync && *mode == P::IMMEDIATE)).unwrap_or(P::FIFO))
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn extent(width: u32, height: u32) -> vk::Extent2D {
        vk::Extent2D { width, height }
    }

    const OPTIONS: SwapchainOptions = SwapchainOptions { extent: [640, 480], vsync: true, hdr: false };

    /// What comes next for a window that says it has this size: `Some(None)` is a rest, `Some(Some(size))` a new swapchain.
    fn next(made_for: Option<SwapchainOptions>, options: SwapchainOptions, size: vk::Extent2D) -> Option<Option<vk::Extent2D>> {
        let [min_image_extent, max_image_extent] = [extent(1, 1), extent(500, 500)];
        let window = vk::SurfaceCapabilitiesKHR { current_extent: size, min_image_extent, max_image_extent, ..Default::default() };
        match next_step(made_for, options, || Ok(window)).expect("an answer") {
            Step::Draw => None,
            Step::Rest => Some(None),
            Step::Make(size, _) => Some(Some(size)),
        }
    }

    const FREE: vk::Extent2D = extent(u32::MAX, u32::MAX);

    #[test]
    fn a_window_without_pixels_rests_whatever_there_was() {
        for made_for in [None, Some(OPTIONS), Some(SwapchainOptions { extent: [1, 1], ..OPTIONS })] {
            for size in [[0, 0], [0, 480], [640, 0]] {
                let options = SwapchainOptions { extent: size, ..OPTIONS };
                assert_eq!(next(made_for, options, extent(size[0], size[1])), Some(None), "{made_for:?} {size:?}");
                assert_eq!(next(made_for, options, FREE), Some(None), "a window that takes any size");
            }
        }
        // The window system was faster than the event.
        assert_eq!(next(None, OPTIONS, extent(0, 0)), Some(None));
        assert_eq!(next(None, OPTIONS, extent(640, 0)), Some(None));
    }

    #[test]
    fn a_window_that_is_back_is_drawn() {
        assert_eq!(next(Some(OPTIONS), OPTIONS, extent(640, 480)), None);
        assert_eq!(next(None, OPTIONS, extent(640, 480)), Some(Some(extent(640, 480))));
        let other = SwapchainOptions { vsync: false, ..OPTIONS };
        assert_eq!(next(Some(other), OPTIONS, extent(640, 480)), Some(Some(extent(640, 480))));
    }

    #[test]
    fn the_window_has_the_last_word_on_its_size() {
        assert_eq!(next(None, OPTIONS, extent(300, 200)), Some(Some(extent(300, 200))));
        assert_eq!(next(None, OPTIONS, FREE), Some(Some(extent(500, 480))));
    }

    #[test]
    fn a_window_that_has_not_changed_is_not_asked() {
        let step = next_step(Some(OPTIONS), OPTIONS, || panic!("asked")).expect("an answer");
        assert!(matches!(step, Step::Draw));
    }
}

//! Draws the window: the panes, and the panel over them. Two frames in flight; never waits for the device.

use std::sync::Arc;

use ash::vk;
use egui_ash_renderer::{Options, Renderer};

use super::pane_pipeline::{PanePipeline, Presented};
use super::panes::{before_reading, Panes};
use super::surface_format::{choose_format, Encoding};
use super::swapchain::{next_step, Step, Surface, Swapchain, SwapchainOptions};
use super::target::Target;
use crate::error::{Error, Result};
use atrous_engine::gpu::Gpu;
use atrous_engine::Doing;

/// Frames that the window draws before it waits for the oldest.
const FRAMES_IN_FLIGHT: usize = 2;

/// What to draw.
pub struct Drawn<'a> {
    /// The halves, once there are any.
    pub panes: Option<&'a Arc<Panes>>,
    /// How; `peak` is filled in here.
    pub presented: Presented,
    /// Textures of the panel that changed.
    pub textures: &'a egui::TexturesDelta,
    /// Triangles of the panel.
    pub primitives: &'a [egui::ClippedPrimitive],
    /// Window pixels for one of the panel.
    pub pixels_per_point: f32,
}

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is on its way to the display.
    Drawn,
    /// The device or the window system is not ready for it. Nothing happened, try again soon.
    Busy,
    /// The window has no pixels. Nothing happened.
    NoPixels,
}

struct Slot {
    cmd: vk::CommandBuffer,
    acquired: vk::Semaphore,
    complete: vk::Fence,
}

/// Everything that the window is drawn with.
pub struct Presenter {
    gpu: Gpu,
    pool: vk::CommandPool,
    slots: Vec<Slot>,
    next: usize,
    target: Target,
    panes: PanePipeline,
    /// `None` while it is being replaced.
    egui: Option<Renderer>,
    /// Textures that may go once every frame that was in flight is complete.
    outdated: Vec<(usize, Vec<egui::TextureId>)>,
    swapchain: Option<Swapchain>,
    is_stale: bool,
    // Last: everything above draws into it.
    surface: Surface,
}

impl Presenter {
    /// Makes everything but the swapchain, which comes with the first frame.
    ///
    /// # Errors
    /// A device that cannot present to the window, or no memory.
    pub fn new(gpu: &Gpu, surface: Surface, hdr: bool) -> Result<Self> {
        // SAFETY: the surface is alive.
        let can = unsafe {
            surface.functions.get_physical_device_surface_support(gpu.physical_device(), gpu.queue_family(), surface.handle)
        };
        if !can.doing("query the window")? {
            return Err(Error::Window { problem: format!("{} cannot draw into it; choose another with --device", gpu.info()) });
        }
        let Some((format, encoding)) = choose_format(&surface.formats(gpu)?, hdr) else {
            return Err(Error::Window { problem: "it has no format that could be drawn".into() });
        };
        let device = gpu.device();
        let flags = vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER;
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family()).flags(flags);
        let target = Target::new(gpu, format, encoding, PRESENTED)?;
        let panes = PanePipeline::new(gpu, target.render_pass, FRAMES_IN_FLIGHT)?;
        // SAFETY: the device is alive, the family is its own.
        let pool = unsafe { device.create_command_pool(&info, None) }.doing("create a command pool")?;
        let mut presenter = Self {
            gpu: gpu.clone(),
            pool,
            slots: Vec::new(),
            next: 0,
            target,
            panes,
            egui: None,
            outdated: Vec::new(),
            swapchain: None,
            is_stale: false,
            surface,
        };
        for _ in 0..FRAMES_IN_FLIGHT {
            presenter.add_slot()?;
        }
        presenter.egui = Some(presenter.create_egui()?);
        Ok(presenter)
    }

    fn add_slot(&mut self) -> Result<()> {
        let device = self.gpu.device();
        let info = vk::CommandBufferAllocateInfo::default().command_pool(self.pool).command_buffer_count(1);
        let signalled = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
        // SAFETY: the device and the pool are alive.
        unsafe {
            let cmd = device.allocate_command_buffers(&info).doing("allocate a command buffer")?[0];
            let acquired = device.create_semaphore(&vk::SemaphoreCreateInfo::default(), None).doing("create a semaphore")?;
            let complete = device.create_fence(&signalled, None).doing("create a fence")?;
            self.slots.push(Slot { cmd, acquired, complete });
        }
        Ok(())
    }

    fn create_egui(&self) -> Result<Renderer> {
        // Every target is drawn in linear light.
        let options = Options { in_flight_frames: FRAMES_IN_FLIGHT, srgb_framebuffer: true, ..Options::default() };
        let (instance, device) = (self.gpu.instance(), self.gpu.device().clone());
        Ok(Renderer::with_default_allocator(instance, self.gpu.physical_device(), device, self.target.render_pass, options)?)
    }

    /// The swapchain has to be made anew before the next frame.
    pub fn invalidate(&mut self) {
        self.is_stale = true;
    }

    /// Whether the oldest frame in flight is complete.
    ///
    /// # Errors
    /// A lost device.
    pub fn is_ready(&self) -> Result<bool> {
        Ok(self.gpu.is_signalled(self.slots[self.next].complete).doing("ask for a frame")?)
    }

    /// Draws a frame, if it can.
    ///
    /// # Errors
    /// A lost device or surface.
    pub fn draw(&mut self, options: SwapchainOptions, drawn: &Drawn) -> Result<Outcome> {
        let slot = &self.slots[self.next];
        let (cmd, acquired, complete) = (slot.cmd, slot.acquired, slot.complete);
        if !self.is_ready()? {
            return Ok(Outcome::Busy);
        }
        if !self.follow(options)? {
            return Ok(Outcome::NoPixels);
        }
        let Some(swapchain) = &self.swapchain else { return Ok(Outcome::Busy) };
        let (image, suboptimal) = match swapchain.acquire(acquired, ACQUIRE_NANOSECONDS) {
            Ok(Some(acquired)) => acquired,
            Ok(None) => return Ok(Outcome::Busy),
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => {
                self.is_stale = true;
                return Ok(Outcome::Busy);
            }
            Err(result) => return Ok(Err(result).doing("acquire an image of the window")?),
        };
        self.record(cmd, image, drawn)?;
        self.submit(cmd, acquired, complete, image)?;
        let presented = self.swapchain.as_ref().map_or(Ok(false), |swapchain| swapchain.present(image));
        match presented {
            Ok(stale) => self.is_stale |= stale || suboptimal,
            Err(vk::Result::ERROR_OUT_OF_DATE_KHR) => self.is_stale = true,
            Err(result) => return Ok(Err(result).doing("present")?),
        }
        self.next = (self.next + 1) % FRAMES_IN_FLIGHT;
        Ok(Outcome::Drawn)
    }

    /// Brings the swapchain up to the window and the wishes. `false`: the window has no pixels.
    fn follow(&mut self, options: SwapchainOptions) -> Result<bool> {
        let made_for = self.swapchain.as_ref().map(|swapchain| swapchain.options).filter(|_| !self.is_stale);
        let size = match next_step(made_for, options, || self.surface.capabilities(&self.gpu))? {
            Step::Draw => return Ok(true),
            Step::Rest => return Ok(false),
            Step::Make(extent, capabilities) => (extent, capabilities),
        };
        self.wait()?;
        if let Some((format, encoding)) = choose_format(&self.surface.formats(&self.gpu)?, options.hdr) {
            if format != self.target.format {
                self.change_format(format, encoding)?;
            }
        }
        let old = self.swapchain.take();
        let swapchain = Swapchain::new(&self.gpu, &self.surface, &self.target, options, size, old)?;
        self.target.point_at(swapchain.canvas.as_ref());
        self.swapchain = Some(swapchain);
        self.is_stale = false;
        Ok(true)
    }

    fn change_format(&mut self, format: vk::SurfaceFormatKHR, encoding: Encoding) -> Result<()> {
        self.swapchain = None;
        self.target = Target::new(&self.gpu, format, encoding, PRESENTED)?;
        self.panes.make_pipeline(self.target.render_pass)?;
        if let Some(egui) = &mut self.egui {
            egui.set_render_pass(self.target.render_pass)?;
        }
        Ok(())
    }

    /// How colours get to the display.
    pub fn encoding(&self) -> Encoding {
        self.target.encoding
    }

    fn record(&mut self, cmd: vk::CommandBuffer, image: u32, drawn: &Drawn) -> Result<()> {
        self.update_textures(drawn.textures)?;
        let Some(swapchain) = &self.swapchain else { return Ok(()) };
        let (device, extent) = (self.gpu.device(), swapchain.extent);
        let begin = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the slot's last frame is complete, so the command buffer is free.
        unsafe { device.begin_command_buffer(cmd, &begin) }.doing("begin a command buffer")?;
        before_reading(&self.gpu, cmd);
        self.target.begin(cmd, swapchain.framebuffers[image as usize], extent, GROUND);
        if let Some(panes) = drawn.panes {
            let presented = Presented { peak: self.target.encoding.peak(), ..drawn.presented };
            self.panes.record(cmd, self.next, panes, extent, &presented);
        }
        if let Some(egui) = &mut self.egui {
            egui.cmd_draw(cmd, extent, drawn.pixels_per_point, drawn.primitives)?;
        }
        self.target.end(cmd, extent);
        // SAFETY: `cmd` is recording.
        Ok(unsafe { device.end_command_buffer(cmd) }.doing("end a command buffer")?)
    }

    /// New glyphs are rare: then this waits for the device, since they are written into a texture that frames in flight read. Old textures go when no frame in flight can use them.
    fn update_textures(&mut self, delta: &egui::TexturesDelta) -> Result<()> {
        let Some(egui) = &mut self.egui else { return Ok(()) };
        for (age, ids) in &mut self.outdated {
            *age += 1;
            if *age > FRAMES_IN_FLIGHT {
                egui.free_textures(&std::mem::take(ids))?;
            }
        }
        self.outdated.retain(|(_, ids)| !ids.is_empty());
        if !delta.free.is_empty() {
            self.outdated.push((0, delta.free.clone()));
        }
        if !delta.set.is_empty() {
            let queue = self.gpu.queue();
            // SAFETY: the queue is locked.
            unsafe { self.gpu.device().queue_wait_idle(*queue) }.doing("wait for the device")?;
            egui.set_textures(*queue, self.pool, &delta.set)?;
        }
        Ok(())
    }

    fn submit(&self, cmd: vk::CommandBuffer, acquired: vk::Semaphore, complete: vk::Fence, image: u32) -> Result<()> {
        let Some(swapchain) = &self.swapchain else { return Ok(()) };
        let (commands, wait, drawn) = ([cmd], [acquired], [swapchain.drawn[image as usize]]);
        let stages = [vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT];
        let info = vk::SubmitInfo::default()
            .command_buffers(&commands)
            .wait_semaphores(&wait)
            .wait_dst_stage_mask(&stages)
            .signal_semaphores(&drawn);
        // SAFETY: the slot's last frame is complete. Reset as late as this, so that a failure before leaves it signalled.
        unsafe { self.gpu.device().reset_fences(&[complete]) }.doing("reset a fence")?;
        let queue = self.gpu.queue();
        // SAFETY: the queue is locked; semaphores and fence are ours and free.
        Ok(unsafe { self.gpu.device().queue_submit(*queue, &[info], complete) }.doing("submit")?)
    }

    fn wait(&self) -> Result<()> {
        let fences: Vec<_> = self.slots.iter().map(|slot| slot.complete).collect();
        // SAFETY: the fences are ours.
        Ok(unsafe { self.gpu.device().wait_for_fences(&fences, true, u64::MAX) }.doing("wait for the window")?)
    }
}

/// An image is usually free at once; where the window system is slow the window's thread looks again later.
const ACQUIRE_NANOSECONDS: u64 = 2_000_000;
/// Around the picture, linear: as in glsl/window/present.frag.
const GROUND: f32 = 0.012;
/// Of an image that was drawn.
const PRESENTED: vk::ImageLayout = vk::ImageLayout::PRESENT_SRC_KHR;

impl Drop for Presenter {
    fn drop(&mut self) {
        // A lost device has nothing more in flight.
        let _ = self.wait();
        self.swapchain = None;
        self.egui = None;
        let device = self.gpu.device();
        // SAFETY: ours; the frames were waited for.
        unsafe {
            for slot in &self.slots {
                device.destroy_semaphore(slot.acquired, None);
                device.destroy_fence(slot.complete, None);
            }
            device.destroy_command_pool(self.pool, None);
        }
    }
}

//! The window: what the denoiser does, and why, while it runs.
//!
//! Two threads. The engine's (`engine`) animates, traces, denoises and fills two images; the window's (`app`) takes input, draws those
//! images with the panel over them, and never waits for the engine. Both submit to one queue, in turns.

mod app;
mod camera;
mod camera_path;
mod captions;
mod clock;
mod content;
mod encode;
mod engine;
mod error;
mod error_view;
mod filter;
mod fullscreen;
mod input;
mod jobs;
mod layout;
mod legend;
mod log;
mod measurements;
mod overlay;
mod pane_pipeline;
mod panel;
mod panes;
mod presenter;
mod record;
mod reference;
#[cfg(feature = "hot-reload")]
mod reload;
mod settings;
mod shared;
mod sizes;
mod surface_format;
mod swapchain;
mod target;
mod textures;
mod timings;
mod tunables;
mod world;

use std::ffi::CStr;
use std::path::PathBuf;
use std::sync::Arc;

use ash::vk;
use raw_window_handle::{HasDisplayHandle, HasWindowHandle};
use winit::event_loop::EventLoop;
use winit::window::Window;

pub use content::Content;
pub use error::{Error, Result};
pub use settings::Settings;

use app::App;
use atrous_engine::gpu::{Gpu, GpuOptions};
use atrous_engine::Doing;
use sizes::Sizes;
use swapchain::Surface;

/// What the window is asked for.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    /// Index or a part of the name of the device.
    pub device: Option<String>,
    /// Khronos validation; its messages are errors.
    pub validation: bool,
    /// Pixels of the picture; `None`: 320x180 on software devices, 1280x720 on others.
    pub size: Option<[u32; 2]>,
    /// Pixels that filters gather over time; `None`: those of the picture.
    pub output_size: Option<[u32; 2]>,
    /// Light has half of the picture's columns and rows.
    pub half_light: bool,
    /// Pixels of the window.
    pub window_size: [u32; 2],
    /// Settings to start with, and to save into.
    pub settings_file: Option<PathBuf>,
    /// Scene to start with, instead of that of the settings.
    pub scene: Option<String>,
    /// What is shown right of the divider, instead of that of the settings.
    pub shown: Option<atrous::config::Preset>,
    /// Folder for pictures.
    pub out: PathBuf,
    /// What the window did, line by line.
    pub log: Option<PathBuf>,
    /// Folder that every frame is written into, from the first one on.
    pub record: Option<PathBuf>,
}

impl WindowOptions {
    fn settings(&self) -> Result<Settings> {
        let mut settings = match &self.settings_file {
            Some(path) if path.exists() => Settings::load(path)?,
            _ => Settings::default(),
        };
        if let Some(scene) = &self.scene {
            settings.scene.clone_from(scene);
        }
        if let Some(preset) = self.shown {
            settings.right = Content::Filtered(preset);
        }
        Ok(settings)
    }

    fn sizes(&self, gpu: &Gpu) -> Sizes {
        let default = if gpu.info().kind == "software" { [320, 180] } else { [1280, 720] };
        let extent = |[width, height]: [u32; 2]| vk::Extent2D { width, height };
        Sizes { rendered: extent(self.size.unwrap_or(default)), output: self.output_size.map(extent), half_light: self.half_light }
    }
}

/// Opens the window and runs until it is closed. Returns the number of validation messages, with those about what was not freed.
///
/// # Errors
/// No display, no device that can draw into the window, a scene that cannot be loaded, or a lost device.
pub fn run(options: WindowOptions) -> Result<usize> {
    let no_display = |e: winit::error::EventLoopError| Error::NoDisplay { problem: e.to_string() };
    let event_loop = EventLoop::with_user_event().build().map_err(no_display)?;
    let mut app = App::new(options, event_loop.create_proxy())?;
    event_loop.run_app(&mut app).map_err(no_display)?;
    app.finish()
}

/// A device that can draw into the window, and the window's surface.
fn create_surface(window: &Arc<Window>, options: &WindowOptions) -> Result<(Gpu, Surface)> {
    let failed = |e: raw_window_handle::HandleError| Error::NoDisplay { problem: e.to_string() };
    let display = window.display_handle().map_err(failed)?.as_raw();
    let names = ash_window::enumerate_required_extensions(display).doing("list the extensions of the window system")?;
    // SAFETY: the names are those of ash, with a null at their end and alive for ever.
    let mut extensions: Vec<&'static CStr> = names.iter().map(|name| unsafe { CStr::from_ptr(*name) }).collect();
    if Gpu::has_instance_extension(ash::ext::swapchain_colorspace::NAME)? {
        extensions.push(ash::ext::swapchain_colorspace::NAME);
    }
    let gpu = Gpu::new(&GpuOptions {
        device: options.device.clone(),
        validation: options.validation,
        instance_extensions: extensions,
        device_extensions: vec![ash::khr::swapchain::NAME],
    })?;
    let handle = window.window_handle().map_err(failed)?.as_raw();
    // SAFETY: both handles are of a window that outlives the surface: the application drops it later.
    let surface = unsafe { ash_window::create_surface(gpu.entry(), gpu.instance(), display, handle, None) };
    let surface = surface.doing("make a surface of the window")?;
    // SAFETY: the surface was made just now, of this instance.
    let surface = unsafe { Surface::new(&gpu, surface) };
    Ok((gpu, surface))
}

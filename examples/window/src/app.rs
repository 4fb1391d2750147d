//! The window's thread: events in, pictures out. It never waits for the engine.

use std::sync::Arc;
use std::time::Instant;

use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::{Window, WindowId};

use super::camera::{FlyCamera, Held};
use super::engine::EngineThread;
use super::log::Log;
use super::panel::Panel;
use super::presenter::Presenter;
#[cfg(feature = "hot-reload")]
use super::reload::ReloadThread;
use super::settings::Settings;
use super::shared::{Request, Shared};
use super::textures::PendingTextures;
use super::{create_surface, WindowOptions};
use crate::error::{Error, Result};
use atrous_engine::gpu::MessageLog;
#[cfg(feature = "hot-reload")]
use atrous_engine::hot_reload::{OtherShaders, ShaderFolders};

/// The engine made a frame.
pub struct Woken;

mod actions;
mod turn;

/// What lives while the window does; dropped in this order.
struct Live {
    #[cfg(feature = "hot-reload")]
    _reload: ReloadThread,
    _engine: EngineThread,
    presenter: Presenter,
    egui: egui_winit::State,
    window: Arc<Window>,
}

/// The application.
pub struct App {
    options: WindowOptions,
    proxy: EventLoopProxy<Woken>,
    live: Option<Live>,
    shared: Arc<Shared>,
    settings: Settings,
    /// The scene that the camera flies in.
    scene: String,
    panel: Panel,
    log: Log,
    help: bool,
    held: Held,
    modifiers: ModifiersState,
    fly: Option<FlyCamera>,
    stepped: Instant,
    textures: PendingTextures,
    /// When to draw next, if nothing happens before.
    due: Option<Instant>,
    error: Option<Error>,
    validation: Option<MessageLog>,
}

impl App {
    /// Nothing is opened yet.
    ///
    /// # Errors
    /// A file of settings that cannot be used, or a log that cannot be written.
    pub fn new(options: WindowOptions, proxy: EventLoopProxy<Woken>) -> Result<Self> {
        let settings = options.settings()?;
        let log = Log::create(options.log.as_deref())?;
        Ok(Self {
            options,
            proxy,
            live: None,
            shared: Arc::default(),
            scene: settings.scene.clone(),
            settings,
            panel: Panel::default(),
            log,
            help: false,
            held: Held::default(),
            modifiers: ModifiersState::default(),
            fly: None,
            stepped: Instant::now(),
            textures: PendingTextures::default(),
            due: None,
            error: None,
            validation: None,
        })
    }

    /// Closes what is open, and says how it went: the number of validation messages, with those about what was not freed.
    ///
    /// # Errors
    /// What ended the window.
    pub fn finish(mut self) -> Result<usize> {
        self.live = None;
        let messages = self.validation.take().map(|log| log.messages()).unwrap_or_default();
        messages.iter().for_each(|message| eprintln!("{message}"));
        self.log.line(&format!("closed validation={}", messages.len()));
        match self.error.take() {
            Some(error) => Err(error),
            None => Ok(messages.len()),
        }
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let attributes = Window::default_attributes()
            .with_title("atrous")
            .with_inner_size(winit::dpi::PhysicalSize::<u32>::from(self.options.window_size));
        let window = event_loop.create_window(attributes).map_err(|e| Error::NoDisplay { problem: e.to_string() })?;
        let window = Arc::new(window);
        let (gpu, surface) = create_surface(&window, &self.options)?;
        self.validation = Some(gpu.message_log());
        let presenter = Presenter::new(&gpu, surface, self.settings.hdr)?;
        let context = egui::Context::default();
        let (viewport, theme) = (egui::ViewportId::ROOT, Some(winit::window::Theme::Dark));
        let side = gpu.limits().max_image_dimension2_d as usize;
        let egui = egui_winit::State::new(context, viewport, &window, Some(window.scale_factor() as f32), theme, Some(side));
        let settings = self.settings.clone();
        let record = self.options.record.clone();
        self.shared.want(|wanted| {
            wanted.settings = settings;
            wanted.requests.extend(record.map(Request::Record));
        });
        let proxy = self.proxy.clone();
        // The loop may be gone already when the last frame is done.
        let wake = move || drop(proxy.send_event(Woken));
        let engine = EngineThread::start(&gpu, self.options.sizes(&gpu), &self.shared, wake);
        self.log.line(&format!("ready {}", gpu.info().name));
        self.live = Some(Live {
            #[cfg(feature = "hot-reload")]
            _reload: ReloadThread::start(&self.shared, &shader_folders()),
            _engine: engine,
            presenter,
            egui,
            window,
        });
        Ok(())
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: Error) {
        self.log.line(&format!("error {error}"));
        self.error = Some(error);
        event_loop.exit();
    }
}

impl ApplicationHandler<Woken> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.live.is_none() {
            if let Err(error) = self.open(event_loop) {
                self.fail(event_loop, error);
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, _: Woken) {
        if let Some(live) = &self.live {
            live.window.request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(live) = &mut self.live else { return };
        let response = live.egui.on_window_event(&live.window, &event);
        let typing = live.egui.egui_ctx().wants_keyboard_input();
        if response.repaint && !matches!(event, WindowEvent::RedrawRequested) {
            live.window.request_redraw();
        }
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(_) => live.presenter.invalidate(),
            WindowEvent::DroppedFile(path) => self.open_scene(path.to_string_lossy().into_owned()),
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::Focused(focused) => {
                self.log.line(&format!("focused {focused}"));
                self.held = Held::default();
            }
            // A key that is down when the window gets the keyboard comes once more, synthetic.
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } if !typing => self.key(event_loop, &event),
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.turn(event_loop) {
                    self.fail(event_loop, error);
                }
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(live) = &self.live else { return };
        match self.due {
            Some(due) if due <= Instant::now() => {
                self.due = None;
                live.window.request_redraw();
                event_loop.set_control_flow(ControlFlow::Wait);
            }
            Some(due) => event_loop.set_control_flow(ControlFlow::WaitUntil(due)),
            None => event_loop.set_control_flow(ControlFlow::Wait),
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.live = None;
    }
}

/// Those of the denoiser and the engine, and the window's own.
#[cfg(feature = "hot-reload")]
fn shader_folders() -> ShaderFolders {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl");
    let own = OtherShaders { folder, built: super::panes::shaders::ALL };
    ShaderFolders { others: vec![own], ..ShaderFolders::of_the_build() }
}

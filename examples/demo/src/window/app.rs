//! The window's thread: events in, pictures out. It never waits for the engine.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::{ModifiersState, PhysicalKey};
use winit::window::{Window, WindowId};

use super::camera::{FlyCamera, Held};
use super::engine::EngineThread;
use super::input::{action, hold, Action};
use super::layout::Place;
use super::log::Log;
use super::overlay::{self, Over};
use super::pane_pipeline::Presented;
use super::panel::Panel;
use super::presenter::{Drawn, Outcome, Presenter};
#[cfg(feature = "hot-reload")]
use super::reload::ReloadThread;
use super::settings::Settings;
use super::shared::{Report, Request, Shared};
use super::surface_format::Encoding;
use super::swapchain::Wish;
use super::textures::PendingTextures;
use super::{create_surface, WindowOptions};
use crate::error::{Error, Result};
use crate::gpu::MessageLog;
#[cfg(feature = "hot-reload")]
use crate::hot_reload::ShaderFolders;

/// The engine made a frame.
pub struct Woken;

/// The panel's width, points.
const PANEL_WIDTH: f32 = 320.0;
/// While the camera flies, and while the device is busy, the window looks again after this time.
const TICK: Duration = Duration::from_millis(12);
/// While the window is minimised.
const MINIMISED_TICK: Duration = Duration::from_millis(200);
/// Window pixels of the magnifier for one of the picture, at scale 1.
const LENS_ZOOM: f32 = 12.0;

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
            .with_inner_size(winit::dpi::PhysicalSize::new(self.options.window_size.0, self.options.window_size.1));
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
        let engine = EngineThread::start(&gpu, self.options.extent(&gpu), &self.shared, wake);
        self.log.line(&format!("ready {}", gpu.info().name));
        self.live = Some(Live {
            #[cfg(feature = "hot-reload")]
            _reload: ReloadThread::start(&self.shared, &ShaderFolders::of_the_build()),
            _engine: engine,
            presenter,
            egui,
            window,
        });
        Ok(())
    }

    fn key(&mut self, event_loop: &ActiveEventLoop, event: &KeyEvent) {
        let PhysicalKey::Code(key) = event.physical_key else { return };
        let is_down = event.state == ElementState::Pressed;
        if !is_down || !self.modifiers.control_key() {
            hold(&mut self.held, key, is_down);
        }
        self.held.fast = self.modifiers.shift_key();
        if is_down && !event.repeat {
            if let Some(action) = action(key, self.modifiers.shift_key(), self.modifiers.control_key()) {
                self.act(event_loop, action);
            }
        }
    }

    fn act(&mut self, event_loop: &ActiveEventLoop, action: Action) {
        let settings = &mut self.settings;
        match action {
            Action::Pause => settings.paused = !settings.paused,
            Action::Step => {
                settings.paused = true;
                // Together, so that no frame comes between.
                self.shared.want(|wanted| {
                    wanted.settings.paused = true;
                    wanted.steps += 1;
                });
            }
            Action::Reset => self.shared.want(|wanted| wanted.reset = true),
            Action::Home => {
                settings.animate_camera = true;
                self.fly = None;
                // Together, so that the frame without history is the one after the jump.
                self.shared.want(|wanted| {
                    wanted.settings.animate_camera = true;
                    (wanted.view, wanted.reset) = (None, true);
                });
            }
            Action::Left(content) => settings.left = content,
            Action::Right(content) => settings.right = content,
            Action::Swap => std::mem::swap(&mut settings.left, &mut settings.right),
            Action::Magnifier => settings.magnifier = !settings.magnifier,
            Action::Panel => settings.panel = !settings.panel,
            Action::Help => self.help = !self.help,
            Action::Screenshot => self.request(Request::Screenshot(self.options.out.clone())),
            Action::Record => self.request(Request::Record(self.options.out.join("sequence"))),
            Action::RecordPath => self.request(Request::RecordPath(self.options.camera_path())),
            Action::ReplayPath => self.request(Request::ReplayPath(self.options.camera_path())),
            Action::SaveSettings => self.save(),
            Action::LoadSettings => self.load(),
            Action::Quit => event_loop.exit(),
        }
    }

    fn request(&self, request: Request) {
        self.shared.want(|wanted| wanted.requests.push(request));
    }

    /// The same file may have become another one.
    fn open_scene(&mut self, path: String) {
        if self.settings.scene == path {
            self.request(Request::Reload);
        }
        self.settings.scene = path;
    }

    fn save(&self) {
        let path = self.options.settings_path();
        match self.settings.save(&path) {
            Ok(()) => self.shared.say(false, format!("settings are in {}", path.display())),
            Err(error) => self.shared.say(true, error.to_string()),
        }
    }

    fn load(&mut self) {
        match Settings::load(&self.options.settings_path()) {
            Ok(settings) => self.settings = settings,
            Err(error) => self.shared.say(true, error.to_string()),
        }
    }

    /// Moves the camera by the keys that are held and by the mouse.
    fn steer(&mut self, turned: [f32; 2]) {
        let seconds = self.stepped.elapsed().as_secs_f32();
        self.stepped = Instant::now();
        if self.settings.animate_camera && self.fly.is_some() {
            self.fly = None;
        }
        if !self.held.moves() && turned == [0.0; 2] {
            return;
        }
        self.settings.animate_camera = false;
        let from = || self.shared.report().view.as_ref().map(FlyCamera::new);
        let Some(mut fly) = self.fly.or_else(from) else { return };
        fly.turn(turned);
        fly.step(self.held, seconds);
        self.fly = Some(fly);
    }

    /// Tells the engine what changed.
    fn tell(&mut self, over: &Over, extent: [u32; 2]) {
        if self.scene != self.settings.scene {
            // Another world: its own camera.
            self.scene.clone_from(&self.settings.scene);
            (self.fly, self.settings.animate_camera) = (None, true);
        }
        let view = self.fly.map(|fly| fly.view());
        let probe = over.pointer.filter(|_| self.settings.magnifier).and_then(|p| over.place.pixel(p, extent));
        let settings = &self.settings;
        self.shared.want_if_changed(|wanted| {
            let same = wanted.settings == *settings && wanted.view == view && wanted.probe == probe;
            if !same {
                wanted.settings.clone_from(settings);
                (wanted.view, wanted.probe) = (view, probe);
            }
            !same
        });
    }

    /// Runs the panel on what came in, and draws where the device is ready; input is taken whether it is or not.
    fn turn(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let Some(mut live) = self.live.take() else { return Ok(()) };
        let done = self.turn_live(event_loop, &mut live);
        self.live = Some(live);
        done
    }

    fn turn_live(&mut self, event_loop: &ActiveEventLoop, live: &mut Live) -> Result<()> {
        let report = self.shared.report().clone();
        let extent = report.panes.as_ref().map_or([320, 180], |p| [p.extent().width, p.extent().height]);
        let input = live.egui.take_egui_input(&live.window);
        let context = live.egui.egui_ctx().clone();
        let (mut over, mut actions) = (Over::default(), Vec::new());
        let encoding = live.presenter.encoding();
        let output = context.run(input, |ctx| (over, actions) = self.ui(ctx, &report, extent, encoding));
        actions.into_iter().for_each(|action| self.act(event_loop, action));
        self.steer(over.turned);
        self.tell(&over, extent);
        live.egui.handle_platform_output(&live.window, output.platform_output);
        self.textures.add(output.textures_delta);
        let size = live.window.inner_size();
        self.log.turned([size.width, size.height], &over, &self.settings, self.help, &report);
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map_or(Duration::MAX, |v| v.repaint_delay);
        self.plan(delay);
        let wish = Wish { extent: [size.width, size.height], vsync: self.settings.vsync, hdr: self.settings.hdr };
        let pixels_per_point = output.pixels_per_point;
        let outcome = if live.presenter.is_ready()? {
            let primitives = context.tessellate(output.shapes, pixels_per_point);
            let drawn = Drawn {
                panes: report.panes.as_ref(),
                presented: self.presented(&over, &report, extent, pixels_per_point),
                textures: self.textures.changes(),
                primitives: &primitives,
                pixels_per_point,
            };
            live.presenter.draw(wish, &drawn)?
        } else {
            Outcome::Busy
        };
        match outcome {
            Outcome::Drawn => {
                self.textures.done();
                self.log.drawn(&report);
            }
            Outcome::Busy => self.plan(TICK),
            // The window system says when it is back; this is for one that does not.
            Outcome::NoPixels => self.plan(MINIMISED_TICK),
        }
        Ok(())
    }

    /// When to draw next: the panel is animated, or the camera flies.
    fn plan(&mut self, delay: Duration) {
        let delay = if self.held.moves() { delay.min(TICK) } else { delay };
        if let Some(at) = Instant::now().checked_add(delay.max(TICK)).filter(|_| delay < Duration::from_secs(3600)) {
            self.due = Some(self.due.map_or(at, |due| due.min(at)));
        }
    }

    fn ui(&mut self, ctx: &egui::Context, report: &Report, extent: [u32; 2], encoding: Encoding) -> (Over, Vec<Action>) {
        let mut actions = Vec::new();
        if self.settings.panel {
            let side = egui::SidePanel::right("panel").default_width(PANEL_WIDTH).min_width(200.0);
            side.show(ctx, |ui| actions = self.panel.show(ui, &mut self.settings, report, encoding));
        }
        let mut over = Over::default();
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ctx, |ui| {
            over = overlay::picture(ui, &mut self.settings, report, extent);
            if report.frames == 0 {
                ui.centered_and_justified(|ui| {
                    ui.label(if report.stopped { "The engine has stopped" } else { "Making the first frame" })
                });
            }
        });
        overlay::help(ctx, &mut self.help);
        (over, actions)
    }

    fn presented(&self, over: &Over, report: &Report, extent: [u32; 2], pixels_per_point: f32) -> Presented {
        let Place { x, y, width, height } = over.place;
        let lens = over.pointer.filter(|_| self.settings.magnifier);
        let scale = (width / extent[0] as f32).max(1.0);
        Presented {
            rect: [x, y, width.max(1.0), height.max(1.0)],
            extent: extent.map(|side| side as f32),
            lens: lens.unwrap_or([-1.0; 2]),
            lens_side: overlay::LENS_SIDE * pixels_per_point,
            lens_zoom: LENS_ZOOM.max(3.0 * scale),
            divider: self.settings.divider,
            exposure: self.settings.exposure,
            display_referred: report.display_referred,
            tone_curve: self.settings.tone_curve,
            peak: 1.0,
        }
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

impl WindowOptions {
    /// Where the settings are kept.
    fn settings_path(&self) -> PathBuf {
        self.settings_file.clone().unwrap_or_else(|| self.out.join("settings.json"))
    }

    fn camera_path(&self) -> PathBuf {
        self.out.join("camera.json")
    }
}

//! One turn of the window: the panel on what came in, the engine told of it, and a picture where the device is ready.

use std::time::{Duration, Instant};

use winit::event_loop::ActiveEventLoop;

use super::{App, Live};
use crate::camera::FlyCamera;
use crate::error::Result;
use crate::input::Action;
use crate::layout::Place;
use crate::overlay::{self, Over};
use crate::pane_pipeline::Presented;
use crate::presenter::{Drawn, Outcome};
use crate::shared::Report;
use crate::surface_format::Encoding;
use crate::swapchain::SwapchainOptions;

/// While the camera flies, and while the device is busy, the window looks again after this time.
const TICK: Duration = Duration::from_millis(12);
/// While the window is minimised.
const MINIMISED_TICK: Duration = Duration::from_millis(200);
/// Window pixels of the magnifier for one of the picture, at scale 1.
const LENS_ZOOM: f32 = 12.0;

impl App {
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

    /// Sends what changed to the engine.
    fn send_changes(&mut self, over: &Over, extent: [u32; 2]) {
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
    pub(super) fn turn(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
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
        self.send_changes(&over, extent);
        live.egui.handle_platform_output(&live.window, output.platform_output);
        self.textures.add(output.textures_delta);
        let size = live.window.inner_size();
        self.log.turned([size.width, size.height], &over, &self.settings, self.help, &report);
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map_or(Duration::MAX, |v| v.repaint_delay);
        self.plan(delay);
        let options = SwapchainOptions { extent: [size.width, size.height], vsync: self.settings.vsync, hdr: self.settings.hdr };
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
            live.presenter.draw(options, &drawn)?
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
        let (mut actions, mut panel_width) = (Vec::new(), 0.0);
        if self.settings.panel {
            let side = egui::SidePanel::right("panel").default_width(overlay::PANEL_WIDTH).min_width(200.0);
            let shown = side.show(ctx, |ui| actions = self.panel.show(ui, &mut self.settings, report, encoding));
            panel_width = shown.response.rect.width();
        }
        let mut over = Over::default();
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ctx, |ui| {
            over = Over { panel_width, ..overlay::picture(ui, &mut self.settings, report, extent) };
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
            tone_curve: self.settings.tone_curve.into(),
            peak: 1.0,
            difference_range: if self.settings.difference { self.settings.difference_range } else { 0.0 },
        }
    }
}

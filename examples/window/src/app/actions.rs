//! What keys and buttons do.

use std::path::PathBuf;

use winit::event::{ElementState, KeyEvent};
use winit::event_loop::ActiveEventLoop;
use winit::keyboard::PhysicalKey;

use super::App;
use crate::input::{action, hold, Action};
use crate::settings::Settings;
use crate::shared::Request;
use crate::WindowOptions;

impl App {
    pub(super) fn key(&mut self, event_loop: &ActiveEventLoop, event: &KeyEvent) {
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

    pub(super) fn act(&mut self, event_loop: &ActiveEventLoop, action: Action) {
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
            Action::LeftError => settings.left = settings.left.error_or_back(),
            Action::RightError => settings.right = settings.right.error_or_back(),
            Action::Difference => settings.difference = !settings.difference,
            Action::Scaling => settings.scaling = settings.scaling.other(),
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
    pub(super) fn open_scene(&mut self, path: String) {
        if self.settings.scene == path {
            self.request(Request::Reload);
        }
        self.settings.scene = path;
    }

    fn save(&self) {
        let path = self.options.settings_path();
        let mut settings = self.settings.clone();
        // One that could not be loaded is not worth keeping.
        if let Some(loaded) = &self.shared.report().loaded {
            settings.scene.clone_from(loaded);
        }
        match settings.save(&path) {
            Ok(()) => self.shared.notify(false, format!("settings are in {}", path.display())),
            Err(error) => self.shared.notify(true, error.to_string()),
        }
    }

    fn load(&mut self) {
        let path = self.options.settings_path();
        if !path.exists() {
            return self.shared.notify(true, format!("there is no {}: Ctrl S saves the settings", path.display()));
        }
        match Settings::load(&path) {
            Ok(settings) => self.settings = settings,
            Err(error) => self.shared.notify(true, error.to_string()),
        }
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

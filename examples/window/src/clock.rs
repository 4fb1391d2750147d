//! How time passes: pause, slow motion, and each part of the animation on and off.

use super::settings::Settings;
use atrous_engine::scene::{Moment, Scene, View, FRAMES_PER_SECOND};

/// Times of the parts of the animation, in frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    camera: f32,
    objects: f32,
    light: f32,
    last: Option<Moment>,
}

impl Clock {
    /// The next moment and the one before it. `view`: the camera, where it does not follow its path.
    pub fn tick(&mut self, scene: &Scene, settings: &Settings, view: Option<View>, advance: bool) -> (Moment, Moment) {
        let step = if advance { settings.speed } else { 0.0 };
        let passes = |on: bool| if on { step } else { 0.0 };
        self.camera += passes(settings.animate_camera);
        self.objects += passes(settings.animate_objects);
        self.light += passes(settings.animate_light);
        let now = Moment {
            view: view.unwrap_or_else(|| scene.view_at(self.camera / FRAMES_PER_SECOND)),
            object_time: self.objects / FRAMES_PER_SECOND,
            light_frame: self.light as u32,
        };
        let before = self.last.replace(now).unwrap_or(now);
        (now, before)
    }

    /// Where the camera was in the last moment.
    pub fn view(&self) -> Option<View> {
        self.last.map(|moment| moment.view)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use atrous_engine::SceneOptions;

    #[test]
    fn what_is_off_stands_still_and_slow_motion_takes_longer() {
        let scene = Scene::load("cornell", &SceneOptions::default()).expect("built in");
        let settings = Settings { animate_camera: false, speed: 0.5, ..Settings::default() };
        let mut clock = Clock::default();
        let (first, before) = clock.tick(&scene, &settings, None, true);
        assert_eq!(first, before, "nothing was before");
        let (second, before) = clock.tick(&scene, &settings, None, true);
        assert_eq!(before, first);
        assert_eq!(second.view, first.view);
        assert!((second.object_time - first.object_time - 0.5 / FRAMES_PER_SECOND).abs() < 1e-6);
        let (paused, _) = clock.tick(&scene, &settings, None, false);
        assert_eq!(paused, second);
    }
}

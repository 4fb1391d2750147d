//! A camera that flies: keys move it, the mouse turns it.

use std::f32::consts::FRAC_PI_2;

use glam::{vec3, Vec3};

use atrous_engine::scene::View;

/// Radians for a pixel of mouse movement.
const TURN: f32 = 0.004;
/// Almost straight up: at the pole itself there would be no right.
const STEEPEST: f32 = FRAC_PI_2 - 0.01;
/// A step of time is never longer, so that a slow frame is no jump, seconds.
const LONGEST_STEP: f32 = 0.1;

/// Which keys are held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held {
    /// W.
    pub forward: bool,
    /// S.
    pub back: bool,
    /// A.
    pub left: bool,
    /// D.
    pub right: bool,
    /// E.
    pub up: bool,
    /// Q.
    pub down: bool,
    /// Shift: faster.
    pub fast: bool,
}

impl Held {
    /// Whether the camera moves.
    pub fn moves(self) -> bool {
        self.direction() != Vec3::ZERO
    }

    /// To the right, up, forward.
    fn direction(self) -> Vec3 {
        let axis = |plus: bool, minus: bool| f32::from(i8::from(plus) - i8::from(minus));
        vec3(axis(self.right, self.left), axis(self.up, self.down), axis(self.forward, self.back))
    }
}

/// Where the camera is and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlyCamera {
    eye: Vec3,
    yaw: f32,
    pitch: f32,
    vertical_fov: f32,
    /// Scene units for a second.
    speed: f32,
}

impl FlyCamera {
    /// Starts where a view is. The speed is half of the distance to what it looks at, for a second.
    pub fn new(view: &View) -> Self {
        let way = view.target - view.eye;
        let forward = way.normalize_or(Vec3::NEG_Z);
        Self {
            eye: view.eye,
            yaw: forward.x.atan2(-forward.z),
            pitch: forward.y.clamp(-1.0, 1.0).asin().clamp(-STEEPEST, STEEPEST),
            vertical_fov: view.vertical_fov,
            speed: (0.5 * way.length()).clamp(0.1, 100.0),
        }
    }

    /// What it sees.
    pub fn view(&self) -> View {
        View { eye: self.eye, target: self.eye + self.forward(), up: Vec3::Y, vertical_fov: self.vertical_fov }
    }

    /// Turns by a movement of the mouse, pixels, y down.
    pub fn turn(&mut self, [x, y]: [f32; 2]) {
        self.yaw += TURN * x;
        self.pitch = (self.pitch - TURN * y).clamp(-STEEPEST, STEEPEST);
    }

    /// Moves for a time in seconds.
    pub fn step(&mut self, held: Held, seconds: f32) {
        let forward = self.forward();
        let right = forward.cross(Vec3::Y).normalize_or(Vec3::X);
        let [x, y, z] = held.direction().normalize_or_zero().to_array();
        let way = right * x + Vec3::Y * y + forward * z;
        self.eye += way * self.speed * seconds.min(LONGEST_STEP) * if held.fast { 4.0 } else { 1.0 };
    }

    fn forward(&self) -> Vec3 {
        let (sin, cos) = self.yaw.sin_cos();
        vec3(sin * self.pitch.cos(), self.pitch.sin(), -cos * self.pitch.cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> FlyCamera {
        FlyCamera::new(&View { eye: vec3(1.0, 2.0, 3.0), target: vec3(3.0, 1.0, 0.0), up: Vec3::Y, vertical_fov: 1.0 })
    }

    #[test]
    fn it_starts_with_the_view_that_it_was_given() {
        let view = camera().view();
        let expected = vec3(2.0, -1.0, -3.0).normalize();
        assert!((view.target - view.eye - expected).length() < 1e-5, "{view:?}");
        assert_eq!(view.eye, vec3(1.0, 2.0, 3.0));
    }

    #[test]
    fn keys_move_along_the_view_and_opposite_ones_cancel() {
        let (mut moved, start) = (camera(), camera().view());
        moved.step(Held { forward: true, ..Held::default() }, 0.05);
        let way = moved.view().eye - start.eye;
        assert!(way.normalize().dot(start.target - start.eye) > 0.999);
        let mut still = camera();
        still.step(Held { forward: true, back: true, ..Held::default() }, 0.05);
        assert_eq!(still, camera());
        assert!(!Held { left: true, right: true, fast: true, ..Held::default() }.moves());
    }

    #[test]
    fn the_mouse_to_the_right_turns_right_and_never_over_the_pole() {
        let mut turned = camera();
        let before = turned.view();
        turned.turn([10.0, 0.0]);
        let right = (before.target - before.eye).cross(Vec3::Y);
        assert!((turned.view().target - turned.view().eye).dot(right) > 0.0);
        turned.turn([0.0, -1e6]);
        assert!(turned.view().target.y - turned.view().eye.y < 1.0);
    }
}

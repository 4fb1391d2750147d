//! A wide Cornell box whose light steps between full and a tenth every eight frames, while the camera sways.

use glam::{vec3, Affine3A, Quat, Vec3};

use super::shapes::{cuboid, quad};
use super::{Material, Scene, View};

const HALF_WIDTH: f32 = 1.9;
const HEIGHT: f32 = 2.0;
const FRONT: f32 = 1.0;
const BACK: f32 = -1.0;
/// Frames between two steps of the light.
const STEP: u32 = 8;

pub fn scene() -> Scene {
    let mut scene = Scene::new("cornell", view(0.0));
    let white = Material::diffuse(vec3(0.73, 0.73, 0.73));
    let across = Vec3::X * 2.0 * HALF_WIDTH;
    let depth = Vec3::Z * (FRONT - BACK);
    let up = Vec3::Y * HEIGHT;
    let corner = vec3(-HALF_WIDTH, 0.0, BACK);
    let fixed = Affine3A::IDENTITY;
    scene.place(quad(corner + depth, across, -depth), white, fixed);
    scene.place(quad(corner + up, across, depth), white, fixed);
    scene.place(quad(corner, across, up), white, fixed);
    scene.place(quad(corner + depth, -depth, up), Material::diffuse(vec3(0.63, 0.065, 0.05)), fixed);
    scene.place(quad(corner + across, depth, up), Material::diffuse(vec3(0.14, 0.45, 0.091)), fixed);
    let turned = |angle: f32, x: f32, z: f32| Affine3A::from_rotation_translation(Quat::from_rotation_y(angle), vec3(x, 0.0, z));
    scene.place(cuboid(vec3(-0.32, 0.0, -0.32), vec3(0.32, 1.2, 0.32)), white, turned(0.31, -0.62, -0.32));
    scene.place(cuboid(vec3(-0.31, 0.0, -0.31), vec3(0.31, 0.6, 0.31)), white, turned(-0.29, 0.55, 0.22));
    let lamp = Material::emitter(vec3(17.0, 13.0, 8.0));
    scene.place(quad(vec3(-0.5, HEIGHT - 0.005, -0.3), Vec3::X, Vec3::Z * 0.6), lamp, fixed);
    scene.set_camera(view);
    scene.set_light_scale(|frame| if (frame / STEP).is_multiple_of(2) { 1.0 } else { 0.1 });
    scene
}

fn view(time: f32) -> View {
    let sway = 0.17 * (time * 1.7).sin();
    View { eye: vec3(sway, 1.0, 3.25), target: vec3(0.25 * sway, 0.98, 0.0), up: Vec3::Y, vertical_fov: 0.78 }
}

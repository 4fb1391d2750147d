//! Eleven pillars pass in front of a glowing panel, and their long shadows wander over the floor.

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cylinder, quad};
use super::{Environment, Material, Placement, Scene, View};

const COUNT: usize = 11;
const SPACING: f32 = 1.55;
/// Scene units for each second.
const SPEED: f32 = 1.2;

pub fn scene() -> Scene {
    let view = View { eye: vec3(0.0, 2.5, 8.2), target: vec3(0.0, 1.25, 0.0), up: Vec3::Y, vertical_fov: 0.62 };
    let mut scene = Scene::new("pillars", view);
    let fixed = Affine3A::IDENTITY;
    let floor = Material::plastic(vec3(0.62, 0.6, 0.57), 0.45).with_checker(vec3(0.48, 0.46, 0.44), 1.0);
    scene.place(quad(vec3(-20.0, 0.0, 14.0), Vec3::X * 40.0, Vec3::NEG_Z * 18.0), floor, fixed);
    scene.place(quad(vec3(-20.0, 0.0, -4.0), Vec3::X * 40.0, Vec3::Y * 8.0), Material::diffuse(vec3(0.55, 0.58, 0.62)), fixed);
    let panel = quad(vec3(-1.1, 1.3, -3.9), Vec3::X * 2.2, Vec3::Y * 2.2);
    scene.place(panel, Material::emitter(vec3(24.0, 18.0, 12.0)), fixed);
    let mesh = scene.add_mesh(cylinder(0.21, 2.7, 24));
    for index in 0..COUNT {
        let hue = index as f32 / COUNT as f32;
        let material = scene.add_material(Material::plastic(color(hue), 0.35));
        let row = if index % 2 == 0 { -1.9 } else { -0.9 };
        scene.add_instance(mesh, material, Placement::Animated(Box::new(move |time| path(index, row, time))));
    }
    scene.environment =
        Environment { zenith: vec3(0.09, 0.13, 0.22), horizon: vec3(0.19, 0.20, 0.24), ground: vec3(0.05, 0.05, 0.05) };
    scene
}

/// From left to right, and back to the left where nobody sees it.
fn path(index: usize, row: f32, time: f32) -> Affine3A {
    let width = COUNT as f32 * SPACING;
    let x = (index as f32 * SPACING + SPEED * time).rem_euclid(width) - 0.5 * width;
    Affine3A::from_translation(vec3(x, 0.0, row))
}

/// A muted rainbow.
fn color(hue: f32) -> Vec3 {
    let channel = |shift: f32| 0.45 + 0.33 * (std::f32::consts::TAU * (hue + shift)).cos();
    vec3(channel(0.0), channel(-0.33), channel(-0.67))
}

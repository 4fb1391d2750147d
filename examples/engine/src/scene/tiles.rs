//! Fine patterns on everything, many of them finer than a pixel, past which the camera glides under a bright sky and a lamp.

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{to_and_fro, Environment, Material, Scene, View};

pub fn scene() -> Scene {
    let mut scene = Scene::new("tiles", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let at = Affine3A::from_translation;
    let floor = Material::diffuse(vec3(0.78, 0.74, 0.66)).with_checker(vec3(0.12, 0.14, 0.2), 9.0);
    scene.place(quad(vec3(-9.0, 0.0, 6.0), Vec3::X * 18.0, Vec3::NEG_Z * 12.0), floor, fixed);
    let wall = Material::diffuse(vec3(0.7, 0.24, 0.16)).with_checker(vec3(0.85, 0.78, 0.6), 14.0);
    scene.place(quad(vec3(-9.0, 0.0, -3.0), Vec3::X * 18.0, Vec3::Y * 3.4), wall, fixed);
    let striped = Material::plastic(vec3(0.1, 0.3, 0.55), 0.35).with_checker(vec3(0.8, 0.82, 0.85), 30.0);
    for index in 0..7 {
        let x = 1.7 * (index as f32 - 3.0);
        match index % 3 {
            0 => scene.place(cylinder(0.35, 1.5, 32), striped, at(vec3(x, 0.0, -1.2))),
            1 => scene.place(cuboid(vec3(-0.4, 0.0, -0.4), vec3(0.4, 1.0, 0.4)), floor, at(vec3(x, 0.0, -0.6))),
            _ => scene.place(sphere(0.5, 32, 48), striped, at(vec3(x, 0.5, -1.0))),
        }
    }
    let lamp = quad(vec3(-2.0, 4.2, -1.0), Vec3::X * 4.0, Vec3::Z * 1.5);
    scene.place(lamp, Material::emitter(vec3(9.0, 8.0, 6.5)), fixed);
    scene.environment = Environment { zenith: vec3(0.35, 0.45, 0.7), horizon: vec3(0.5, 0.52, 0.56), ground: vec3(0.1, 0.1, 0.1) };
    scene.set_camera(view);
    scene
}

/// Sideways, seventy centimetres a second.
fn view(time: f32) -> View {
    let x = 0.7 * to_and_fro(time, 4.0) - 1.4;
    View { eye: vec3(x, 1.6, 4.2), target: vec3(0.8 * x, 0.9, -1.0), up: Vec3::Y, vertical_fov: 0.72 }
}

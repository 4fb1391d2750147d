//! A flat mirror, and things that move before it: a ball that rolls to and fro, and a block that turns. The camera goes slowly to and fro, too.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Quat, Vec3};

use super::shapes::{cuboid, quad, sphere};
use super::{Environment, Material, Placement, Scene, View};

/// `surface_id` of the mirror.
pub const MIRROR: u32 = 1;
/// Of the things that move.
pub const MOVERS: [u32; 2] = [2, 3];

/// The world.
pub fn scene() -> Scene {
    let mut scene = Scene::new("mirror_moving", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let mirror = cuboid(vec3(-2.4, 0.05, -2.05), vec3(2.4, 2.2, -2.0));
    scene.place(mirror, Material::metal(vec3(0.92, 0.92, 0.93), 0.0), fixed);
    movers(&mut scene);
    let floor = Material::diffuse(vec3(0.7, 0.66, 0.58)).with_checker(vec3(0.16, 0.2, 0.3), 1.0);
    scene.place(quad(vec3(-6.0, 0.0, 7.0), Vec3::X * 12.0, Vec3::NEG_Z * 9.5), floor, fixed);
    let behind = Material::diffuse(vec3(0.65, 0.3, 0.2)).with_checker(vec3(0.75, 0.72, 0.6), 0.8);
    scene.place(quad(vec3(6.0, 0.0, 7.0), Vec3::NEG_X * 12.0, Vec3::Y * 4.5), behind, fixed);
    // Above and before the mirror: it shows the lit side of things.
    let key = quad(vec3(-1.5, 4.2, -1.6), Vec3::X * 3.0, Vec3::Z * 3.0);
    scene.place(key, Material::emitter(vec3(9.0, 8.4, 7.4)), fixed);
    scene.environment = Environment { zenith: vec3(0.3, 0.36, 0.5), horizon: vec3(0.4, 0.4, 0.42), ground: vec3(0.1, 0.1, 0.1) };
    scene.set_camera(view);
    scene
}

fn movers(scene: &mut Scene) {
    let ball = scene.add_mesh(sphere(0.35, 32, 48));
    let blue = scene.add_material(Material::diffuse(vec3(0.1, 0.3, 0.75)).with_checker(vec3(0.85, 0.85, 0.8), 4.0));
    // It rolls: its angle is its way over its radius.
    let rolling = |time: f32| {
        let way = 1.4 * (TAU * 0.15 * time).sin();
        Affine3A::from_rotation_translation(Quat::from_rotation_z(-way / 0.35), vec3(way, 0.35, -0.6))
    };
    scene.add_instance(ball, blue, Placement::Animated(Box::new(rolling)));
    let block = scene.add_mesh(cuboid(vec3(-0.25, 0.0, -0.25), vec3(0.25, 0.9, 0.25)));
    let striped = scene.add_material(Material::diffuse(vec3(0.1, 0.5, 0.2)).with_checker(vec3(0.9, 0.85, 0.3), 4.0));
    let turned = |time: f32| Affine3A::from_rotation_translation(Quat::from_rotation_y(TAU * 0.2 * time), vec3(-1.3, 0.0, 0.6));
    scene.add_instance(block, striped, Placement::Animated(Box::new(turned)));
}

fn view(time: f32) -> View {
    let aside = 0.25 * (TAU * 0.1 * time).sin();
    View { eye: vec3(aside, 1.9, 4.6), target: vec3(0.0, 0.95, -1.0), up: Vec3::Y, vertical_fov: 0.62 }
}

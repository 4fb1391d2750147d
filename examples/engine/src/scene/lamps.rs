//! A room with two lamps that light a part of it each: on the left one swings on its cord, on the right, behind a partition, one flickers. A dim
//! panel behind the camera lights both.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Quat, Vec3};

use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{Material, Placement, Scene, View};

const HALF_WIDTH: f32 = 3.0;
const HEIGHT: f32 = 2.8;
const BACK: f32 = -2.5;
const FRONT: f32 = 6.0;
/// Where the cord of the lamp that swings hangs from.
const HOOK: Vec3 = vec3(-1.5, 2.8, -0.6);
/// Frames between two steps of the lamp that flickers.
const STEP: u32 = 6;

pub fn scene() -> Scene {
    let mut scene = Scene::new("lamps", view(0.0));
    shell(&mut scene);
    furniture(&mut scene);
    let bulb = scene.add_mesh(sphere(0.11, 6, 10));
    let glow = scene.add_material(Material::emitter(vec3(95.0, 70.0, 42.0)));
    scene.add_instance(bulb, glow, Placement::Animated(Box::new(swing)));
    let globe = scene.add_mesh(sphere(0.17, 6, 10));
    let flicker = scene.add_material(Material::emitter(vec3(22.0, 28.0, 40.0)));
    scene.add_instance(globe, flicker, Placement::Fixed(Affine3A::from_translation(vec3(1.75, 1.6, -0.9))));
    scene.set_emission_scale(flicker, |frame| if (frame / STEP).is_multiple_of(2) { 1.0 } else { 0.1 });
    let panel = quad(vec3(-1.5, HEIGHT - 0.01, FRONT - 1.6), Vec3::X * 3.0, Vec3::Z * 0.8);
    scene.place(panel, Material::emitter(vec3(1.6, 1.5, 1.4)), Affine3A::IDENTITY);
    scene.set_camera(view);
    scene
}

fn shell(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let (across, along, up) = (Vec3::X * 2.0 * HALF_WIDTH, Vec3::Z * (FRONT - BACK), Vec3::Y * HEIGHT);
    let corner = vec3(-HALF_WIDTH, 0.0, BACK);
    let boards = Material::plastic(vec3(0.42, 0.27, 0.16), 0.4).with_checker(vec3(0.34, 0.21, 0.12), 3.0);
    scene.place(quad(corner + along, across, -along), boards, fixed);
    scene.place(quad(corner + up, across, along), Material::diffuse(vec3(0.8, 0.78, 0.74)), fixed);
    let paper = Material::diffuse(vec3(0.66, 0.62, 0.5)).with_checker(vec3(0.5, 0.42, 0.34), 4.0);
    scene.place(quad(corner, across, up), paper, fixed);
    let wall = Material::diffuse(vec3(0.7, 0.67, 0.62));
    scene.place(quad(corner + along, -along, up), wall, fixed);
    scene.place(quad(corner + across, along, up), wall, fixed);
    scene.place(quad(corner + along + across, -across, up), wall, fixed);
    scene.place(cuboid(vec3(0.45, 0.0, BACK), vec3(0.6, HEIGHT, 1.2)), Material::diffuse(vec3(0.45, 0.55, 0.5)), fixed);
}

fn furniture(scene: &mut Scene) {
    let at = Affine3A::from_translation;
    let wood = Material::plastic(vec3(0.5, 0.3, 0.15), 0.3);
    scene.place(cuboid(vec3(-0.7, 0.68, -0.45), vec3(0.7, 0.74, 0.45)), wood, at(vec3(-1.5, 0.0, -0.6)));
    for (x, z) in [(-0.62, -0.38), (0.62, -0.38), (-0.62, 0.38), (0.62, 0.38)] {
        scene.place(cylinder(0.035, 0.68, 12), wood, at(vec3(x - 1.5, 0.0, z - 0.6)));
    }
    scene.place(cylinder(0.12, 0.34, 24), Material::plastic(vec3(0.16, 0.35, 0.55), 0.25), at(vec3(-1.8, 0.74, -0.5)));
    scene.place(sphere(0.16, 16, 24), Material::diffuse(vec3(0.75, 0.2, 0.12)), at(vec3(-1.15, 0.9, -0.45)));
    scene.place(cuboid(vec3(1.3, 0.0, -1.9), vec3(2.3, 0.9, -1.3)), Material::diffuse(vec3(0.55, 0.5, 0.42)), Affine3A::IDENTITY);
    scene.place(cylinder(0.16, 0.7, 24), Material::plastic(vec3(0.7, 0.68, 0.6), 0.4), at(vec3(1.3, 0.0, 0.3)));
}

/// A pendulum with a cord of ninety centimetres, and its ordinary period.
fn swing(time: f32) -> Affine3A {
    let turn = Quat::from_rotation_z(0.55 * (TAU * 0.53 * time).sin());
    Affine3A::from_translation(HOOK + turn * (Vec3::NEG_Y * 0.9))
}

fn view(_: f32) -> View {
    View { eye: vec3(0.25, 1.65, 5.1), target: vec3(0.1, 1.15, -1.0), up: Vec3::Y, vertical_fov: 0.66 }
}

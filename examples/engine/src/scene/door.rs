//! A dark room beside a bright one: all light comes through a door ajar, so that few paths find the lamp.

use glam::{vec3, Affine3A, Quat, Vec3};

use super::mesh::Mesh;
use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{Material, Scene, View};

const HALF_WIDTH: f32 = 2.6;
const HEIGHT: f32 = 2.6;
const BACK: f32 = -2.4;
const FRONT: f32 = 5.0;
/// The opening in the back wall.
const OPENING: (f32, f32, f32) = (0.1, 1.0, 2.1);
/// Where the bright room ends.
const BEYOND: f32 = -5.4;

pub fn scene() -> Scene {
    let mut scene = Scene::new("door", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let at = Affine3A::from_translation;
    let plaster = Material::diffuse(vec3(0.78, 0.75, 0.7));
    let (across, up) = (Vec3::X * 2.0 * HALF_WIDTH, Vec3::Y * HEIGHT);
    let corner = vec3(-HALF_WIDTH, 0.0, BEYOND);
    let along = Vec3::Z * (FRONT - BEYOND);
    let floor = Material::plastic(vec3(0.5, 0.36, 0.24), 0.4).with_checker(vec3(0.4, 0.28, 0.18), 2.0);
    scene.place(quad(corner + along, across, -along), floor, fixed);
    scene.place(quad(corner + up, across, along), plaster, fixed);
    scene.place(quad(corner, across, up), plaster, fixed);
    scene.place(quad(corner + along, -along, up), Material::diffuse(vec3(0.7, 0.5, 0.42)), fixed);
    scene.place(quad(corner + across, along, up), Material::diffuse(vec3(0.45, 0.55, 0.62)), fixed);
    scene.place(quad(corner + along + across, -across, up), plaster, fixed);
    scene.place(wall(), plaster, fixed);
    // It opens into the dark room, and hides the lamp from most of it.
    let leaf = cuboid(vec3(0.0, 0.01, 0.0), vec3(OPENING.1 - OPENING.0, OPENING.2 - 0.01, 0.05));
    let ajar = Affine3A::from_rotation_translation(Quat::from_rotation_y(-0.75), vec3(OPENING.0, 0.0, BACK + 0.06));
    scene.place(leaf, Material::plastic(vec3(0.62, 0.58, 0.5), 0.35), ajar);
    let lamp = quad(vec3(-1.6, HEIGHT - 0.02, BEYOND + 0.8), Vec3::X * 1.0, Vec3::Z * 1.0);
    scene.place(lamp, Material::emitter(vec3(150.0, 128.0, 96.0)), fixed);
    scene.place(cylinder(0.28, 0.8, 24), Material::diffuse(vec3(0.3, 0.42, 0.3)), at(vec3(-1.3, 0.0, -0.4)));
    scene.place(sphere(0.3, 24, 32), Material::plastic(vec3(0.7, 0.25, 0.15), 0.25), at(vec3(-1.3, 1.1, -0.4)));
    scene.place(cuboid(vec3(0.9, 0.0, 0.0), vec3(1.9, 0.7, 0.8)), Material::diffuse(vec3(0.66, 0.6, 0.5)), fixed);
    scene.set_camera(view);
    scene
}

/// The wall between the rooms, and the opening that it leaves.
fn wall() -> Mesh {
    let (left, right, top) = OPENING;
    let mut wall = cuboid(vec3(-HALF_WIDTH, 0.0, BACK - 0.1), vec3(left, HEIGHT, BACK));
    wall.append(&cuboid(vec3(right, 0.0, BACK - 0.1), vec3(HALF_WIDTH, HEIGHT, BACK)));
    wall.append(&cuboid(vec3(left, top, BACK - 0.1), vec3(right, HEIGHT, BACK)));
    wall
}

fn view(time: f32) -> View {
    let sway = 0.25 * (time * 1.3).sin();
    View { eye: vec3(sway, 1.5, 4.6), target: vec3(0.2 * sway, 1.1, -1.5), up: Vec3::Y, vertical_fov: 0.7 }
}

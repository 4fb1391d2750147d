//! A columned hall. The sun falls through the arcade on the right, thin railings run between the columns, and the
//! camera walks.

use std::f32::consts::TAU;

use glam::{vec2, vec3, Affine3A, Vec2, Vec3};

use super::mesh::Mesh;
use super::shapes::{cuboid, lathe, quad, sphere};
use super::{to_and_fro, Environment, Lamp, Material, Placement, Scene, View};

const BAYS: usize = 8;
const BAY: f32 = 3.0;
const NEAR: f32 = 6.0;
const AISLE: f32 = 2.3;
const WALL: f32 = 4.3;
const HEIGHT: f32 = 4.6;

pub fn scene() -> Scene {
    with_railings("hall", || Placement::Fixed(Affine3A::IDENTITY))
}

/// The railings slide to and fro.
pub fn railings_moving() -> Scene {
    let sliding = |time: f32| Affine3A::from_translation(Vec3::X * (to_and_fro(1.5 * time, 1.2) - 0.6));
    with_railings("hall_railings", || Placement::Animated(Box::new(sliding)))
}

/// The sun swings from side to side.
pub fn sun_moving() -> Scene {
    let mut scene = with_railings("hall_sun", || Placement::Fixed(Affine3A::IDENTITY));
    scene.set_lamp_path(0, |time| Affine3A::from_rotation_y(0.3 * (TAU * 0.2 * time).sin()));
    scene
}

fn with_railings(name: &str, placement: impl Fn() -> Placement) -> Scene {
    let mut scene = Scene::new(name, view(0.0));
    shell(&mut scene);
    arcade(&mut scene);
    columns(&mut scene);
    railings(&mut scene, placement);
    ornaments(&mut scene);
    scene.lamps.push(Lamp::Sun {
        direction: vec3(0.84, 0.47, -0.20).normalize(),
        irradiance: vec3(38.0, 31.0, 22.0),
        radius: 0.012,
    });
    scene.environment = Environment { zenith: vec3(1.6, 2.5, 4.4), horizon: vec3(3.6, 4.0, 4.6), ground: vec3(0.6, 0.55, 0.5) };
    scene.set_camera(view);
    scene
}

fn length() -> f32 {
    BAYS as f32 * BAY
}

fn shell(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let along = Vec3::NEG_Z * length();
    let marble = Material::plastic(vec3(0.66, 0.62, 0.55), 0.35).with_checker(vec3(0.34, 0.20, 0.15), 1.0);
    scene.place(quad(vec3(-WALL, 0.0, NEAR), Vec3::X * 2.0 * WALL, along), marble, fixed);
    let plaster = Material::diffuse(vec3(0.74, 0.69, 0.6));
    scene.place(quad(vec3(-WALL, HEIGHT, NEAR + -length()), Vec3::X * 2.0 * WALL, -along), plaster, fixed);
    scene.place(quad(vec3(-WALL, 0.0, NEAR), along, Vec3::Y * HEIGHT), Material::diffuse(vec3(0.72, 0.55, 0.42)), fixed);
    scene.place(quad(vec3(-WALL, 0.0, NEAR - length()), Vec3::X * 2.0 * WALL, Vec3::Y * HEIGHT), plaster, fixed);
    scene.place(quad(vec3(WALL, 0.0, NEAR), Vec3::X * -2.0 * WALL, Vec3::Y * HEIGHT), plaster, fixed);
    // Open ground beyond the arcade, so that the sun is bounced in from outside, too.
    let lawn = Material::diffuse(vec3(0.34, 0.36, 0.18));
    scene.place(quad(vec3(WALL, -0.02, NEAR + 20.0), Vec3::X * 60.0, Vec3::NEG_Z * (length() + 40.0)), lawn, fixed);
    let mut beams = Mesh::default();
    for bay in 0..=BAYS {
        let z = NEAR - bay as f32 * BAY;
        beams.append(&cuboid(vec3(-WALL, HEIGHT - 0.45, z - 0.16), vec3(WALL, HEIGHT, z + 0.16)));
    }
    scene.place(beams, Material::diffuse(vec3(0.30, 0.19, 0.11)), fixed);
}

/// The wall on the right: piers, a sill and a lintel, and the openings that they leave.
fn arcade(scene: &mut Scene) {
    let mut wall = Mesh::default();
    for bay in 0..=BAYS {
        let z = NEAR - bay as f32 * BAY;
        wall.append(&cuboid(vec3(WALL - 0.01, 0.0, z - 0.45), vec3(WALL + 0.4, HEIGHT, z + 0.45)));
    }
    wall.append(&cuboid(vec3(WALL - 0.02, 0.0, NEAR - length()), vec3(WALL + 0.42, 0.55, NEAR)));
    wall.append(&cuboid(vec3(WALL - 0.02, 3.5, NEAR - length()), vec3(WALL + 0.42, HEIGHT + 0.4, NEAR)));
    scene.place(wall, Material::diffuse(vec3(0.74, 0.69, 0.6)), Affine3A::IDENTITY);
}

fn columns(scene: &mut Scene) {
    let shaft = |radius: f32, height: f32| (vec2(radius, height), Vec2::X);
    let mut column = lathe(&[shaft(0.27, 0.3), shaft(0.255, 1.6), shaft(0.22, HEIGHT - 0.75)], 28);
    column.append(&cuboid(vec3(-0.36, 0.0, -0.36), vec3(0.36, 0.3, 0.36)));
    column.append(&cuboid(vec3(-0.3, HEIGHT - 0.75, -0.3), vec3(0.3, HEIGHT - 0.62, 0.3)));
    column.append(&cuboid(vec3(-0.37, HEIGHT - 0.62, -0.37), vec3(0.37, HEIGHT - 0.44, 0.37)));
    let mesh = scene.add_mesh(column);
    let stone = scene.add_material(Material::plastic(vec3(0.78, 0.74, 0.66), 0.5));
    for bay in 0..BAYS {
        for side in [-1.0, 1.0] {
            let place = vec3(side * AISLE, 0.0, NEAR - (bay as f32 + 0.5) * BAY);
            scene.add_instance(mesh, stone, Placement::Fixed(Affine3A::from_translation(place)));
        }
    }
}

fn railings(scene: &mut Scene, placement: impl Fn() -> Placement) {
    let mut bars = Mesh::default();
    let (front, back) = (-AISLE - 0.012, -AISLE + 0.012);
    let (far, near) = (NEAR - length() + 0.5 * BAY, NEAR - 0.5 * BAY);
    for height in [0.98, 0.72, 0.46] {
        bars.append(&cuboid(vec3(front, height, far), vec3(back, height + 0.025, near)));
    }
    let posts = ((near - far) / 0.3) as usize;
    for post in 0..=posts {
        let z = near - 0.3 * post as f32;
        bars.append(&cuboid(vec3(front, 0.0, z - 0.01), vec3(back, 0.98, z + 0.01)));
    }
    let other_side = bars.clone().translated(Vec3::X * 2.0 * AISLE);
    let iron = scene.add_material(Material::metal(vec3(0.35, 0.34, 0.33), 0.4));
    for bars in [bars, other_side] {
        let mesh = scene.add_mesh(bars);
        scene.add_instance(mesh, iron, placement());
    }
}

fn ornaments(scene: &mut Scene) {
    let ball = scene.add_mesh(sphere(0.42, 32, 48));
    let brass = scene.add_material(Material::metal(vec3(0.93, 0.72, 0.36), 0.25));
    let glazed = scene.add_material(Material::plastic(vec3(0.06, 0.25, 0.42), 0.2));
    let plinth = cuboid(vec3(-0.32, 0.0, -0.32), vec3(0.32, 0.85, 0.32));
    let plinth = (scene.add_mesh(plinth), scene.add_material(Material::diffuse(vec3(0.7, 0.66, 0.6))));
    for (index, material) in [brass, glazed, brass].into_iter().enumerate() {
        let foot = vec3(-AISLE - 1.1, 0.0, NEAR - (1.0 + 2.0 * index as f32) * BAY);
        scene.add_instance(plinth.0, plinth.1, Placement::Fixed(Affine3A::from_translation(foot)));
        let turned = foot + Vec3::Y * 1.27;
        scene.add_instance(ball, material, Placement::Fixed(Affine3A::from_translation(turned)));
    }
}

/// A walk of a metre a second, with steps that can be seen.
fn view(time: f32) -> View {
    let time = to_and_fro(time, 16.0);
    let step = time * 1.8 * std::f32::consts::PI;
    let eye = vec3(0.55 + 0.03 * (0.5 * step).sin(), 1.65 + 0.025 * step.cos(), 4.6 - 1.1 * time);
    let target = eye + vec3(-0.26 + 0.06 * (0.5 * time).sin(), -0.06, -1.0);
    View { eye, target, up: Vec3::Y, vertical_fov: 0.95 }
}

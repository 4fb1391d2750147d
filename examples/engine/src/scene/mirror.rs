//! Mirrors side by side from polished to rough, and a ball that is one, before which painted things move. The camera stands still: whatever
//! moves in a mirror is what is seen in it.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Quat, Vec3};

use super::shapes::{cuboid, quad, sphere};
use super::{Environment, Material, Placement, Scene, View};

/// Perceptual roughness of the panels, from left to right.
pub const ROUGHNESS: [f32; 6] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];
/// Width of a panel.
const PANEL: f32 = 0.8;

pub fn scene() -> Scene {
    let mut scene = Scene::new("mirror", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let floor = Material::diffuse(vec3(0.7, 0.66, 0.58)).with_checker(vec3(0.16, 0.2, 0.3), 1.0);
    scene.place(quad(vec3(-6.0, 0.0, 7.0), Vec3::X * 12.0, Vec3::NEG_Z * 9.5), floor, fixed);
    let behind = Material::diffuse(vec3(0.65, 0.3, 0.2)).with_checker(vec3(0.75, 0.72, 0.6), 0.8);
    scene.place(quad(vec3(6.0, 0.0, 7.0), Vec3::NEG_X * 12.0, Vec3::Y * 4.5), behind, fixed);
    for (index, roughness) in ROUGHNESS.into_iter().enumerate() {
        let left = PANEL * (index as f32 - 3.0);
        let panel = cuboid(vec3(left + 0.01, 0.05, -2.05), vec3(left + PANEL - 0.01, 2.2, -2.0));
        scene.place(panel, Material::metal(vec3(0.92, 0.92, 0.93), roughness), fixed);
    }
    let steel = Material::metal(vec3(0.9, 0.88, 0.85), 0.0);
    scene.place(sphere(0.4, 48, 64), steel, Affine3A::from_translation(vec3(1.9, 0.4, -0.9)));
    let key = quad(vec3(-1.5, 4.2, 0.5), Vec3::X * 3.0, Vec3::Z * 2.0);
    scene.place(key, Material::emitter(vec3(9.0, 8.4, 7.4)), fixed);
    movers(&mut scene);
    scene.environment = Environment { zenith: vec3(0.3, 0.36, 0.5), horizon: vec3(0.4, 0.4, 0.42), ground: vec3(0.1, 0.1, 0.1) };
    scene.set_camera(view);
    scene
}

/// A ball that goes to and fro along the mirrors, and a block that turns.
fn movers(scene: &mut Scene) {
    let ball = scene.add_mesh(sphere(0.35, 32, 48));
    let red = scene.add_material(Material::diffuse(vec3(0.8, 0.1, 0.06)));
    let there = |time: f32| Affine3A::from_translation(vec3(1.6 * (TAU * 0.15 * time).sin(), 0.35, 0.1));
    scene.add_instance(ball, red, Placement::Animated(Box::new(there)));
    let block = scene.add_mesh(cuboid(vec3(-0.25, 0.0, -0.25), vec3(0.25, 0.9, 0.25)));
    let striped = scene.add_material(Material::diffuse(vec3(0.1, 0.5, 0.2)).with_checker(vec3(0.9, 0.85, 0.3), 4.0));
    let turned = |time: f32| Affine3A::from_rotation_translation(Quat::from_rotation_y(TAU * 0.2 * time), vec3(-1.3, 0.0, 0.6));
    scene.add_instance(block, striped, Placement::Animated(Box::new(turned)));
}

fn view(_: f32) -> View {
    View { eye: vec3(0.0, 1.55, 4.6), target: vec3(0.0, 0.95, -1.0), up: Vec3::Y, vertical_fov: 0.62 }
}

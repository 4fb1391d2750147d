//! A shop window and a glass ball. A ball rolls behind the pane, a block slides on the street and is seen in the pane alone, and the camera sways.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{Environment, Glass, Material, Placement, Scene, View};

/// `surface_id` of the pane.
pub const PANE: u32 = 1;
/// Of the glass ball.
pub const BALL: u32 = 2;
/// Of the ball that rolls behind the pane.
pub const ROLLING: u32 = 3;
/// Of the block that slides on the street.
pub const BLOCK: u32 = 4;

/// The world.
pub fn scene() -> Scene {
    let mut scene = Scene::new("vitrine", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let clear = vec3(0.94, 0.97, 0.95);
    scene.place(quad(vec3(-2.9, 0.25, 0.0), Vec3::X * 3.2, Vec3::Y * 2.0), Material::glass(Glass::Pane, clear), fixed);
    let ball = Affine3A::from_translation(vec3(0.72, 0.98, 0.7));
    scene.place(sphere(0.42, 64, 96), Material::glass(Glass::Body, Vec3::splat(0.99)), ball);
    movers(&mut scene);
    house(&mut scene);
    shop(&mut scene);
    street(&mut scene);
    scene.environment = Environment { zenith: vec3(0.25, 0.32, 0.45), horizon: vec3(0.3, 0.32, 0.36), ground: vec3(0.1, 0.1, 0.1) };
    scene.set_camera(view);
    scene
}

fn movers(scene: &mut Scene) {
    let ball = scene.add_mesh(sphere(0.3, 32, 48));
    let red = scene.add_material(Material::diffuse(vec3(0.75, 0.1, 0.07)).with_checker(vec3(0.9, 0.85, 0.75), 8.0));
    let rolls = |time: f32| Affine3A::from_translation(vec3(-1.3 + 0.9 * (TAU * 0.2 * time).sin(), 0.7, -0.9));
    scene.add_instance(ball, red, Placement::Animated(Box::new(rolls)));
    let block = scene.add_mesh(cuboid(vec3(-0.35, 0.0, -0.35), vec3(0.35, 1.5, 0.35)));
    let striped = scene.add_material(Material::diffuse(vec3(0.1, 0.55, 0.15)).with_checker(vec3(0.95, 0.9, 0.3), 3.0));
    let slides = |time: f32| Affine3A::from_translation(vec3(-3.0 + 0.9 * (TAU * 0.17 * time + 1.0).sin(), 0.0, 2.3));
    scene.add_instance(block, striped, Placement::Animated(Box::new(slides)));
}

/// The wall around the pane, and what the ball stands on.
fn house(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let brick = Material::diffuse(vec3(0.62, 0.27, 0.18)).with_checker(vec3(0.75, 0.66, 0.52), 5.0);
    scene.place(quad(vec3(0.3, 0.0, 0.0), Vec3::X * 4.0, Vec3::Y * 3.2), brick, fixed);
    scene.place(quad(vec3(-6.0, 0.0, 0.0), Vec3::X * 3.1, Vec3::Y * 3.2), brick, fixed);
    let plain = Material::diffuse(vec3(0.3, 0.33, 0.3));
    scene.place(quad(vec3(-2.9, 2.25, 0.0), Vec3::X * 3.2, Vec3::Y * 0.95), plain, fixed);
    scene.place(quad(vec3(-2.9, 0.0, 0.0), Vec3::X * 3.2, Vec3::Y * 0.25), plain, fixed);
    let stone = Material::diffuse(vec3(0.55, 0.53, 0.5));
    scene.place(cylinder(0.2, 0.56, 32), stone, Affine3A::from_translation(vec3(0.72, 0.0, 0.7)));
}

fn shop(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let boards = Material::diffuse(vec3(0.5, 0.36, 0.22)).with_checker(vec3(0.3, 0.2, 0.12), 3.0);
    scene.place(quad(vec3(-5.0, 0.0, 0.0), Vec3::X * 7.0, Vec3::NEG_Z * 3.2), boards, fixed);
    let paper = Material::diffuse(vec3(0.16, 0.34, 0.42)).with_checker(vec3(0.62, 0.6, 0.46), 2.5);
    scene.place(quad(vec3(-5.0, 0.0, -3.2), Vec3::X * 7.0, Vec3::Y * 3.0), paper, fixed);
    let plaster = Material::diffuse(vec3(0.6, 0.58, 0.54));
    scene.place(quad(vec3(-5.0, 0.0, 0.0), Vec3::NEG_Z * 3.2, Vec3::Y * 3.0), plaster, fixed);
    scene.place(quad(vec3(2.0, 0.0, -3.2), Vec3::Z * 3.2, Vec3::Y * 3.0), plaster, fixed);
    scene.place(quad(vec3(-5.0, 3.0, -3.2), Vec3::X * 7.0, Vec3::Z * 3.2), plaster, fixed);
    let lamp = Material::emitter(vec3(3.2, 2.8, 2.2));
    scene.place(quad(vec3(-2.6, 2.9, -2.4), Vec3::X * 2.4, Vec3::Z * 1.0), lamp, fixed);
    for (x, height) in [(-2.3, 0.9), (-0.5, 0.6)] {
        let block = cuboid(vec3(x - 0.25, 0.0, -2.1), vec3(x + 0.25, height, -1.6));
        scene.place(block, Material::plastic(vec3(0.7, 0.68, 0.62), 0.4), fixed);
    }
}

fn street(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let paving = Material::diffuse(vec3(0.5, 0.5, 0.52)).with_checker(vec3(0.34, 0.34, 0.37), 2.0);
    scene.place(quad(vec3(-9.0, 0.0, 6.0), Vec3::X * 15.0, Vec3::NEG_Z * 6.0), paving, fixed);
    let opposite = Material::diffuse(vec3(0.8, 0.72, 0.5)).with_checker(vec3(0.3, 0.36, 0.28), 1.2);
    scene.place(quad(vec3(6.0, 0.0, 6.0), Vec3::NEG_X * 15.0, Vec3::Y * 4.0), opposite, fixed);
    let lamp = Material::emitter(vec3(34.0, 31.0, 27.0));
    scene.place(quad(vec3(-4.5, 4.4, 2.0), Vec3::X * 4.0, Vec3::Z * 2.5), lamp, fixed);
}

fn view(time: f32) -> View {
    let sway = 0.25 * (0.9 * time).sin();
    View { eye: vec3(1.5 + sway, 1.4, 3.2), target: vec3(-0.5 + 0.3 * sway, 1.0, 0.0), up: Vec3::Y, vertical_fov: 0.6 }
}

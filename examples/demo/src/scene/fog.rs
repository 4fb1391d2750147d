//! A colonnade in fog. A lamp behind the pillars on the left throws shafts of light across the nave, and the camera walks by.

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cuboid, cylinder, quad};
use super::{Material, Medium, Placement, Scene, View};

const PILLARS: usize = 11;
const SPACING: f32 = 1.35;
const NEAR: f32 = 3.5;
const ROW: f32 = 2.7;
const LEFT: f32 = -8.0;
const RIGHT: f32 = 4.2;
const FAR: f32 = -15.0;
const HEIGHT: f32 = 4.6;

pub fn scene() -> Scene {
    let mut scene = Scene::new("fog", view(0.0));
    shell(&mut scene);
    pillars(&mut scene);
    let lamp = quad(vec3(LEFT + 0.3, 2.9, -4.2), Vec3::Z * 0.8, Vec3::Y * 0.8);
    scene.place(lamp, Material::emitter(vec3(330.0, 270.0, 190.0)), Affine3A::IDENTITY);
    scene.medium = Some(Medium { scattering: vec3(0.105, 0.11, 0.115), extinction: 0.12, anisotropy: 0.35 });
    scene.set_camera(view);
    scene
}

fn shell(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let (width, length) = (RIGHT - LEFT, 8.0 - FAR);
    let along = Vec3::NEG_Z * length;
    let stone = Material::plastic(vec3(0.5, 0.48, 0.45), 0.5).with_checker(vec3(0.33, 0.31, 0.3), 1.0);
    scene.place(quad(vec3(LEFT, 0.0, 8.0), Vec3::X * width, along), stone, fixed);
    let plaster = Material::diffuse(vec3(0.5, 0.5, 0.52));
    scene.place(quad(vec3(LEFT, HEIGHT, FAR), Vec3::X * width, -along), plaster, fixed);
    scene.place(quad(vec3(LEFT, 0.0, 8.0), along, Vec3::Y * HEIGHT), plaster, fixed);
    scene.place(quad(vec3(LEFT, 0.0, FAR), Vec3::X * width, Vec3::Y * HEIGHT), Material::diffuse(vec3(0.38, 0.42, 0.5)), fixed);
    scene.place(quad(vec3(RIGHT, 0.0, FAR), -along, Vec3::Y * HEIGHT), Material::diffuse(vec3(0.5, 0.42, 0.36)), fixed);
    scene.place(quad(vec3(RIGHT, 0.0, 8.0), Vec3::X * -width, Vec3::Y * HEIGHT), plaster, fixed);
}

fn pillars(scene: &mut Scene) {
    let mut pillar = cylinder(0.3, HEIGHT, 24);
    pillar.append(&cuboid(vec3(-0.4, 0.0, -0.4), vec3(0.4, 0.25, 0.4)));
    let mesh = scene.add_mesh(pillar);
    let marble = scene.add_material(Material::plastic(vec3(0.66, 0.62, 0.56), 0.4));
    for index in 0..PILLARS {
        for side in [-1.0, 1.0] {
            let place = vec3(side * ROW, 0.0, NEAR - index as f32 * SPACING);
            scene.add_instance(mesh, marble, Placement::Fixed(Affine3A::from_translation(place)));
        }
    }
}

/// Sideways and forwards at once, so that what is near and what is far move differently.
fn view(time: f32) -> View {
    let eye = vec3(-0.9 + 1.5 * time, 1.6, 5.6 - 0.9 * time);
    View { eye, target: eye + vec3(-0.16, 0.03, -1.0), up: Vec3::Y, vertical_fov: 0.85 }
}

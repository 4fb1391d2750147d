//! An arcade in fog. A lamp high up behind it throws shafts of light between the pillars, and the camera walks along.

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cuboid, cylinder, quad};
use super::{to_and_fro, Material, Medium, Placement, Scene, View};

const PILLARS: usize = 21;
const SPACING: f32 = 1.3;
const SIDE: f32 = 14.0;
const NEAR: f32 = 8.0;
const FAR: f32 = -22.0;
const HEIGHT: f32 = 4.6;
/// Underside of the beam on the pillars. It hides the lamp, near which fog is too bright to show.
const BEAM: f32 = 2.5;

pub fn scene() -> Scene {
    let mut scene = Scene::new("fog", view(0.0));
    shell(&mut scene);
    arcade(&mut scene);
    let lamp = quad(vec3(-0.3, 3.7, -3.2), Vec3::X * 0.6, Vec3::Y * 0.5);
    scene.place(lamp, Material::emitter(vec3(900.0, 730.0, 520.0)), Affine3A::IDENTITY);
    scene.medium = Some(Medium { scattering: vec3(0.105, 0.11, 0.115), extinction: 0.12, anisotropy: 0.3 });
    scene.set_camera(view);
    scene
}

fn shell(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let (across, along) = (Vec3::X * 2.0 * SIDE, Vec3::NEG_Z * (NEAR - FAR));
    let stone = Material::plastic(vec3(0.5, 0.48, 0.45), 0.5).with_checker(vec3(0.33, 0.31, 0.3), 1.0);
    scene.place(quad(vec3(-SIDE, 0.0, NEAR), across, along), stone, fixed);
    let plaster = Material::diffuse(vec3(0.5, 0.5, 0.52));
    scene.place(quad(vec3(-SIDE, HEIGHT, FAR), across, -along), plaster, fixed);
    scene.place(quad(vec3(-SIDE, 0.0, NEAR), along, Vec3::Y * HEIGHT), plaster, fixed);
    scene.place(quad(vec3(SIDE, 0.0, FAR), -along, Vec3::Y * HEIGHT), plaster, fixed);
    scene.place(quad(vec3(-SIDE, 0.0, FAR), across, Vec3::Y * HEIGHT), Material::diffuse(vec3(0.34, 0.38, 0.46)), fixed);
    scene.place(quad(vec3(SIDE, 0.0, NEAR), -across, Vec3::Y * HEIGHT), plaster, fixed);
}

fn arcade(scene: &mut Scene) {
    let mut pillar = cylinder(0.26, BEAM, 24);
    pillar.append(&cuboid(vec3(-0.34, 0.0, -0.34), vec3(0.34, 0.2, 0.34)));
    let mesh = scene.add_mesh(pillar);
    let marble = scene.add_material(Material::plastic(vec3(0.66, 0.62, 0.56), 0.4));
    for index in 0..PILLARS {
        let x = (index as f32 - 0.5 * (PILLARS as f32 - 1.0)) * SPACING;
        scene.add_instance(mesh, marble, Placement::Fixed(Affine3A::from_translation(vec3(x, 0.0, 0.0))));
    }
    let beam = cuboid(vec3(-SIDE, BEAM, -0.3), vec3(SIDE, HEIGHT, 0.3));
    scene.place(beam, Material::diffuse(vec3(0.45, 0.42, 0.38)), Affine3A::IDENTITY);
}

/// Sideways: near and far move differently.
fn view(time: f32) -> View {
    let time = to_and_fro(time, 3.0);
    let eye = vec3(-1.4 + 2.7 * time, 1.5, 6.2 - 0.3 * time);
    View { eye, target: eye + vec3(0.1, -0.03, -1.0), up: Vec3::Y, vertical_fov: 0.8 }
}

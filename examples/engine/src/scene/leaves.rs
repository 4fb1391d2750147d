//! A path under trees. The sun falls through sprays of leaves, whose outlines are holes in quads, onto the ground and a wall; the camera walks.

use glam::{vec2, vec3, Affine3A, Quat, Vec3};

use super::mesh::Mesh;
use super::shapes::{cylinder, quad};
use super::{to_and_fro, Environment, Lamp, Material, Scene, View};

const TRUNKS: [(f32, f32); 5] = [(-2.4, -3.0), (2.2, -5.5), (-2.8, -8.5), (2.6, -11.0), (-1.9, -14.0)];
const SPRAYS: u32 = 90;

pub fn scene() -> Scene {
    let mut scene = Scene::new("leaves", view(0.0));
    let fixed = Affine3A::IDENTITY;
    let ground = Material::diffuse(vec3(0.42, 0.36, 0.27)).with_checker(vec3(0.36, 0.31, 0.24), 0.7);
    scene.place(quad(vec3(-14.0, 0.0, 8.0), Vec3::X * 28.0, Vec3::NEG_Z * 36.0), ground, fixed);
    let plaster = Material::diffuse(vec3(0.72, 0.68, 0.6));
    scene.place(quad(vec3(-3.6, 0.0, 8.0), Vec3::NEG_Z * 30.0, Vec3::Y * 2.4), plaster, fixed);
    let mut crowns = Mesh::default();
    for (number, (x, z)) in (0..).zip(TRUNKS) {
        let bark = Material::diffuse(vec3(0.22, 0.17, 0.12));
        scene.place(cylinder(0.16, 3.4, 16), bark, Affine3A::from_translation(vec3(x, 0.0, z)));
        crown(&mut crowns, vec3(x, 3.6, z), number);
    }
    scene.place(crowns, Material { leaves: true, ..Material::diffuse(vec3(0.16, 0.34, 0.08)) }, fixed);
    scene.lamps.push(Lamp::Sun { direction: vec3(0.55, 0.78, -0.22).normalize(), irradiance: vec3(8.0, 6.8, 5.2), radius: 0.0093 });
    scene.environment =
        Environment { zenith: vec3(0.30, 0.50, 0.95), horizon: vec3(0.75, 0.88, 1.05), ground: vec3(0.12, 0.11, 0.10) };
    scene.set_camera(view);
    scene
}

/// Sprays in all directions, within a ball about a point.
fn crown(mesh: &mut Mesh, middle: Vec3, number: u32) {
    for spray in 0..SPRAYS {
        let random = |k: u32| {
            let mut h = (number * SPRAYS + spray).wrapping_mul(0x9e37_79b9) ^ k.wrapping_mul(0x85eb_ca6b);
            for _ in 0..2 {
                h = (h ^ h >> 16).wrapping_mul(0x7feb_352d);
                h = (h ^ h >> 15).wrapping_mul(0x846c_a68b);
            }
            (h >> 8) as f32 / (1 << 24) as f32
        };
        let direction = vec3(random(0) - 0.5, 0.7 * (random(1) - 0.5), random(2) - 0.5).normalize_or(Vec3::Y);
        let place = middle + direction * 1.7 * random(3).cbrt();
        let turn = Quat::from_euler(glam::EulerRot::YXZ, 6.3 * random(4), 1.2 * (random(5) - 0.5), 6.3 * random(6));
        let (u, v) = (turn * Vec3::X * 0.7, turn * Vec3::Z * 0.7);
        let mut leaf = quad(place - 0.5 * (u + v), u, v);
        leaf.uvs = vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)];
        mesh.append(&leaf);
    }
}

/// A walk of a metre a second.
fn view(time: f32) -> View {
    let time = to_and_fro(time, 12.0);
    let eye = vec3(0.3 * (0.5 * time).sin(), 1.6, 4.0 - 0.9 * time);
    View { eye, target: eye + vec3(-0.35, -0.22, -1.0), up: Vec3::Y, vertical_fov: 0.95 }
}

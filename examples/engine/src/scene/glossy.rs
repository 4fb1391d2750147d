//! Rough mirrors among coloured things on a chequered floor, seen from a camera that goes round them.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Quat, Vec3};

use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{Environment, Material, Placement, Scene, View};

pub fn scene() -> Scene {
    let mut scene = Scene::new("glossy", view(0.0));
    room(&mut scene);
    balls(&mut scene);
    let at = |x: f32, z: f32, angle: f32| Affine3A::from_rotation_translation(Quat::from_rotation_y(angle), vec3(x, 0.0, z));
    scene.place(
        cuboid(vec3(-0.4, 0.0, -0.4), vec3(0.4, 0.8, 0.4)),
        Material::plastic(vec3(0.75, 0.08, 0.06), 0.3),
        at(1.75, 0.55, 0.5),
    );
    scene.place(cylinder(0.34, 1.1, 40), Material::plastic(vec3(0.07, 0.42, 0.16), 0.25), at(-2.05, -0.75, 0.0));
    scene.place(cylinder(0.28, 0.5, 40), Material::diffuse(vec3(0.85, 0.62, 0.1)), at(-0.55, 1.55, 0.0));
    // A folding screen of three rough mirrors.
    for (index, roughness) in [0.15, 0.25, 0.4].into_iter().enumerate() {
        let x = -2.1 + 2.1 * index as f32;
        let angle = 0.35 * (1.0 - index as f32);
        let panel = cuboid(vec3(-1.0, 0.05, -0.04), vec3(1.0, 2.3, 0.04));
        let place = at(x, -2.1 + 0.25 * (index as f32 - 1.0).abs(), angle);
        scene.place(panel, Material::metal(vec3(0.9, 0.91, 0.93), roughness), place);
    }
    scene.environment =
        Environment { zenith: vec3(0.30, 0.38, 0.55), horizon: vec3(0.42, 0.42, 0.45), ground: vec3(0.08, 0.08, 0.08) };
    scene.set_camera(view);
    scene
}

fn room(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let floor = Material::plastic(vec3(0.72, 0.70, 0.66), 0.3).with_checker(vec3(0.10, 0.11, 0.14), 1.5);
    scene.place(quad(vec3(-9.0, 0.0, 9.0), Vec3::X * 18.0, Vec3::NEG_Z * 18.0), floor, fixed);
    scene.place(quad(vec3(-9.0, 0.0, -4.2), Vec3::X * 18.0, Vec3::Y * 6.0), Material::diffuse(vec3(0.32, 0.38, 0.46)), fixed);
    let key = quad(vec3(-2.6, 3.9, 0.2), Vec3::X * 2.0, Vec3::Z * 1.4);
    scene.place(key, Material::emitter(vec3(15.0, 13.0, 10.5)), fixed);
    let fill = quad(vec3(4.0, 1.2, 2.6), vec3(-0.6, 0.0, -1.6), Vec3::Y * 1.6).translated(vec3(0.6, 0.0, 0.0));
    scene.place(fill, Material { two_sided_emission: true, ..Material::emitter(vec3(2.2, 3.2, 5.0)) }, fixed);
}

fn balls(scene: &mut Scene) {
    let large = scene.add_mesh(sphere(0.62, 48, 64));
    let small = scene.add_mesh(sphere(0.3, 32, 48));
    let gold = scene.add_material(Material::metal(vec3(1.0, 0.71, 0.29), 0.22));
    let copper = scene.add_material(Material::metal(vec3(0.95, 0.54, 0.42), 0.38));
    let steel = scene.add_material(Material::metal(vec3(0.8, 0.82, 0.85), 0.15));
    let blue = scene.add_material(Material::plastic(vec3(0.06, 0.16, 0.6), 0.2));
    let still = |x: f32, y: f32, z: f32| Placement::Fixed(Affine3A::from_translation(vec3(x, y, z)));
    scene.add_instance(large, gold, still(0.15, 0.62, -0.15));
    scene.add_instance(large, steel, still(-1.25, 0.62, 0.35));
    scene.add_instance(small, copper, still(0.85, 0.3, 1.0));
    // One ball rolls on a circle round the others.
    scene.add_instance(
        small,
        blue,
        Placement::Animated(Box::new(|time| {
            let angle = 0.9 + TAU * 0.11 * time;
            Affine3A::from_translation(vec3(2.45 * angle.sin(), 0.3, 0.1 + 1.75 * angle.cos()))
        })),
    );
}

fn view(time: f32) -> View {
    let angle = 0.12 + 0.35 * (time * 0.8).sin();
    let eye = vec3(6.3 * angle.sin(), 1.85, 6.3 * angle.cos());
    View { eye, target: vec3(0.0, 0.72, 0.0), up: Vec3::Y, vertical_fov: 0.62 }
}

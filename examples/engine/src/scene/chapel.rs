//! A room with a window of coloured panes. A sun that swings shines through it, a lamp goes round, another to and fro, and a third stands still: four
//! lights, whose shadows move and have colours.

use std::f32::consts::TAU;

use glam::{vec3, Affine3A, Vec3};

use super::shapes::{cuboid, cylinder, quad, sphere};
use super::{Environment, Glass, Lamp, Material, Scene, View};

const HALF_WIDTH: f32 = 3.0;
const HEIGHT: f32 = 3.4;
const BACK: f32 = -4.0;
const FRONT: f32 = 4.5;
/// The window in the wall on the right: along z, then y.
const WINDOW: [[f32; 2]; 2] = [[-2.4, 0.9], [0.8, 2.9]];
const COLOURS: [Vec3; 4] = [vec3(0.85, 0.08, 0.06), vec3(0.08, 0.2, 0.85), vec3(0.9, 0.72, 0.1), vec3(0.08, 0.6, 0.2)];

pub fn scene() -> Scene {
    let mut scene = Scene::new("chapel", view(0.0));
    walls(&mut scene);
    window(&mut scene);
    furniture(&mut scene);
    lamps(&mut scene);
    scene.environment = Environment { zenith: vec3(0.5, 0.6, 0.8), horizon: vec3(0.6, 0.62, 0.66), ground: vec3(0.2, 0.2, 0.2) };
    scene.set_camera(view);
    scene
}

fn walls(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let (across, along) = (Vec3::X * 2.0 * HALF_WIDTH, Vec3::Z * (FRONT - BACK));
    let stone = Material::diffuse(vec3(0.66, 0.64, 0.6));
    let floor = Material::plastic(vec3(0.6, 0.58, 0.54), 0.5).with_checker(vec3(0.42, 0.4, 0.38), 1.0);
    let corner = vec3(-HALF_WIDTH, 0.0, BACK);
    scene.place(quad(corner + along, across, -along), floor, fixed);
    scene.place(quad(corner + Vec3::Y * HEIGHT, across, along), stone, fixed);
    scene.place(quad(corner, across, Vec3::Y * HEIGHT), stone, fixed);
    scene.place(quad(corner + along, -along, Vec3::Y * HEIGHT), stone, fixed);
    scene.place(quad(corner + along + across, -across, Vec3::Y * HEIGHT), stone, fixed);
    let [[near, far], [low, high]] = WINDOW;
    for (z, y) in
        [([BACK, FRONT], [0.0, low]), ([BACK, FRONT], [high, HEIGHT]), ([BACK, near], [low, high]), ([far, FRONT], [low, high])]
    {
        let part = quad(vec3(HALF_WIDTH, y[0], z[0]), Vec3::Z * (z[1] - z[0]), Vec3::Y * (y[1] - y[0]));
        scene.place(part, stone, fixed);
    }
}

fn window(scene: &mut Scene) {
    let fixed = Affine3A::IDENTITY;
    let [[near, far], [low, high]] = WINDOW;
    let (columns, rows) = (5, 4);
    let size = [(far - near) / columns as f32, (high - low) / rows as f32];
    let at = |column: usize, row: usize| vec3(HALF_WIDTH, low + row as f32 * size[1], near + column as f32 * size[0]);
    for (number, colour) in COLOURS.into_iter().enumerate() {
        let mut panes = super::Mesh::default();
        for cell in (0..columns * rows).filter(|cell| (cell % columns + 2 * (cell / columns)) % COLOURS.len() == number) {
            panes.append(&quad(at(cell % columns, cell / columns), Vec3::Z * size[0], Vec3::Y * size[1]));
        }
        scene.place(panes, Material::glass(Glass::Pane, colour), fixed);
    }
    let mut lead = super::Mesh::default();
    let (thin, deep) = (0.02, 0.04);
    for column in 0..=columns {
        let middle = at(column, 0);
        lead.append(&cuboid(vec3(HALF_WIDTH - deep, low, middle.z - thin), vec3(HALF_WIDTH + deep, high, middle.z + thin)));
    }
    for row in 0..=rows {
        let middle = at(0, row);
        lead.append(&cuboid(vec3(HALF_WIDTH - deep, middle.y - thin, near), vec3(HALF_WIDTH + deep, middle.y + thin, far)));
    }
    scene.place(lead, Material::diffuse(vec3(0.12, 0.12, 0.13)), fixed);
}

fn furniture(scene: &mut Scene) {
    let stone = Material::diffuse(vec3(0.74, 0.7, 0.62));
    for (x, z) in [(-1.7, -2.6), (-1.7, 0.2), (1.5, -3.0)] {
        scene.place(cylinder(0.2, HEIGHT, 32), stone, Affine3A::from_translation(vec3(x, 0.0, z)));
    }
    let wood = Material::diffuse(vec3(0.4, 0.25, 0.14));
    for z in [-2.2, -1.2, -0.2] {
        let bench = cuboid(vec3(-0.9, 0.0, z - 0.15), vec3(0.7, 0.42, z + 0.15));
        scene.place(bench, wood, Affine3A::IDENTITY);
    }
    let plinth = cuboid(vec3(-0.3, 0.0, -3.3), vec3(0.3, 0.9, -2.8));
    scene.place(plinth, stone, Affine3A::IDENTITY);
    scene.place(
        sphere(0.35, 32, 48),
        Material::plastic(vec3(0.6, 0.6, 0.62), 0.4),
        Affine3A::from_translation(vec3(0.0, 1.25, -3.05)),
    );
}

fn lamps(scene: &mut Scene) {
    let lamp = |position, intensity| Lamp::Point { position, radius: 0.08, intensity, spot: None };
    scene.lamps = vec![
        Lamp::Sun { direction: vec3(0.72, 0.5, -0.1).normalize(), irradiance: vec3(11.0, 9.6, 8.0), radius: 0.02 },
        lamp(vec3(0.0, 2.5, 0.0), vec3(7.0, 5.2, 3.2)),
        lamp(vec3(-2.2, 1.9, -1.2), vec3(2.0, 3.2, 6.0)),
        lamp(vec3(2.2, 2.7, -3.2), vec3(6.0, 3.2, 4.0)),
    ];
    scene.set_lamp_path(0, |time| Affine3A::from_rotation_y(0.25 * (TAU * 0.15 * time).sin()));
    scene.set_lamp_path(1, |time| {
        let angle = TAU * 0.2 * time;
        Affine3A::from_translation(vec3(1.1 * angle.cos(), 0.0, -1.4 + 1.1 * angle.sin()))
    });
    scene.set_lamp_path(2, |time| Affine3A::from_translation(Vec3::Z * (1.2 * (TAU * 0.18 * time).sin())));
}

fn view(time: f32) -> View {
    let sway = 0.2 * (0.8 * time).sin();
    View { eye: vec3(-0.4 + sway, 1.7, 3.9), target: vec3(0.15, 1.05, -2.0), up: Vec3::Y, vertical_fov: 0.8 }
}

//! A closed room with a lamp under its ceiling, balls of four materials, one of which rolls, and a camera that moves.

use bevy::camera::{Exposure, RenderTarget};
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::prelude::*;
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::solari::prelude::{RaytracingMesh3d, SolariLighting};
use bevy_atrous::{Capture, Denoise, Source};

/// Pixels.
pub const EXTENT: [u32; 2] = [160, 90];

/// The frame at which camera and balls stand.
#[derive(Resource, Default)]
pub struct Frame(pub u32);

/// What is captured, from the first frame on.
#[derive(Resource)]
pub struct Captured(pub Capture);

/// The picture of the camera. Without tone mapping and dithering it is the denoised texture itself, so that it can be compared.
#[derive(Resource)]
pub struct Target(pub Handle<Image>);

#[derive(Component)]
struct Rolls;

/// The room, a camera with Solari that is denoised, and what moves them.
pub struct ScenePlugin;

impl Plugin for ScenePlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<Frame>().add_systems(Startup, spawn).add_systems(Update, place);
    }
}

/// Centre, size and colour of the boxes that are matte.
const BOXES: [([f32; 3], [f32; 3], [f32; 3]); 7] = [
    // Floor, ceiling, back, front behind the camera, left, right, and a block.
    ([0.0, -0.1, 0.0], [8.2, 0.2, 8.2], [0.7, 0.68, 0.65]),
    ([0.0, 4.1, 0.0], [8.2, 0.2, 8.2], [0.75, 0.75, 0.75]),
    ([0.0, 2.0, -3.1], [8.2, 4.2, 0.2], [0.72, 0.72, 0.72]),
    ([0.0, 2.0, 4.1], [8.2, 4.2, 0.2], [0.72, 0.72, 0.72]),
    ([-4.1, 2.0, 0.0], [0.2, 4.2, 8.2], [0.65, 0.12, 0.1]),
    ([4.1, 2.0, 0.0], [0.2, 4.2, 8.2], [0.12, 0.3, 0.65]),
    ([2.3, 0.6, -1.7], [1.1, 1.2, 1.1], [0.3, 0.6, 0.3]),
];

/// Place on the floor, radius, colour, roughness and whether it is metal.
type Ball = ([f32; 2], f32, [f32; 3], f32, bool);
const BALLS: [Ball; 4] = [
    ([-1.9, -0.8], 0.8, [0.8, 0.6, 0.25], 0.9, false),
    ([0.0, -1.2], 0.9, [0.9, 0.8, 0.7], 0.25, true),
    ([1.3, 0.6], 0.5, [0.15, 0.35, 0.7], 0.3, false),
    ([-0.9, 0.9], 0.4, [0.75, 0.2, 0.2], 0.8, false),
];

fn spawn(
    mut commands: Commands,
    mut images: ResMut<Assets<Image>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    frame: Res<Frame>,
    captured: Res<Captured>,
) -> Result {
    let mut spawn = |mesh: Mesh, at: Vec3, material: StandardMaterial| -> Result<Entity> {
        // Solari reads tangents.
        let mesh = meshes.add(mesh.with_generated_tangents()?);
        let material = MeshMaterial3d(materials.add(material));
        let things = (Mesh3d(mesh.clone()), RaytracingMesh3d(mesh), material, Transform::from_translation(at));
        Ok(commands.spawn(things).id())
    };
    let matte = |[red, green, blue]: [f32; 3]| StandardMaterial {
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..Color::linear_rgb(red, green, blue).into()
    };
    for (centre, size, colour) in BOXES {
        spawn(Cuboid::from_size(size.into()).into(), centre.into(), matte(colour))?;
    }
    let emissive = LinearRgba::rgb(14.0, 12.5, 10.0);
    let lamp = StandardMaterial { emissive, ..matte([0.5; 3]) };
    spawn(Cuboid::new(1.6, 0.05, 1.6).into(), Vec3::new(0.3, 3.9, -0.4), lamp)?;
    let mut last = None;
    for ([x, z], radius, [red, green, blue], perceptual_roughness, is_metal) in BALLS {
        let metallic = if is_metal { 1.0 } else { 0.0 };
        let material = StandardMaterial { perceptual_roughness, metallic, ..Color::linear_rgb(red, green, blue).into() };
        last = Some(spawn(bevy::shape::Sphere::new(radius).mesh().uv(48, 32), Vec3::new(x, radius, z), material)?);
    }
    last.into_iter().for_each(|ball| {
        commands.entity(ball).insert(Rolls);
    });

    let [width, height] = EXTENT;
    let mut target = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
    target.texture_descriptor.usage |= TextureUsages::COPY_SRC;
    let target = images.add(target);
    commands.insert_resource(Target(target.clone()));
    let camera = (Camera3d::default(), RenderTarget::from(target), eye(frame.0), Tonemapping::None, DebandDither::Disabled);
    // One unit of emission is one unit of the picture.
    let exposure = Exposure { ev100: -1.2_f32.log2() };
    let denoise = Denoise { source: Source::MainTexture, capture: Some(captured.0.clone()), ..default() };
    commands.spawn((camera, exposure, SolariLighting::default(), denoise));
    Ok(())
}

fn eye(frame: u32) -> Transform {
    let time = frame as f32;
    let eye = Vec3::new(-0.6 + 0.03 * time, 1.7 + 0.005 * time, 3.7);
    Transform::from_translation(eye).looking_at(Vec3::new(0.01 * time, 1.1, -0.8), Vec3::Y)
}

fn place(
    frame: Res<Frame>,
    mut camera: Single<&mut Transform, (With<Camera3d>, Without<Rolls>)>,
    mut balls: Query<&mut Transform, With<Rolls>>,
) {
    **camera = eye(frame.0);
    for mut transform in &mut balls {
        transform.translation.x = BALLS[3].0[0] + 0.03 * frame.0 as f32;
    }
}

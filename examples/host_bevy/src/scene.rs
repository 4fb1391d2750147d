//! Spheres on a floor, one of which moves, seen by a camera that moves and turns: as meshes for Bevy, as numbers for the path tracer.

use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::core_pipeline::prepass::{DeferredPrepass, NormalPrepass};
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::image::{ImageAddressMode, ImageSampler, ImageSamplerDescriptor};
use bevy::math::Affine2;
use bevy::prelude::*;
use bevy::render::camera::TemporalJitter;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat, TextureUsages};
use bevy_atrous::{Capture, Denoise, Source};

/// Pixels.
pub const EXTENT: [u32; 2] = [320, 180];

/// Centre and radius of the light.
pub const LIGHT: [f32; 4] = [3.0, 6.0, 2.0, 0.9];

/// Half the side of the floor.
const FLOOR: f32 = 60.0;

/// A sphere that lies on the floor.
pub struct Sphere {
    x: f32,
    z: f32,
    /// Scene units.
    pub radius: f32,
    /// Linear.
    pub albedo: [f32; 3],
    /// Scene units a frame, along x.
    speed: f32,
}

/// As many as the shader has.
pub const SPHERES: [Sphere; 5] = [
    Sphere { x: -2.2, z: 0.0, radius: 1.0, albedo: [0.8, 0.25, 0.2], speed: 0.0 },
    Sphere { x: 0.1, z: -0.6, radius: 0.8, albedo: [0.25, 0.65, 0.3], speed: 0.0 },
    Sphere { x: 2.1, z: 0.2, radius: 1.1, albedo: [0.3, 0.4, 0.85], speed: 0.0 },
    Sphere { x: -1.4, z: 2.0, radius: 0.45, albedo: [0.85, 0.75, 0.3], speed: 0.05 },
    Sphere { x: 0.4, z: -3.2, radius: 1.5, albedo: [0.8, 0.8, 0.8], speed: 0.0 },
];

/// What the path tracer has to know of a frame.
#[derive(Resource, Clone)]
pub struct Scene {
    /// Number of the frame.
    pub index: u32,
    /// The frame at which everything stands.
    pub time: u32,
    /// Paths a pixel.
    pub paths: u32,
    /// Offset of the samples from the pixel centres, pixels.
    pub jitter: Vec2,
}

impl Default for Scene {
    fn default() -> Self {
        Self { index: 0, time: 0, paths: 1, jitter: Vec2::ZERO }
    }
}

impl Scene {
    /// The centres of [`SPHERES`].
    pub fn centres(&self) -> impl Iterator<Item = Vec3> + use<> {
        let time = self.time as f32;
        SPHERES.iter().map(move |sphere| Vec3::new(sphere.x + time * sphere.speed, sphere.radius, sphere.z))
    }

    fn camera(&self) -> Transform {
        let time = self.time as f32;
        let eye = Vec3::new(-1.5 + 0.06 * time, 2.4 + 0.01 * time, 7.0);
        Transform::from_translation(eye).looking_at(Vec3::new(0.03 * time, 0.8, 0.0), Vec3::Y)
    }
}

/// How the camera hands over: guides alone, or as Solari does, the deferred G-buffer and light in the main texture.
#[derive(Resource, Clone, Copy, PartialEq)]
pub struct LikeSolari(pub bool);

/// What is captured, from the first frame on.
#[derive(Resource)]
pub struct Captured(pub Capture);

/// The picture of the camera. Without tone mapping and dithering it is the denoised texture itself, so that it can be compared.
#[derive(Resource)]
pub struct Target(pub Handle<Image>);

#[derive(Component)]
struct Place(usize);

/// Meshes, a camera that is denoised, and what moves them.
pub struct ScenePlugin;

impl Plugin for ScenePlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(Scene::default()).add_systems(Startup, spawn).add_systems(Update, place);
    }
}

fn spawn(
    mut commands: Commands,
    mut images: ResMut<Assets<Image>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    scene: Res<Scene>,
    like_solari: Res<LikeSolari>,
    captured: Res<Captured>,
) {
    // Without reflectance the albedo of both lobes is the base colour.
    let mut matte = |material| MeshMaterial3d(materials.add(StandardMaterial { reflectance: 0.0, ..material }));
    let floor = Plane3d::new(Vec3::Y, Vec2::splat(FLOOR));
    // A square of the floor has one unit, the texture has two.
    let uv_transform = Affine2::from_scale(Vec2::splat(FLOOR));
    let checks = matte(StandardMaterial { base_color_texture: Some(images.add(checks())), uv_transform, ..default() });
    commands.spawn((Mesh3d(meshes.add(floor)), checks, Transform::default()));
    for (index, sphere) in SPHERES.iter().enumerate() {
        let mesh = bevy::shape::Sphere::new(sphere.radius).mesh().uv(96, 64);
        let [red, green, blue] = sphere.albedo;
        let material = matte(Color::linear_rgb(red, green, blue).into());
        commands.spawn((Mesh3d(meshes.add(mesh)), material, Transform::default(), Place(index)));
    }
    let [width, height] = EXTENT;
    let mut target = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
    target.texture_descriptor.usage |= TextureUsages::COPY_SRC;
    let target = images.add(target);
    commands.insert_resource(Target(target.clone()));
    let camera = (Camera3d::default(), RenderTarget::from(target), scene.camera(), Tonemapping::None, DebandDither::Disabled);
    let source = if like_solari.0 { Source::MainTexture } else { Source::PathTracer };
    let denoised = (Denoise { source, capture: Some(captured.0.clone()), ..default() }, NormalPrepass);
    let mut camera = commands.spawn((camera, denoised, TemporalJitter::default()));
    if like_solari.0 {
        camera.insert(DeferredPrepass);
    }
}

/// Squares of 0.75 and 0.25, as the path tracer has them.
fn checks() -> Image {
    let [bright, dark] = [[225, 225, 225, 255], [137, 137, 137, 255]];
    let size = Extent3d { width: 2, height: 2, depth_or_array_layers: 1 };
    let texels = [bright, dark, dark, bright].concat();
    let mut image = Image::new(size, TextureDimension::D2, texels, TextureFormat::Rgba8UnormSrgb, RenderAssetUsages::default());
    let repeat = ImageAddressMode::Repeat;
    image.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
        address_mode_u: repeat,
        address_mode_v: repeat,
        ..ImageSamplerDescriptor::nearest()
    });
    image
}

type IsCamera = (With<Camera3d>, Without<Place>);

fn place(
    scene: Res<Scene>,
    camera: Single<(&mut Transform, &mut TemporalJitter), IsCamera>,
    mut spheres: Query<(&mut Transform, &Place)>,
) {
    let (mut transform, mut jitter) = camera.into_inner();
    (*transform, jitter.offset) = (scene.camera(), scene.jitter);
    let centres: Vec<Vec3> = scene.centres().collect();
    for (mut transform, place) in &mut spheres {
        transform.translation = centres[place.0];
    }
}

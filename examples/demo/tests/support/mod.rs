//! A device under validation, and small pictures.

use std::sync::Arc;

use ash::vk::Extent2D;
use atrous_demo::scene::Mesh;
use atrous_demo::{PathTracer, Scene, SceneOptions, TracerOptions};
use glam::{Vec2, Vec3};

pub use atrous_demo::testing::Validated;

pub const SMALL: Extent2D = Extent2D { width: 32, height: 18 };

pub fn built_in(name: &str, options: SceneOptions) -> Arc<Scene> {
    Arc::new(Scene::load(name, &options).expect("a built-in scene"))
}

pub fn tracer(gpu: &Validated, scene: &Arc<Scene>, options: TracerOptions) -> PathTracer {
    PathTracer::new(&gpu.0, scene, SMALL, options).expect("a path tracer")
}

pub fn render(gpu: &Validated, tracer: &mut PathTracer, frame: u32) {
    tracer.begin_frame(frame).expect("a frame");
    gpu.0
        .submit(|cmd| {
            tracer.record_gbuffer(cmd);
            tracer.record_lighting(cmd);
            Ok(())
        })
        .expect("a submit");
}

pub fn mean(pixels: &[[f32; 3]]) -> f64 {
    pixels.iter().flatten().map(|value| f64::from(*value)).sum::<f64>() / (3 * pixels.len()) as f64
}

pub fn rgb(pixels: Vec<[f32; 4]>) -> Vec<[f32; 3]> {
    pixels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect()
}

/// A cube of side 2 about the origin whose faces look inwards or outwards.
pub fn cube(inwards: bool) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);
        let corners = vec![axis - u - v, axis + u - v, axis + u + v, axis - u + v];
        let triangles = if inwards { vec![[0, 2, 1], [0, 3, 2]] } else { vec![[0, 1, 2], [0, 2, 3]] };
        let normal = if inwards { -axis } else { axis };
        mesh.append(&Mesh { positions: corners, normals: vec![normal; 4], uvs: vec![Vec2::ZERO; 4], triangles });
    }
    mesh
}

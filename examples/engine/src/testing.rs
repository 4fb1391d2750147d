//! A device under validation and small pictures, for tests.

use std::io::Write;
use std::ops::Deref;
use std::sync::Arc;

use ash::vk::Extent2D;
use glam::{Vec2, Vec3};

use crate::scene::Mesh;
use crate::{Gpu, GpuOptions, PathTracer, Scene, SceneOptions, TracerOptions};

/// A device under synchronisation validation; the test fails when it goes with messages.
pub struct Validated(pub Gpu);

impl Validated {
    /// `None`, said on the terminal, where there is no device or no validation layer: the test is skipped then. An error with
    /// `ATROUS_REQUIRE_DEVICE=1`.
    pub fn new() -> Option<Self> {
        match Gpu::new(&GpuOptions { validation: true, ..GpuOptions::default() }) {
            Ok(gpu) => Some(Self(gpu)),
            Err(error) => {
                assert!(std::env::var_os("ATROUS_REQUIRE_DEVICE").is_none(), "ATROUS_REQUIRE_DEVICE is set, but: {error}");
                let thread = std::thread::current();
                // Not by a macro: the test harness would swallow it.
                let _ = writeln!(std::io::stderr(), "SKIPPED {}: {error}", thread.name().unwrap_or("a test"));
                None
            }
        }
    }
}

impl Deref for Validated {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for Validated {
    fn drop(&mut self) {
        let messages = self.0.validation_messages();
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "validation: {messages:#?}");
        }
    }
}

/// A size of pictures that takes no time.
pub const SMALL: Extent2D = Extent2D { width: 40, height: 22 };

/// A scene by its name.
pub fn built_in(name: &str, options: SceneOptions) -> Arc<Scene> {
    Arc::new(Scene::load(name, &options).expect("a built-in scene"))
}

/// A tracer of [`SMALL`] pictures.
pub fn tracer(gpu: &Validated, scene: &Arc<Scene>, options: TracerOptions) -> PathTracer {
    PathTracer::new(&gpu.0, scene, SMALL, options).expect("a path tracer")
}

/// Renders a frame without a denoiser.
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

/// The mean of all components.
pub fn mean(pixels: &[[f32; 3]]) -> f64 {
    pixels.iter().flatten().map(|value| f64::from(*value)).sum::<f64>() / (3 * pixels.len()) as f64
}

/// Without alpha.
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

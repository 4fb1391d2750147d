//! The library's own test of the guides, on the guides of a renderer: what is right is called right, and what is declared wrongly is named.

use ash::vk::Extent2D;
use atrous::config::{Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit};
use atrous::reference::Image;
use atrous::FrameParams;
use atrous_conventions::{check, Guides, Report, Verdict};
use atrous_engine::testing::{built_in, Validated};
use atrous_engine::{PathTracer, SceneOptions, TracerOptions};

const EXTENT: Extent2D = Extent2D { width: 120, height: 68 };

/// What the demo declares.
fn declared() -> Conventions {
    Conventions { motion_unit: MotionUnit::Pixels, motion_depth: MotionDepth::Absolute, ..Conventions::default() }
}

struct Frame {
    params: FrameParams,
    images: [Image<[f32; 4]>; 3],
    surface_id: Image<u32>,
}

impl Frame {
    fn render(gpu: &Validated, tracer: &mut PathTracer, index: u32) -> Self {
        tracer.begin_frame(index).expect("a frame");
        gpu.0
            .submit(|cmd| {
                tracer.record_gbuffer(cmd);
                Ok(())
            })
            .expect("a submit");
        let (camera, extent) = (tracer.camera(index), [EXTENT.width, EXTENT.height]);
        let outputs = tracer.outputs();
        let image = |image| Image::from_texels(extent, gpu.0.read_image(image).expect("texels")).expect("the extent");
        let ids = gpu.0.read_image_u32(&outputs.surface_id).expect("ids");
        Self {
            params: FrameParams {
                view_from_world: camera.view_from_world,
                clip_from_view: camera.clip_from_view,
                jitter: camera.jitter,
                ..FrameParams::new(extent)
            },
            images: [&outputs.depth, &outputs.normal, &outputs.motion].map(image),
            surface_id: Image::from_texels(extent, ids).expect("the extent"),
        }
    }

    fn guides(&self) -> Guides<'_> {
        let [depth, normal, motion] = &self.images;
        Guides { params: self.params, depth, normal: Some(normal), motion: Some(motion), surface_id: Some(&self.surface_id) }
    }
}

/// What the library says of a scene under several declarations.
fn reports<const N: usize>(gpu: &Validated, scene: &str, variants: [Conventions; N]) -> [Report; N] {
    let options = TracerOptions { jitter: true, ..TracerOptions::default() };
    let mut tracer = PathTracer::new(&gpu.0, &built_in(scene, SceneOptions::default()), EXTENT, options).expect("a path tracer");
    let frames = [5, 6].map(|index| Frame::render(gpu, &mut tracer, index));
    variants.map(|conventions| check(&conventions, &frames[0].guides(), &frames[1].guides()).expect("images that fit"))
}

#[test]
fn guides_of_every_scene_are_as_declared() {
    let Some(gpu) = Validated::new() else { return };
    for scene in ["cornell", "pillars", "glossy", "hall"] {
        let [report] = reports(&gpu, scene, [declared()]);
        assert!(!report.complains(), "{scene}:\n{report}");
        println!("{scene}:\n{report}");
    }
}

#[test]
fn a_wrong_declaration_is_named() {
    let Some(gpu) = Validated::new() else { return };
    let [sign, unit, z, depth] = reports(
        &gpu,
        "hall",
        [
            Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..declared() },
            Conventions { motion_unit: MotionUnit::Uv, ..declared() },
            Conventions { motion_depth: MotionDepth::Difference, ..declared() },
            Conventions { depth: DepthEncoding::RayLength, ..declared() },
        ],
    );
    for (name, report, verdict) in [
        ("sign", &sign, sign.motion.verdict),
        ("unit", &unit, unit.motion.verdict),
        ("z", &z, z.motion_depth.verdict),
        ("depth", &depth, depth.geometry.verdict),
    ] {
        assert_eq!(verdict, Verdict::Mistake, "{name}:\n{report}");
        assert_eq!(report.conventions, declared(), "{name}:\n{report}");
    }
}

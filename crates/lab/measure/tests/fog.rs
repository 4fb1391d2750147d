//! Fog: its estimator against a known answer and its own reference, and what the filter of volumes reaches beside that of surfaces.

use std::sync::Arc;

use ash::vk::Extent2D;
use atrous::config::Preset;
use atrous_engine::scene::{Material, Medium, View};
use atrous_engine::testing::{built_in, cube, mean, render, rgb, tracer, Validated, SMALL};
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer, Scene, SceneOptions, TracerOptions};
use atrous_measure::measure::Frame;
use glam::{vec3, Affine3A, Vec3};

/// Thin fog in front of a wall that shines evenly from all sides: what it scatters is its coefficient times the length of the ray.
#[test]
fn thin_fog_in_even_light_is_as_bright_as_it_is_deep() {
    let Some(gpu) = Validated::new() else { return };
    for anisotropy in [0.0, 0.6] {
        let view = View { eye: Vec3::ZERO, target: Vec3::NEG_Z, up: Vec3::Y, vertical_fov: 0.9 };
        let mut scene = Scene::new("furnace", view);
        scene.place(cube(true), Material { emission: Vec3::ONE, ..Material::diffuse(Vec3::ZERO) }, Affine3A::IDENTITY);
        let scattering = vec3(1e-3, 5e-4, 0.0);
        scene.medium = Some(Medium { scattering, extinction: 1e-3, anisotropy });
        let mut tracer = tracer(&gpu, &Arc::new(scene), TracerOptions::default());
        let reference = tracer.render_reference(512, |_, _| ()).expect("a reference");
        let volume = reference.volume.expect("a medium");
        // The far wall is a plane at depth 1: the ray of a pixel is as long as its direction with depth 1.
        let [w, h] = [SMALL.width as f32, SMALL.height as f32];
        let length = |i: usize| {
            let (x, y) = ((i % 32) as f32 + 0.5, (i / 32) as f32 + 0.5);
            let tangent = 0.45_f32.tan();
            let across = vec3((x / w * 2.0 - 1.0) * tangent * w / h, (y / h * 2.0 - 1.0) * tangent, 1.0);
            // Beyond 45 degrees it meets a wall at the side.
            across.length() / across.abs().max_element()
        };
        let expected: f32 = (0..volume.len()).map(length).sum::<f32>() / volume.len() as f32;
        let given = |c: usize| volume.iter().map(|v| f64::from(v[c])).sum::<f64>() / volume.len() as f64 / f64::from(expected);
        println!("g {anisotropy}: {:.6} {:.6} {:.6}", given(0), given(1), given(2));
        assert!((given(0) / 1e-3 - 1.0).abs() < 0.02 && (given(1) / 5e-4 - 1.0).abs() < 0.02 && given(2) == 0.0, "{anisotropy}");
    }
}

/// As every estimator of the demo, noise that its reference is the mean of; and depths before the surfaces.
#[test]
fn the_reference_is_the_mean_of_the_noise() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("fog", SceneOptions { static_camera: true, ..SceneOptions::default() });
    let mut tracer = tracer(&gpu, &scene, TracerOptions::default());
    let mut sum = 0.0;
    let frames = 96;
    for frame in 0..frames {
        render(&gpu, &mut tracer, frame);
        let volume = tracer.volume().expect("a medium");
        sum += mean(&rgb(gpu.0.read_image(&volume.noisy_volume).expect("pixels"))) / f64::from(frames);
        let depths = gpu.0.read_image(&volume.scattering_depth).expect("pixels");
        let surfaces = gpu.0.read_image(&tracer.outputs().depth).expect("pixels");
        for (depth, surface) in depths.iter().zip(&surfaces) {
            assert!(depth[0] >= 0.0 && depth[0] <= surface[0] * 1.0001, "{} {}", depth[0], surface[0]);
        }
    }
    let reference = mean(&tracer.render_reference(1024, |_, _| ()).expect("a reference").volume.expect("a medium"));
    assert!((sum / reference - 1.0).abs() < 0.03, "{sum} {reference}");
}

#[test]
fn a_scene_without_a_medium_has_no_volume() {
    let Some(gpu) = Validated::new() else { return };
    let mut tracer = tracer(&gpu, &built_in("cornell", SceneOptions::default()), TracerOptions::default());
    assert!(tracer.volume().is_none());
    assert!(tracer.render_reference(1, |_, _| ()).expect("a reference").volume.is_none());
}

const EXTENT: Extent2D = Extent2D { width: 192, height: 108 };

/// Errors of the last of 14 frames with a moving camera: noisy volume, denoised volume.
fn errors(gpu: &Validated, volume_motion: bool) -> [f64; 2] {
    let scene = built_in("fog", SceneOptions::default());
    let mut tracer = PathTracer::new(&gpu.0, &scene, EXTENT, TracerOptions::default()).expect("a path tracer");
    let options = DenoiserOptions { volume_motion, ..DenoiserOptions::new(Preset::Svgf) };
    let mut denoiser = FrameDenoiser::new(&gpu.0, &tracer, &options).expect("a denoiser");
    for index in 0..14 {
        tracer.begin_frame(index).expect("a frame");
        denoiser.render(&mut tracer).expect("a submit");
    }
    let mut frame = Frame::read(&gpu.0, &tracer, [&mut denoiser]).expect("pictures");
    frame.set_reference(tracer.render_reference(128, |_, _| {}).expect("a reference"));
    let scores = frame.scores(None).expect("finite pictures").expect("a reference");
    assert!(scores[1].rmse < 0.35 * scores[0].rmse, "surfaces and fog together: {} {}", scores[1].rmse, scores[0].rmse);
    let errors = frame.volume.expect("a medium").errors().expect("finite pictures").expect("a reference");
    [errors[0], errors[1]]
}

#[test]
fn fog_is_clean_and_its_own_motion_is_better_than_that_of_surfaces() {
    let Some(gpu) = Validated::new() else { return };
    let ([noisy, own], [_, surfaces]) = (errors(&gpu, true), errors(&gpu, false));
    println!("RMSE of the volume: noisy {noisy:.4}, own motion {own:.4}, motion of surfaces {surfaces:.4}");
    assert!(own < 0.2 * noisy, "{own} {noisy}");
    assert!(own < 0.95 * surfaces, "{own} {surfaces}");
}

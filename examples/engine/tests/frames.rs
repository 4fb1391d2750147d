//! Frames are the same every time, move as they say, and hold nothing that is not a number.

use std::sync::Arc;

use ash::vk::Extent2D;
use atrous_engine::scene::BUILT_IN;
use atrous_engine::testing::{built_in, render, tracer, Validated, SMALL};
use atrous_engine::{Error, Gpu, GpuOptions, Image, PathTracer, Scene, SceneOptions, TracerOptions};
use glam::Vec3;

fn all_images(tracer: &PathTracer) -> Vec<&Image> {
    let outputs = tracer.outputs();
    outputs.gbuffer().into_iter().chain(outputs.lighting()).collect()
}

#[test]
fn two_runs_are_bit_identical_and_seeds_matter() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("pillars", SceneOptions::default());
    let bytes = |seed: u32, frame: u32| {
        let mut tracer = tracer(&gpu, &scene, TracerOptions { seed, ..Default::default() });
        render(&gpu, &mut tracer, frame);
        all_images(&tracer).iter().map(|image| gpu.0.read_bytes(image).expect("bytes")).collect::<Vec<_>>()
    };
    let first = bytes(0, 3);
    assert!(first == bytes(0, 3), "two runs differ");
    assert!(first != bytes(1, 3), "the seed changes nothing");
    assert!(first != bytes(0, 4), "the frame changes nothing");
}

#[test]
fn light_of_half_the_size_is_that_of_the_pixels_it_was_traced_for() {
    let Some(gpu) = Validated::new() else { return };
    for name in ["chapel", "fog"] {
        let scene = built_in(name, SceneOptions::default());
        let whole = TracerOptions { lamps_apart: true, ambient: true, ..Default::default() };
        let mut tracers = [whole, TracerOptions { half_light: true, ..whole }].map(|options| tracer(&gpu, &scene, options));
        // Another pixel of 2x2 in each.
        for frame in [0, 1] {
            tracers.iter_mut().for_each(|tracer| render(&gpu, tracer, frame));
            let [whole, half] = tracers.each_ref().map(light_images);
            assert!(whole.len() > 9, "{name}");
            let (columns, [x0, y0]) = (tracers[1].light_extent().width, tracers[1].light_offset());
            for (whole, half) in whole.into_iter().zip(half) {
                let [picture, light] = [whole, half].map(|image| gpu.0.read_bytes(image).expect("bytes"));
                let texel = light.len() / (half.extent.width * half.extent.height) as usize;
                assert!(half.extent == tracers[1].light_extent() && whole.extent == SMALL, "{name}: {}", whole.name);
                for (pixel, lit) in (0..).zip(light.chunks_exact(texel)) {
                    let (x, y) = (2 * (pixel % columns) + x0, 2 * (pixel / columns) + y0);
                    let at = (y * SMALL.width + x) as usize * texel;
                    assert_eq!(lit, &picture[at..at + texel], "{name}, frame {frame}, {}: pixel {x}, {y}", whole.name);
                }
            }
            let unshadowed = tracers.each_ref().map(|tracer| {
                let lamps = tracer.lamps_apart().iter().map(|lamp| &lamp.unshadowed_direct);
                lamps.map(|image| gpu.0.read_bytes(image).expect("bytes")).collect::<Vec<_>>()
            });
            assert!(unshadowed[0] == unshadowed[1], "{name}: of every pixel");
        }
    }
}

/// What is traced for pixels of light.
fn light_images(tracer: &PathTracer) -> Vec<&Image> {
    let mut all = tracer.outputs().lighting().to_vec();
    for lamp in tracer.lamps_apart() {
        all.extend([&lamp.noisy_visibility, &lamp.occluder_distance, &lamp.occluder_id]);
    }
    all.extend(tracer.ambient().iter().flat_map(|ambient| [&ambient.noisy_ambient, &ambient.ambient_distance]));
    all.extend(tracer.volume().iter().flat_map(|volume| [&volume.noisy_volume, &volume.scattering_depth]));
    all
}

#[test]
fn references_are_bit_identical() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("glossy", SceneOptions::default());
    let reference = || tracer(&gpu, &scene, TracerOptions::default()).render_reference(24, |_, _| ()).expect("a reference");
    assert!(reference() == reference());
}

#[test]
fn every_scene_gives_finite_positive_light_and_unit_normals() {
    let Some(gpu) = Validated::new() else { return };
    for name in BUILT_IN {
        let mut tracer = tracer(&gpu, &built_in(name, SceneOptions::default()), TracerOptions::default());
        for frame in [0, 1, 11] {
            render(&gpu, &mut tracer, frame);
            for image in all_images(&tracer).into_iter().filter(|image| !["visibility", "seed", "surface_id"].contains(&image.name))
            {
                let pixels = gpu.0.read_image(image).expect("pixels");
                assert!(pixels.iter().flatten().all(|value| value.is_finite()), "{name}, frame {frame}: {}", image.name);
            }
            // Motion has signs.
            for image in tracer.outputs().lighting().into_iter().filter(|image| image.name != "specular_motion") {
                let pixels = gpu.0.read_image(image).expect("pixels");
                assert!(pixels.iter().flatten().all(|value| *value >= 0.0), "{name}, frame {frame}: {}", image.name);
            }
            let ids = gpu.0.read_image_u32(&tracer.outputs().surface_id).expect("ids");
            let normals = gpu.0.read_image(&tracer.outputs().normal).expect("normals");
            for (normal, _) in normals.iter().zip(ids).filter(|(_, id)| *id != 0) {
                assert!((Vec3::from_slice(normal).length() - 1.0).abs() < 2e-3, "{name}: {normal:?}");
            }
        }
    }
}

#[test]
fn a_scene_is_seen_however_long_it_runs() {
    let Some(gpu) = Validated::new() else { return };
    for name in BUILT_IN {
        let mut tracer =
            tracer(&gpu, &built_in(name, SceneOptions { static_light: true, ..Default::default() }), TracerOptions::default());
        let mut light = |frame| {
            render(&gpu, &mut tracer, frame);
            let pixels = gpu.0.read_image(&tracer.outputs().scattered).expect("pixels");
            pixels.iter().map(|p| p[0] + p[1] + p[2]).sum::<f32>()
        };
        let first = light(0);
        for frame in [200, 900, 3000, 30_000] {
            assert!(light(frame) > 0.2 * first, "{name}, frame {frame}");
        }
    }
}

#[test]
fn the_light_steps_and_can_be_held() {
    let steps = |scene: &Scene| [7, 8, 15, 16].map(|frame| scene.light_scale(frame));
    assert_eq!(steps(&built_in("cornell", SceneOptions::default())), [1.0, 0.1, 0.1, 1.0]);
    assert_eq!(steps(&built_in("cornell", SceneOptions { static_light: true, ..Default::default() })), [1.0; 4]);
}

#[test]
fn one_lamp_flickers_by_itself_and_can_be_held() {
    let stepping = |options: SceneOptions| {
        let scene = built_in("lamps", options);
        let (on, off) = (scene.emissions(0), scene.emissions(6));
        let changed = on.iter().zip(&off).filter(|(on, off)| on != off);
        changed.map(|(on, off)| off.length() / on.length()).collect::<Vec<_>>()
    };
    assert!(matches!(stepping(SceneOptions::default())[..], [tenth] if (tenth - 0.1).abs() < 1e-6));
    assert!(stepping(SceneOptions { static_light: true, ..Default::default() }).is_empty());
}

#[test]
fn jitter_stays_within_the_pixel_and_is_off_by_default() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("cornell", SceneOptions::default());
    assert_eq!(tracer(&gpu, &scene, TracerOptions::default()).camera(5).jitter, [0.0; 2]);
    let jittered = tracer(&gpu, &scene, TracerOptions { jitter: true, ..Default::default() });
    let offsets: Vec<_> = (0..16).map(|frame| jittered.camera(frame).jitter).collect();
    assert!(offsets.iter().flatten().all(|offset| (-0.5..=0.5).contains(offset)));
    assert!(offsets.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn extents_at_the_edge() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("cornell", SceneOptions::default());
    let make = |width, height| PathTracer::new(&gpu.0, &scene, Extent2D { width, height }, TracerOptions::default());
    let mut tiny = make(1, 1).expect("one pixel is a picture");
    render(&gpu, &mut tiny, 0);
    assert_eq!(gpu.0.read_image(&tiny.outputs().direct).expect("direct").len(), 1);
    for (width, height) in [(0, 18), (32, 0), (1 << 20, 1)] {
        assert!(matches!(make(width, height), Err(Error::Extent { .. })), "{width}x{height}");
    }
}

#[test]
fn wrong_requests_are_errors() {
    let Some(gpu) = Validated::new() else { return };
    let mut tracer = tracer(&gpu, &built_in("cornell", SceneOptions::default()), TracerOptions::default());
    assert!(matches!(tracer.render_reference(0, |_, _| ()), Err(Error::NoSamples)));
    let options = GpuOptions { device: Some("no such device".into()), ..GpuOptions::default() };
    let error = Gpu::new(&options).map(|_| ()).expect_err("no such device");
    assert!(error.to_string().contains("no such device") && error.to_string().contains("0: "), "{error}");
    let error = Scene::load("kornell", &SceneOptions::default()).map(|_| ()).expect_err("no such scene");
    assert!(error.to_string().contains("cornell, pillars"), "{error}");
    let empty = Arc::new(Scene::new("empty", tracer.scene().view(0)));
    assert!(matches!(PathTracer::new(&gpu.0, &empty, SMALL, TracerOptions::default()), Err(Error::EmptyScene)));
}

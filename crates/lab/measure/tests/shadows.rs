//! The sun apart from the path: its estimator against the one of all light, and what the filter of its visibility reaches at the edges of shadows.

use ash::vk::Extent2D;
use atrous::config::Preset;
use atrous_engine::testing::{built_in, mean, render, rgb, tracer, Validated};
use atrous_engine::{DenoiserOptions, FrameDenoiser, PathTracer, SceneOptions, TracerOptions};
use atrous_measure::moving_shadows::MovingShadows;
use atrous_measure::shadows::{ShadowEdges, ShadowGuides};

/// The light of the sun times its visibility, with the light that has none of it, is all light.
#[test]
fn the_parts_add_up_to_all_light() {
    let Some(gpu) = Validated::new() else { return };
    for name in ["hall", "leaves", "chapel"] {
        let scene = built_in(name, SceneOptions { static_camera: true, static_objects: true, static_light: true });
        let mut tracer = tracer(&gpu, &scene, TracerOptions { lamps_apart: true, ..TracerOptions::default() });
        let (mut parts, frames) = (0.0, 64);
        for frame in 0..frames {
            render(&gpu, &mut tracer, frame);
            let read = |image| gpu.0.read_image(image).expect("pixels");
            for lamp in tracer.lamps_apart() {
                let light = read(&lamp.unshadowed_direct).into_iter().zip(read(&lamp.noisy_visibility));
                let light: Vec<_> = light.map(|(l, v)| [l[0] * v[0], l[1] * v[1], l[2] * v[2]]).collect();
                parts += mean(&light) / f64::from(frames);
                let distances = read(&lamp.occluder_distance);
                assert!(distances.iter().zip(read(&lamp.noisy_visibility)).all(|(d, v)| (d[0] > 0.0) == (v[..3] != [1.0; 3])));
            }
            let others = [&tracer.outputs().scattered, &tracer.outputs().emission].map(|image| mean(&rgb(read(image))));
            parts += (others[0] + others[1]) / f64::from(frames);
        }
        let whole = mean(&tracer.render_reference(256, |_, _| ()).expect("a reference").radiance());
        println!("{name}: {parts:.4} of {whole:.4}");
        assert!((parts / whole - 1.0).abs() < 0.02, "{name}: {parts} {whole}");
    }
}

/// Frames of a small `hall`, whose camera walks, with all light in one and with the sun apart.
#[test]
fn edges_of_shadows_are_sharp_and_nearly_right() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("hall", SceneOptions::default());
    let extent = Extent2D { width: 160, height: 90 };
    let mut radiance = Vec::new();
    for sun_apart in [false, true] {
        let options = TracerOptions { lamps_apart: sun_apart, ..TracerOptions::default() };
        let mut tracer = PathTracer::new(&gpu.0, &scene, extent, options).expect("a tracer");
        let mut denoiser = FrameDenoiser::new(&gpu.0, &tracer, &DenoiserOptions::new(Preset::Asvgf)).expect("a denoiser");
        for frame in 0..10 {
            tracer.begin_frame(frame).expect("a frame");
            denoiser.render(&mut tracer).expect("a frame");
        }
        radiance.push(rgb(denoiser.read("denoised_radiance").expect("an output")));
        if sun_apart {
            let guides = ShadowGuides::read(&gpu.0, &tracer, 64).expect("rays").expect("a sun");
            let reference = tracer.render_reference(64, |_, _| ()).expect("a reference").radiance();
            let edges = ShadowEdges::new(guides);
            let errors: Vec<f64> = radiance.iter().map(|image| edges.error(image, &reference).expect("finite")).collect();
            let widths: Vec<_> = radiance.iter().chain([&reference]).map(|image| edges.width(image, &reference)).collect();
            println!("error {errors:.4?}, width {widths:.2?} of {} edges", edges.profiles());
            // The ratio alone would also move with the filter of all light in one.
            assert!(errors[1] < 0.1616 && errors[1] < 0.68 * errors[0], "{errors:?}");
            assert!(widths[1].expect("edges") < widths[2].expect("edges") + 1.5, "{widths:?}");
        }
    }
}

/// Railings that slide, and a sun that swings: with ids and the place of the light, the filter follows their shadows.
#[test]
fn shadows_that_move_are_followed() {
    let Some(gpu) = Validated::new() else { return };
    let mut found = Vec::new();
    for scene in ["hall_railings", "hall_sun"] {
        let extent = Extent2D { width: 320, height: 180 };
        let shadows = MovingShadows { scene, extent, frames: 16, reference_rays: 64, static_camera: true };
        let [without, with] = shadows.measure(&gpu.0).expect("frames");
        println!("{scene}: {without:.4?} without, {with:.4?} with");
        found.push((scene, without, with));
    }
    for (scene, without, with) in found {
        assert!(with.rmse < 0.85 * without.rmse, "{scene}: {without:?} {with:?}");
        assert!(without.lag < 2.0 && with.lag < 2.0, "{scene}: {without:?} {with:?}");
    }
}

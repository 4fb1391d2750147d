//! The light is right: known answers, ways of sampling that agree, and a reference that is the mean of the noise.

use std::sync::Arc;

use atrous_engine::scene::{Environment, Material, View};
use atrous_engine::testing::{built_in, cube, mean, render, rgb, tracer, Validated, SMALL};
use atrous_engine::{LightSampling, Noise, Scene, SceneOptions, TracerOptions};
use glam::{vec3, Affine3A, Vec3};

fn view(eye: Vec3) -> View {
    View { eye, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 0.9 }
}

fn assert_near(name: &str, given: f64, expected: f64, tolerance: f64) {
    assert!((given - expected).abs() <= tolerance * expected, "{name}: {given}, expected {expected} within {tolerance}");
}

#[test]
fn closed_emitting_box_gives_the_albedo_and_its_square() {
    let Some(gpu) = Validated::new() else { return };
    for sampling in [LightSampling::Both, LightSampling::Lights, LightSampling::Bsdf] {
        let mut scene = Scene::new("furnace", view(vec3(0.5, 0.3, 0.8)));
        let albedo = 0.6;
        scene.place(cube(true), Material { emission: Vec3::ONE, ..Material::diffuse(Vec3::splat(albedo)) }, Affine3A::IDENTITY);
        let mut tracer = tracer(&gpu, &Arc::new(scene), TracerOptions { light_sampling: sampling, ..Default::default() });
        let reference = tracer.render_reference(256, |_, _| ()).expect("a reference");
        assert_near("emission", mean(&reference.emission), 1.0, 1e-5);
        assert_near("direct", mean(&reference.direct), f64::from(albedo), 0.01);
        assert_near("indirect", mean(&reference.indirect), f64::from(albedo * albedo), 0.02);
    }
}

#[test]
fn convex_diffuser_under_an_even_sky_shows_its_albedo_and_nothing_indirect() {
    let Some(gpu) = Validated::new() else { return };
    let mut scene = Scene::new("sky", view(vec3(1.5, 1.2, 4.5)));
    scene.environment = Environment { zenith: Vec3::ONE, horizon: Vec3::ONE, ground: Vec3::ONE };
    scene.place(cube(false), Material::diffuse(Vec3::splat(0.5)), Affine3A::IDENTITY);
    let mut tracer = tracer(&gpu, &Arc::new(scene), TracerOptions::default());
    let reference = tracer.render_reference(16, |_, _| ()).expect("a reference");
    let ids = gpu.0.read_image_u32(&tracer.outputs().surface_id).expect("ids");
    assert!(ids.contains(&1) && ids.contains(&0), "the cube must cover a part of the picture");
    for (index, id) in ids.iter().enumerate() {
        let (direct, emission) = if *id == 0 { (0.0, 1.0) } else { (0.5, 0.0) };
        assert!((reference.direct[index][1] - direct).abs() < 1e-4, "direct {:?}", reference.direct[index]);
        assert!((reference.emission[index][1] - emission).abs() < 1e-4, "emission {:?}", reference.emission[index]);
        assert_eq!(reference.indirect[index], [0.0; 3]);
    }
}

#[test]
fn white_metal_keeps_what_single_scattering_keeps() {
    let Some(gpu) = Validated::new() else { return };
    // Intermediates: the directional albedo of single-scattering GGX, here between 0 and 45 degrees, by an independent integration.
    for (roughness, expected) in [(0.2, 0.998), (0.6, 0.812)] {
        let mut scene = Scene::new("metal", view(vec3(0.0, 0.0, 2.2)));
        scene.environment = Environment { zenith: Vec3::ONE, horizon: Vec3::ONE, ground: Vec3::ONE };
        scene.place(cube(false), Material::metal(Vec3::ONE, roughness), Affine3A::IDENTITY);
        let mut tracer = tracer(&gpu, &Arc::new(scene), TracerOptions::default());
        let reference = tracer.render_reference(64, |_, _| ()).expect("a reference");
        let ids = gpu.0.read_image_u32(&tracer.outputs().surface_id).expect("ids");
        let metal: Vec<_> = reference.direct.iter().zip(ids).filter(|(_, id)| *id == 1).map(|(pixel, _)| *pixel).collect();
        assert!(metal.iter().all(|pixel| pixel[1] <= 1.001), "roughness {roughness} adds light");
        assert_near("metal", mean(&metal), expected, 0.01);
    }
}

#[test]
fn the_ways_of_finding_lights_agree() {
    let Some(gpu) = Validated::new() else { return };
    for name in ["cornell", "glossy"] {
        let scene = built_in(name, SceneOptions::default());
        let means = [LightSampling::Both, LightSampling::Lights, LightSampling::Bsdf].map(|light_sampling| {
            let mut tracer = tracer(&gpu, &scene, TracerOptions { light_sampling, ..Default::default() });
            mean(&tracer.render_reference(1024, |_, _| ()).expect("a reference").direct)
        });
        assert_near(name, means[1], means[0], 0.02);
        assert_near(name, means[2], means[0], 0.02);
    }
}

/// Blue noise is as large as white noise, and cancels in a neighbourhood.
#[test]
fn blue_noise_cancels_in_a_neighbourhood() {
    let Some(gpu) = Validated::new() else { return };
    const FRAMES: u32 = 16;
    let still = SceneOptions { static_light: true, static_camera: true, static_objects: true };
    let scene = built_in("cornell", still);
    // Mean squares of the error of pixels, and of that of means over 2x2 pixels.
    let errors = |noise: Noise| {
        let mut tracer = tracer(&gpu, &scene, TracerOptions { noise, ..Default::default() });
        let reference = tracer.render_reference(1024, |_, _| ()).expect("a reference").direct;
        let [mut of_pixels, mut of_means] = [0.0; 2];
        for frame in 0..FRAMES {
            render(&gpu, &mut tracer, frame);
            let direct = rgb(gpu.0.read_image(&tracer.outputs().direct).expect("direct"));
            let error: Vec<_> = direct.iter().zip(&reference).map(|(noisy, clean)| f64::from(noisy[1] - clean[1])).collect();
            let wide = SMALL.width as usize;
            let of_block = |x: usize, y: usize| [0, 1, wide, wide + 1].iter().map(|i| error[y * wide + x + i]).sum::<f64>() / 4.0;
            let blocks = (0..SMALL.height as usize).step_by(2).flat_map(|y| (0..wide).step_by(2).map(move |x| (x, y)));
            of_pixels += error.iter().map(|e| e * e).sum::<f64>() / error.len() as f64;
            of_means += blocks.map(|(x, y)| of_block(x, y).powi(2)).sum::<f64>() * 4.0 / error.len() as f64;
        }
        [of_pixels, of_means]
    };
    let ([white, white_means], [blue, blue_means]) = (errors(Noise::White), errors(Noise::Blue));
    println!("errors of pixels: white {white:.4}, blue {blue:.4}; of means: white {white_means:.4}, blue {blue_means:.4}");
    assert_near("blue noise", blue, white, 0.15);
    assert!(blue_means < 0.75 * white_means, "{blue_means} of {white_means}");
}

#[test]
fn the_mean_of_noisy_frames_is_the_reference() {
    let Some(gpu) = Validated::new() else { return };
    let still = SceneOptions { static_light: true, static_camera: true, static_objects: true };
    for name in ["cornell", "hall"] {
        let mut tracer = tracer(&gpu, &built_in(name, still), TracerOptions::default());
        let reference = tracer.render_reference(512, |_, _| ()).expect("a reference");
        let (mut direct, mut indirect) = (0.0, 0.0);
        const FRAMES: u32 = 200;
        for frame in 0..FRAMES {
            render(&gpu, &mut tracer, frame);
            direct += mean(&rgb(gpu.0.read_image(&tracer.outputs().direct).expect("direct")));
            indirect += mean(&rgb(gpu.0.read_image(&tracer.outputs().indirect).expect("indirect")));
        }
        assert_near(name, direct / f64::from(FRAMES), mean(&reference.direct), 0.02);
        assert_near(name, indirect / f64::from(FRAMES), mean(&reference.indirect), 0.03);
    }
}

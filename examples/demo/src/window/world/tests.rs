//! The world without a window.

use std::time::Duration;

use super::*;
use crate::window::headless::Headless;

const SMALL: vk::Extent2D = vk::Extent2D { width: 32, height: 18 };

fn settings(scene: &str) -> Settings {
    Settings { scene: scene.into(), ..Settings::default() }
}

fn world(gpu: &Gpu, settings: &Settings) -> World {
    World::new(gpu, SMALL, settings).expect("a world")
}

/// Both panes as they are shown.
fn shown(world: &mut World, gpu: &Gpu, contents: [Content; 2]) -> [Vec<[f32; 3]>; 2] {
    let panes = Panes::new(gpu, SMALL).expect("panes");
    let mut writer = PaneWriter::new(gpu, &panes).expect("a pipeline");
    world.fill(&mut writer, &panes, contents).expect("a submit");
    panes.images.each_ref().map(|image| rgb(&gpu.read_image(image).expect("pixels")))
}

fn rgb(pixels: &[[f32; 4]]) -> Vec<[f32; 3]> {
    pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect()
}

fn read(gpu: &Gpu, image: &crate::Image) -> Vec<[f32; 3]> {
    rgb(&gpu.read_image(image).expect("pixels"))
}

fn sum(layers: &[Vec<[f32; 3]>]) -> Vec<[f32; 3]> {
    (0..layers[0].len()).map(|i| [0, 1, 2].map(|c| layers.iter().map(|layer| layer[i][c]).sum())).collect()
}

fn mean(pixels: &[[f32; 3]]) -> f32 {
    pixels.iter().flatten().sum::<f32>() / (3 * pixels.len()) as f32
}

/// Up to what a half float holds.
fn assert_same(given: &[[f32; 3]], wanted: &[[f32; 3]], what: &str) {
    for (i, (a, b)) in given.iter().zip(wanted).enumerate() {
        let near = a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 2e-3 * b.abs() + 1e-4);
        assert!(near, "{what}, pixel {i}: {a:?}, not {b:?}");
    }
}

#[test]
fn the_reference_of_fog_is_that_without_a_window() {
    let Some(gpu) = Headless::new() else { return };
    let settings = settings("fog");
    let mut world = world(&gpu, &settings);
    world.frame(&settings, None, false, false).expect("a frame");
    world.accumulate(true).expect("a submit");
    while world.reference_samples() < 64 {
        let reference = world.reference.as_mut().expect("a reference");
        reference.add(&world.tracer, Duration::from_secs(1), 64).expect("a submit");
    }
    let [reference, _] = shown(&mut world, &gpu, [Content::Reference, Content::Noisy]);

    let options = TracerOptions::default();
    let mut tracer = PathTracer::new(&gpu, &world.scene, SMALL, options).expect("a path tracer");
    let wanted = tracer.render_reference(64, |_, _| ()).expect("a reference");
    assert_same(&reference, &wanted.radiance(), "reference");
    // So that a picture without its medium is seen to be wrong.
    let medium = mean(wanted.volume.as_ref().expect("a medium"));
    assert!(medium > 0.2 * mean(&wanted.radiance()), "{medium}");
}

#[test]
fn noisy_and_filtered_pictures_have_their_medium() {
    let Some(gpu) = Headless::new() else { return };
    let settings = settings("fog");
    let mut world = world(&gpu, &settings);
    for _ in 0..3 {
        world.frame(&settings, None, true, false).expect("a frame");
    }
    let [noisy, filtered] = shown(&mut world, &gpu, [Content::Noisy, Content::Filtered(Preset::Asvgf)]);
    let (outputs, medium) = (world.tracer.outputs(), &world.tracer.volume().expect("a medium").noisy_volume);
    let parts = [&outputs.scattered, &outputs.emission, medium].map(|image| read(&gpu, image));
    assert_same(&noisy, &sum(&parts), "noisy");
    let filter = world.filters.first().expect("a filter");
    let parts = [&filter.radiance, filter.medium.as_ref().expect("a medium")].map(|image| read(&gpu, image));
    assert_same(&filtered, &sum(&parts), "filtered");
    assert!(mean(&parts[1]) > 0.2 * mean(&filtered), "there is fog");
}

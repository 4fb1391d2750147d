//! The world without a window.

use std::time::Duration;

use ash::vk;

use super::*;
use crate::error_view::Wake;
use atrous::DebugView;
use atrous_engine::testing::Validated;

const SMALL: vk::Extent2D = vk::Extent2D { width: 32, height: 18 };

fn settings(scene: &str) -> Settings {
    Settings { scene: scene.into(), ..Settings::default() }
}

fn world(gpu: &Gpu, settings: &Settings) -> World {
    World::new(gpu, Sizes::of(SMALL), settings).expect("a world")
}

/// Both panes as they are shown.
fn shown(world: &mut World, gpu: &Gpu, contents: [Content; 2]) -> [Vec<[f32; 3]>; 2] {
    let panes = Panes::new(gpu, world.sizes.shown()).expect("panes");
    let mut writer = PaneWriter::new(gpu, &panes).expect("a pipeline");
    world.fill(&mut writer, &panes, contents).expect("a submit");
    panes.images.each_ref().map(|image| rgb(&gpu.read_image(image).expect("pixels")))
}

fn rgb(pixels: &[[f32; 4]]) -> Vec<[f32; 3]> {
    pixels.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect()
}

fn read(gpu: &Gpu, image: &atrous_engine::Image) -> Vec<[f32; 3]> {
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
    let Some(gpu) = Validated::new() else { return };
    let settings = settings("fog");
    let mut world = world(&gpu, &settings);
    world.frame(&settings, None, false, false).expect("a frame");
    world.accumulate(true).expect("a submit");
    while world.reference_samples() < 64 {
        let reference = world.reference.as_mut().expect("a reference");
        reference.add(&world.tracer, Duration::from_secs(1), 64).expect("a submit");
    }
    let [reference, _] = shown(&mut world, &gpu, [Content::Reference, Content::Noisy]);

    let options = atrous_engine::TracerOptions::default();
    let mut tracer = PathTracer::new(&gpu, &world.scene, SMALL, options).expect("a path tracer");
    let wanted = tracer.render_reference(64, |_, _| ()).expect("a reference");
    assert_same(&reference, &wanted.radiance(), "reference");
    // So that a picture without its medium is seen to be wrong.
    let medium = mean(wanted.volume.as_ref().expect("a medium"));
    assert!(medium > 0.2 * mean(&wanted.radiance()), "{medium}");
}

#[test]
fn noisy_and_filtered_pictures_have_their_medium() {
    let Some(gpu) = Validated::new() else { return };
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

#[test]
fn light_of_half_the_size_fills_a_picture_of_display_size() {
    let Some(gpu) = Validated::new() else { return };
    let output = vk::Extent2D { width: 48, height: 27 };
    let sizes = Sizes { output: Some(output), half_light: true, ..Sizes::of(SMALL) };
    let settings = with(Preset::Fast);
    let mut world = World::new(&gpu, sizes, &settings).expect("a world");
    for _ in 0..2 {
        world.frame(&settings, None, true, false).expect("a frame");
    }
    let depth = Content::Debug(Preset::Fast, DebugView::Depth);
    let [noisy, filtered] = shown(&mut world, &gpu, [Content::Noisy, Content::Filtered(Preset::Fast)]);
    let filter = world.filters.first().expect("a filter");
    assert_eq!(filtered, read(&gpu, &filter.display), "the output as it is");
    assert!(filter.display.extent == output && mean(&filtered) > 0.01, "{}", mean(&filtered));
    let outputs = world.tracer.outputs();
    let [light, emission] = [&outputs.scattered, &outputs.emission].map(|image| read(&gpu, image));
    let enlarged = |pixels: &[[f32; 3]], [w, h]: [usize; 2]| -> Vec<[f32; 3]> {
        (0..27).flat_map(|y| (0..48).map(move |x| (x, y))).map(|(x, y)| pixels[y * h / 27 * w + x * w / 48]).collect()
    };
    assert_same(&noisy, &sum(&[enlarged(&light, [16, 9]), enlarged(&emission, [32, 18])]), "noisy");
    let [depths, _] = shown(&mut world, &gpu, [depth, Content::Noisy]);
    let view = read(&gpu, &world.filters[0].debug);
    assert_eq!(depths, enlarged(&view, [16, 9]), "a view of the pixels that have light");
    let panes = Panes::new(&gpu, output).expect("panes");
    let probe = world.probe(&panes, [Content::Noisy, depth], [47, 13]).expect("a submit");
    world.filters[0].show(&gpu, DebugView::Depth).expect("a submit");
    let corner = gpu.read_half_texel(&world.filters[0].debug, [15, 4]).expect("a texel");
    assert!(corner[3] > 0.0 && probe.numbers[DebugView::Depth as usize] == Some(corner[3]), "{probe:?}");
}

/// Frames of a history, mean over the pixels.
fn history(world: &mut World, preset: Preset) -> f32 {
    let bars = world.histogram([Content::Filtered(preset), Content::Noisy]).expect("a submit").expect("a filter with history");
    let frames: u32 = (0..).zip(bars).map(|(frames, count)| frames * count).sum();
    frames as f32 / bars.iter().sum::<u32>() as f32
}

fn with(preset: Preset) -> Settings {
    Settings { right: Content::Filtered(preset), ..settings("cornell") }
}

#[test]
fn a_paused_picture_does_not_move_and_a_step_moves_by_its_motion() {
    let Some(gpu) = Validated::new() else { return };
    for taa in [false, true] {
        let settings = Settings { taa, ..with(Preset::Asvgf) };
        let mut world = world(&gpu, &settings);
        for _ in 0..3 {
            world.frame(&settings, None, true, false).expect("a frame");
        }
        for preset in [Preset::Svgf, Preset::Asvgf] {
            world.frame(&Settings { taa, ..with(preset) }, None, false, false).expect("a frame");
            let motion = gpu.read_image(&world.tracer.outputs().motion).expect("pixels");
            assert!(motion.iter().all(|m| m[0] == 0.0 && m[1] == 0.0), "{preset:?}, taa {taa}");
        }
        world.frame(&settings, None, true, false).expect("a frame");
        let mut tracer =
            PathTracer::new(&gpu, &world.scene, SMALL, Sizes::of(SMALL).tracer_options(&settings)).expect("a path tracer");
        // The fourth moment after the third, with the jitter of the sixth frame.
        tracer.begin_moment(world.tracer.frame(), &world.scene.moment(4), &world.scene.moment(3)).expect("a frame");
        gpu.submit(|cmd| {
            tracer.record_gbuffer(cmd);
            Ok(())
        })
        .expect("a submit");
        let [given, wanted] = [&world.tracer, &tracer].map(|t| gpu.read_image(&t.outputs().motion).expect("pixels"));
        assert!(wanted.iter().any(|m| m[0] != 0.0), "the camera sways");
        assert_eq!(given, wanted, "taa {taa}");
    }
}

#[test]
fn a_filter_goes_on_where_it_stopped_while_time_stands_still() {
    let Some(gpu) = Validated::new() else { return };
    for taa in [false, true] {
        let [asvgf, svgf] = [Preset::Asvgf, Preset::Svgf].map(|preset| Settings { taa, ..with(preset) });
        let mut world = world(&gpu, &asvgf);
        let mut frame = |settings: &Settings, advance, reset| {
            world.frame(settings, None, advance, reset).expect("a frame");
            let [_, picture] = shown(&mut world, &gpu, [settings.left, settings.right]);
            assert!(picture.iter().flatten().all(|c| c.is_finite()));
            let preset = settings.right.preset().expect("a filter");
            (history(&mut world, preset), mean(&picture))
        };
        // The light changes with the eighth.
        for _ in 0..3 {
            frame(&asvgf, true, false);
        }
        let (before, light) = frame(&asvgf, true, false);
        assert!(before > 2.0, "{before}");
        assert!(frame(&svgf, false, false).0 <= 1.0, "a filter that starts");
        let (resumed, lit) = frame(&asvgf, false, false);
        assert!(resumed > before, "paused, switched on again, taa {taa}: {before} frames, then {resumed}");
        assert!((lit / light - 1.0).abs() < 0.1, "{light} {lit}");
        let (stepped, _) = frame(&asvgf, true, false);
        assert!(stepped > 0.7 * resumed, "a step, taa {taa}: {resumed} frames, then {stepped}");
        frame(&svgf, true, false);
        assert!(frame(&asvgf, false, false).0 <= 1.0, "it has not seen the step");
        frame(&asvgf, false, false);
        frame(&svgf, false, true);
        assert!(frame(&asvgf, false, false).0 <= 1.0, "it was reset while it was off");
    }
}

#[test]
fn another_kind_of_picture_is_of_the_same_moment() {
    let Some(gpu) = Validated::new() else { return };
    let plain = with(Preset::Asvgf);
    let mut world = world(&gpu, &plain);
    for _ in 0..3 {
        world.frame(&plain, None, true, false).expect("a frame");
    }
    let before = world.view();
    let taa = Settings { taa: true, ..plain };
    assert!(world.follow(&Shared::default(), &taa).expect("a tracer"));
    world.frame(&taa, None, false, false).expect("a frame");
    assert!(before.is_some() && world.view() == before);
    assert!(world.follow(&Shared::default(), &Settings { scene: "pillars".into(), ..taa.clone() }).expect("a scene"));
    world.frame(&taa, None, false, false).expect("a frame");
    assert_eq!(world.view(), Some(world.scene.view(0)), "another scene begins at its beginning");
}

#[test]
fn a_scene_that_cannot_be_loaded_leaves_the_old_one() {
    let Some(gpu) = Validated::new() else { return };
    let settings = with(Preset::Asvgf);
    let (mut world, shared) = (world(&gpu, &settings), Shared::default());
    world.frame(&settings, None, true, false).expect("a frame");
    let broken = Settings { scene: "nowhere.glb".into(), ..settings };
    assert!(!world.follow(&shared, &broken).expect("no scene"));
    assert!(!world.follow(&shared, &broken).expect("said once"));
    let messages = shared.report().messages.clone();
    assert!(messages.len() == 1 && messages[0].is_error && messages[0].text.contains("nowhere.glb"), "{messages:?}");
    world.frame(&broken, None, true, false).expect("a frame");
    assert_eq!(world.scene_name(), "cornell");
}

#[test]
fn the_reference_grows_while_time_runs_until_something_changes() {
    let Some(gpu) = Validated::new() else { return };
    // The light of the box changes with its eighth frame, and nothing else does.
    let settings = Settings { animate_camera: false, animate_objects: false, ..with(Preset::Svgf) };
    let mut world = world(&gpu, &settings);
    let mut paths = Vec::new();
    for _ in 0..9 {
        world.frame(&settings, None, true, false).expect("a frame");
        world.accumulate(true).expect("a submit");
        paths.push(world.reference_samples());
    }
    let falls: Vec<_> = paths.windows(2).filter(|pair| pair[1] <= pair[0]).collect();
    assert_eq!(falls.len(), 1, "one change of the light: {paths:?}");
    let moving = Settings { animate_camera: true, ..settings };
    world.frame(&moving, None, true, false).expect("a frame");
    assert_eq!(world.reference_samples(), 0, "another view is another picture");
}

#[test]
fn an_error_is_that_of_the_picture_against_the_reference() {
    let Some(gpu) = Validated::new() else { return };
    let content = Content::Error(Preset::Svgf);
    let settings = Settings { right: content, ..settings("cornell") };
    let mut world = world(&gpu, &settings);
    world.frame(&settings, None, false, false).expect("a frame");
    world.accumulate(true).expect("a submit");
    let panes = Panes::new(&gpu, SMALL).expect("panes");
    let mut writer = PaneWriter::new(&gpu, &panes).expect("a pipeline");
    let (sender, receiver) = std::sync::mpsc::channel();
    let wake: Wake = Arc::new(move || sender.send(()).expect("the test waits"));
    world.measure_errors(&mut writer, [Content::Noisy, content], &wake).expect("a submit");
    assert_eq!(world.errors(), [], "FLIP takes its time");
    receiver.recv_timeout(Duration::from_secs(120)).expect("a measurement");
    // What was measured is taken once its thread is done.
    while world.errors().is_empty() {
        world.measure_errors(&mut writer, [Content::Noisy, content], &wake).expect("a submit");
    }
    let [picture, reference] = shown(&mut world, &gpu, [Content::Filtered(Preset::Svgf), Content::Reference]);
    let of = |pixels| atrous_lab::scores::Rgb::new(SMALL.width, SMALL.height, pixels).expect("finite");
    let (rmse, flip) =
        (atrous_lab::scores::rmse(of(&picture), of(&reference)), atrous_lab::scores::flip(of(&picture), of(&reference)));
    let report = world.errors()[0];
    assert_eq!((report.rmse, report.flip), (rmse.expect("an error"), flip.expect("an error")));
    assert_eq!((report.preset, report.paths), (Preset::Svgf, world.reference_samples()));
    assert!(report.rmse > 0.0 && receiver.try_recv().is_err(), "the same is not measured again");
    let [map, _] = shown(&mut world, &gpu, [content, Content::Noisy]);
    let lit = map.iter().filter(|rgb| rgb.iter().sum::<f32>() > 0.1).count();
    assert!(lit > 50, "{lit} pixels of the heat map are no black");
    world.measure_errors(&mut writer, [Content::Noisy; 2], &wake).expect("a submit");
    assert_eq!(world.errors(), [], "none is shown");
}

//! A picture that is a part of the host's images.

use super::support::{assert_valid, materials, scene::Scene, session, upload, upload_part};
use atrous::config::{AdaptiveRule, GradientSource, PostProcess, Preset, Sampling, Signals};
use atrous::{Config, DebugView, Declaration, Error, FrameParams, Lifetime, Shape, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_part_has_the_bits_of_a_picture_of_its_own", a_part_has_the_bits_of_a_picture_of_its_own),
    ("what_lies_beside_a_part_is_kept", what_lies_beside_a_part_is_kept),
    ("a_part_beyond_its_images_is_refused", a_part_beyond_its_images_is_refused),
];

/// What is rendered, what is allocated for it, and the images that it is a part of.
const RENDERED: [u32; 2] = [37, 21];
const ALLOCATED: [u32; 2] = [40, 24];
const IMAGES: [u32; 2] = [83, 50];

/// Another place in each frame, with both ends.
const ORIGINS: [[u32; 2]; 4] = [[0, 0], [46, 29], [13, 7], [43, 1]];

/// Few, so that each stage that reads or writes an image of the host is among them.
fn configs() -> [Config; 6] {
    let base = Config { debug_view: true, ..Config::new(ALLOCATED) };
    let (apart, specular) = (Signals::Apart, Signals::Specular);
    let best = Config { signals: apart, post_process: PostProcess::ToneMapTaa, reactive_mask: true, ..base };
    let lights = Config { visibility: 3, coloured_visibility: true, ambient_occlusion: true, firefly_filter: true, ..base };
    [
        best,
        Config { signals: specular, sampling: Sampling::OneOf2x2, ..base },
        Config { preset: Preset::Svgf, material_class: true, volume: true, float_output: true, ..lights },
        Config { preset: Preset::Asvgf, gradient_source: GradientSource::Reshaded, signals: apart, object_normal: true, ..base },
        Config { preset: Preset::Percentile, adaptive_rule: AdaptiveRule::Percentiles, post_process: PostProcess::ToneMap, ..base },
        Config { preset: Preset::Eaw, ..base },
    ]
}

/// Name and texels of a side of each output image whose texels are pixels.
fn outputs(declaration: &Declaration) -> Vec<(String, u32)> {
    let images =
        declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Output && matches!(r.shape, Shape::Image { .. }));
    images.map(|r| (r.name.clone(), r.extent(declaration.setup()).expect("an image")[0])).collect()
}

/// Bits of the texels of a part, row by row.
fn part(texels: &[[f32; 4]], width: u32, [x, y]: [u32; 2], [columns, rows]: [u32; 2]) -> Vec<[u32; 4]> {
    let row = |q: u32| ((y + q) * width + x) as usize;
    (0..rows).flat_map(|q| &texels[row(q)..row(q) + columns as usize]).map(|t| t.map(f32::to_bits)).collect()
}

fn a_part_has_the_bits_of_a_picture_of_its_own() {
    for config in configs() {
        let tuning = Tuning::for_preset(config.preset);
        let scene = Scene { speed: 0.12, allocated: ALLOCATED, ..Scene::new(RENDERED) };
        let mut alone = session(&config);
        let mut within = session(&Config { image_extent: Some(IMAGES), ..config });
        let names = outputs(alone.executor().denoiser().declaration());
        let widths = outputs(within.executor().denoiser().declaration());
        for (i, origin) in (0..).zip(ORIGINS) {
            let view = DebugView::ALL[(3 * i as usize + 2) % DebugView::ALL.len()];
            let params = FrameParams { debug_view: Some(view), reshaded: i > 1, materials: materials(), ..scene.params(i) };
            let guides = scene.frame(i, i);
            upload(&mut alone, &guides);
            upload_part(&mut within, &guides, origin);
            alone.run(&params, &tuning).expect("a frame");
            within.run(&FrameParams { viewport_origin: origin, ..params }, &tuning).expect("a frame");
            for ((name, width), (_, larger)) in names.iter().zip(&widths) {
                // One texel a stratum begins in the corner.
                let (at, extent) = if *larger == IMAGES[0] { (origin, RENDERED) } else { ([0; 2], RENDERED.map(|side| side / 3)) };
                let found = part(&within.download(name).expect(name), *larger, at, extent);
                let expected = part(&alone.download(name).expect(name), *width, [0; 2], extent);
                assert!(found == expected, "{name} of frame {i} of {config:?}");
            }
            let counted = [&mut alone, &mut within].map(|s| s.statistics().expect("counters"));
            assert_eq!(counted[0], counted[1], "frame {i} of {config:?}");
        }
    }
    assert_valid();
}

fn what_lies_beside_a_part_is_kept() {
    let [left, right] = [[0, 0], [43, 29]];
    let config = Config { image_extent: Some(IMAGES), ..Config::new(ALLOCATED) };
    let scene = Scene { allocated: ALLOCATED, ..Scene::new(RENDERED) };
    let mut s = session(&config);
    let mut shown = Vec::new();
    for (i, viewport_origin) in [(0, left), (1, right)] {
        upload_part(&mut s, &scene.frame(i, i), viewport_origin);
        s.run(&FrameParams { viewport_origin, ..scene.params(i) }, &Tuning::for_preset(config.preset)).expect("a frame");
        shown.push(s.download("denoised_radiance").expect("an output"));
    }
    assert_ne!(part(&shown[1], IMAGES[0], right, RENDERED), part(&shown[0], IMAGES[0], right, RENDERED));
    // All but the part of the last frame.
    for (x, y) in (0..IMAGES[1]).flat_map(|y| (0..IMAGES[0]).map(move |x| (x, y))) {
        let is_last = (right[0]..right[0] + RENDERED[0]).contains(&x) && (right[1]..right[1] + RENDERED[1]).contains(&y);
        let at = (y * IMAGES[0] + x) as usize;
        assert!(is_last || shown[0][at].map(f32::to_bits) == shown[1][at].map(f32::to_bits), "{x}, {y}");
    }
    assert_valid();
}

fn a_part_beyond_its_images_is_refused() {
    let config = Config { image_extent: Some(IMAGES), ..Config::new(ALLOCATED) };
    let mut s = session(&config);
    let scene = Scene { allocated: ALLOCATED, ..Scene::new(RENDERED) };
    upload_part(&mut s, &scene.frame(0, 0), [0; 2]);
    for viewport_origin in [[47, 0], [0, 30], [u32::MAX, 0]] {
        let params = FrameParams { viewport_origin, ..scene.params(0) };
        let error = s.run(&params, &Tuning::default()).expect_err("refused").to_string();
        assert!(error.contains("viewport_origin") && error.contains("83, 50"), "{error}");
    }
    let small = Config { image_extent: Some([39, 50]), ..config }.declare().expect_err("refused").to_string();
    assert!(small.contains("image_extent") && small.contains("39, 50") && small.contains("40, 24"), "{small}");
    let two = Config { output_extent: Some(IMAGES), ..config }.declare().expect_err("refused").to_string();
    assert!(two.contains("output_extent") && two.contains("Leave one of both out"), "{two}");
    let mut alone = session(&Config::new(ALLOCATED));
    upload(&mut alone, &scene.frame(0, 0));
    let error = alone.run(&FrameParams { viewport_origin: [4, 0], ..scene.params(0) }, &Tuning::default());
    assert!(matches!(error, Err(Error::ViewportOrigin { given: [4, 0], .. })), "{error:?}");
    assert_valid();
}

//! The visibility of lights: beside the presets for surfaces, with their light and without.

use super::support::{assert_finite, assert_valid, frame, random, scene::Guides, scene::Scene, session, session_with, upload};
use atrous::config::{PostProcess, Preset, Signals};
use atrous::executor::{Session, SessionOptions};
use atrous::Counter;
use atrous::{Config, FrameParams, ResetReason, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("it_costs_at_most_12_bytes_a_pixel", it_costs_at_most_12_bytes_a_pixel),
    ("it_is_nearer_to_the_truth_than_its_samples", it_is_nearer_to_the_truth_than_its_samples),
    ("all_or_nothing_is_a_fixed_point", all_or_nothing_is_a_fixed_point),
    ("a_reset_frame_equals_a_first_frame", a_reset_frame_equals_a_first_frame),
    ("two_runs_are_bit_identical", two_runs_are_bit_identical),
    ("a_render_rect_gives_the_bits_of_a_tight_image", a_render_rect_gives_the_bits_of_a_tight_image),
    ("surfaces_are_as_they_were_and_the_product_is_added", surfaces_are_as_they_were_and_the_product_is_added),
    ("what_is_no_visibility_is_counted_and_does_not_spread", what_is_no_visibility_is_counted_and_does_not_spread),
    ("odd_depths_beside_missing_samples_are_no_nan", odd_depths_beside_missing_samples_are_no_nan),
    ("ambient_occlusion_is_nearer_to_the_truth_than_its_samples", ambient_occlusion_is_nearer_to_the_truth_than_its_samples),
    ("each_of_four_lights_is_what_it_is_alone", each_of_four_lights_is_what_it_is_alone),
    ("a_grey_light_is_the_same_in_colour", a_grey_light_is_the_same_in_colour),
    ("several_lights_cost_no_more_memory_than_the_page_says", several_lights_cost_no_more_memory_than_the_page_says),
    ("the_products_of_coloured_lights_are_added", the_products_of_coloured_lights_are_added),
];

const EXTENT: [u32; 2] = [96, 54];

fn config(extent: [u32; 2]) -> Config {
    Config { visibility: 1, ..Config::new(extent) }
}

fn visibility_of(s: &mut Session, g: &Guides, params: &FrameParams) -> Vec<f32> {
    upload(s, g);
    let context = s.run(params, &Tuning::default()).expect("frame");
    let image = s.download("denoised_visibility").expect("denoised_visibility");
    assert_finite(&image, context.render_extent, s.executor().denoiser().declaration().allocated_extent());
    assert_valid();
    image.iter().map(|v| v[0]).collect()
}

/// History, transients and the output, of every preset with what it has by default and with the post-process.
fn it_costs_at_most_12_bytes_a_pixel() {
    let extent = [1920, 1080];
    for preset in Preset::ALL {
        for (signals, post_process) in [(Signals::Together, PostProcess::None), (Signals::Apart, PostProcess::ToneMapTaa)] {
            let without = Config { preset, signals, post_process, ..Config::new(extent) };
            let bytes = |config: &Config| {
                let memory = config.declare().expect("valid").memory();
                memory.history + memory.transient + memory.output
            };
            let more = bytes(&Config { visibility: 1, ..without }) as f64 - bytes(&without) as f64;
            let a_pixel = more / f64::from(extent[0] * extent[1]);
            let most = match (preset, post_process) {
                // It keeps no guide of the frame before.
                (Preset::Eaw, _) => 24.0,
                // It has no spatial filter, whose images would be free by then, and its motion is still needed.
                (Preset::Stabilize, PostProcess::ToneMapTaa) => 16.0,
                _ => 12.0,
            };
            assert!(a_pixel > 8.0 && a_pixel <= most, "{preset:?}: {a_pixel}");
        }
    }
}

fn it_is_nearer_to_the_truth_than_its_samples() {
    let error =
        |a: &[f32], truth: &[[f32; 4]]| (a.iter().zip(truth).map(|(a, b)| (a - b[0]).powi(2)).sum::<f32>() / a.len() as f32).sqrt();
    for (speed, share) in [(0.0, 0.35), (0.05, 0.5)] {
        let scene = Scene { speed, ..Scene::new(EXTENT) };
        let mut s = session(&config(EXTENT));
        let (mut filtered, mut noisy) = (0.0, 0.0);
        for i in 0..24 {
            let g = scene.frame(i, i);
            let image = visibility_of(&mut s, &g, &scene.params(i));
            let samples: Vec<_> =
                g.noisy_visibility.iter().map(|v| if v[0].is_nan() { 1.0 } else { v[0].clamp(0.0, 1.0) }).collect();
            (filtered, noisy) = (error(&image, &g.clean_visibility), error(&samples, &g.clean_visibility));
        }
        println!("speed {speed}: {noisy:.4} to {filtered:.4}");
        assert!(filtered < share * noisy, "speed {speed}: {noisy} to {filtered}");
    }
}

fn all_or_nothing_is_a_fixed_point() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    for (v, distance) in [(1.0, f32::INFINITY), (0.0, 50.0)] {
        let mut s = session(&config(EXTENT));
        for i in 0..4 {
            let mut g = scene.frame(i, i);
            g.noisy_visibility.fill([v; 4]);
            g.occluder_distance.fill([distance; 4]);
            let image = visibility_of(&mut s, &g, &scene.params(i));
            // The sky is not in a shadow.
            let expected = g.surface_id.iter().map(|id| if *id == 0 { 1.0 } else { v });
            assert!(image.iter().zip(expected).all(|(a, b)| *a == b), "{v}");
        }
    }
}

fn a_reset_frame_equals_a_first_frame() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    // Not poisoned: a reset would poison the history, too, and a shader that reads it would find no surface there.
    let [mut used, mut fresh] = [(); 2].map(|()| session_with(&config(EXTENT), SessionOptions::default()));
    for i in 0..4 {
        visibility_of(&mut used, &scene.frame(i, i), &scene.params(i));
    }
    let cut = FrameParams { reset: Some(ResetReason::CameraCut), ..scene.params(9) };
    let g = scene.frame(9, 9);
    assert_eq!(visibility_of(&mut used, &g, &cut), visibility_of(&mut fresh, &g, &scene.params(9)));
}

fn two_runs_are_bit_identical() {
    let scene = Scene { speed: 0.13, ..Scene::new(EXTENT) };
    let run = || -> Vec<Vec<f32>> {
        let mut s = session_with(&config(EXTENT), SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        (0..5).map(|i| visibility_of(&mut s, &scene.frame(i, i), &scene.params(i))).collect()
    };
    assert_eq!(run(), run());
}

fn a_render_rect_gives_the_bits_of_a_tight_image() {
    let tight = Scene { speed: 0.15, ..Scene::new([37, 21]) };
    let loose = Scene { allocated: [66, 40], ..tight };
    let (mut a, mut b) = (session(&config(tight.allocated)), session(&config(loose.allocated)));
    for i in 0..4 {
        let x = visibility_of(&mut a, &tight.frame(i, i), &tight.params(i));
        let y = visibility_of(&mut b, &loose.frame(i, i), &loose.params(i));
        for (row, expected) in x.chunks(37).enumerate() {
            assert_eq!(&y[row * 66..row * 66 + 37], expected, "frame {i}, row {row}");
        }
    }
}

fn surfaces_are_as_they_were_and_the_product_is_added() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    for preset in [Preset::Svgf, Preset::Eaw, Preset::Best] {
        let without = Config { preset, ..Config::new(EXTENT) };
        let (mut surfaces, mut both) = (session(&without), session(&Config { visibility: 1, ..without }));
        for i in 0..4 {
            let (g, params) = (scene.frame(i, i), scene.params(i));
            let (_, expected) = frame(&mut surfaces, &g, &params, &Tuning::for_preset(preset));
            // With the input left out, and then with it.
            upload(&mut both, &g);
            if i % 2 == 0 {
                both.unbind("unshadowed_direct").expect("known");
            }
            both.run(&params, &Tuning::for_preset(preset)).expect("frame");
            let image = both.download("denoised_radiance").expect("output");
            let seen = both.download("denoised_visibility").expect("output");
            for (p, (sum, alone)) in image.iter().zip(&expected).enumerate() {
                let light = |c: usize| if i % 2 == 0 { 0.0 } else { g.unshadowed_direct[p][c] * seen[p][0] };
                let close = (0..3).all(|c| (sum[c] - alone[c] - light(c)).abs() <= 2e-3 * (alone[c] + light(c)));
                assert!(close && (i % 2 == 1 || sum == alone), "{preset:?}, frame {i}, {p}: {sum:?} {alone:?}");
            }
        }
        assert_valid();
    }
}

fn what_is_no_visibility_is_counted_and_does_not_spread() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.5, 1.5, 1e30];
    let mut s = session(&config(EXTENT));
    for i in 0..4 {
        let mut g = scene.frame(i, i);
        g.noisy_visibility.fill([1.0; 4]);
        g.occluder_distance.fill([f32::INFINITY; 4]);
        let surface: Vec<usize> =
            (0..g.surface_id.len()).filter(|p| g.surface_id[*p] != 0).step_by(211).take(2 * bad.len()).collect();
        for (k, value) in bad.into_iter().enumerate() {
            g.noisy_visibility[surface[k]] = [value; 4];
            g.occluder_distance[surface[bad.len() + k]] = [value; 4];
        }
        g.unshadowed_direct[surface[0]] = [f32::NAN; 4];
        let image = visibility_of(&mut s, &g, &scene.params(i));
        // Negative infinity and -0.5 are no light: -0.5 becomes 0, what is not finite takes after its surroundings.
        let dark = image.iter().filter(|v| **v < 1.0).count();
        assert!(dark <= 9 * 4 && image.iter().all(|v| (0.0..=1.0).contains(v)), "frame {i}: {dark}");
        let counts = s.download("statistics").expect("statistics");
        let count = |i: Counter| counts[i as usize][0];
        assert_eq!((count(Counter::Visibility), count(Counter::OccluderDistance)), (6.0, 3.0));
        assert_eq!(count(Counter::Radiance), 1.0);
        let radiance = s.download("denoised_radiance").expect("output");
        assert_finite(&radiance, EXTENT, EXTENT);
    }
}

/// Depths at which a pixel is as large as nothing, or the way to the next pixel longer than a half float holds.
fn odd_depths_beside_missing_samples_are_no_nan() {
    const DEPTHS: [f32; 7] = [1.5e-39, 1e-30, 1e-9, 65504.0, 1e7, 9e14, f32::MAX];
    let scene = Scene { speed: 0.05, ..Scene::new([36, 18]) };
    let pixels = 32 * 18;
    for preset in [Preset::Best, Preset::Eaw] {
        let mut s = session(&Config { preset, ..config(scene.extent) });
        // One pixel, every second one, or all; of samples every third is missing, those to the right, or all.
        let cases = DEPTHS.iter().flat_map(|depth| (0..9).map(move |i| (*depth, i / 3, i % 3)));
        for (frame, (depth, odd, missing)) in (0..).zip(cases) {
            let mut g = scene.frame(frame, frame);
            for p in 0..pixels {
                let (x, y) = (p % 32, p / 32);
                if [p == 9 * 36 + 12, (x + y) % 2 == 0, true][odd] {
                    g.depth[p] = [depth; 4];
                }
                g.noisy_visibility[p] = [if [p % 3 == 0, x >= 12, true][missing] { f32::NAN } else { (p % 5 % 2) as f32 }; 4];
                g.occluder_distance[p] = [if y < 9 { 0.5 } else { 65504.0 }; 4];
            }
            let image = visibility_of(&mut s, &g, &scene.params(frame));
            assert!(image.iter().all(|v| (0.0..=1.0).contains(v)), "{preset}, depth {depth:e}, {odd}, {missing}");
        }
    }
}

/// The inputs of a light, as those of the only one.
fn alone(g: &Guides, light: usize) -> Guides {
    let mut one = g.clone();
    if let Some(lamp) = light.checked_sub(1).map(|i| &g.further_lights[i]) {
        (one.noisy_visibility, one.occluder_distance) = (lamp.noisy_visibility.clone(), lamp.occluder_distance.clone());
    }
    one
}

fn output_of(light: usize) -> String {
    ["denoised_visibility".to_owned(), format!("denoised_visibility_{light}")][light.min(1)].clone()
}

fn each_of_four_lights_is_what_it_is_alone() {
    let scene = Scene { speed: 0.07, ..Scene::new(EXTENT) };
    let radii = [0.00465, 0.02, 0.01, 0.004];
    let [light_radius, light_radius_1, light_radius_2, light_radius_3] = radii;
    let tuning = Tuning { light_radius, light_radius_1, light_radius_2, light_radius_3, ..Tuning::default() };
    // A sun that moves, one that stands, a lamp that moves, and one that nobody tells the place of.
    let lights = |i: u32| [[0.1 * i as f32, 0.8, 0.5, 0.0], [0.3, 0.8, 0.5, 0.0], [0.2 * i as f32, 6.0, 2.0, 1.0], [0.0; 4]];
    for coloured_visibility in [false, true] {
        let base = Config { coloured_visibility, ..config(EXTENT) };
        let mut together = session(&Config { visibility: 4, ..base });
        let mut apart = [(); 4].map(|()| session(&base));
        for i in 0..5 {
            let (g, params) = (scene.frame(i, i), FrameParams { lights: lights(i), ..scene.params(i) });
            upload(&mut together, &g);
            together.run(&params, &tuning).expect("frame");
            for (light, one) in apart.iter_mut().enumerate() {
                upload(one, &alone(&g, light));
                let lights = [params.lights[light], [0.0; 4], [0.0; 4], [0.0; 4]];
                one.run(&FrameParams { lights, ..params }, &Tuning { light_radius: radii[light], ..tuning }).expect("frame");
                let [a, b] =
                    [(&mut together, output_of(light)), (one, output_of(0))].map(|(s, name)| s.download(&name).expect(&name));
                let far = a.iter().zip(&b).filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 4e-3)).count();
                assert!(far * 500 <= a.len(), "frame {i}, light {light}, colour {coloured_visibility}: {far} pixels differ");
            }
        }
        assert_valid();
    }
}

fn a_grey_light_is_the_same_in_colour() {
    let scene = Scene { speed: 0.07, ..Scene::new(EXTENT) };
    let [mut grey, mut coloured] =
        [false, true].map(|coloured_visibility| session(&Config { coloured_visibility, ..config(EXTENT) }));
    for i in 0..5 {
        let mut g = scene.frame(i, i);
        g.noisy_visibility.iter_mut().for_each(|v| *v = [v[0]; 4]);
        visibility_of(&mut grey, &g, &scene.params(i));
        visibility_of(&mut coloured, &g, &scene.params(i));
        let [a, b] = [&mut grey, &mut coloured].map(|s| s.download("denoised_visibility").expect("output"));
        // The output in colour is of half floats.
        let far = a.iter().zip(&b).find(|(a, b)| (0..3).any(|c| (a[0] - b[c]).abs() > 2e-3) || b[3] != 1.0);
        assert_eq!(far, None, "frame {i}");
    }
}

fn several_lights_cost_no_more_memory_than_the_page_says() {
    let bytes = |visibility, coloured_visibility| {
        let memory = Config { visibility, coloured_visibility, ..Config::new([1920, 1080]) }.declare().expect("valid").memory();
        memory.history + memory.transient + memory.output
    };
    let of_lights = |lights, coloured| (bytes(lights, coloured) - bytes(0, coloured)) as f64 / (1920.0 * 1080.0);
    let [grey, coloured] = [false, true].map(|coloured| [0, 1, 2, 3, 4].map(|lights| of_lights(lights, coloured)));
    println!("{grey:?} {coloured:?}");
    // As docs/presets.md says.
    assert!(grey[1] <= 12.0 && grey[2] <= 58.0 && grey[4] <= 66.0, "{grey:?}");
    assert!(coloured[1] <= 26.0 && coloured[2] <= 130.0 && coloured[4] <= 146.0, "{coloured:?}");
    let error = Config { visibility: 5, ..Config::new([60, 60]) }.declare().map(|_| ()).expect_err("four at most").to_string();
    assert!(error.contains("visibility") && error.contains('5') && error.contains('4'), "{error}");
}

fn the_products_of_coloured_lights_are_added() {
    let scene = Scene { speed: 0.1, ..Scene::new(EXTENT) };
    let without = Config { preset: Preset::Svgf, ..Config::new(EXTENT) };
    let mut surfaces = session(&without);
    let mut both = session(&Config { visibility: 3, coloured_visibility: true, ..without });
    for i in 0..3 {
        let (g, params, tuning) = (scene.frame(i, i), scene.params(i), Tuning::for_preset(Preset::Svgf));
        let (_, expected) = frame(&mut surfaces, &g, &params, &tuning);
        upload(&mut both, &g);
        // The second light is multiplied by its host.
        both.unbind("unshadowed_direct_1").expect("known");
        both.run(&params, &tuning).expect("frame");
        let image = both.download("denoised_radiance").expect("output");
        let seen = [0, 2].map(|light| both.download(&output_of(light)).expect("output"));
        let light = [&g.unshadowed_direct, &g.further_lights[1].unshadowed_direct];
        for (p, (sum, alone)) in image.iter().zip(&expected).enumerate() {
            let added = |c: usize| light[0][p][c] * seen[0][p][c] + light[1][p][c] * seen[1][p][c];
            let close = (0..3).all(|c| (sum[c] - alone[c] - added(c)).abs() <= 2e-3 * (alone[c] + added(c)));
            assert!(close, "frame {i}, {p}: {sum:?} {alone:?}");
        }
    }
    assert_valid();
}

fn ambient_occlusion_is_nearer_to_the_truth_than_its_samples() {
    // A little occlusion, as between walls far apart, and much of it; a bit more to the right.
    for (speed, occluded) in [(0.0, 0.03), (0.05, 0.03), (0.0, 0.5), (0.05, 0.5)] {
        let scene = Scene { speed, ..Scene::new(EXTENT) };
        let mut s = session(&Config { ambient_occlusion: true, ..Config::new(EXTENT) });
        let truth: Vec<f32> = (0..96 * 54).map(|p| 1.0 - occluded * (0.5 + (p % 96) as f32 / 96.0)).collect();
        let (mut noise, mut error, mut bias) = (0.0, 0.0, 0.0);
        for i in 0..24 {
            let mut g = scene.frame(i, i);
            for (p, open) in truth.iter().enumerate() {
                let [hit, far] = [random(p as u32, i, 40), random(p as u32, i, 41)];
                let seen = hit < *open;
                g.further_lights[1].noisy_visibility[p] = [f32::from(seen); 4];
                g.further_lights[1].occluder_distance[p] = [if seen { f32::INFINITY } else { 0.1 + far }; 4];
            }
            upload(&mut s, &g);
            s.run(&scene.params(i), &Tuning::default()).expect("frame");
            let image = s.download("denoised_ambient").expect("output");
            let surfaces: Vec<_> = (0..truth.len()).filter(|p| g.surface_id[*p] != 0).collect();
            let mean = |of: &dyn Fn(usize) -> f32| surfaces.iter().map(|p| of(*p)).sum::<f32>() / surfaces.len() as f32;
            noise = mean(&|p| (g.further_lights[1].noisy_visibility[p][0] - truth[p]).powi(2)).sqrt();
            error = mean(&|p| (image[p][0] - truth[p]).powi(2)).sqrt();
            bias = mean(&|p| image[p][0] - truth[p]);
        }
        println!("{occluded} at {speed}: {noise:.4} to {error:.4}, bias {bias:.4}");
        assert!(error < 0.25 * noise, "{occluded} at {speed}: {noise} to {error}");
        assert!(bias.abs() < 0.25 * occluded, "{occluded} at {speed}: {bias}");
        assert_valid();
    }
}

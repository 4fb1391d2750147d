//! What must hold whatever the picture: see also the CPU twins, which have the same properties.

use super::support::{
    assert_valid, frame, gpu, luminance_history, pixels, random, rmse,
    scene::{Guides, Scene},
    session, session_with, svgf, upload,
};
use atrous::config::{Conventions, PostProcess, Preset, Signals};
use atrous::executor::{AllocatedMemory, Session, SessionOptions};
use atrous::{Config, FrameParams, ResetReason, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_constant_image_is_a_fixed_point", a_constant_image_is_a_fixed_point),
    ("without_alpha_it_is_the_running_mean", without_alpha_it_is_the_running_mean),
    ("rare_light_keeps_its_mean_while_the_camera_moves", rare_light_keeps_its_mean_while_the_camera_moves),
    ("light_fades_in_the_same_time_at_any_frame_rate", light_fades_in_the_same_time_at_any_frame_rate),
    ("a_render_rect_gives_the_bits_of_a_tight_image", a_render_rect_gives_the_bits_of_a_tight_image),
    ("a_reset_frame_equals_a_first_frame", a_reset_frame_equals_a_first_frame),
    ("results_do_not_depend_on_the_parity_of_the_frame", results_do_not_depend_on_the_parity_of_the_frame),
    ("two_runs_are_bit_identical", two_runs_are_bit_identical),
    ("the_number_of_frames_in_flight_changes_nothing", the_number_of_frames_in_flight_changes_nothing),
    ("the_render_extent_may_change_from_frame_to_frame", the_render_extent_may_change_from_frame_to_frame),
    ("the_sky_passes_untouched", the_sky_passes_untouched),
    ("emission_is_added_untouched", emission_is_added_untouched),
    ("light_that_comes_divided_gives_the_same_picture", light_that_comes_divided_gives_the_same_picture),
    ("an_exposure_ratio_scales_the_history", an_exposure_ratio_scales_the_history),
    ("memory_is_what_the_executor_allocates", memory_is_what_the_executor_allocates),
    ("every_structural_variant_runs", every_structural_variant_runs),
    ("an_output_that_lends_its_image_has_the_same_bits", an_output_that_lends_its_image_has_the_same_bits),
];

fn an_output_that_lends_its_image_has_the_same_bits() {
    let scene = Scene { speed: 0.1, ..Scene::new([40, 24]) };
    let base = svgf(scene.extent);
    let mut configs: Vec<_> = (1..=4).map(|levels| Config { levels: Some(levels), ..base }).collect();
    configs.push(Config { signals: Signals::Apart, post_process: PostProcess::ToneMapTaa, ..base });
    configs.push(Config { preset: Preset::Eaw, ..base });
    configs.push(Config { preset: Preset::Percentile, ..base });
    for config in configs {
        let [mut lent, mut apart] = [true, false].map(|share| {
            let declaration = config.graph().expect("valid").share_outputs(share).finish().expect("valid");
            Session::new(gpu(), declaration, SessionOptions { poison: true, ..Default::default() }).expect("session")
        });
        assert!(
            lent.executor().denoiser().declaration().resources().len()
                < apart.executor().denoiser().declaration().resources().len()
        );
        for i in 0..3 {
            let (guides, params) = (scene.frame(i, i), scene.params(i));
            let (_, a) = frame(&mut lent, &guides, &params, &Tuning::default());
            let (_, b) = frame(&mut apart, &guides, &params, &Tuning::default());
            assert_eq!(a, b, "{config:?}, frame {i}");
        }
    }
    assert_valid();
}

/// A host may divide by the albedo itself. What it divides by next to nothing is multiplied by as little again.
fn light_that_comes_divided_gives_the_same_picture() {
    let scene = Scene { speed: 0.1, ..Scene::new([40, 24]) };
    for (preset, signals) in [Preset::Svgf, Preset::Best, Preset::Asvgf, Preset::Eaw]
        .map(|preset| (preset, Signals::Together))
        .into_iter()
        .chain([(Preset::Best, Signals::Specular), (Preset::Svgf, Signals::Apart)])
    {
        let config = Config { preset, signals, ..Config::new(scene.extent) };
        let conventions = Conventions { demodulated: true, ..Conventions::default() };
        let [mut radiance, mut irradiance] = [config, Config { conventions, ..config }].map(|config| session(&config));
        let tuning = Tuning::for_preset(preset);
        for i in 0..4 {
            let mut guides = scene.frame(i, i);
            let albedo = [0.5, 0.25, 0.5, 1.0];
            guides.albedo.fill(albedo);
            let (_, expected) = frame(&mut radiance, &guides, &scene.params(i), &tuning);
            upload(&mut irradiance, &guides);
            let declaration = irradiance.executor().denoiser().declaration().clone();
            for (name, texels) in guides.declared(&declaration) {
                if name.starts_with("noisy_") && name != "noisy_specular" {
                    let background = |k: usize| guides.depth[k][0] == 0.0;
                    let divided = (texels.iter().enumerate())
                        .map(|(k, t)| std::array::from_fn(|c| if background(k) { t[c] } else { t[c] / albedo[c] }));
                    irradiance.upload(name, &divided.collect::<Vec<_>>()).expect(name);
                }
            }
            irradiance.run(&scene.params(i), &tuning).expect("a frame");
            let given = irradiance.download("denoised_radiance").expect("output");
            assert!(rmse(&given, &expected) < 2e-3, "{config:?}, frame {i}: {}", rmse(&given, &expected));
        }
        irradiance.upload("albedo", &vec![[0.0; 4]; 40 * 24]).expect("albedo");
        irradiance.run(&scene.params(3), &tuning).expect("a frame");
        let black = irradiance.download("denoised_radiance").expect("output");
        let depth = scene.frame(3, 3).depth;
        let is_lit = |k: &usize| depth[*k][0] != 0.0 && black[*k][..3].iter().any(|c| *c != 0.0);
        let lit = (0..depth.len()).filter(is_lit).count();
        assert!(lit == 0 || signals == Signals::Specular, "{config:?}: {lit} black pixels are lit");
    }
    assert_valid();
}

fn a_constant_image_is_a_fixed_point() {
    let scene = Scene { noise: 0.0, ..Scene::new([48, 27]) };
    let mut s = session(&Config::new(scene.extent));
    let mut g = scene.frame(0, 0);
    g.noisy_radiance.fill([0.5, 0.25, 2.0, 1.0]);
    s.unbind("albedo").expect("known");
    for i in 0..4 {
        for (name, texels) in g.images().into_iter().filter(|(n, _)| ["depth", "normal", "motion", "noisy_radiance"].contains(n)) {
            s.upload(name, texels).expect(name);
        }
        s.upload_ids("surface_id", &g.surface_id).expect("surface_id");
        s.run(&scene.params(i), &Tuning::default()).expect("frame");
        for texel in s.download("denoised_radiance").expect("output") {
            // Weighted sums of equal values are a little off, and are rounded back.
            assert_eq!(texel, [0.5, 0.25, 2.0, 1.0], "frame {i}");
        }
    }
    assert_valid();
}

fn without_alpha_it_is_the_running_mean() {
    let scene = Scene::new([36, 18]);
    let mut s = session(&Config::new(scene.extent));
    // With a luminance tolerance of next to nothing the filter does not mix pixels, so the output is the accumulation.
    let tuning = Tuning { alpha: 0.0, alpha_moments: 0.0, sigma_l: 0.0, ..Tuning::default() };
    let count = 12;
    let mut mean = vec![[0.0; 4]; 32 * 18];
    let mut last = Vec::new();
    for i in 0..count {
        let g = scene.frame(0, i);
        for (m, texel) in mean.iter_mut().zip(&g.noisy_radiance) {
            (0..3).for_each(|c| m[c] += texel[c] / count as f32);
        }
        last = frame(&mut s, &g, &scene.params(0), &tuning).1;
    }
    let error = rmse(&last, &mean);
    let one = rmse(&scene.frame(0, count - 1).noisy_radiance, &mean);
    assert!(error < 0.004, "{error}, a single frame is {one} away");
    assert!(one > 0.1, "{one}");
}

/// One pixel in twenty is lit, and the sharp look-up of `best` undershoots beside it.
fn rare_light_keeps_its_mean_while_the_camera_moves() {
    let scene = Scene { speed: 0.03, ..Scene::new([192, 108]) };
    let mut s = session(&Config { preset: Preset::Best, ..Config::new(scene.extent) });
    let light = |picture: &[[f32; 4]], g: &Guides| -> f64 {
        picture
            .iter()
            .zip(&g.surface_id)
            .filter(|(_, id)| **id != 0)
            .map(|(texel, _)| f64::from(texel[0] + texel[1] + texel[2]))
            .sum()
    };
    let mut kept = 0.0_f64;
    for i in 0..12 {
        let mut g = scene.frame(i, i);
        for (p, (x, y)) in pixels(scene.extent).enumerate().filter(|(p, _)| g.surface_id[*p] != 0) {
            g.noisy_radiance[p] = g.clean[p].map(|v| if random(x, y, 300 + i) < 0.05 { 20.0 * v } else { 0.0 });
        }
        let picture = frame(&mut s, &g, &scene.params(i), &Tuning::default()).1;
        println!("frame {i}: {:.4} of the light", light(&picture, &g) / light(&g.clean, &g));
        if i >= 6 {
            kept += light(&picture, &g) / light(&g.clean, &g) / 6.0;
        }
    }
    println!("{kept:.4} of the light");
    assert!((kept - 1.0).abs() < 0.02, "{kept}");
}

/// The share of the old light that is left 0.1 seconds after the light went out, by a preset that does not react to lights.
fn left_of_the_light(frames_a_second: u32, tuning: &Tuning) -> f32 {
    let scene = Scene { noise: 0.0, ..Scene::new([19, 18]) };
    let mut s = session(&svgf(scene.extent));
    let mut g = scene.frame(0, 0);
    g.albedo.fill([1.0; 4]);
    let mut left = 0.0;
    for (light, count) in [(1.0, 40), (0.0, frames_a_second / 10)] {
        g.noisy_radiance.fill([light, light, light, 1.0]);
        for _ in 0..count {
            let (_, denoised) = frame(&mut s, &g, &scene.params(0), tuning);
            let lit: Vec<f32> = denoised.iter().zip(&g.surface_id).filter(|(_, id)| **id != 0).map(|(t, _)| t[0]).collect();
            left = lit.iter().sum::<f32>() / lit.len() as f32;
        }
    }
    left
}

fn light_fades_in_the_same_time_at_any_frame_rate() {
    let tuning = Tuning::for_preset(Preset::Svgf);
    let of = |rate: u32| {
        let scaled = tuning.for_frame_time(1.0 / rate as f32).expect("in range");
        [left_of_the_light(rate, &scaled), left_of_the_light(rate, &tuning)]
    };
    let [[slow, slow_frames], [usual, _], [fast, fast_frames]] = [30, 60, 120].map(of);
    println!("left after 0.1 s: {slow:.3}, {usual:.3}, {fast:.3} by seconds, {slow_frames:.3} and {fast_frames:.3} by frames");
    assert!((slow / usual - 1.0).abs() < 0.02 && (fast / usual - 1.0).abs() < 0.02, "{slow}, {usual}, {fast}");
    assert!(slow_frames > 6.0 * fast_frames, "{slow_frames}, {fast_frames}");
    assert_valid();
}

fn a_render_rect_gives_the_bits_of_a_tight_image() {
    for signals in Signals::ALL {
        let tight = Scene { speed: 0.15, ..Scene::new([37, 21]) };
        let loose = Scene { allocated: [66, 40], ..tight };
        let post_process = PostProcess::ToneMapTaa;
        let mut a = session(&Config { signals, post_process, ..Config::new(tight.allocated) });
        let mut b = session(&Config { signals, post_process, ..Config::new(loose.allocated) });
        for i in 0..5 {
            let (_, x) = frame(&mut a, &tight.frame(i, i), &tight.params(i), &Tuning::default());
            let (_, y) = frame(&mut b, &loose.frame(i, i), &loose.params(i), &Tuning::default());
            let (x_display, y_display) = (a.download("display").expect("display"), b.download("display").expect("display"));
            for (px, py) in pixels(tight.extent) {
                let (p, q) = ((py * 37 + px) as usize, (py * 66 + px) as usize);
                assert_eq!((x[p], x_display[p]), (y[q], y_display[q]), "frame {i}, pixel {px},{py}");
            }
        }
    }
}

fn a_reset_frame_equals_a_first_frame() {
    for signals in Signals::ALL {
        let scene = Scene { speed: 0.1, ..Scene::new([40, 24]) };
        let config = Config { signals, post_process: PostProcess::ToneMapTaa, ..Config::new(scene.extent) };
        let mut used = session(&config);
        for i in 0..5 {
            frame(&mut used, &scene.frame(i, i), &scene.params(i), &Tuning::default());
        }
        let cut = FrameParams { reset: Some(ResetReason::CameraCut), ..scene.params(9) };
        let (context, reset) = frame(&mut used, &scene.frame(9, 9), &cut, &Tuning::default());
        assert_eq!(context.reset, Some(ResetReason::CameraCut));
        let mut fresh = session(&config);
        let (context, first) = frame(&mut fresh, &scene.frame(9, 9), &scene.params(9), &Tuning::default());
        assert_eq!(context.reset, Some(ResetReason::Created));
        assert_eq!(reset, first);
        assert_eq!(used.download("display").expect("display"), fresh.download("display").expect("display"));
    }
}

fn results_do_not_depend_on_the_parity_of_the_frame() {
    let scene = Scene { speed: 0.1, ..Scene::new([40, 24]) };
    let run = |before: u32| {
        let mut s = session(&Config::new(scene.extent));
        for i in 0..before {
            frame(&mut s, &scene.frame(i, 77 + i), &scene.params(i), &Tuning::default());
        }
        s.invalidate();
        (0..4).map(|i| frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default()).1).last()
    };
    assert_eq!(run(0), run(1));
    assert_eq!(run(0), run(2));
}

fn two_runs_are_bit_identical() {
    let scene = Scene { speed: 0.1, ..Scene::new([66, 36]) };
    let run = || -> Vec<Vec<[f32; 4]>> {
        let mut s = session(&Config::new(scene.extent));
        (0..5).map(|i| frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default()).1).collect()
    };
    assert_eq!(run(), run());
}

fn the_number_of_frames_in_flight_changes_nothing() {
    let scene = Scene { speed: 0.1, ..Scene::new([36, 18]) };
    let run = |frames_in_flight: u32| -> Vec<Vec<[f32; 4]>> {
        let mut s = session(&Config { frames_in_flight, ..Config::new(scene.extent) });
        let params = |i: u32| FrameParams { frame_slot: i % frames_in_flight, ..scene.params(i) };
        (0..6).map(|i| frame(&mut s, &scene.frame(i, i), &params(i), &Tuning::default()).1).collect()
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(3));
}

fn the_render_extent_may_change_from_frame_to_frame() {
    let allocated = [66, 36];
    let mut s = session(&Config { post_process: PostProcess::ToneMapTaa, ..Config::new(allocated) });
    for (i, extent) in (0..).zip([[66, 36], [48, 27], [48, 27], [66, 36], [33, 19], [1, 1], [66, 36]]) {
        let scene = Scene { allocated, ..Scene::new(extent) };
        frame(&mut s, &scene.frame(0, i), &scene.params(0), &Tuning::default());
        if i == 3 {
            let lengths = luminance_history(&mut s, "luminance_history");
            let kept = lengths.iter().filter(|m| m.history_length > 1.0).count();
            let surface = scene.frame(0, i).surface_id.iter().filter(|&&id| id != 0).count();
            assert!(kept * 100 > surface * 98, "history of {kept} pixels of {surface} only survived a change of resolution");
        }
    }
}

fn the_sky_passes_untouched() {
    let scene = Scene { speed: 0.2, ..Scene::new([60, 60]) };
    let mut s = session(&Config::new(scene.extent));
    let mut sky = 0;
    for i in 0..4 {
        let g = scene.frame(i, i);
        let (_, image) = frame(&mut s, &g, &scene.params(i), &Tuning::default());
        for (texel, noisy) in image.iter().zip(&g.noisy_radiance).zip(&g.surface_id).filter(|(_, &id)| id == 0).map(|(t, _)| t) {
            sky += 1;
            assert!((0..3).all(|c| (texel[c] / noisy[c] - 1.0).abs() < 1e-3), "{texel:?} {noisy:?}");
        }
    }
    assert!(sky > 400, "{sky} pixels of sky");
}

fn emission_is_added_untouched() {
    let scene = Scene::new([36, 18]);
    let (mut with, mut without) = (session(&Config::new(scene.extent)), session(&Config::new(scene.extent)));
    with.upload("emission", &[[3.0, 2.0, 1.0, 0.0]; 36 * 18]).expect("emission");
    for i in 0..3 {
        let (_, a) = frame(&mut with, &scene.frame(i, i), &scene.params(i), &Tuning::default());
        let (_, b) = frame(&mut without, &scene.frame(i, i), &scene.params(i), &Tuning::default());
        for (a, b) in a.iter().zip(&b) {
            assert!((0..3).all(|c| (a[c] - b[c] - [3.0, 2.0, 1.0][c]).abs() < 0.01), "{a:?} {b:?}");
        }
    }
}

fn an_exposure_ratio_scales_the_history() {
    let scene = Scene::new([36, 18]);
    let mut s = session(&Config::new(scene.extent));
    let mut before = Vec::new();
    for i in 0..12 {
        before = frame(&mut s, &scene.frame(0, i), &scene.params(0), &Tuning::default()).1;
    }
    let bright = Scene { light: 4.0, ..scene };
    let params = FrameParams { exposure_ratio: 4.0, ..scene.params(0) };
    let (_, after) = frame(&mut s, &bright.frame(0, 12), &params, &Tuning::default());
    let scaled: Vec<[f32; 4]> = before.iter().map(|t| t.map(|v| 4.0 * v)).collect();
    let (kept, dropped) = (rmse(&after, &scaled), rmse(&after, &before));
    assert!(kept < 0.1 * dropped, "{kept} from the scaled history, {dropped} from the old one");
}

fn is_software() -> bool {
    let gpu = gpu();
    let host = gpu.host();
    // SAFETY: instance and physical device are live and belong together.
    let properties = unsafe { host.instance.get_physical_device_properties(host.physical_device) };
    properties.device_type == ash::vk::PhysicalDeviceType::CPU
}

fn memory_is_what_the_executor_allocates() {
    for signals in Signals::ALL {
        let config = Config { signals, ..svgf([320, 180]) };
        let s = session(&config);
        let (planned, allocated) = (config.declare().expect("valid").memory(), s.executor().allocated());
        println!("{signals:?}: planned {} + {}, allocated {allocated:?}", planned.history, planned.transient);
        // A device may pad an image; software Vulkan does not at this extent, but for the two of a single texel, of the exposure.
        if is_software() {
            assert_eq!(planned.transient, allocated.transient);
            assert!((planned.history..planned.history + 2 * 4096).contains(&allocated.history), "{}", planned.history);
        }
        let whole = |planned: u64, allocated: u64| (planned..2 * planned).contains(&allocated);
        assert!(whole(planned.transient, allocated.transient) && whole(planned.history, allocated.history), "{allocated:?}");
        // The device gives no more than that, and what lies between for alignment.
        let AllocatedMemory { history, transient, output, device } = allocated;
        let all = history + transient + output;
        let between = if is_software() { 65536 } else { all };
        assert!((all..all + between).contains(&device), "{allocated:?}");
    }
}

fn every_structural_variant_runs() {
    let scene = Scene { speed: 0.1, ..Scene::new([24, 18]) };
    for signals in Signals::ALL {
        for (surface_id, object_normal) in [(false, false), (false, true), (true, true)] {
            for levels in [1, 2, 10] {
                let post_process = PostProcess::ToneMap;
                let config =
                    Config { signals, surface_id, object_normal, levels: Some(levels), post_process, ..Config::new(scene.extent) };
                let mut s = session_with(&config, SessionOptions { poison: true, timestamps: true, ..Default::default() });
                for i in 0..3 {
                    frame(&mut s, &scene.frame(i, i), &scene.params(i), &Tuning::default());
                }
                let times = s.times();
                assert_eq!(times.len(), config.declare().expect("valid").passes().len());
                upload(&mut s, &scene.frame(3, 3));
            }
        }
    }
}

//! Temporal gradients: what they see, and what they leave alone.

use super::support::host::{Host, Shaded};
use super::support::{assert_valid, frame, pixels, rmse, scene::Scene, session, warnings};
use atrous::config::{GradientSource, Preset, Signals};
use atrous::{Config, FrameParams, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("where_nothing_changed_the_gradient_is_exactly_zero", where_nothing_changed_the_gradient_is_exactly_zero),
    ("two_runs_are_equal_to_the_bit", two_runs_are_equal_to_the_bit),
    ("a_gradient_sample_is_not_one_in_the_next_frame", a_gradient_sample_is_not_one_in_the_next_frame),
    ("a_light_switched_on_in_the_dark_is_seen", a_light_switched_on_in_the_dark_is_seen),
    ("after_a_switch_the_error_is_less_than_half_that_of_svgf", after_a_switch_the_error_is_less_than_half_that_of_svgf),
    ("history_follows_light_that_changes_as_a_whole", history_follows_light_that_changes_as_a_whole),
    ("a_static_scene_is_as_steady_as_with_svgf", a_static_scene_is_as_steady_as_with_svgf),
    ("without_reshading_history_is_trusted_and_it_is_said_once", without_reshading_history_is_trusted_and_it_is_said_once),
    ("without_samples_no_gradient_is_needed", without_samples_no_gradient_is_needed),
    ("a_local_change_stays_local", a_local_change_stays_local),
    ("stabilize_takes_flicker_from_another_denoiser", stabilize_takes_flicker_from_another_denoiser),
];

const EXTENT: [u32; 2] = [96, 54];

fn host(preset: Preset) -> Host {
    Host::new(Config { preset, ..Config::new(EXTENT) })
}

fn assert_trusted(shaded: &Shaded) {
    let bad = shaded.confidence.iter().position(|c| *c != 1.0);
    assert!(bad.is_none(), "pixel {bad:?} of {}: {:?}", shaded.confidence.len(), bad.map(|i| shaded.confidence[i]));
}

fn valid_samples(shaded: &Shaded) -> usize {
    shaded.samples.iter().filter(|t| t[2] != 0).count()
}

fn where_nothing_changed_the_gradient_is_exactly_zero() {
    for (stratum_size, speed) in [(2, 0.0), (3, 0.0), (4, 0.0), (2, 0.07), (3, 0.07), (4, 0.07)] {
        let scene = Scene { speed, ..Scene::new(EXTENT) };
        let mut host = Host::new(Config { preset: Preset::Asvgf, stratum_size, ..Config::new(EXTENT) });
        for i in 0..5 {
            let shaded = host.frame(&scene, i);
            assert!(shaded.gradient.iter().all(|g| g[0] == 0.0), "strata of {stratum_size}, frame {i}: a gradient");
            assert_trusted(&shaded);
            if i > 0 {
                let (valid, all) = (valid_samples(&shaded), shaded.samples.len());
                assert!(valid * 10 > all * 6, "strata of {stratum_size}, speed {speed}: {valid} samples in {all} strata");
                assert!(shaded.gradient.iter().filter(|g| g[1] > 0.0).count() * 10 > valid * 8, "samples were not compared");
            }
        }
    }
    assert_valid();
}

fn two_runs_are_equal_to_the_bit() {
    let scene = Scene { speed: 0.15, ..Scene::new(EXTENT) };
    let mut hosts = [host(Preset::Asvgf), host(Preset::Asvgf)];
    for i in 0..6 {
        let lit = Scene { light: if i % 2 == 0 { 1.0 } else { 0.4 }, ..scene };
        let [a, b] = hosts.each_mut().map(|h| h.frame(&lit, i));
        assert_eq!(a.samples, b.samples, "frame {i}");
        let bits = |t: &[[f32; 4]]| t.iter().flatten().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&a.denoised), bits(&b.denoised), "frame {i}");
    }
}

fn a_gradient_sample_is_not_one_in_the_next_frame() {
    for stratum_size in [2, 3, 4] {
        let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
        let mut host = Host::new(Config { preset: Preset::Asvgf, stratum_size, ..Config::new(EXTENT) });
        let mut before = Vec::new();
        for i in 0..6 {
            let shaded = host.frame(&scene, i);
            let width = EXTENT[0].div_ceil(stratum_size);
            let (mut now, mut taken) = (Vec::new(), Vec::new());
            for (s, &[x, y, place, _]) in (0u32..).zip(&shaded.samples).filter(|(_, t)| t[2] != 0) {
                let place = u32::from(place) - 1;
                now.push([s % width * stratum_size + place % stratum_size, s / width * stratum_size + place / stratum_size]);
                taken.push([u32::from(x), u32::from(y)]);
            }
            assert!(taken.iter().all(|p| !before.contains(p)), "frame {i}: a sample was taken over twice in a row");
            before = now;
        }
    }
}

fn a_light_switched_on_in_the_dark_is_seen() {
    let scene = Scene { speed: 0.03, ..Scene::new(EXTENT) };
    let mut host = host(Preset::Asvgf);
    for (i, light) in [0.0, 0.0, 0.0, 1.0, 1.0, 0.0].into_iter().enumerate() {
        let shaded = host.frame(&Scene { light, ..scene }, i as u32);
        let surface = || shaded.confidence.iter().zip(&shaded.surface).filter(|(_, s)| **s);
        let (all, dropped) = (surface().count(), surface().filter(|(c, _)| **c < 0.01).count());
        let seen = i == 3 || i == 5;
        println!("frame {i}, light {light}: {dropped} of {all} pixels drop their history");
        assert!(if seen { dropped * 100 > all * 95 } else { dropped == 0 }, "frame {i}");
    }
}

/// Up and down, in the frame of the switch and in the two after it.
fn after_a_switch_the_error_is_less_than_half_that_of_svgf() {
    for (before, after) in [(1.0, 0.2), (0.2, 1.0)] {
        let scene = Scene::new(EXTENT);
        let errors = [Preset::Svgf, Preset::Asvgf].map(|preset| {
            let mut host = host(preset);
            for _ in 0..12 {
                host.frame_with(&Scene { light: before, ..scene }, 0, &params(&scene, preset));
            }
            (0..3)
                .map(|_| {
                    let shaded = host.frame_with(&Scene { light: after, ..scene }, 0, &params(&scene, preset));
                    rmse(&shaded.denoised, &shaded.clean)
                })
                .collect::<Vec<_>>()
        });
        println!("light {before} to {after}: SVGF {:.4?}, A-SVGF {:.4?}", errors[0], errors[1]);
        for (svgf, asvgf) in errors[0].iter().zip(&errors[1]) {
            assert!(*asvgf <= 0.45 * svgf, "{asvgf} against {svgf}");
        }
    }
}

/// Where all light falls or rises together `best` keeps its history: its error after the switch is that of a long history, while A-SVGF
/// begins anew. Without re-shaded samples it still drops what is no longer true.
fn history_follows_light_that_changes_as_a_whole() {
    for (before, after) in [(1.0, 0.2), (0.2, 1.0)] {
        let scene = Scene::new(EXTENT);
        let run = |preset: Preset, reshaded: bool| {
            let mut host = host(preset);
            let params = FrameParams { reshaded, ..scene.params(0) };
            let mut last = None;
            for i in 0..13 {
                let light = if i < 12 { before } else { after };
                last = Some(host.frame_with(&Scene { light, ..scene }, 0, &params));
            }
            let shaded = last.expect("frames");
            (rmse(&shaded.denoised, &shaded.clean), shaded.confidence)
        };
        let ((asvgf, _), (best, confidence), (svgf, _)) =
            (run(Preset::Asvgf, true), run(Preset::Best, true), run(Preset::Svgf, false));
        let kept = confidence.iter().filter(|c| **c > 0.9).count() as f32 / confidence.len() as f32;
        let (without, _) = run(Preset::Best, false);
        println!("light {before} to {after}: A-SVGF {asvgf:.4}, best {best:.4} ({kept:.2} kept), without samples {without:.4}, SVGF {svgf:.4}");
        assert!(kept > 0.5, "{kept}");
        assert!(best <= 0.7 * asvgf, "{best} against {asvgf}");
        assert!(without <= 0.6 * svgf, "{without} against {svgf}");
    }
    assert_valid();
}

fn params(scene: &Scene, preset: Preset) -> FrameParams {
    FrameParams { reshaded: preset != Preset::Svgf, ..scene.params(0) }
}

fn a_static_scene_is_as_steady_as_with_svgf() {
    let scene = Scene::new(EXTENT);
    let errors = [Preset::Svgf, Preset::Asvgf].map(|preset| {
        let mut host = host(preset);
        let (mut sum, mut before) = (0.0, Vec::new());
        for i in 0..40 {
            let shaded = host.frame_with(&scene, 0, &params(&scene, preset));
            if i >= 20 {
                sum += rmse(&shaded.denoised, &before);
            }
            before = shaded.denoised;
        }
        sum / 20.0
    });
    println!("change from frame to frame: SVGF {:.5}, A-SVGF {:.5}", errors[0], errors[1]);
    assert!(errors[1] <= 1.05 * errors[0], "{errors:?}");
}

fn without_reshading_history_is_trusted_and_it_is_said_once() {
    let scene = Scene::new([36, 20]);
    let mut host = Host::new(Config { preset: Preset::Asvgf, ..Config::new(scene.extent) });
    let said = warnings().len();
    for i in 0..5 {
        let light = if i < 3 { 1.0 } else { 0.1 };
        let shaded = host.frame_with(&Scene { light, ..scene }, 0, &scene.params(0));
        assert_trusted(&shaded);
    }
    let new = &warnings()[said..];
    assert!(matches!(new, [one] if one.contains("FrameParams::reshaded") && one.contains("Svgf")), "{new:?}");
    let said = warnings().len();
    let config = Config { preset: Preset::Asvgf, gradient_source: GradientSource::Reshaded, ..Config::new(scene.extent) };
    let mut host = Host::new(config);
    for _ in 0..3 {
        let shaded = host.frame_with(&scene, 0, &scene.params(0));
        assert_trusted(&shaded);
    }
    let new = &warnings()[said..];
    assert!(matches!(new, [one] if one.contains("`reshaded_radiance`")), "{new:?}");
    // What has another confidence for them does not do without.
    let said = warnings().len();
    let mut host = Host::new(Config { preset: Preset::Best, ..Config::new(scene.extent) });
    for _ in 0..3 {
        host.frame_with(&scene, 0, &scene.params(0));
    }
    assert_eq!(warnings()[said..], [] as [String; 0]);
    assert_valid();
}

/// A picture as good as with passes that find no gradient, without them.
fn without_samples_no_gradient_is_needed() {
    for signals in Signals::ALL {
        let config = Config { preset: Preset::Best, signals, gradient_source: GradientSource::Reshaded, ..Config::new(EXTENT) };
        let alone = Config { gradient_source: GradientSource::ChangeTest, ..config };
        let declared = [config, alone].map(|config| config.declare().expect("valid"));
        let passes = declared.each_ref().map(|declaration| declaration.passes().len());
        assert!(passes[1] + 6 <= passes[0], "{signals}: {passes:?} passes");
        let bytes = declared.each_ref().map(|declaration| declaration.memory().history + declaration.memory().transient);
        assert!(bytes[1] < bytes[0], "{signals}: {bytes:?} bytes");
        let mut sessions = [config, alone].map(|config| session(&config));
        let mut errors = [0.0; 2];
        for i in 0..6 {
            let scene = Scene { speed: 0.12, light: if i % 3 == 2 { 0.3 } else { 1.0 }, ..Scene::new(EXTENT) };
            let tuning = Tuning::for_preset(Preset::Best);
            let clean = Scene { noise: 0.0, ..scene }.frame(i, i).noisy_radiance;
            for (session, error) in sessions.iter_mut().zip(&mut errors) {
                let (_, denoised) = frame(session, &scene.frame(i, i), &scene.params(i), &tuning);
                *error += rmse(&denoised, &clean) / 6.0;
            }
        }
        println!("{signals}: error {errors:.4?}, passes {passes:?}");
        assert!(errors[1] <= 1.01 * errors[0], "{signals}: {errors:?}");
    }
    assert_valid();
}

/// Gradients are joint: those of the ball do not reach the wall behind it.
fn a_local_change_stays_local() {
    let scene = Scene::new(EXTENT);
    let config = Config { preset: Preset::Asvgf, gradient_source: GradientSource::Sparse, ..Config::new(EXTENT) };
    let mut host = Host::new(config);
    host.frame_with(&scene, 0, &scene.params(0));
    let ids = scene.frame(0, 0).surface_id;
    let width = EXTENT[0].div_ceil(3);
    let id_at = |x: u32, y: u32| ids[(y * EXTENT[0] + x) as usize];
    let sparse: Vec<[f32; 4]> = pixels([width, EXTENT[1].div_ceil(3)])
        .map(|(x, y)| [if id_at(3 * x + 1, 3 * y + 1) == 2 { -1.0 } else { 0.0 }, 1.0, 0.0, 0.0])
        .collect();
    host.session.upload("sparse_gradient", &sparse).expect("sparse_gradient");
    let shaded = host.frame_with(&scene, 0, &scene.params(0));
    let mean = |id: u32, far: bool| {
        let chosen = pixels(EXTENT).filter(|&(x, y)| id_at(x, y) == id && (!far || is_far_from_ball(&ids, x, y)));
        let values: Vec<f32> = chosen.map(|(x, y)| shaded.confidence[(y * EXTENT[0] + x) as usize]).collect();
        values.iter().sum::<f32>() / values.len() as f32
    };
    let (ball, wall) = (mean(2, false), mean(1, true));
    assert!(ball < 0.1 && wall > 0.9, "confidence of the ball {ball}, of the wall {wall}");
}

fn is_far_from_ball(ids: &[u32], x: u32, y: u32) -> bool {
    let near = |a: u32, side: u32| a.saturating_sub(5)..(a + 6).min(side);
    near(y, EXTENT[1]).all(|v| near(x, EXTENT[0]).all(|u| ids[(v * EXTENT[0] + u) as usize] != 2))
}

fn stabilize_takes_flicker_from_another_denoiser() {
    let scene = Scene::new(EXTENT);
    let mut host = host(Preset::Stabilize);
    for i in 0..24 {
        let light = if i < 16 { 1.0 } else { 0.3 };
        // A denoiser without memory: what is left of the noise changes with every frame.
        let other = Scene { light, noise: 0.15, ..scene }.frame(0, i + 500).noisy_radiance;
        host.session.upload("other_denoised_radiance", &other).expect("other_denoised_radiance");
        let shaded = host.frame(&Scene { light, ..scene }, 0);
        let (stabilized, left) = (rmse(&shaded.denoised, &shaded.clean), rmse(&other, &shaded.clean));
        assert!(stabilized <= 1.05 * left, "frame {i}: {stabilized} against {left}");
        if i % 16 >= 7 {
            assert!(stabilized < 0.45 * left, "frame {i}: {stabilized} against {left}");
        }
    }
    assert_valid();
}

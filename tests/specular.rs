//! Specular light on the GPU: bad input, and what a host may leave out.

use super::support::{frame, rmse, scene::Scene, session};
use atrous::config::{Preset, Signals};
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("roughness_and_hit_distances_out_of_range_are_counted_and_do_not_spread", out_of_range),
    ("a_black_specular_albedo_gives_a_picture", black_albedo),
    ("the_sum_of_both_lights_comes_out", both_lights),
];

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Best, signals: Signals::Specular, ..Config::new(extent) }
}

fn out_of_range() {
    let scene = Scene::new([32, 18]);
    let config = config(scene.extent);
    let (mut good, mut bad) = (session(&config), session(&config));
    let pixel = 32 * 9 + 3;
    let tuning = Tuning::for_preset(config.preset);
    for i in 0..6 {
        let guides = scene.frame(0, i);
        frame(&mut good, &guides, &scene.params(0), &tuning);
        let mut spoilt = guides.clone();
        if i == 2 {
            for (k, (roughness, distance)) in [(f32::NAN, f32::NAN), (1.5, -1.0), (-0.1, f32::NEG_INFINITY)].into_iter().enumerate()
            {
                spoilt.roughness[pixel + k] = [roughness; 4];
                spoilt.specular_hit_distance[pixel + k] = [distance; 4];
            }
        }
        let (_, denoised) = frame(&mut bad, &spoilt, &scene.params(0), &tuning);
        assert!(denoised.iter().flatten().all(|x| x.is_finite()), "frame {i}");
        let counts: Vec<u32> = bad.download("statistics").expect("statistics").iter().map(|c| c[0] as u32).collect();
        assert_eq!(counts[8..10], if i == 2 { [3, 3] } else { [0, 0] }, "frame {i}: roughness, hit distance");
    }
    let [a, b] = [&mut good, &mut bad].map(|s| s.download("denoised_radiance").expect("output"));
    let (far, near): (Vec<_>, Vec<_>) = (0..a.len()).partition(|i| (i % 32).abs_diff(4) > 8);
    let of = |pixels: &[usize]| {
        let cut = |image: &[[f32; 4]]| pixels.iter().map(|i| image[*i]).collect::<Vec<_>>();
        rmse(&cut(&a), &cut(&b))
    };
    assert!(of(&far) < 1e-3 && of(&near) < 0.05, "far {}, near {}", of(&far), of(&near));
}

fn black_albedo() {
    let scene = Scene::new([32, 18]);
    let mut s = session(&config(scene.extent));
    for i in 0..4 {
        let mut guides = scene.frame(0, i);
        guides.specular_albedo.fill([0.0; 4]);
        let (_, denoised) = frame(&mut s, &guides, &scene.params(0), &Tuning::for_preset(Preset::Best));
        assert!(denoised.iter().flatten().all(|x| x.is_finite() && *x < 100.0), "frame {i}");
    }
}

/// With little noise, what comes out is the sum of the two lights, whatever divides them.
fn both_lights() {
    let scene = Scene { noise: 0.05, speed: 0.1, ..Scene::new([64, 36]) };
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Eaw, Preset::Best] {
        let mut s = session(&Config { preset, ..config(scene.extent) });
        for i in 0..8 {
            let guides = scene.frame(i, i);
            let (_, denoised) = frame(&mut s, &guides, &scene.params(i), &Tuning::for_preset(preset));
            let sum = guides.clean.iter().zip(&guides.clean_specular).map(|(a, b)| std::array::from_fn(|c| a[c] + b[c]));
            let truth: Vec<[f32; 4]> = sum.collect();
            let (error, without) = (rmse(&denoised, &truth), rmse(&guides.clean, &truth));
            assert!(error < 0.5 * without, "{preset}, frame {i}: {error}, without specular light {without}");
        }
    }
}

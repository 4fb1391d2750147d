//! Specular light on the GPU: bad input, and what a host may leave out.

use super::support::scene::{Guides, Scene};
use super::support::{assert_valid, frame, rmse, session};
use atrous::config::{Preset, Signals};
use atrous::executor::Session;
use atrous::{Config, FrameParams, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("roughness_and_hit_distances_out_of_range_are_counted_and_do_not_spread", out_of_range),
    ("a_black_specular_albedo_gives_a_picture", black_albedo),
    ("the_sum_of_both_lights_comes_out", both_lights),
    ("little_specular_light_comes_out_as_it_came", dark_albedo),
    ("rough_surfaces_of_which_no_distance_is_known_are_as_good_as_diffuse_ones", rough_without_distances),
];

fn config(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Best, signals: Signals::Specular, ..Config::new(extent) }
}

fn out_of_range() {
    let scene = Scene::new([36, 18]);
    let config = config(scene.extent);
    let (mut good, mut bad) = (session(&config), session(&config));
    let pixel = 32 * 9 + 3;
    let tuning = Tuning::for_preset(config.preset);
    for i in 0..6 {
        let guides = scene.frame(0, i);
        frame(&mut good, &guides, &scene.params(0), &tuning);
        let mut spoilt = guides.clone();
        if i == 2 {
            for (k, (roughness, distance)) in [(f32::NAN, f32::NAN), (1.5, -2.0), (-0.1, f32::NEG_INFINITY)].into_iter().enumerate()
            {
                spoilt.roughness[pixel + k] = [roughness; 4];
                spoilt.specular_hit_distance[pixel + k] = [distance; 4];
            }
            // What is not known is not bad.
            spoilt.roughness[pixel + 5] = [-1.0; 4];
            spoilt.specular_hit_distance[pixel + 5] = [-1.0; 4];
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
    let scene = Scene::new([36, 18]);
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
    let scene = Scene { noise: 0.05, speed: 0.1, ..Scene::new([66, 36]) };
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

/// An albedo of the base would divide it in another way.
fn dark_albedo() {
    let scene = Scene { speed: 0.1, ..Scene::new([36, 18]) };
    for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Eaw, Preset::Best] {
        for albedo in [0.01, 0.03, 0.06] {
            let mut s = session(&Config { preset, ..config(scene.extent) });
            let light = 0.8 * albedo;
            for i in 0..4 {
                let mut guides = scene.frame(i, i);
                guides.noisy_diffuse.fill([0.0; 4]);
                guides.noisy_specular.fill([light; 4]);
                guides.specular_albedo.fill([albedo; 4]);
                let (_, denoised) = frame(&mut s, &guides, &scene.params(i), &Tuning::for_preset(preset));
                let wrong = denoised.iter().filter(|pixel| (pixel[0] / light - 1.0).abs() > 0.01).count();
                assert_eq!(wrong, 0, "{preset}, albedo {albedo}, frame {i}: of {}, such as {:?}", denoised.len(), denoised[99]);
            }
        }
    }
}

/// The same light, once as diffuse and once as specular light: of roughness 1, which is what a host says that gives none. `best` looks the
/// past of diffuse light up by a cubic, which is sharper where the camera moves. In `asvgf` the widest lobe takes a little less from far taps.
/// Light whose place nobody knows is also compared by logarithms, which in `best` takes .3 % for changes.
/// Two stages that compute the same in different order, and a floor of the deviation that tells noise by how its neighbours bend.
const AS_GOOD: f64 = 1.0 + 1e-4;

fn rough_without_distances() {
    let cases = [
        (Preset::Svgf, 0.0, AS_GOOD),
        (Preset::Svgf, 0.15, AS_GOOD),
        (Preset::Asvgf, 0.15, 1.005),
        (Preset::Best, 0.0, 1.005),
        (Preset::Best, 0.15, 1.02),
    ];
    for (preset, speed, bound) in cases {
        let scene = Scene { speed, ..Scene::new([64, 36]) };
        let (mut diffuse, mut specular) =
            (session(&Config { preset, ..Config::new(scene.extent) }), session(&Config { preset, ..config(scene.extent) }));
        let tuning = Tuning::for_preset(preset);
        let mut errors = [0.0, 0.0];
        for i in 0..12 {
            let (mut guides, params) = (scene.frame(i, i), scene.params(i));
            let (_, as_diffuse) = frame(&mut diffuse, &guides, &params, &tuning);
            guides.specular_albedo = guides.albedo.clone();
            guides.noisy_specular = guides.noisy_radiance.clone();
            guides.noisy_diffuse.fill([0.0; 4]);
            let as_specular = frame_without_distances(&mut specular, &guides, &params, &tuning);
            if i >= 4 {
                errors[0] += rmse(&as_diffuse, &guides.clean);
                errors[1] += rmse(&as_specular, &guides.clean);
            }
        }
        assert!(
            errors[1] <= bound * errors[0],
            "{preset}, speed {speed}: {} as specular, {} as diffuse light",
            errors[1],
            errors[0]
        );
    }
}

fn frame_without_distances(s: &mut Session, guides: &Guides, params: &FrameParams, tuning: &Tuning) -> Vec<[f32; 4]> {
    let declaration = s.executor().denoiser().declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        if !["roughness", "specular_hit_distance"].contains(&name) {
            s.upload(name, texels).expect(name);
        }
    }
    if declaration.find("surface_id").is_some() {
        s.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
    }
    s.run(params, tuning).expect("frame");
    assert_valid();
    s.download("denoised_radiance").expect("denoised_radiance")
}

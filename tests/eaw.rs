//! The preset `eaw`: single frames, each weight, sub-sampled input.

use super::support::{assert_valid, frame, pixels, rmse, scene::Guides, scene::Scene, session};
use atrous::config::{EawWeights, Preset, Sampling};
use atrous::{Config, Tuning, UseFrame};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("each_weight_improves_a_single_frame", each_weight_improves_a_single_frame),
    ("no_frame_depends_on_the_one_before", no_frame_depends_on_the_one_before),
    ("nothing_survives_the_frame", nothing_survives_the_frame),
    ("sub_sampled_input_is_painted_in", sub_sampled_input_is_painted_in),
];

const EXTENT: [u32; 2] = [160, 90];

fn config() -> Config {
    Config { preset: Preset::Eaw, ..Config::new(EXTENT) }
}

fn denoise(config: &Config, g: &Guides, scene: &Scene) -> Vec<[f32; 4]> {
    frame(&mut session(config), g, &scene.params(0), &Tuning::default()).1
}

/// [EAW] Figure 4.
fn each_weight_improves_a_single_frame() {
    let scene = Scene::new(EXTENT);
    let g = scene.frame(0, 1);
    let noisy = rmse(&g.noisy_radiance, &g.clean);
    let errors = [0, 1, 2, 3].map(|count| {
        let config = Config { eaw_weights: EawWeights::first(count), ..config() };
        rmse(&denoise(&config, &g, &scene), &g.clean)
    });
    println!("noisy {noisy:.4}, with 0 to 3 weights {errors:.4?}");
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    assert!(noisy.powi(2) / errors[3].powi(2) > 10.0, "{noisy} {errors:?}");
}

fn no_frame_depends_on_the_one_before() {
    let scene = Scene { speed: 0.2, ..Scene::new(EXTENT) };
    let mut s = session(&config());
    frame(&mut s, &scene.frame(0, 0), &scene.params(0), &Tuning::default());
    let (_, after) = frame(&mut s, &scene.frame(3, 7), &scene.params(3), &Tuning::default());
    let (_, alone) = frame(&mut session(&config()), &scene.frame(3, 7), &scene.params(3), &Tuning::default());
    assert_eq!(after, alone);
    assert_valid();
}

fn nothing_survives_the_frame() {
    let declaration = config().declare().expect("valid");
    // But for the unit in which light is counted: one texel, in two copies.
    assert_eq!(declaration.memory().history, 8);
    let is_unit = |name: &str| name == "filter_exposure";
    let kept: Vec<_> = declaration.resources().iter().filter(|r| r.lifetime.is_history()).map(|r| r.name.as_str()).collect();
    assert_eq!(kept, ["filter_exposure"]);
    let uses = declaration.passes().iter().flat_map(|p| &p.uses);
    let before = uses.filter(|u| u.frame != UseFrame::Current).map(|u| declaration.resource(u.resource).name.as_str());
    assert!(before.into_iter().all(is_unit));
}

fn sub_sampled_input_is_painted_in() {
    let scene = Scene { noise: 0.2, ..Scene::new(EXTENT) };
    let full = scene.frame(0, 1);
    for (sampling, side) in [(Sampling::OneOf2x2, 2), (Sampling::OneOf4x4, 4)] {
        let mut g = full.clone();
        for (x, y) in pixels(EXTENT).filter(|(x, y)| x % side != 0 || y % side != 1) {
            g.noisy_radiance[(y * EXTENT[0] + x) as usize] = [f32::NAN; 4];
        }
        let mut s = session(&Config { sampling, ..config() });
        let (_, image) = frame(&mut s, &g, &scene.params(0), &Tuning::default());
        let counted = s.download("statistics").expect("statistics")[3][0];
        let error = rmse(&image, &full.clean);
        let of_all = rmse(&denoise(&config(), &full, &scene), &full.clean);
        println!("{sampling:?}: error {error:.4}, of all samples {of_all:.4}");
        assert_eq!(counted, 0.0, "holes are no bad values");
        assert!(image.iter().all(|t| t[0] > 0.0), "a hole is left");
        // Of side² pixels one has a sample: the noise is `side` times as large.
        assert!(error < f64::from(side) * of_all, "{error} {of_all}");
    }
}

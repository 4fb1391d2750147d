//! What a host gets that asks for nothing.

use super::support::{assert_finite, assert_valid, rmse, scene::Scene, session, warnings};
use atrous::config::Preset;
use atrous::{Config, Lifetime, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_host_with_the_least_inputs_gets_best", a_host_with_the_least_inputs_gets_best),
    ("light_that_changes_is_seen_without_samples_of_the_host", light_that_changes_is_seen_without_samples_of_the_host),
];

const EXTENT: [u32; 2] = [96, 54];
/// Those that a host has to give, but for its ids.
const NEEDED: [&str; 3] = ["depth", "normal", "noisy_radiance"];

/// The error of the last of some frames, whose light is `light(frame)`, filtered with the inputs that are named; and that of the noisy
/// one. Nothing else is asked of the host, which shades nothing again.
fn errors(config: &Config, given: &[&str], frames: u32, light: impl Fn(u32) -> f32) -> [f64; 2] {
    let (mut s, mut errors) = (session(config), [f64::NAN; 2]);
    for i in 0..frames {
        let scene = Scene { speed: 0.03, light: light(i), ..Scene::new(EXTENT) };
        let guides = scene.frame(i, i);
        for (name, texels) in guides.images().into_iter().filter(|(name, _)| given.contains(name)) {
            s.upload(name, texels).expect(name);
        }
        s.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
        s.run(&scene.params(i), &Tuning::default()).expect("a frame");
        let image = s.download("denoised_radiance").expect("an output");
        assert_finite(&image, EXTENT, EXTENT);
        errors = [rmse(&image, &guides.clean), rmse(&guides.noisy_radiance, &guides.clean)];
    }
    assert_valid();
    errors
}

fn a_host_with_the_least_inputs_gets_best() {
    let (before, config) = (warnings().len(), Config::new(EXTENT));
    assert_eq!((config.preset, Preset::default()), (Preset::Best, Preset::Best));
    assert_eq!(Tuning::default(), Tuning::for_preset(config.preset));
    let declaration = config.declare().expect("valid");
    let needed = declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Input { optional: false });
    assert_eq!(needed.map(|r| r.name.as_str()).filter(|name| *name != "surface_id").collect::<Vec<_>>(), NEEDED);
    // Without albedo textures blur with the noise.
    for (more, share) in [(&[][..], 0.75), (&["motion", "albedo"], 0.25)] {
        let [error, noisy] = errors(&config, &[&NEEDED, more].concat(), 12, |_| 1.0);
        println!("{error:.4} of {noisy:.4}, with {more:?} besides");
        assert!(error < share * noisy, "{error} of {noisy}, with {more:?} besides");
    }
    assert_eq!(warnings()[before..], [] as [String; 0]);
}

fn light_that_changes_is_seen_without_samples_of_the_host() {
    let given = [&NEEDED[..], &["motion", "albedo"]].concat();
    for (what, on) in [("comes on", 4.0), ("goes out", 0.2)] {
        let of = |preset| errors(&Config { preset, ..Config::new(EXTENT) }, &given, 14, |i| if i < 12 { 1.0 } else { on });
        let ([best, _], [svgf, _]) = (of(Preset::default()), of(Preset::Svgf));
        println!("a light that {what}: {best:.4}, svgf {svgf:.4}");
        assert!(best < 0.5 * svgf, "a light that {what}: {best}, svgf {svgf}");
    }
}

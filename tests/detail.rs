//! Fine structure that no guide knows, which noise does not explain: it is no longer filtered away, and noise of the same spread is.

use super::support::{frame, scene, scene::Guides, scene::Scene, session, upload_to_engine};
use atrous::config::Preset;
use atrous::reference::Engine;
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;
use std::ops::Range;

pub const TESTS: &[DeviceTest] = &[
    ("structure_stays_and_noise_of_its_spread_does_not", structure_stays_and_noise_of_its_spread_does_not),
    ("beside_noise_the_twin_has_the_same_detail", beside_noise_the_twin_has_the_same_detail),
    ("little_of_a_structure_that_noise_hides_stays", little_of_a_structure_that_noise_hides_stays),
];

const EXTENT: [u32; 2] = [48, 36];
const PIXELS: u32 = EXTENT[0] * EXTENT[1];
const FRAMES: u32 = 4;
const LIGHT: f32 = 2.0;

/// Light of a wall, of which each pixel has its own from frame to frame in the columns that are `steady`, but for `noise`.
struct Wall {
    steady: Range<u32>,
    noise: f32,
}

const ALL: Range<u32> = 0..EXTENT[0];
const NONE: Range<u32> = 0..0;

impl Wall {
    fn structure(&self, pixel: u32, frame: u32) -> f32 {
        let is_steady = self.steady.contains(&(pixel % EXTENT[0]));
        scene::random(pixel, if is_steady { 0 } else { frame }, 0) - 0.5
    }

    fn frame(&self, index: u32) -> Guides {
        let mut guides = Scene::new(EXTENT).frame(0, 0);
        guides.depth.fill([10.0; 4]);
        guides.normal.fill([0.0, 0.0, 1.0, 0.0]);
        guides.surface_id.fill(1);
        guides.albedo.fill([1.0; 4]);
        let light = |pixel| LIGHT + self.structure(pixel, index) + self.noise * (scene::random(pixel, index, 1) - 0.5);
        guides.noisy_radiance = (0..PIXELS).map(|pixel| [light(pixel); 4]).collect();
        guides
    }

    /// The last of its frames, of which no history is longer than one.
    fn denoised(&self, preset: Preset) -> Vec<[f32; 4]> {
        let mut s = session(&Config { preset, ..Config::new(EXTENT) });
        let denoised = (0..FRAMES).map(|i| frame(&mut s, &self.frame(i), &Scene::new(EXTENT).params(0), &forgetful()).1);
        denoised.last().expect("frames")
    }

    /// The share of the structure that is left: noise that is left as well does not count.
    fn left(&self, preset: Preset) -> f32 {
        let image = self.denoised(preset);
        let is_inner = |i: &usize| (6..42).contains(&(i % EXTENT[0] as usize)) && (6..30).contains(&(i / EXTENT[0] as usize));
        let inner = || (0..image.len()).filter(is_inner).map(|i| [image[i][0] - LIGHT, self.structure(i as u32, FRAMES - 1)]);
        inner().map(|[light, structure]| light * structure).sum::<f32>()
            / inner().map(|[_, structure]| structure * structure).sum::<f32>()
    }
}

fn forgetful() -> Tuning {
    Tuning { alpha: 1.0, alpha_moments: 1.0, ..Tuning::default() }
}

fn structure_stays_and_noise_of_its_spread_does_not() {
    for preset in [Preset::Best, Preset::Fast] {
        let [structure, noise] = [ALL, NONE].map(|steady| Wall { steady, noise: 0.05 }.left(preset));
        assert!(structure > 0.85, "{preset}: {structure}");
        assert!(noise < 0.2, "{preset}: {noise}");
    }
}

fn little_of_a_structure_that_noise_hides_stays() {
    let [clear, mixed, hidden] = [0.1, 0.25, 2.0].map(|noise| Wall { steady: ALL, noise }.left(Preset::Fast));
    assert!(clear > mixed && mixed > hidden, "{clear}, {mixed}, {hidden}");
    assert!(hidden < 0.2, "{hidden}");
}

fn beside_noise_the_twin_has_the_same_detail() {
    let wall = Wall { steady: 0..24, noise: 0.1 };
    let config = Config { preset: Preset::Fast, ..Config::new(EXTENT) };
    let mut engine = Engine::new(config.declare().expect("valid")).expect("twins");
    for i in 0..FRAMES {
        upload_to_engine(&mut engine, &wall.frame(i));
        engine.run(&Scene::new(EXTENT).params(0), &forgetful()).expect("a frame");
    }
    let (twin, image) = (engine.download("denoised_radiance").expect("denoised_radiance"), wall.denoised(Preset::Fast));
    let difference = twin.iter().zip(&image).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
    assert!(difference < 0.01, "{difference}");
}

//! Jitter for an upscaler behind the denoiser, and guides of several samples a pixel.

use super::support::{assert_valid, frame, pixels, rmse, scene::Guides, scene::Scene, session};
use atrous::config::Preset;
use atrous::{Config, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("jittered_frames_have_the_detail_that_an_upscaler_gathers", jittered_frames_have_the_detail_that_an_upscaler_gathers),
    ("several_samples_a_pixel_may_have_the_guides_of_one_or_means", several_samples_a_pixel_may_have_the_guides_of_one_or_means),
];

const EXTENT: [u32; 2] = [96, 54];
const FRAMES: u32 = 32;

/// Where the sample of a frame lies in each of 2×2 parts of its pixel.
const JITTER: [[f32; 2]; 4] = [[-0.25, -0.25], [0.25, 0.25], [0.25, -0.25], [-0.25, 0.25]];

/// Runs frames with the jitter of each, and puts every pixel where its sample lies in a picture of twice the size, over the last four
/// frames: what an upscaler makes of still frames.
fn upscaled(jitter: impl Fn(u32) -> [f32; 2]) -> Vec<[f32; 4]> {
    let config = Config { preset: Preset::Best, ..Config::new(EXTENT) };
    let mut s = session(&config);
    let wide = EXTENT[0] * 2;
    let mut picture = vec![[0.0; 4]; (wide * EXTENT[1] * 2) as usize];
    for i in 0..FRAMES {
        let scene = Scene { jitter: jitter(i), ..Scene::new(EXTENT) };
        let (_, image) = frame(&mut s, &scene.frame(0, i), &scene.params(0), &Tuning::for_preset(Preset::Best));
        for (x, y) in pixels(EXTENT) {
            let part = JITTER[(i % 4) as usize].map(|j| u32::from(j > 0.0));
            let to = (2 * y + part[1]) * wide + 2 * x + part[0];
            picture[to as usize] = image[(y * EXTENT[0] + x) as usize];
        }
    }
    picture
}

fn jittered_frames_have_the_detail_that_an_upscaler_gathers() {
    let reference = Scene { noise: 0.0, ..Scene::new(EXTENT.map(|side| 2 * side)) }.frame(0, 0).clean;
    let jittered = rmse(&upscaled(|i| JITTER[(i % 4) as usize]), &reference);
    let enlarged = rmse(&upscaled(|_| [0.0; 2]), &reference);
    println!("error at twice the extent: with jitter {jittered:.4}, without {enlarged:.4}");
    assert!(jittered < 0.5 * enlarged, "{jittered} {enlarged}");
    assert_valid();
}

/// Four samples a pixel. Radiance and albedo are their means; the guides are those of one of them, or means as well.
struct Resolved {
    guides: Guides,
    /// Pixels whose samples show more than one thing.
    is_edge: Vec<bool>,
}

fn resolved(index: u32, mean_guides: bool) -> Resolved {
    let samples = JITTER.map(|jitter| Scene { jitter, ..moving() }.frame(index, index));
    let mean = |of: &dyn Fn(&Guides) -> &Vec<[f32; 4]>| -> Vec<[f32; 4]> {
        let texel = |i: usize| [0, 1, 2, 3].map(|c| samples.iter().map(|s| of(s)[i][c]).sum::<f32>() / 4.0);
        (0..samples[0].depth.len()).map(texel).collect()
    };
    let id = |sample: usize, i: usize| samples[sample].surface_id[i];
    let is_edge = (0..samples[0].depth.len()).map(|i| (1..4).any(|sample| id(sample, i) != id(0, i))).collect();
    let one = samples[0].clone();
    let mut guides =
        Guides { noisy_radiance: mean(&|g| &g.noisy_radiance), clean: mean(&|g| &g.clean), albedo: mean(&|g| &g.albedo), ..one };
    if mean_guides {
        (guides.depth, guides.normal, guides.motion) = (mean(&|g| &g.depth), mean(&|g| &g.normal), mean(&|g| &g.motion));
    }
    Resolved { guides, is_edge }
}

fn moving() -> Scene {
    Scene { speed: 0.06, ..Scene::new(EXTENT) }
}

fn several_samples_a_pixel_may_have_the_guides_of_one_or_means() {
    let measure = |preset: Preset, mean_guides: bool| {
        let mut s = session(&Config { preset, ..Config::new(EXTENT) });
        let mut error = 0.0;
        for i in 0..FRAMES {
            let Resolved { guides, is_edge } = resolved(i, mean_guides);
            let (_, image) = frame(&mut s, &guides, &moving().params(i), &Tuning::for_preset(preset));
            let edges = |texels: &[[f32; 4]]| -> Vec<_> { texels.iter().zip(&is_edge).filter(|e| *e.1).map(|e| *e.0).collect() };
            if i >= FRAMES / 2 {
                error += rmse(&edges(&image), &edges(&guides.clean)) / f64::from(FRAMES / 2);
            }
        }
        (error, s.statistics().expect("counters"))
    };
    for preset in [Preset::Svgf, Preset::Best] {
        let ((of_one, lost), (of_means, lost_by_means)) = (measure(preset, false), measure(preset, true));
        println!("{preset}, error at edges: guides of one sample {of_one:.4}, means of four {of_means:.4}");
        assert!((of_means / of_one - 1.0).abs() < 0.25, "{preset}: {of_one} {of_means}");
        for statistics in [lost, lost_by_means] {
            assert!(statistics.history_lost() * 100 < statistics.history_sought(), "{preset}: {statistics:?}");
        }
    }
}

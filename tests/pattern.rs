//! The synthetic pattern of [SVGF] Fig. 9: what the temporal estimate of variance keeps and the spatial one blurs.

use super::support::{assert_valid, random, scene::Scene, session_with, svgf, svgf_tuning, upload};
use atrous::executor::{Session, SessionOptions};
use atrous::FrameContext;
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[("temporal_variance_keeps_stripes_that_spatial_variance_blurs", stripes)];

const EXTENT: [u32; 2] = [120, 48];
const STRIPE: u32 = 5;
const QUIET: f32 = 0.6;

/// `f(x, a)` of the figure: 0 below `a`, else 1/(1 − a). Its mean is 1 for every `a`, its variance a/(1 − a).
fn pattern(x: f32, a: f32) -> f32 {
    if x < a {
        0.0
    } else {
        1.0 / (1.0 - a)
    }
}

fn is_quiet(y: u32) -> bool {
    (y / STRIPE) % 2 == 1
}

/// Rows of stripes: the figure's noise, with `a` growing from left to right, between rows without any noise.
fn image(seed: u32) -> Vec<[f32; 4]> {
    super::support::pixels(EXTENT)
        .map(|(x, y)| {
            let a = 0.9 * x as f32 / EXTENT[0] as f32;
            let value = if is_quiet(y) { QUIET } else { pattern(random(x, y, seed), a) };
            [value, value, value, 1.0]
        })
        .collect()
}

/// The middle rows of the stripes that are quiet or not, over the noisier right half.
fn middles(quiet: bool) -> impl Iterator<Item = usize> {
    let rows = (0..EXTENT[1]).filter(move |&y| is_quiet(y) == quiet && y % STRIPE == STRIPE / 2);
    rows.flat_map(|y| (EXTENT[0] / 2..EXTENT[0]).map(move |x| (y * EXTENT[0] + x) as usize))
}

fn mean(indices: impl Iterator<Item = usize>, value: impl Fn(usize) -> f32) -> f32 {
    let values: Vec<f32> = indices.map(value).collect();
    values.iter().sum::<f32>() / values.len() as f32
}

/// How far the estimated deviation tells noisy stripes from quiet ones: 1 entirely, 0 not at all.
fn contrast(deviation: &[[f32; 4]]) -> f32 {
    let (quiet, noisy) = (mean(middles(true), |i| deviation[i][3]), mean(middles(false), |i| deviation[i][3]));
    (noisy - quiet) / (noisy + quiet)
}

fn stripes() {
    let scene = Scene::new(EXTENT);
    let mut guides = scene.frame(0, 0);
    // One flat wall: nothing but luminance can stop the filter.
    guides.depth.fill([2.0; 4]);
    guides.normal.fill([0.0, 0.0, 1.0, 0.0]);
    guides.albedo.fill([1.0; 4]);
    guides.surface_id.fill(1);
    let mut s = session_with(&svgf(EXTENT), SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    let declaration = s.executor().denoiser().declaration();
    let variance = declaration.passes().iter().position(|p| p.name == "variance").expect("a pass");
    let estimate = declaration.passes()[variance].use_of("estimate_0").expect("written").resource;
    let estimate = declaration.resource(estimate).name.clone();
    let (mut contrasts, mut blurs) = (Vec::new(), Vec::new());
    for i in 0..16 {
        guides.noisy_radiance = image(i);
        upload(&mut s, &guides);
        let trace = &mut |s: &mut Session, _: &FrameContext, pass: usize, done: bool| {
            if pass == variance && done {
                contrasts.push(contrast(&s.download(&estimate)?));
            }
            Ok(())
        };
        s.run_traced(&scene.params(0), &svgf_tuning(), trace).expect("frame");
        let output = s.download("denoised_radiance").expect("output");
        blurs.push(mean(middles(true), |i| (output[i][0] - QUIET).abs()));
    }
    assert_valid();
    println!("contrast of the estimate: spatial {:.3}, temporal after 16 frames {:.3}", contrasts[0], contrasts[15]);
    println!("departure of quiet stripes from {QUIET}: {:.4} at first, {:.4} after 16 frames", blurs[0], blurs[15]);
    assert!(contrasts[0] < 0.5, "the spatial estimate was expected to blur: {contrasts:?}");
    assert!(contrasts[15] > 0.95, "the temporal estimate was expected to keep the stripes: {contrasts:?}");
    assert!(blurs[0] > 0.1, "{blurs:?}");
    // The 3x3 blur of the variance lets noise creep in from the sides by one pixel a level, so some blur remains.
    assert!(blurs[15] < blurs[0] / 2.0, "{blurs:?}");
}

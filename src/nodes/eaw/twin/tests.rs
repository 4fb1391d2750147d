//! The kernel, each weight on its own, holes.

use super::*;
use crate::config::{EawWeights, Sampling};
use crate::reference::holes::HOLE;
use crate::reference::test_scene::*;
use crate::{Config, FrameParams};

const EXTENT: [u32; 2] = [24, 20];

/// The first `weights` edge functions, for an input of `sampling`.
#[derive(Clone, Copy)]
struct Settings {
    weights: u32,
    sampling: Sampling,
    tuning: Tuning,
}

fn of(weights: u32, sampling: Sampling) -> Settings {
    Settings { weights, sampling, tuning: svgf_tuning() }
}

fn run(s: &Settings, level: u32, surfaces: impl Fn(i32, i32) -> Surface, input: &Image<[f32; 4]>) -> Image<[f32; 4]> {
    let params = FrameParams { clip_from_view: perspective(EXTENT).to_cols_array_2d(), ..FrameParams::new(EXTENT) };
    let frame = frame_with(&Config::new(EXTENT), &params, &params);
    let inputs = EawInputs {
        guide: &guides(EXTENT, surfaces).guide,
        irradiance: &[input],
        weights: EawWeights::first(s.weights),
        filling_levels: s.sampling as u32,
    };
    eaw(&frame, &s.tuning, level, &inputs).remove(0)
}

fn at(image: &Image<[f32; 4]>, x: i32, y: i32) -> f32 {
    image.get(x, y).expect("inside")[0]
}

#[test]
fn without_weights_it_is_the_spline() {
    let impulse = paint(EXTENT, |x, y| if (x, y) == (12, 10) { [1.0, 1.0, 1.0, 0.0] } else { [0.0; 4] });
    for level in 0..2 {
        let (output, step) = (run(&of(0, Sampling::Full), level, |_, _| surface(2.0), &impulse), 1 << level);
        for (i, kernel) in KERNEL.iter().enumerate() {
            let value = at(&output, 12 + (i as i32 - 2) * step, 10);
            assert!((value - kernel * 0.375).abs() < 1e-4, "level {level}, {i}: {value}");
        }
    }
}

#[test]
fn each_weight_stops_at_its_own_edge() {
    let bright = |x: i32| if x < 12 { 0.0 } else { 60.0 };
    let input = paint(EXTENT, |x, _| [bright(x), bright(x), bright(x), 0.0]);
    let turned = |x: i32, _| if x < 12 { surface(2.0) } else { Surface { normal: [1.0, 0.0, 0.0], ..surface(2.0) } };
    let far = |x: i32, _| if x < 12 { surface(2.0) } else { surface(4.0) };
    let leak =
        |weights, surfaces: &dyn Fn(i32, i32) -> Surface| at(&run(&of(weights, Sampling::Full), 0, surfaces, &input), 11, 10);
    assert!(leak(0, &|_, _| surface(2.0)) > 10.0);
    assert!(leak(1, &|_, _| surface(2.0)) < 1e-3);
    let dim = input.map(|t| t.map(|v| v / 60.0));
    let leak = |weights, surfaces: &dyn Fn(i32, i32) -> Surface| at(&run(&of(weights, Sampling::Full), 0, surfaces, &dim), 11, 10);
    assert!(leak(1, &turned) > 0.1 && leak(2, &turned) < 1e-3);
    assert!(leak(2, &far) > 0.1 && leak(3, &far) < 1e-3);
}

#[test]
fn holes_are_painted_in_from_samples_alone() {
    for (sampling, side) in [(Sampling::OneOf2x2, 2), (Sampling::OneOf4x4, 4)] {
        let settings = of(3, sampling);
        let input = paint(EXTENT, |x, y| if x % side == 1 && y % side == 0 { [0.5, 0.5, 0.5, 0.0] } else { [0.0, 0.0, 0.0, HOLE] });
        let surfaces = |x: i32, y: i32| if y < 3 { Surface::default() } else { surface(2.0 + x as f32 * 0.01) };
        let output = run(&settings, 1, surfaces, &run(&settings, 0, surfaces, &input));
        assert!(output.texels().iter().all(|t| (t[0] - 0.5).abs() < 1e-3 && t[3] == 0.0), "{sampling:?}");
    }
}

#[test]
fn a_hole_that_sees_nothing_of_its_kind_takes_what_there_is() {
    let settings = of(3, Sampling::OneOf4x4);
    let lonely = |x: i32, y: i32| if (x, y) == (10, 10) { surface(90.0) } else { surface(2.0) };
    let input = paint(EXTENT, |x, y| if (x, y) == (10, 10) { [0.0, 0.0, 0.0, HOLE] } else { [0.5, 0.5, 0.5, 0.0] });
    assert!((at(&run(&settings, 0, lonely, &input), 10, 10) - 0.5).abs() < 1e-3);
}

#[test]
fn extreme_depths_and_radiances_stay_finite() {
    let surfaces = |x: i32, y: i32| surface([1e-30, 1e-3, 1.0, 1e20, 3e38][(x * 3 + y) as usize % 5]);
    let input = noise(EXTENT, 2).map(|t| t.map(|v| if v > 0.5 { 65504.0 } else { 0.0 }));
    let settings = Settings { tuning: Tuning { eaw_sigma_radiance: 1e-4, ..svgf_tuning() }, ..of(3, Sampling::Full) };
    for level in [0, 9] {
        assert!(all_finite(&run(&settings, level, surfaces, &input.map(|t| [t[0], t[1], t[2], 0.0]))));
    }
}

//! Fixed points, jitter, light that changes, what is followed and what is dropped, and pictures larger than what is rendered.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_surface_motion, round_to_half};
use crate::{Config, FrameParams};

const EXTENT: [u32; 2] = [12, 10];
const OUTPUT: [u32; 2] = [24, 25];

/// Numbers under which a past that moves weighs as much as nine samples, and is hardly clipped.
fn long_past() -> Tuning {
    Tuning { taa_alpha: 0.1, taa_gamma: 8.0, ..svgf_tuning() }
}

/// A frame whose output has an extent of its own, before and now.
fn frame_to(render: [u32; 2], output: [u32; 2]) -> FrameConstants {
    let config = Config { output_extent: Some(output), ..Config::new(render) };
    frame_with(&config, &FrameParams::new(render), &FrameParams::new(render))
}

fn tuned(
    frame: &FrameConstants,
    tuning: &Tuning,
    guides: &Guides,
    radiance: &Image<[f32; 4]>,
    previous: Option<&Image<Kept>>,
) -> Upscaled {
    let (guide, motion) = (&guides.guide, Motion::Stored(&guides.surface_motion));
    let inputs = UpscaleInputs { radiance: &[radiance], albedo: None, tone_mapped: false, guide, motion, previous };
    temporal_upscale(frame, tuning, frame.output_extent, Outgoing::Halves, &inputs)
}

fn run(frame: &FrameConstants, guides: &Guides, radiance: &Image<[f32; 4]>, previous: Option<&Image<Kept>>) -> Upscaled {
    tuned(frame, &svgf_tuning(), guides, radiance, previous)
}

fn flat(extent: [u32; 2]) -> Guides {
    guides(extent, |_, _| surface(4.0))
}

fn are_finite(history: &Image<Kept>) -> bool {
    history.texels().iter().all(|kept| kept.even.is_finite() && kept.weight.is_finite())
}

fn largest_difference(a: &Image<[f32; 4]>, b: &Image<[f32; 4]>) -> f32 {
    a.texels().iter().flatten().zip(b.texels().iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// A history that shows a colour everywhere, under the light of a radiance without albedo.
fn history_of(
    frame: &FrameConstants,
    guides: &Guides,
    radiance: &Image<[f32; 4]>,
    colour: impl Fn(i32, i32) -> f32,
) -> Image<Kept> {
    let Upscaled { history, picture, .. } = run(&reset(*frame), guides, radiance, None);
    paint(history.extent(), |x, y| {
        let (kept, now) = (history.at(IVec2::new(x, y)), rgb(&picture, IVec2::new(x, y)));
        Kept::new(ratio_of(kept.even) / now * colour(x, y), 100.0, kept.depth)
    })
}

#[test]
fn a_constant_image_is_a_fixed_point() {
    for output in [EXTENT, OUTPUT, [36, 30]] {
        for level in [0.0, 0.02, 1.0, 30000.0] {
            let colour = [0.3, 0.9, 0.001].map(|c: f32| c * level);
            let constant = Image::new(EXTENT, [colour[0], colour[1], colour[2], 1.0]);
            let frame = FrameConstants { jitter: [0.3, -0.4], ..frame_to(EXTENT, output) };
            let mut upscaled = run(&reset(frame), &flat(EXTENT), &constant, None);
            for _ in 0..20 {
                upscaled = run(&frame, &flat(EXTENT), &constant, Some(&upscaled.history));
            }
            // Components of the history have the steps of the largest one.
            let step = colour[1] / 2048.0;
            for texel in upscaled.picture.texels() {
                let is_near = |c: usize| (texel[c] - colour[c]).abs() <= 2e-3 * colour[c] + step.max(2e-7);
                assert!((0..3).all(is_near), "{texel:?} of {colour:?} at {output:?}");
            }
        }
    }
}

#[test]
fn jittered_samples_are_put_back() {
    // A ramp, sampled at centre + jitter: its value at the centre must come out nearer than it went in.
    for jitter in [[0.4, 0.0], [-0.4, 0.0], [0.0, 0.4], [0.25, 0.25]] {
        let ramp = |x: f32, y: f32| 0.03 * x + 0.02 * y + 0.1;
        let sampled = paint(EXTENT, |x, y| [ramp(x as f32 + 0.5 + jitter[0], y as f32 + 0.5 + jitter[1]); 4]);
        let frame = FrameConstants { jitter, ..frame(EXTENT) };
        let picture = run(&reset(frame), &flat(EXTENT), &sampled, None).picture;
        let (raw, put_back, right) = (sampled.at(IVec2::new(5, 5))[0], picture.at(IVec2::new(5, 5))[0], ramp(5.5, 5.5));
        assert!((put_back - right).abs() < 0.7 * (raw - right).abs(), "{jitter:?}: {raw} to {put_back}, right is {right}");
    }
}

#[test]
fn a_sample_weighs_as_much_as_the_past_leaves_it() {
    let grey = Image::new(EXTENT, [0.5; 4].map(round_to_half));
    let checks = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.2 } else { 0.8 }; 4]);
    let p = IVec2::new(5, 5);
    for (motion, longer) in [([0.0, 0.0], STILL_PAST), ([1.0, 0.0], 1.0)] {
        for alpha in [0.1, 0.5] {
            let mut scene = flat(EXTENT);
            scene.surface_motion = Image::new(EXTENT, pack_surface_motion(motion, Some((0.0, [0.0, 0.0, 1.0]))));
            let tuning = Tuning { taa_alpha: alpha, taa_gamma: 8.0, ..svgf_tuning() };
            let frame = frame(EXTENT);
            let history = history_of(&frame, &scene, &checks, |_, _| 0.5);
            // The past is of the light of its own pixel; that of the neighbour, where it moved, is nearly the same.
            let given = tuned(&frame, &tuning, &scene, &checks, Some(&history));
            let past = (1.0 / alpha - 1.0) * longer;
            let around = run(&reset(frame), &scene, &checks, None);
            // With a step of the history's weight.
            assert!(
                (given.history.at(p).weight - past - around.history.at(p).weight).abs() < 0.01 * past + 0.02,
                "{motion:?} {alpha}"
            );
        }
    }
    let first = run(&reset(frame(EXTENT)), &flat(EXTENT), &grey, None);
    let samples = first.history.at(p).weight;
    assert!((0.98..1.02).contains(&samples), "one sample in its middle: {samples}");
}

#[test]
fn light_that_changes_causes_no_lag() {
    let albedo = noise(EXTENT, 3).map(|t| [0.2 + 0.6 * t[0]; 4]);
    let lit = |light: f32| albedo.map(|a| [a[0] * light, a[0] * light, a[0] * light, 1.0]);
    let frame = frame_to(EXTENT, OUTPUT);
    let scene = flat(EXTENT);
    let step = |light: f32, previous: Option<&Image<Kept>>| {
        let (guide, motion) = (&scene.guide, Motion::Stored(&scene.surface_motion));
        let radiance = lit(light);
        let inputs = UpscaleInputs { radiance: &[&radiance], albedo: Some(&albedo), tone_mapped: false, guide, motion, previous };
        temporal_upscale(&frame, &svgf_tuning(), OUTPUT, Outgoing::Halves, &inputs)
    };
    let settle = |light| (0..30).fold(step(light, None), |now, _| step(light, Some(&now.history)));
    for (before, after) in [(0.3, 2.0), (2.0, 0.3)] {
        let (switched, settled) = (step(after, Some(&settle(before).history)), settle(after));
        let error = largest_difference(&switched.picture, &settled.picture) / after;
        assert!(error < 0.05, "{before} to {after}: {error}");
    }
}

#[test]
fn history_is_clipped_to_the_neighbourhood() {
    let dark = Image::new(EXTENT, [0.1, 0.2, 0.1, 1.0].map(round_to_half));
    let ghost = Image::new(EXTENT, Kept::new(Vec3::new(9.0, 0.1, 9.0), 9.0, 4.0));
    let picture = run(&frame(EXTENT), &flat(EXTENT), &dark, Some(&ghost)).picture;
    assert!(largest_difference(&picture, &dark) < 2e-3, "{:?}", picture.texels()[0]);
    let checks = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.1 } else { 0.3 }; 4]);
    let bright = |gamma| {
        let tuning = Tuning { taa_gamma: gamma, taa_alpha: 0.01, ..svgf_tuning() };
        let history = history_of(&frame(EXTENT), &flat(EXTENT), &checks, |_, _| 0.5);
        tuned(&frame(EXTENT), &tuning, &flat(EXTENT), &checks, Some(&history)).picture.at(IVec2::new(5, 5))[0]
    };
    assert!(bright(8.0) > 0.45, "a wide box lets it pass: {}", bright(8.0));
    assert!(bright(1.0) < 0.35, "a narrow one does not: {}", bright(1.0));
}

#[test]
fn a_grey_neighbourhood_keeps_a_history_that_rounding_tinted() {
    let grey = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.4 } else { 0.6 }; 4].map(round_to_half));
    let frame = frame(EXTENT);
    let at = |red: f32| {
        let history = history_of(&frame, &flat(EXTENT), &grey, |_, _| 0.55)
            .map(|kept| Kept::new(ratio_of(kept.even) * Vec3::new(red, 1.0, 1.0), kept.weight, kept.depth));
        tuned(&frame, &long_past(), &flat(EXTENT), &grey, Some(&history)).picture.at(IVec2::new(5, 5))[1]
    };
    let grey = at(1.0);
    assert!(grey > 0.53, "{grey}");
    assert!((at(1.0009) - grey).abs() < 1e-3, "{} for {grey}: the next half must not decide", at(1.0009));
    assert!((at(1.2) - grey).abs() > 0.02, "{} for {grey}: a colour that is there to see is clipped", at(1.2));
}

#[test]
fn history_follows_the_nearest_surface() {
    // A near object moves by 2 pixels to the right: at its edge the background pixel beside it takes the object's motion.
    let mut scene = guides(EXTENT, |x, _| surface(if x < 6 { 2.0 } else { 9.0 }));
    for y in 0..10 {
        for x in 0..6 {
            *scene.surface_motion.get_mut(x, y).expect("inside") = pack_surface_motion([-2.0, 0.0], Some((0.0, [0.0, 0.0, 1.0])));
        }
    }
    let frame = frame(EXTENT);
    let checks = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.1 } else { 0.6 }; 4]);
    let columns = history_of(&frame, &scene, &Image::new(EXTENT, [0.35; 4]), |x, _| 0.05 * x as f32);
    let tuning = Tuning { taa_alpha: 0.01, taa_gamma: 8.0, ..svgf_tuning() };
    let light = run(&reset(frame), &flat(EXTENT), &checks, None);
    let picture = tuned(&frame, &tuning, &scene, &checks, Some(&columns)).picture;
    for (x, column) in [(4, 2.0), (6, 4.0), (7, 7.0), (9, 9.0)] {
        let p = IVec2::new(x, 5);
        let around = (light.picture.at(p)[0]) / ratio_of(light.history.at(p).even).x;
        let (value, expected) = (picture.at(p)[0], 0.05 * column / 0.36 * around);
        assert!((value - expected).abs() < 0.03, "{x}: {value} for {expected}");
    }
}

#[test]
fn a_surface_that_was_not_there_has_no_past() {
    let frame = FrameConstants { jitter: [0.2, 0.1], ..frame_to(EXTENT, OUTPUT) };
    let image = noise(EXTENT, 3);
    let run_after = |before: &dyn Fn(i32, i32) -> f32| {
        let (guide, motion) = (&flat(EXTENT).guide, Motion::Stored(&flat(EXTENT).surface_motion));
        let history = paint(OUTPUT, |x, y| Kept::new(Vec3::ONE, 2.0, before(x, y)));
        let previous = Some(&history);
        let inputs = UpscaleInputs { radiance: &[&image], albedo: None, tone_mapped: false, guide, motion, previous };
        temporal_upscale(&frame, &svgf_tuning(), OUTPUT, Outgoing::Halves, &inputs)
    };
    let first = run(&reset(frame), &flat(EXTENT), &image, None);
    assert_eq!(run_after(&|_, _| 5.0), first);
    assert_ne!(run_after(&|_, _| 4.0), first);
    assert_eq!(run_after(&|_, _| 0.0), first);
    // Jitter hid the near thing from all pixels but those of one sample.
    let after = run_after(&|x, y| if [x / 2, y / 2] == [6, 5] { 4.0 } else { 9.0 });
    let differs = |x: i32, y: i32| after.picture.at(IVec2::new(x, y)) != first.picture.at(IVec2::new(x, y));
    assert!(differs(12, 12) && differs(10, 12) && !differs(4, 12) && !differs(20, 12));
}

/// A near thing covered the left until now, and its outline is still in the history of what it uncovers.
#[test]
fn what_was_just_uncovered_keeps_little_of_the_colour_beside_it() {
    let (frame, image) = (frame_to(EXTENT, OUTPUT), noise(EXTENT, 3));
    let (guide, motion) = (&flat(EXTENT).guide, Motion::Stored(&flat(EXTENT).surface_motion));
    // The history has the depth of the nearest surface around, so the outline belongs to the near thing.
    let covered = |x: i32| if x < 14 { 2.0 } else { 4.0 };
    let history = paint(OUTPUT, |x, _| Kept::new(Vec3::splat(50.0), 2.0, covered(x)));
    let previous = Some(&history);
    let inputs = UpscaleInputs { radiance: &[&image], albedo: None, tone_mapped: false, guide, motion, previous };
    let after = temporal_upscale(&frame, &svgf_tuning(), OUTPUT, Outgoing::Halves, &inputs).picture;
    let brightest = |x: i32| (2..OUTPUT[1] as i32 - 2).map(|y| after.at(IVec2::new(x, y))[1]).fold(0.0, f32::max);
    let (beside, away) = (brightest(12), brightest(18));
    assert!(beside < 0.6 * away, "{beside} beside the outline, {away} away from it");
}

#[test]
fn off_screen_and_reset_take_the_current_colour() {
    for output in [EXTENT, OUTPUT] {
        let image = noise(EXTENT, 3);
        let poison = Image::new(output, Kept { even: Vec3::NAN, weight: f32::NAN, depth: 4.0 });
        let frame = frame_to(EXTENT, output);
        let first = run(&frame, &flat(EXTENT), &image, None);
        assert!(all_finite(&first.picture) && are_finite(&first.history));
        assert_eq!(run(&reset(frame), &flat(EXTENT), &image, Some(&poison)), first);
        let mut away = flat(EXTENT);
        away.surface_motion = Image::new(EXTENT, pack_surface_motion([16384.0, 0.0], None));
        assert_eq!(run(&frame, &away, &image, Some(&poison)), first);
    }
}

#[test]
fn absurd_light_stays_finite() {
    for output in [EXTENT, OUTPUT] {
        let frame = frame_to(EXTENT, output);
        for light in [f32::MAX, -f32::MAX, 65504.0, 1e-30, f32::INFINITY] {
            let image = paint(EXTENT, |x, y| [if (x + y) % 3 == 0 { light } else { 0.5 }; 4]);
            let first = run(&reset(frame), &flat(EXTENT), &image, None);
            let second = run(&frame, &flat(EXTENT), &image, Some(&first.history));
            for upscaled in [first, second] {
                assert!(all_finite(&upscaled.picture) && are_finite(&upscaled.history), "{light} at {output:?}");
                // What is no number would be stored as black.
                assert!(upscaled.picture.texels().iter().all(|t| t[0] > 0.0), "{light} at {output:?}");
            }
        }
    }
}

#[test]
fn neither_parity_nor_the_allocation_changes_a_bit() {
    let large = [29, 23];
    let image = noise(EXTENT, 4);
    let history = noise(EXTENT, 5).map(|t| Kept::new(Vec3::new(t[0], t[1], t[2]), 2.0, 4.0));
    let mut tight = flat(EXTENT);
    tight.surface_motion = Image::new(EXTENT, pack_surface_motion([0.75, -3.5], None));
    let loose =
        Guides { guide: embed(&tight.guide, large, [0x7fff; 4]), surface_motion: embed(&tight.surface_motion, large, [0x7e00; 4]) };
    let expected = run(&frame(EXTENT), &tight, &image, Some(&history));
    let in_large = FrameConstants {
        render_extent: EXTENT,
        previous_render_extent: EXTENT,
        output_extent: EXTENT,
        previous_output_extent: EXTENT,
        frame_index: 1,
        ..frame(large)
    };
    let image = embed(&image, large, [f32::NAN; 4]);
    let history = embed(&history, large, Kept { even: Vec3::NAN, weight: f32::NAN, depth: 4.0 });
    assert_eq!(run(&in_large, &loose, &image, Some(&history)), expected);
}

/// Frames of a still picture under jitter, with or without a past. `render(i)`: the extent of frame i.
fn gathered(
    output: [u32; 2],
    keeps: bool,
    render: impl Fn(u32) -> [u32; 2],
    picture: impl Fn(Vec2) -> f32,
) -> Vec<Image<[f32; 4]>> {
    let frames = 48;
    let largest = output;
    let config = Config { output_extent: Some(output), ..Config::new(render(0)) };
    let mut state = crate::FrameState::default();
    let mut past: Option<Image<Kept>> = None;
    let radical = |base: u32, i: u32| {
        let (mut i, mut f, mut r) = (i + 1, 1.0, 0.0);
        while i > 0 {
            f /= base as f32;
            r += f * (i % base) as f32;
            i /= base;
        }
        r - 0.5
    };
    let mut pictures = Vec::new();
    for i in 0..frames {
        let extent = render(i);
        let jitter = [radical(2, i % 8), radical(3, i % 8)];
        let params = FrameParams { jitter, ..FrameParams::new(extent) };
        let frame = state.begin(&crate::Setup { allocated_extent: largest, ..config.setup() }, &params, &svgf_tuning());
        let frame = frame.expect("valid").constants;
        let scale = extent[0] as f32 / output[0] as f32;
        let image = paint(extent, |x, y| {
            let v = picture((Vec2::new(x as f32, y as f32) + 0.5 + Vec2::from(jitter)) / scale);
            [v, v, v, 1.0]
        });
        let scene = flat(extent);
        let white = Image::new(extent, [1.0; 4]);
        let (guide, motion) = (&scene.guide, Motion::Stored(&scene.surface_motion));
        let previous = past.as_ref().filter(|_| keeps);
        let inputs = UpscaleInputs { radiance: &[&image], albedo: Some(&white), tone_mapped: false, guide, motion, previous };
        let now = temporal_upscale(&frame, &svgf_tuning(), output, Outgoing::Halves, &inputs);
        past = Some(now.history);
        pictures.push(now.picture);
    }
    pictures
}

/// A line of two output pixels that is not quite level, dark before bright.
fn slanted(s: Vec2) -> f32 {
    if (s.y - 10.3 - 0.17 * s.x).abs() < 1.0 {
        0.1
    } else {
        0.9
    }
}

/// Mean of a picture over each pixel.
fn reference(extent: [u32; 2], picture: impl Fn(Vec2) -> f32) -> Image<[f32; 4]> {
    paint(extent, |x, y| {
        let parts = (0..64).map(|i| Vec2::new((i % 8) as f32 + 0.5, (i / 8) as f32 + 0.5) / 8.0);
        [parts.map(|part| picture(Vec2::new(x as f32, y as f32) + part)).sum::<f32>() / 64.0; 4]
    })
}

fn rmse(a: &Image<[f32; 4]>, b: &Image<[f32; 4]>) -> f32 {
    let squares = a.texels().iter().zip(b.texels()).map(|(a, b)| (a[0] - b[0]).powi(2)).sum::<f32>();
    (squares / a.texels().len() as f32).sqrt()
}

#[test]
fn a_thin_line_is_gathered_without_dashes() {
    let (render, output) = ([20, 16], [40, 32]);
    let pictures = gathered(output, true, |_| render, slanted);
    let right = reference(output, slanted);
    let (first, last) = (rmse(&pictures[0], &right), rmse(&pictures[47], &right));
    assert!(last < 0.85 * first, "{first} to {last}");
    // Power at the period of the jitter: what eight frames do not have in common.
    let zipper = |pictures: &[Image<[f32; 4]>]| {
        let last = &pictures[40..];
        let mean = paint(output, |x, y| [last.iter().map(|p| p.at(IVec2::new(x, y))[0]).sum::<f32>() / 8.0; 4]);
        last.iter().map(|p| rmse(p, &mean)).sum::<f32>() / 8.0
    };
    let (with, without) = (zipper(&pictures), zipper(&gathered(output, false, |_| render, slanted)));
    assert!(with < 0.65 * without, "{with} of {without} without a past");
}

#[test]
fn a_render_extent_that_changes_keeps_the_past() {
    let output = [40, 32];
    let steady = gathered(output, true, |_| [20, 16], slanted);
    let changing = gathered(output, true, |i| if i % 3 == 0 { [24, 19] } else { [20, 16] }, slanted);
    let right = reference(output, slanted);
    let [steady, changing] = [&steady[47], &changing[47]].map(|picture| rmse(picture, &right));
    assert!(changing < 1.25 * steady, "{steady} steady, {changing} changing");
}

#[test]
fn colour_transforms_and_filters_are_what_they_claim() {
    for c in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.2, 0.5, 0.9)] {
        assert!(from_ycocg(to_ycocg(c)).distance(c) < 1e-6);
    }
    for t in [0.0, 0.25, 0.5, 0.9] {
        let w = catmull_rom_weights(t);
        assert!((w.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        // It interpolates, and reproduces a parabola.
        let parabola: f32 = w.iter().zip([1.0, 0.0, 1.0, 4.0]).map(|(w, v)| w * v).sum();
        assert!((parabola - t * t).abs() < 1e-6, "{t}");
    }
}

#[test]
fn one_pixel_stays() {
    let image = Image::new([1, 1], [0.25, 0.5, 0.75, 1.0]);
    for output in [[1, 1], [3, 2]] {
        let frame = frame_to([1, 1], output);
        let first = run(&reset(frame), &flat([1, 1]), &image, None);
        let picture = run(&frame, &flat([1, 1]), &image, Some(&first.history)).picture;
        assert!(largest_difference(&picture, &Image::new(output, [0.25, 0.5, 0.75, 1.0])) < 1e-3, "{picture:?}");
    }
}

#[test]
fn an_edge_of_a_lamp_is_as_smooth_as_a_display_shows_it() {
    // A bright half plane, its edge in the middle of the pixels of a column.
    let lamp = |x: f32| if x < 6.0 { 50.0 } else { 0.05 };
    let scene = flat(EXTENT);
    for tone_curve in [ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Linear] {
        let tuning = Tuning { tone_curve, ..svgf_tuning() };
        let show = |c: [f32; 4]| {
            match tone_curve {
                ToneCurve::Aces => c[0].min(1e4) * (2.51 * c[0] + 0.03) / (c[0] * (2.43 * c[0] + 0.59) + 0.14),
                ToneCurve::Reinhard => c[0] / (1.0 + c[0]),
                ToneCurve::Linear => c[0],
            }
            .clamp(0.0, 1.0)
        };
        let at = |tone_mapped: bool| {
            let radiance = paint(EXTENT, |x, _| [lamp(x as f32); 4]);
            let (guide, motion) = (&scene.guide, Motion::Stored(&scene.surface_motion));
            let inputs = UpscaleInputs { radiance: &[&radiance], albedo: None, tone_mapped, guide, motion, previous: None };
            let frame = FrameConstants { jitter: [0.5, 0.0], ..frame(EXTENT) };
            show(temporal_upscale(&reset(frame), &tuning, EXTENT, Outgoing::Halves, &inputs).picture.at(IVec2::new(6, 5)))
        };
        // Half of the samples are of the lamp.
        let (shown, plain, half) = (at(true), at(false), 0.5 * (show([50.0; 4]) + show([0.05; 4])));
        assert!((shown - half).abs() < 0.1, "{tone_curve:?}: {shown} for {half}, {plain} without");
    }
}

#[test]
fn radiance_at_an_edge_of_a_lamp_is_that_of_the_pixel() {
    let extent = [20, 16];
    let lamp = |s: Vec2| if s.y < 6.3 + 0.17 * s.x { 20.0 } else { 0.2 };
    let pictures = gathered(extent, true, |_| extent, lamp);
    let shown = |picture: &Image<[f32; 4]>| picture.map(|c| [c[0] / (1.0 + c[0]); 4]);
    let error = rmse(&shown(&pictures[47]), &shown(&reference(extent, lamp)));
    assert!(error < 0.04, "{error}");
}

#[test]
fn a_lamp_beside_a_pixel_is_not_in_its_radiance() {
    let extent = [20, 16];
    // Its edge lies between two columns of pixels.
    let lamp = |s: Vec2| if s.x < 10.0 { 50.0 } else { 0.05 };
    let picture = &gathered(extent, true, |_| extent, lamp)[47];
    let beside = picture.at(IVec2::new(10, 8))[0];
    assert!(beside < 0.5, "{beside} for 0.05");
}

#[test]
fn a_dark_thing_beside_a_lamp_keeps_its_light() {
    let lamp = |x: i32| if x < 6 { 50.0 } else { 0.05 };
    let mut scene = flat(EXTENT);
    // The past lies between pixels, where the weights of Catmull and Rom are negative.
    scene.surface_motion = Image::new(EXTENT, pack_surface_motion([0.5, 0.0], Some((0.0, [0.0, 0.0, 1.0]))));
    let radiance = paint(EXTENT, |x, _| [lamp(x); 4]);
    let history = paint(EXTENT, |x, _| Kept::new(Vec3::splat(lamp(x)), 100.0, 4.0));
    let (guide, motion) = (&scene.guide, Motion::Stored(&scene.surface_motion));
    let previous = Some(&history);
    let inputs = UpscaleInputs { radiance: &[&radiance], albedo: None, tone_mapped: true, guide, motion, previous };
    let picture = temporal_upscale(&frame(EXTENT), &long_past(), EXTENT, Outgoing::Halves, &inputs).picture;
    for x in 0..EXTENT[0] as i32 {
        let shown = picture.at(IVec2::new(x, 5))[0];
        assert!((0.045..51.0).contains(&shown), "{shown} at {x}");
    }
}

#[test]
fn a_dark_gradient_has_no_bands() {
    // A ramp that rises by less than a step of the history in a pixel.
    let output = [64, 8];
    let ramp = |s: Vec2| 0.02 * (1.0 + 0.01 * s.x / 64.0);
    let pictures = gathered(output, true, |_| [32, 4], ramp);
    let last = &pictures[47];
    let at = |x: i32| (2..6).map(|y| last.at(IVec2::new(x, y))[0]).sum::<f32>() / 4.0;
    // A step of an 8-bit display is 0.0003 there, after its curve.
    for x in 2..62 {
        let (shown, right) = (at(x), ramp(Vec2::new(x as f32 + 0.5, 4.0)));
        assert!((shown - right).abs() < 0.001 * right, "{shown} at {x} for {right}");
    }
}

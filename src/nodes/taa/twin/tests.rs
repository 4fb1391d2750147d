//! Fixed points, convergence, jitter, clipping, what is followed.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_surface_motion, round_to_half};

const EXTENT: [u32; 2] = [12, 10];

fn run(
    frame: &FrameConstants,
    guides: &Guides,
    tone_mapped: &Image<[f32; 4]>,
    previous: Option<&Image<[f32; 4]>>,
) -> Image<[f32; 4]> {
    tuned(frame, &svgf_tuning(), guides, tone_mapped, previous)
}

fn tuned(
    frame: &FrameConstants,
    tuning: &Tuning,
    guides: &Guides,
    tone_mapped: &Image<[f32; 4]>,
    previous: Option<&Image<[f32; 4]>>,
) -> Image<[f32; 4]> {
    taa(frame, tuning, &TaaInputs { tone_mapped, guide: &guides.guide, surface_motion: &guides.surface_motion, previous })
}

fn flat(extent: [u32; 2]) -> Guides {
    guides(extent, |_, _| surface(4.0))
}

fn largest_difference(a: &Image<[f32; 4]>, b: &Image<[f32; 4]>) -> f32 {
    a.texels().iter().flatten().zip(b.texels().iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_constant_image_is_a_fixed_point() {
    let constant = Image::new(EXTENT, [0.3, 0.9, 0.001, 1.0].map(round_to_half));
    let frame = FrameConstants { jitter: [0.3, -0.4], ..frame(EXTENT) };
    let mut display = run(&reset(frame), &flat(EXTENT), &constant, None);
    for _ in 0..20 {
        display = run(&frame, &flat(EXTENT), &constant, Some(&display));
    }
    assert_eq!(display, constant);
}

#[test]
fn a_static_image_converges() {
    let image = noise(EXTENT, 1).map(|t| [t[0], t[0], t[0], 1.0]);
    let step = |display: &Image<[f32; 4]>| run(&frame(EXTENT), &flat(EXTENT), &image, Some(display));
    let after = |start: f32| (0..150).fold(Image::new(EXTENT, [start, start, start, 1.0]), |display, _| step(&display));
    let (from_dark, from_bright) = (after(0.0), after(1.0));
    // Half precision stalls where a tenth of the way is less than half a step.
    assert!(largest_difference(&from_dark, &from_bright) < 6e-3, "{}", largest_difference(&from_dark, &from_bright));
    assert_eq!(step(&from_dark), from_dark);
    // Extremes stay clipped; most pixels come to where a first frame would be.
    let settled = run(&reset(frame(EXTENT)), &flat(EXTENT), &image, None);
    let near = from_dark.texels().iter().zip(settled.texels()).filter(|(a, b)| (a[0] - b[0]).abs() < 6e-3).count();
    assert!(near > 90, "{near} of 120");
}

#[test]
fn alpha_is_the_weight_of_the_new_frame() {
    // Pixels of 0.4 and 0.6 leave room around the mean: a history of 0.55 is not clipped.
    let checks = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.4 } else { 0.6 }; 4]);
    let current = run(&reset(frame(EXTENT)), &flat(EXTENT), &checks, None);
    let history = Image::new(EXTENT, [0.55; 4]);
    for alpha in [0.1, 0.5, 1.0] {
        let tuning = Tuning { taa_alpha: alpha, ..svgf_tuning() };
        let display = tuned(&frame(EXTENT), &tuning, &flat(EXTENT), &checks, Some(&history));
        let (now, before) = (current.at(IVec2::new(5, 5))[0], 0.55);
        let (w, v) = (alpha / (1.0 + now), (1.0 - alpha) / (1.0 + before));
        let expected = (w * now + v * before) / (w + v);
        assert!((display.at(IVec2::new(5, 5))[0] - expected).abs() < 1e-3);
    }
}

#[test]
fn jittered_samples_are_put_back() {
    // A ramp, sampled at centre + jitter: its value at the centre must come out nearer than it went in.
    for jitter in [[0.4, 0.0], [-0.4, 0.0], [0.0, 0.4], [0.25, -0.25]] {
        let ramp = |x: f32, y: f32| 0.03 * x + 0.02 * y + 0.1;
        let sampled = paint(EXTENT, |x, y| [ramp(x as f32 + 0.5 + jitter[0], y as f32 + 0.5 + jitter[1]); 4]);
        let frame = FrameConstants { jitter, ..frame(EXTENT) };
        let display = run(&reset(frame), &flat(EXTENT), &sampled, None);
        let (raw, put_back, right) = (sampled.at(IVec2::new(5, 5))[0], display.at(IVec2::new(5, 5))[0], ramp(5.5, 5.5));
        if jitter[1] != -jitter[0] || jitter[0] == 0.0 {
            assert!((put_back - right).abs() < 0.7 * (raw - right).abs(), "{jitter:?}: {raw} to {put_back}, right is {right}");
        }
    }
}

#[test]
fn history_is_clipped_to_the_neighbourhood() {
    let dark = Image::new(EXTENT, [0.1, 0.2, 0.1, 1.0].map(round_to_half));
    let ghost = Image::new(EXTENT, [0.9, 0.1, 0.9, 1.0]);
    let display = run(&frame(EXTENT), &flat(EXTENT), &dark, Some(&ghost));
    assert!(largest_difference(&display, &dark) < 1e-3, "{:?}", display.texels()[0]);
    let wide = Tuning { taa_gamma: 8.0, taa_alpha: 0.01, ..svgf_tuning() };
    let speckled = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.1 } else { 0.3 }; 4]);
    let ghost = Image::new(EXTENT, [0.9; 4]);
    let display = tuned(&frame(EXTENT), &wide, &flat(EXTENT), &speckled, Some(&ghost));
    assert!(display.at(IVec2::new(5, 5))[0] > 0.7, "a wide box lets it pass");
    // The box by hand: 0.1 at (5, 5) and in the corners around it, 0.3 at its sides.
    let alpha = 0.1;
    let (frame, tuning) = (frame(EXTENT), Tuning { taa_gamma: 1.25, taa_alpha: alpha, ..svgf_tuning() });
    let side = (-1.39_f32).exp();
    let share = 4.0 * side / (1.0 + 4.0 * side + 4.0 * side * side);
    let (mean, deviation) = (0.1 + 0.2 * share, 0.2 * (share * (1.0 - share)).sqrt());
    let (now, before) = (run(&reset(frame), &flat(EXTENT), &speckled, None).at(IVec2::new(5, 5))[0], mean + 1.25 * deviation);
    let (w, v) = (alpha / (1.0 + now), (1.0 - alpha) / (1.0 + before));
    let expected = (w * now + v * before) / (w + v);
    for outside in [0.9, before + 0.05] {
        let history = Image::new(EXTENT, [outside; 4]);
        let given = tuned(&frame, &tuning, &flat(EXTENT), &speckled, Some(&history)).at(IVec2::new(5, 5))[0];
        assert!((given - expected).abs() < 1e-3, "{given} for {expected}");
    }
}

#[test]
fn a_grey_neighbourhood_keeps_a_history_that_rounding_tinted() {
    let grey = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.4 } else { 0.6 }; 4].map(round_to_half));
    let history = |red| Image::new(EXTENT, [red, 0.55, 0.55, 1.0].map(round_to_half));
    let tuning = Tuning { taa_alpha: 0.1, ..svgf_tuning() };
    let at = |red| tuned(&frame(EXTENT), &tuning, &flat(EXTENT), &grey, Some(&history(red))).at(IVec2::new(5, 5))[1];
    let grey = at(0.55);
    assert!(grey > 0.53, "{grey}");
    // The next half above: it must not decide whether the history is kept.
    assert!((at(0.5505) - grey).abs() < 1e-3, "{} for {grey}", at(0.5505));
    // A colour that is there to see is clipped.
    assert!((at(0.65) - grey).abs() > 0.02, "{} for {grey}", at(0.65));
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
    let columns = paint(EXTENT, |x, _| [0.05 * x as f32; 4]);
    let (frame, tuning) = (frame(EXTENT), Tuning { taa_alpha: 0.01, taa_gamma: 8.0, ..svgf_tuning() });
    let speckled = paint(EXTENT, |x, y| [if (x + y) % 2 == 0 { 0.1 } else { 0.6 }; 4]);
    let display = tuned(&frame, &tuning, &scene, &speckled, Some(&columns));
    for (x, column) in [(4, 2.0), (6, 4.0), (7, 7.0), (9, 9.0)] {
        let value = display.at(IVec2::new(x, 5))[0];
        assert!((value - 0.05 * column).abs() < 0.01, "{x}: {value}");
    }
    // The background is infinitely far, whatever is stored for it.
    let mut sky = scene.clone();
    sky.guide = paint(EXTENT, |x, y| if x < 6 { scene.guide.at(IVec2::new(x, y)) } else { [0; 4] });
    assert_eq!(tuned(&frame, &tuning, &sky, &speckled, Some(&columns)), display);
}

#[test]
fn off_screen_and_reset_take_the_current_colour() {
    let image = noise(EXTENT, 3);
    let poison = Image::new(EXTENT, [f32::NAN; 4]);
    let first = run(&frame(EXTENT), &flat(EXTENT), &image, None);
    assert!(all_finite(&first));
    assert_eq!(run(&reset(frame(EXTENT)), &flat(EXTENT), &image, Some(&poison)), first);
    let mut away = flat(EXTENT);
    away.surface_motion = Image::new(EXTENT, pack_surface_motion([16384.0, 0.0], None));
    assert_eq!(run(&frame(EXTENT), &away, &image, Some(&poison)), first);
}

#[test]
fn neither_parity_nor_the_allocation_changes_a_bit() {
    let large = [29, 23];
    let (image, history) = (noise(EXTENT, 4), noise(EXTENT, 5));
    let mut tight = flat(EXTENT);
    tight.surface_motion = Image::new(EXTENT, pack_surface_motion([0.75, -3.5], None));
    let loose = Guides {
        guide: embed(&tight.guide, large, [0x7fff; 4]),
        surface_motion: embed(&tight.surface_motion, large, [0x7e00; 4]),
        depth_gradient: Image::new(large, 0),
    };
    let expected = run(&frame(EXTENT), &tight, &image, Some(&history));
    let in_large = FrameConstants { render_extent: EXTENT, previous_render_extent: EXTENT, frame_index: 1, ..frame(large) };
    let [image, history] = [image, history].map(|i| embed(&i, large, [f32::NAN; 4]));
    assert_eq!(run(&in_large, &loose, &image, Some(&history)), embed(&expected, large, [0.0; 4]));
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
    assert_eq!(run(&frame([1, 1]), &flat([1, 1]), &image, Some(&image)), image);
}

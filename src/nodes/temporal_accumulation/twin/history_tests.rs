//! Pixels of the previous frame that are a pixel's history, and the reasons why there are none.

use super::tests::inputs;
use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_guide, pack_surface_motion};

const EXTENT: [u32; 2] = [7, 7];
const NEW: f32 = 100.0;

/// Current surfaces that expect `expected` (depth ratio, normal) at `motion`, on a previous frame whose history is its column
/// number.
struct Scene {
    now: Surface,
    motion: [f32; 2],
    expected: (f32, [f32; 3]),
    gradient: [f32; 2],
    before: Image<Surface>,
    sharp: bool,
}

impl Scene {
    fn new(motion: [f32; 2]) -> Self {
        Self {
            now: surface(4.0),
            motion,
            expected: (0.0, [0.0, 0.0, 1.0]),
            gradient: [0.0; 2],
            before: Image::new(EXTENT, surface(4.0)),
            sharp: false,
        }
    }

    fn with(mut self, change: impl Fn(i32, i32, &mut Surface)) -> Self {
        for y in 0..7 {
            for x in 0..7 {
                change(x, y, self.before.get_mut(x, y).expect("inside"));
            }
        }
        self
    }

    /// The history that the centre pixel (3, 3) takes, and its moments. `alpha` is 0 and the history long: nearly nothing is
    /// new.
    fn centre(&self) -> (f32, LuminanceHistory) {
        let tuning = Tuning { alpha: 0.0, alpha_moments: 0.0, max_history_length: 1024.0, ..svgf_tuning() };
        let columns = paint(EXTENT, |x, _| [x as f32, x as f32, x as f32, 0.0]);
        let luminance_history = paint(EXTENT, |x, y| LuminanceHistory {
            mean: x as f32,
            deviation: 0.5,
            history_length: 1000.0 + y as f32,
            reason: 1,
            outside: None,
        });
        let new = Image::new(EXTENT, [NEW, NEW, NEW, 0.0]);
        let guides = Guides {
            guide: Image::new(EXTENT, pack_guide(&Surface { gradient: self.gradient, ..self.now })),
            surface_motion: Image::new(EXTENT, pack_surface_motion(self.motion, Some(self.expected))),
        };
        let output = temporal_accumulation(
            &frame(EXTENT),
            &tuning,
            &TemporalAccumulationInputs {
                sharp: self.sharp,
                previous: Some(PreviousFrame {
                    guide: &self.before.map(pack_guide),
                    signals: &[SignalHistory { irradiance: &columns, luminance_history: &luminance_history }],
                }),
                ..inputs(&guides, &[&new])
            },
        );
        (output.irradiance[0].get(3, 3).expect("inside")[0], *output.luminance_history[0].get(3, 3).expect("inside"))
    }

    #[track_caller]
    fn assert_history(&self, column: f32) -> LuminanceHistory {
        let (c, luminance_history) = self.centre();
        let expected = column + (NEW - column) / luminance_history.history_length;
        assert!((c - expected).abs() < 5e-3, "{c} for {expected}, {luminance_history:?}");
        assert_eq!(luminance_history.reason, 0);
        luminance_history
    }

    #[track_caller]
    fn assert_none(&self, reason: Reason) {
        let (c, luminance_history) = self.centre();
        assert_eq!((c, luminance_history.history_length, luminance_history.deviation), (NEW, 1.0, 0.0));
        assert_eq!(luminance_history.reason, reason as u16);
        assert!((luminance_history.mean - NEW).abs() < 0.1);
    }
}

#[test]
fn history_is_interpolated_along_the_motion() {
    Scene::new([0.0, 0.0]).assert_history(3.0);
    Scene::new([1.0, -2.0]).assert_history(4.0);
    let luminance_history = Scene::new([-1.25, 0.5]).assert_history(1.75);
    assert!((luminance_history.history_length - 1004.5).abs() <= 0.5, "the mean of 1003 and 1004, and one more");
}

#[test]
fn the_spread_of_the_taps_counts_as_variance() {
    let still = Scene::new([0.0, 0.0]).assert_history(3.0);
    let between = Scene::new([0.5, 0.0]).assert_history(3.5);
    let new = |mean: f32| (NEW - mean) * (NEW - mean) / 1004.0;
    assert!((still.deviation.powi(2) - (0.25 + new(3.0))).abs() < 0.02, "{still:?}");
    assert!((between.deviation.powi(2) - (0.25 + 0.25 + new(3.5))).abs() < 0.02, "{between:?}");
}

#[test]
fn a_refused_tap_gives_its_weight_to_the_others() {
    Scene::new([0.25, 0.0]).with(|x, _, s| s.id = if x == 4 { 2 } else { 1 }).assert_history(3.0);
    Scene::new([0.25, 0.0]).with(|x, _, s| s.linear_depth = if x == 3 { 9.0 } else { 4.0 }).assert_history(4.0);
    Scene::new([0.25, 0.25])
        .with(|x, y, s| s.normal = if (x, y) == (3, 3) { [1.0, 0.0, 0.0] } else { s.normal })
        .assert_history((3.0 * 0.1875 + 4.0 * (0.0625 + 0.1875)) / (0.1875 + 0.0625 + 0.1875));
}

#[test]
fn a_tap_that_is_turned_away_counts_for_less() {
    // Cosine 0.95, but for the rounding of stored normals, at column 4 where 0.9 is tolerated; another surface at column 5 keeps the cubic away.
    let turned = [(1.0f32 - 0.95 * 0.95).sqrt(), 0.0, 0.95];
    let scene = |motion| {
        Scene { sharp: true, ..Scene::new(motion) }.with(|x, _, s| match x {
            4 => s.normal = turned,
            5 => s.id = 2,
            _ => {}
        })
    };
    let likeness = (0.95 - 0.9) / (0.95 * 0.1);
    let whole = 0.75 + 0.25 * likeness;
    let between = scene([0.25, 0.0]).assert_history((0.75 * 3.0 + 0.25 * likeness * 4.0) / whole);
    assert!((between.history_length - (1003.0 * whole + 1.0)).abs() < 2.0, "{between:?}");
    // A turned surface without another beside it is all that is known, for a shorter time.
    let alone = scene([1.0, 0.0]).assert_history(4.0);
    assert!((alone.history_length - (1003.0 * likeness + 1.0)).abs() < 10.0, "{alone:?}");
    let without = Scene { sharp: false, ..scene([1.0, 0.0]) }.assert_history(4.0);
    assert!((without.history_length - 1004.0).abs() < 2.0, "{without:?}");
    // What rounding turns is as good as the same.
    let rounded =
        Scene { sharp: true, ..Scene::new([0.0, 0.0]) }.with(|_, _, s| s.normal = [0.05, 0.0, 0.99875]).assert_history(3.0);
    assert!((rounded.history_length - 1004.0).abs() < 1.0, "{rounded:?}");
}

#[test]
fn without_a_bilinear_tap_the_neighbours_serve() {
    // Only column 2 is left: beside the taps 3 and 4, within reach of the pixel nearest to 3.25.
    Scene::new([0.25, 0.0]).with(|x, _, s| s.id = if x == 2 { 1 } else { 2 }).assert_history(2.0);
    // A weight below 0.01 is not trusted alone: 3 has 0.995, the sliver at 4 leads to the mean of 2 and 4.
    Scene::new([0.005, 0.0]).with(|x, _, s| s.id = if x == 3 { 2 } else { 1 }).assert_history(3.0);
    // From 0.01 on it is.
    Scene::new([0.0625, 0.0]).with(|x, _, s| s.id = if x == 3 { 2 } else { 1 }).assert_history(4.0);
    Scene::new([0.25, 0.0]).with(|x, _, s| s.id = if x == 1 { 1 } else { 2 }).assert_none(Reason::Id);
}

#[test]
fn every_reason_is_told() {
    Scene::new([9.0, 0.0]).assert_none(Reason::OffScreen);
    Scene::new([0.0, -16384.0]).assert_none(Reason::OffScreen);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.id = 2).assert_none(Reason::Id);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.is_apart = true).assert_none(Reason::Id);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.linear_depth = 0.0).assert_none(Reason::Id);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.linear_depth = 4.1).assert_none(Reason::Depth);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.normal = [0.6, 0.0, 0.8]).assert_none(Reason::Normal);
    // The nearest pixel tells: (3, 3) has another normal, all others another depth.
    Scene::new([0.25, 0.25])
        .with(|x, y, s| if (x, y) == (3, 3) { s.normal = [1.0, 0.0, 0.0] } else { s.linear_depth = 7.0 })
        .assert_none(Reason::Normal);
}

#[test]
fn a_partly_visible_neighbourhood_is_enough_at_the_border() {
    Scene::new([3.75, 0.0]).assert_history(6.0);
    Scene::new([-3.5, -3.5]).assert_history(0.0);
    Scene::new([-4.25, 0.0]).assert_history(0.0);
}

#[test]
fn the_tests_are_of_what_is_expected_of_the_previous_frame() {
    let nearer = Scene { expected: (-0.5, [0.0, 0.0, 1.0]), ..Scene::new([0.0, 0.0]) };
    nearer.assert_none(Reason::Depth);
    nearer.with(|_, _, s| s.linear_depth = 2.0).assert_history(3.0);
    let turned = Scene { expected: (0.0, [1.0, 0.0, 0.0]), ..Scene::new([0.0, 0.0]) };
    turned.assert_none(Reason::Normal);
    turned.with(|_, _, s| s.normal = [1.0, 0.0, 0.0]).assert_history(3.0);
    // Tolerance: 2 % of the depth, and a pixel's change along both axes.
    Scene::new([0.0, 0.0]).with(|_, _, s| s.linear_depth = 4.07).assert_history(3.0);
    Scene::new([0.0, 0.0]).with(|_, _, s| s.linear_depth = 4.57).assert_none(Reason::Depth);
    Scene { gradient: [-0.25, 0.25], ..Scene::new([0.0, 0.0]) }.with(|_, _, s| s.linear_depth = 4.57).assert_history(3.0);
}

#[test]
fn another_render_extent_is_scaled() {
    let (now, before) = ([4, 4], [2, 2]);
    let frame = FrameConstants { previous_render_extent: before, ..frame(now) };
    let tuning = Tuning { alpha: 0.0, alpha_moments: 0.0, max_history_length: 1024.0, ..svgf_tuning() };
    let guides = guides(now, |_, _| surface(4.0));
    let columns = paint(now, |x, _| [[8.0, 16.0, 99.0, 99.0][x as usize]; 4]);
    let luminance_history = Image::new(now, LuminanceHistory { mean: 8.0, history_length: 1e3, ..LuminanceHistory::default() });
    let output = temporal_accumulation(
        &frame,
        &tuning,
        &TemporalAccumulationInputs {
            guide: &guides.guide,
            surface_motion: &guides.surface_motion,
            irradiance: &[&Image::new(now, [0.0; 4])],
            object_normals: None,
            material_class: None,
            history_confidence: None,
            repair: false,
            sharp: false,
            light_ratio: None,
            previous: Some(PreviousFrame {
                guide: &guides.guide,
                signals: &[SignalHistory { irradiance: &columns, luminance_history: &luminance_history }],
            }),
        },
    );
    for (x, expected) in [8.0, 10.0, 14.0, 16.0].iter().enumerate() {
        let c = output.irradiance[0].texels()[4 + x][0];
        assert!((c - expected).abs() < 0.03, "{x}: {c}");
    }
}

#[test]
fn signals_are_independent_but_for_taps_and_length() {
    let guides = guides(EXTENT, |x, _| Surface { id: (x % 3) as u8 + 1, ..surface(4.0) });
    let run = |seeds: &[u32]| {
        let mut output: Option<TemporalAccumulationOutputs> = None;
        for step in 0..3 {
            let new: Vec<_> = seeds.iter().map(|seed| noise(EXTENT, seed + 10 * step)).collect();
            let before = output.as_ref().map(|o| o.irradiance.iter().zip(&o.luminance_history));
            let signals: Vec<_> = before
                .into_iter()
                .flatten()
                .map(|(irradiance, luminance_history)| SignalHistory { irradiance, luminance_history })
                .collect();
            let next = temporal_accumulation(
                &frame(EXTENT),
                &svgf_tuning(),
                &TemporalAccumulationInputs {
                    guide: &guides.guide,
                    surface_motion: &guides.surface_motion,
                    irradiance: &new.iter().collect::<Vec<_>>(),
                    object_normals: None,
                    material_class: None,
                    history_confidence: None,
                    repair: false,
                    sharp: false,
                    light_ratio: None,
                    previous: output.as_ref().map(|_| PreviousFrame { guide: &guides.guide, signals: &signals }),
                },
            );
            output = Some(next);
        }
        output.expect("three frames")
    };
    let (both, first, second) = (run(&[1, 2]), run(&[1]), run(&[2]));
    assert_eq!((&both.irradiance[0], &both.irradiance[1]), (&first.irradiance[0], &second.irradiance[0]));
    assert_eq!(
        (&both.luminance_history[0], &both.luminance_history[1]),
        (&first.luminance_history[0], &second.luminance_history[0])
    );
    assert_ne!(first.irradiance[0], second.irradiance[0]);
}

#[test]
fn a_sharp_look_up_of_rare_light_keeps_its_mean() {
    const EXTENT: [u32; 2] = [16, 16];
    let tuning = Tuning { alpha: 0.0, alpha_moments: 0.0, max_history_length: 1024.0, ..svgf_tuning() };
    // All of it moves to where 4x4 pixels show the surface.
    let is_lit = |x, y| (x == 5 || x == 10) && (y == 4 || y == 11);
    let rare = paint(EXTENT, |x, y| [if is_lit(x, y) { 16.0 } else { 0.0 }; 4]);
    let luminance_history = Image::new(EXTENT, LuminanceHistory { mean: 1.0, history_length: 1e3, ..LuminanceHistory::default() });
    let guides = Guides {
        guide: Image::new(EXTENT, pack_guide(&surface(4.0))),
        surface_motion: Image::new(EXTENT, pack_surface_motion([0.5, 0.5], Some((0.0, [0.0, 0.0, 1.0])))),
    };
    let output = temporal_accumulation(
        &frame(EXTENT),
        &tuning,
        &TemporalAccumulationInputs {
            sharp: true,
            previous: Some(PreviousFrame {
                guide: &guides.guide,
                signals: &[SignalHistory { irradiance: &rare, luminance_history: &luminance_history }],
            }),
            ..inputs(&guides, &[&Image::new(EXTENT, [0.0; 4])])
        },
    );
    let light = |image: &Image<[f32; 4]>| image.texels().iter().map(|texel| texel[0]).sum::<f32>();
    let (before, now) = (light(&rare), light(&output.irradiance[0]));
    assert!((now / before - 1.0).abs() < 3e-3, "{before} before, {now} now");
    assert!(output.irradiance[0].texels().iter().any(|texel| texel[0] < 0.0), "the cubic undershoots");
}

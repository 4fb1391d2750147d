//! Numbers behind the colours, what is missing, bars.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_reflection, pack_surface_motion, Reason};
use crate::Config;
use glam::Vec3;

const EXTENT: [u32; 2] = [16, 14];

/// Nothing but guides and counters.
fn bare<'a>(guides: &'a Guides, statistics: &'a Statistics) -> DebugViewInputs<'a> {
    DebugViewInputs {
        guide: &guides.guide,
        surface_motion: &guides.surface_motion,
        statistics,
        luminance_history: &[],
        irradiance_history: &[],
        history_confidence: None,
        gradient: None,
        stratum_size: 3,
        block_percentiles: &[],
        firefly_limits: &[],
        noisy: &[],
        reflection: None,
        visibility_history: None,
        albedo: None,
        instances: Instances::default(),
    }
}

/// A plane whose left half is background.
fn view(view: DebugView, luminance_history: &LuminanceHistory, statistics: &Statistics) -> Image<[f32; 4]> {
    let guides = guides(EXTENT, |x, _| if x < 8 { surface(0.0) } else { surface(3.0) });
    let luminance_history = Image::new(EXTENT, *luminance_history);
    let inputs = DebugViewInputs { luminance_history: &[&luminance_history], ..bare(&guides, statistics) };
    debug_view(&frame(EXTENT), &Tuning { alpha: 0.2, ..svgf_tuning() }, &inputs, view)
}

#[test]
fn alpha_holds_the_number_and_the_background_is_black() {
    let luminance_history =
        LuminanceHistory { mean: 1.0, deviation: 0.5, history_length: 4.0, reason: Reason::Depth as u16, outside: None };
    for (shown, number) in [
        (DebugView::HistoryLength, 4.0),
        (DebugView::MeanAndDeviation, 1.0),
        (DebugView::Alpha, 0.25),
        (DebugView::Disocclusion, 3.0),
        (DebugView::Depth, 3.0),
    ] {
        let image = view(shown, &luminance_history, &Statistics::default());
        assert_eq!(image.get(12, 3).map(|t| t[3]), Some(number), "{shown:?}");
        assert_eq!(image.get(2, 3), Some(&[0.0; 4]), "{shown:?}");
    }
}

#[test]
fn what_the_preset_lacks_is_a_chequer() {
    for shown in [DebugView::Deviation, DebugView::Lambda, DebugView::Gradient, DebugView::Fireflies] {
        let image = view(shown, &LuminanceHistory::default(), &Statistics::default());
        let at = |x, y| image.get(x, y).map(|t| t[0]).expect("inside");
        assert!(at(0, 0) < at(8, 0) && at(0, 0) == at(8, 8) && at(8, 0) < 0.1, "{shown:?}");
    }
}

#[test]
fn bars_grow_with_the_number_of_bad_values() {
    let lit = |count: u32| {
        let image = view(DebugView::BadValues, &LuminanceHistory::default(), &counted(&[(Counter::Depth, count)]));
        assert_eq!(image.get(0, 0).map(|t| t[3]), Some(count as f32));
        (0..EXTENT[0] as i32).filter(|&x| image.get(x, 0).is_some_and(|t| t[0] > 0.1)).count()
    };
    assert_eq!([lit(0), lit(EXTENT[0] * EXTENT[1])], [0, 16]);
    assert!(lit(1) > 0 && lit(20) > lit(1));
}

/// The colour that the legend has for a number.
fn of_legend(shown: DebugView, ramp: usize, mark: &str) -> [f32; 3] {
    let ramp = &shown.legend().ramps[ramp];
    let (place, _) = ramp.marks.iter().find(|(_, text)| *text == mark).unwrap_or_else(|| panic!("{shown:?} has no {mark}"));
    ramp.colour(*place)
}

fn assert_near(given: [f32; 3], wanted: [f32; 3], what: &str) {
    assert!(given.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 2e-3), "{what}: {given:?}, the legend has {wanted:?}");
}

#[test]
fn the_legend_has_the_colours_of_the_picture() {
    let guides = guides(EXTENT, |_, _| surface(1.0));
    let luminance_history =
        LuminanceHistory { mean: 1.0, deviation: 9.0, history_length: 2.0, reason: Reason::Normal as u16, outside: None };
    let of = |history_length| Image::new(EXTENT, LuminanceHistory { history_length, ..luminance_history });
    let (two, eight) = (of(2.0), of(8.0));
    let deviation = Image::new(EXTENT, [0.0, 0.0, 0.0, 0.25]);
    let gradient = Image::new([6, 5], [-0.5, 0.5, 0.0, 0.0]);
    let seen = SeenReflection { hit_distance: 1.0, roughness: 0.0 };
    let [reflection, surface_past, no_past] = [Some(1.0), Some(0.0), None].map(|s| Image::new(EXTENT, pack_reflection(&seen, s)));
    // A pixel of the plane is 2/14 scene units high: 4 of them.
    let history = VisibilityHistory { mean: [0.5; 3], occluder_distance: 8.0 / 14.0, ..VisibilityHistory::default() };
    let visibility = Image::new(EXTENT, history);
    let (statistics, confidence) = (Statistics::default(), Image::new(EXTENT, 0.5));
    let inputs = DebugViewInputs {
        luminance_history: &[&two],
        irradiance_history: &[&deviation],
        history_confidence: Some(&confidence),
        gradient: Some(&gradient),
        reflection: Some(&reflection),
        visibility_history: Some(&visibility),
        ..bare(&guides, &statistics)
    };
    let tuning = Tuning { alpha: 0.0, light_radius: 1.0, ..svgf_tuning() };
    let colour = |inputs: &DebugViewInputs, shown| {
        let [r, g, b, _] = *debug_view(&frame(EXTENT), &tuning, inputs, shown).get(3, 3).expect("inside");
        [r, g, b]
    };
    for (shown, mark) in [
        (DebugView::Deviation, "0.25"),
        (DebugView::Gradient, "-1"),
        (DebugView::Lambda, "0.5"),
        (DebugView::Alpha, "0.5"),
        (DebugView::Depth, "1"),
        (DebugView::HitDistance, "0.5"),
        (DebugView::ReflectionHistory, "image"),
        (DebugView::Visibility, "0.5"),
    ] {
        assert_near(colour(&inputs, shown), of_legend(shown, 0, mark), shown.name());
    }
    let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.03);
    assert!(near(colour(&inputs, DebugView::Penumbra), of_legend(DebugView::Penumbra, 0, "4")), "4 pixels of penumbra");
    let surface = DebugViewInputs { reflection: Some(&surface_past), ..inputs };
    let view = DebugView::ReflectionHistory;
    assert_near(colour(&surface, view), of_legend(view, 0, "surface"), "surface");
    let none = DebugViewInputs { reflection: Some(&no_past), ..inputs };
    assert_near(colour(&none, view), from_srgb(view.legend().cases[0].1.map(f32::from)), "no past");
    let longer = DebugViewInputs { luminance_history: &[&eight], ..inputs };
    assert_near(colour(&longer, DebugView::HistoryLength), of_legend(DebugView::HistoryLength, 0, "8"), "history");
    let [mean, deviation] = [("1", 0), ("9", 1)].map(|(mark, ramp)| of_legend(DebugView::MeanAndDeviation, ramp, mark));
    assert_near(colour(&inputs, DebugView::MeanAndDeviation), [mean[0], deviation[1], 0.0], "luminance_history");
    let (name, reset) = DebugView::Disocclusion.legend().cases[usize::from(Reason::Normal as u16)];
    assert_eq!(name, "normal");
    assert_near(colour(&inputs, DebugView::Disocclusion), from_srgb(reset.map(f32::from)), "reason");
    for (given, ramp, mark) in [([10.0, 0.0], 0, "10"), ([-64.0, 0.0], 0, "-64"), ([0.0, -10.0], 1, "-10")] {
        assert_near(motion(given).0, of_legend(DebugView::Motion, ramp, mark), mark);
    }
}

/// The camera slides along a flat mirror: what is seen in it moves less than the mirror, as what lies behind a window does.
#[test]
fn virtual_motion_is_that_of_the_image_behind_the_mirror() {
    let [now, before] = [0.0, 2.0].map(|x| camera(EXTENT, Vec3::new(x, 0.0, 0.0)));
    let frame = frame_with(&Config::new(EXTENT), &now, &before);
    let mut guides = guides(EXTENT, |_, _| surface(4.0));
    let pixels = |depth: f32| 2.0 * 7.0 / depth;
    guides.surface_motion = Image::new(EXTENT, pack_surface_motion([-pixels(4.0), 0.0], Some((0.0, [0.0, 0.0, 1.0]))));
    let length = |hit_distance, roughness| {
        let reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance, roughness }, None));
        let statistics = Statistics::default();
        let inputs = DebugViewInputs { reflection: Some(&reflection), ..bare(&guides, &statistics) };
        debug_view(&frame, &Tuning::default(), &inputs, DebugView::VirtualMotion).at(IVec2::new(8, 7))[3]
    };
    for (hit_distance, roughness, depth) in [(4.0, 0.0, 8.0), (12.0, 0.0, 16.0), (0.0, 0.0, 4.0), (4.0, 1.0, 4.0)] {
        let (given, wanted) = (length(hit_distance, roughness), pixels(depth));
        assert!((given - wanted).abs() < 0.02, "{hit_distance}, roughness {roughness}: {given} for {wanted}");
    }
}

/// Before a mirror at rest a thing moves, and its image with it.
#[test]
fn virtual_motion_follows_the_thing_in_the_mirror() {
    let still = camera(EXTENT, Vec3::ZERO);
    let (frame, guides) = (frame_with(&Config::new(EXTENT), &still, &still), guides(EXTENT, |_, _| surface(4.0)));
    let mut transforms = [[[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]; 3];
    transforms[2][0][3] = 2.0;
    let reflection = Image::new(EXTENT, pack_reflection(&SeenReflection { hit_distance: 4.0, roughness: 0.0 }, None));
    for (id, wanted) in [(1, 0.0), (2, 2.0 * 7.0 / 8.0)] {
        let hit_id = Image::new(EXTENT, id);
        let instances = Instances { hit_id: Some(&hit_id), transforms: Some(&transforms), ..Default::default() };
        let statistics = Statistics::default();
        let inputs = DebugViewInputs { reflection: Some(&reflection), instances, ..bare(&guides, &statistics) };
        let given = debug_view(&frame, &Tuning::default(), &inputs, DebugView::VirtualMotion).at(IVec2::new(8, 7))[3];
        assert!((given - wanted).abs() < 0.02, "id {id}: {given} for {wanted}");
    }
}

#[test]
fn every_view_says_what_its_colours_mean() {
    for shown in DebugView::ALL {
        let legend = shown.legend();
        assert!(!legend.ramps.is_empty() || !legend.cases.is_empty() || !legend.note.is_empty(), "{shown:?}");
        for ramp in legend.ramps {
            let ends = [ramp.marks.first(), ramp.marks.last()].map(|mark| mark.map(|mark| mark.0));
            assert_eq!(ends, [Some(0.0), Some(1.0)], "{shown:?}: a ramp without its range");
            assert!(ramp.marks.windows(2).all(|pair| pair[0].0 < pair[1].0), "{shown:?}");
            assert_ne!(ramp.colour(0.0), ramp.colour(1.0), "{shown:?}");
        }
    }
}

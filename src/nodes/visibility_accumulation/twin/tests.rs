//! Shadows that stand still, move, are lit by a point, and lie under a camera that moves.

use super::*;
use crate::nodes::visibility_samples::twin::visibility_samples;
use crate::reference::test_scene::*;
use crate::reference::visibility::{halves, unpack_visibility};
use crate::reference::{pack_surface_motion, InstanceTransform, Surface};
use crate::FrameParams;

const EXTENT: [u32; 2] = [24, 24];

/// Samples `(visibility, distance)` of a plane at depth 1, whose pixels are 2/24 scene units long.
fn samples(of: impl Fn(i32, i32) -> (f32, f32)) -> Image<(Visible, f32)> {
    let g = guides(EXTENT, |_, _| surface(1.0));
    let [visibility, distance] = [0, 1].map(|i| paint(EXTENT, |x, y| [<[f32; 2]>::from(of(x, y))[i]; 4]));
    visibility_samples(&frame(EXTENT), &g.guide, &visibility, &distance, false).0.map(|[word, _]| {
        let [visibility, distance] = halves(*word);
        ([visibility; 3], distance)
    })
}

struct Sequence {
    guides: Guides,
    frame: FrameConstants,
    /// Of every occluder, by the id 1.
    transform: Option<InstanceTransform>,
    history: Option<Image<VisibilityHistory>>,
    tuning: Tuning,
}

impl Sequence {
    fn new() -> Self {
        // One scene unit of occluder distance is a penumbra of half a pixel to either side.
        let tuning = Tuning { light_radius: 1.0 / 24.0, ..svgf_tuning() };
        Self { guides: guides(EXTENT, |_, _| surface(1.0)), frame: frame(EXTENT), transform: None, history: None, tuning }
    }

    fn frame(&mut self, samples: &Image<(Visible, f32)>) -> Image<VisibilityHistory> {
        let g = &self.guides;
        let distance = samples.map(|(_, distance)| [distance.abs(); 4]);
        let (id, transforms) = (Image::new(EXTENT, 1), self.transform.map(|transform| [transform; 2]));
        let transforms = transforms.as_ref().map(<[_; 2]>::as_slice);
        let inputs = VisibilityAccumulationInputs {
            guide: &g.guide,
            surface_motion: &g.surface_motion,
            samples,
            occluders: Occluders { distance: Some(&distance), id: Some(&id), transforms, ..Default::default() },
            ambient: false,
            previous: self.history.as_ref().map(|history| (&g.guide, history)),
        };
        let (history, _) = visibility_accumulation(&self.frame, &self.tuning, &inputs);
        // As the images round it.
        let packed = history.map(pack_visibility).map(|[word, colours]| unpack_visibility(*word, Some(*colours)));
        self.history = Some(packed.clone());
        packed
    }
}

/// An edge at x: lit to the right, with a penumbra of `radius` pixels to either side.
fn edge(at: f32, radius: f32, seed: u32) -> Image<(Visible, f32)> {
    let random = noise(EXTENT, seed);
    samples(move |x, y| {
        let seen = 0.5 + 0.5 * (x as f32 + 0.5 - at) / radius;
        let lit = random.at(IVec2::new(x, y))[0] < seen;
        (f32::from(lit), if lit { 0.0 } else { radius * 2.0 })
    })
}

#[test]
fn a_mean_converges_to_the_visibility() {
    let mut sequence = Sequence { tuning: Tuning { visibility_alpha: 0.0, ..Sequence::new().tuning }, ..Sequence::new() };
    let mut last = Image::new([1, 1], VisibilityHistory::default());
    for i in 0..60 {
        last = sequence.frame(&edge(12.0, 6.0, i));
    }
    for x in 4..20 {
        let expected = (0.5 + 0.5 * (x as f32 + 0.5 - 12.0) / 6.0_f32).clamp(0.0, 1.0);
        let column = (0..24).map(|y| last.at(IVec2::new(x, y)).mean[0]).sum::<f32>() / 24.0;
        assert!((column - expected).abs() < 0.06, "{x}: {column} for {expected}");
    }
    let middle = last.at(IVec2::new(12, 8));
    assert_eq!(middle.history_length, 60.0);
    assert!((middle.deviation - 0.5).abs() < 0.1 && (middle.occluder_distance / 12.0 - 1.0).abs() < 0.1, "{middle:?}");
}

#[test]
fn a_shadow_takes_no_notice_of_the_albedo() {
    let chequers = guides(EXTENT, |x, y| Surface { is_apart: (x + y) % 2 == 0, ..surface(1.0) });
    let [plain, chequered] = [Sequence::new(), Sequence { guides: chequers, ..Sequence::new() }]
        .map(|mut sequence| (0..2).map(|i| sequence.frame(&edge(12.0, 6.0, i))).last());
    assert!(plain.expect("a frame").texels() == chequered.expect("a frame").texels());
}

#[test]
fn a_shadow_that_left_leaves_nothing_behind() {
    let mut sequence = Sequence::new();
    for i in 0..20 {
        sequence.frame(&edge(16.0, 0.5, i));
    }
    let after = sequence.frame(&edge(6.0, 0.5, 99));
    for (x, y) in (9..24).flat_map(|x| (0..24).map(move |y| (x, y))) {
        assert_eq!(after.at(IVec2::new(x, y)).mean[0], 1.0, "{x},{y}");
    }
    let back = sequence.frame(&edge(16.0, 0.5, 100));
    for (x, y) in (0..13).flat_map(|x| (0..24).map(move |y| (x, y))) {
        assert_eq!(back.at(IVec2::new(x, y)).mean[0], 0.0, "{x},{y}");
    }
}

#[test]
fn no_penumbra_is_known_where_blocks_around_hold_samples_of_one_kind() {
    // A shadow from x = 4 on: in the first column of blocks it has an edge, and from x = 14 on that is out of reach.
    let mut sequence = Sequence::new();
    let found = sequence.frame(&samples(|x, _| if x < 4 { (1.0, 0.0) } else { (0.0, 2.0) }));
    for x in 4..24 {
        let h = found.at(IVec2::new(x, 8));
        assert_eq!((h.mean[0], h.occluder_distance > 0.0), (0.0, x < 14), "{x}: {h:?}");
    }
}

#[test]
fn motion_does_not_blur_what_is_sharp_and_blurs_what_is_soft_a_little() {
    // A third of a pixel a frame, with the shadow.
    let weight = |radius: f32| {
        let mut sequence = Sequence::new();
        sequence.guides.surface_motion = Image::new(EXTENT, pack_surface_motion([1.0 / 3.0, 0.0], Some((0.0, [0.0, 0.0, 1.0]))));
        let mut last = Image::new([1, 1], VisibilityHistory::default());
        for i in 0..30 {
            last = sequence.frame(&edge(12.0 - i as f32 / 3.0 + 5.0, radius, i));
        }
        // The edge is at 7.3.
        (5..10).map(|x| last.at(IVec2::new(x, 8))).collect::<Vec<_>>()
    };
    let sharp = weight(0.25);
    assert!(sharp[2].history_length <= 4.0, "{sharp:?}");
    assert_eq!([sharp[0], sharp[4]].map(|h| h.mean[0]), [0.0, 1.0], "{sharp:?}");
    let soft = weight(6.0);
    assert!(soft[2].history_length >= 9.0 && soft[2].mean[0] > 0.2 && soft[2].mean[0] < 0.8, "{soft:?}");
}

#[test]
fn a_shadow_that_moves_takes_its_history_along() {
    // Under a sun that stands above, half a pixel a frame.
    let params = FrameParams { lights: [[0.0, 0.0, 1.0, 0.0]; 4], ..FrameParams::new(EXTENT) };
    let moved = [[1.0, 0.0, 0.0, -1.0 / 24.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let error = |transform: Option<InstanceTransform>| {
        let mut sequence = Sequence::new();
        sequence.frame = frame_with(&crate::Config::new(EXTENT), &params, &params);
        sequence.transform = transform;
        let mut last = Image::new([1, 1], VisibilityHistory::default());
        for i in 0..24 {
            last = sequence.frame(&edge(2.0 + i as f32 / 2.0, 5.0, i));
        }
        let expected = |x: i32| (0.5 + 0.5 * (x as f32 + 0.5 - 13.5) / 5.0_f32).clamp(0.0, 1.0);
        let squares = (0..24)
            .flat_map(|y| (9..18).map(move |x| (x, y)))
            .map(|(x, y)| (last.at(IVec2::new(x, y)).mean[0] - expected(x)).powi(2));
        (squares.sum::<f32>() / (24.0 * 9.0)).sqrt()
    };
    let (without, with) = (error(None), error(Some(moved)));
    assert!(with < 0.6 * without, "{without} to {with}");
}

#[test]
fn occluders_without_a_motion_that_can_be_used_are_counted() {
    let shadow = samples(|x, _| if x < 12 { (0.0, 2.0) } else { (1.0, 0.0) });
    let g = guides(EXTENT, |_, _| surface(1.0));
    let (id, motion) = (Image::new(EXTENT, 3), Image::new(EXTENT, [f32::NAN; 4]));
    let history = Image::new(EXTENT, VisibilityHistory::default());
    let count = |occluders: Occluders, frame: &FrameConstants| {
        let inputs = VisibilityAccumulationInputs {
            guide: &g.guide,
            surface_motion: &g.surface_motion,
            samples: &shadow,
            occluders,
            ambient: false,
            previous: Some((&g.guide, &history)),
        };
        let (_, statistics) = visibility_accumulation(frame, &svgf_tuning(), &inputs);
        [Counter::OccluderId, Counter::OccluderMotion].map(|counter| statistics[counter])
    };
    let transforms = [[[0.0; 4]; 3]; 3];
    let by_id = Occluders { id: Some(&id), transforms: Some(&transforms), ..Default::default() };
    assert_eq!(count(by_id, &frame(EXTENT)), [12 * 24, 0], "of occluded pixels");
    assert_eq!(count(Occluders { motion: Some(&motion), ..Default::default() }, &frame(EXTENT)), [0, 12 * 24]);
    assert_eq!(count(Occluders { motion: Some(&motion), ..by_id }, &reset(frame(EXTENT))), [0, 0]);
}

#[test]
fn a_pixel_without_a_sample_takes_those_around() {
    let mut sequence = Sequence::new();
    let hole = |v: f32| samples(move |x, y| if (x, y) == (8, 8) { (f32::NAN, 0.0) } else { (v, if v < 1.0 { 2.0 } else { 0.0 }) });
    for v in [0.0, 1.0] {
        let first = sequence.frame(&hole(v));
        assert!(first.texels().iter().all(|h| h.mean == [v; 3]), "{v}");
        sequence.history = None;
    }
    let none = sequence.frame(&samples(|_, _| (f32::NAN, 0.0)));
    assert!(none.texels().iter().all(|h| h.mean == [1.0; 3] && h.deviation == 0.0));
}

#[test]
fn a_reset_frame_and_the_background_have_no_past() {
    let mut sequence = Sequence::new();
    sequence.frame(&samples(|_, _| (0.0, 4.0)));
    let g = guides(EXTENT, |x, _| if x < 4 { Default::default() } else { surface(1.0) });
    let lit = samples(|_, _| (1.0, 0.0));
    let inputs = VisibilityAccumulationInputs {
        ambient: false,
        guide: &g.guide,
        surface_motion: &g.surface_motion,
        samples: &lit,
        occluders: Occluders::default(),
        previous: Some((&sequence.guides.guide, sequence.history.as_ref().expect("a frame"))),
    };
    let (after, _) = visibility_accumulation(&reset(frame(EXTENT)), &sequence.tuning, &inputs);
    let fresh = VisibilityHistory { mean: [1.0; 3], history_length: 1.0, ..Default::default() };
    assert!(after.texels().iter().all(|texel| *texel == fresh));
}

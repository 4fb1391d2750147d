//! Places of samples, samples that are dropped, and the candidates of the next frame.

use super::*;
use crate::reference::test_scene::*;
use crate::reference::{pack_guide, unpack_gradient_sample, Surface};
use crate::{Config, FrameParams};
use glam::Vec3;

/// A pixel at depth 4 is half a unit wide.
const EXTENT: [u32; 2] = [24, 16];

const STRATUM_SIZE: u32 = 3;

/// A wall at depth 4, seen by a camera that moved by whole pixels.
struct Wall {
    frame: FrameConstants,
    guides: Guides,
    ids: Image<u32>,
}

impl Wall {
    fn new(extent: [u32; 2], moved_pixels: f32) -> Self {
        let pixel = 8.0 / extent[1] as f32;
        let camera_at = |x: f32| FrameParams { jitter: [0.2, -0.3], ..camera(extent, Vec3::new(x * pixel, 0.0, 0.0)) };
        let frame = frame_with(&Config::new(extent), &camera_at(0.0), &camera_at(moved_pixels));
        Self { frame, guides: guides(extent, |_, _| surface(4.0)), ids: Image::new(extent, 1) }
    }

    fn inputs(&self) -> ForwardProjectInputs<'_> {
        ForwardProjectInputs {
            guide: &self.guides.guide,
            previous: None,
            instance_transforms: None,
            forward_motion: None,
            stratum_size: STRATUM_SIZE,
        }
    }

    /// Runs both passes of a frame.
    fn run(&self, frame: &FrameConstants, inputs: &ForwardProjectInputs) -> (ForwardProjectOutputs, Statistics) {
        let tuning = svgf_tuning();
        let mut claims = Image::new(inputs.guide.extent().map(|side| side.div_ceil(STRATUM_SIZE)), 0);
        let statistics = forward_project_claim(frame, &tuning, inputs, &mut claims);
        let outputs = forward_project_resolve(frame, &tuning, inputs, &claims, Some(&self.ids));
        let samples = outputs.gradient_samples.texels().iter().filter(|t| t[2] != 0).count();
        assert_eq!(samples, claims.texels().iter().filter(|key| **key != 0).count(), "a claim without a sample");
        (outputs, statistics)
    }

    /// The first frame, and the second after it with other inputs.
    fn second(&self, inputs: ForwardProjectInputs) -> (ForwardProjectOutputs, ForwardProjectOutputs) {
        let (first, second, _) = self.second_with_statistics(inputs);
        (first, second)
    }

    fn second_with_statistics(&self, inputs: ForwardProjectInputs) -> (ForwardProjectOutputs, ForwardProjectOutputs, Statistics) {
        let first = self.run(&self.frame, &self.inputs()).0;
        let previous = PreviousCandidates { guide: &self.guides.guide, candidates: &first.gradient_candidates };
        let (second, statistics) = self.run(&self.frame, &ForwardProjectInputs { previous: Some(previous), ..inputs });
        (first, second, statistics)
    }

    fn samples(&self, outputs: &ForwardProjectOutputs) -> Vec<GradientSample> {
        let count = Strata::new(&self.frame, STRATUM_SIZE).count();
        let all = (0..count.y).flat_map(|y| (0..count.x).map(move |x| [x, y]));
        all.filter_map(|s| unpack_gradient_sample(STRATUM_SIZE, s, outputs.gradient_samples.at(UVec2::from(s).as_ivec2())))
            .collect()
    }
}

#[test]
fn what_stands_still_lands_on_itself() {
    for extent in [EXTENT, [25, 17], [2, 2]] {
        let wall = Wall::new(extent, 0.0);
        let (first, second) = wall.second(wall.inputs());
        assert!(wall.samples(&first).is_empty());
        let samples = wall.samples(&second);
        assert_eq!(samples.len() as u32, Strata::new(&wall.frame, STRATUM_SIZE).count().element_product());
        assert!(samples.iter().all(|s| s.pixel == s.previous_pixel));
    }
}

#[test]
fn a_camera_that_slides_shifts_the_samples_and_loses_those_at_the_border() {
    let wall = Wall::new(EXTENT, 5.0);
    let (first, second) = wall.second(wall.inputs());
    let samples = wall.samples(&second);
    assert!(samples.iter().all(|s| s.pixel[0] + 5 == s.previous_pixel[0] && s.pixel[1] == s.previous_pixel[1]));
    let visible = first.gradient_candidates.texels().iter().filter(|c| c[0] >= 5);
    let mut strata: Vec<_> = visible.map(|c| [(u32::from(c[0]) - 5) / 3, u32::from(c[1]) / 3]).collect();
    strata.sort_unstable();
    strata.dedup();
    assert_eq!(samples.len(), strata.len(), "every stratum that a candidate reaches has one sample");
}

#[test]
fn hidden_samples_and_those_of_another_instance_are_dropped() {
    let wall = Wall::new(EXTENT, 0.0);
    let nearer = Image::new(EXTENT, pack_guide(&surface(3.0)));
    let other = Image::new(EXTENT, pack_guide(&Surface { id: 2, ..surface(4.0) }));
    let sky = Image::new(EXTENT, [0; 4]);
    for guide in [&nearer, &other, &sky] {
        assert!(wall.samples(&wall.second(ForwardProjectInputs { guide, ..wall.inputs() }).1).is_empty());
    }
}

#[test]
fn transforms_move_samples_and_unusable_ones_have_a_meaning() {
    let wall = Wall::new(EXTENT, 0.0);
    let still = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    // Previous from current: the instance came from two pixels further left.
    let moved = [[1.0, 0.0, 0.0, -1.0], still[1], still[2]];
    let with = |table: &[InstanceTransform]| {
        wall.samples(&wall.second(ForwardProjectInputs { instance_transforms: Some(table), ..wall.inputs() }).1)
    };
    assert!(with(&[still, moved]).iter().all(|s| s.pixel[0] == s.previous_pixel[0] + 2));
    assert!(!with(&[still, moved]).is_empty());
    let standing = with(&[still, still]);
    assert_eq!(with(&[moved]), standing, "an id beyond the end");
    assert_eq!(with(&[moved, [[f32::NAN; 4]; 3]]), standing, "not finite");
    assert!(with(&[still, [[0.0; 4]; 3]]).is_empty(), "no inverse");
}

#[test]
fn forward_motion_leads_and_bad_values_are_counted() {
    let wall = Wall::new(EXTENT, 0.0);
    let with = |texel: [f32; 4]| {
        let motion = Image::new(EXTENT, texel);
        let (_, outputs, statistics) =
            wall.second_with_statistics(ForwardProjectInputs { forward_motion: Some(&motion), ..wall.inputs() });
        (wall.samples(&outputs), statistics[Counter::ForwardMotion])
    };
    let (samples, bad) = with([3.0 / 24.0, -2.0 / 16.0, 4.0, 0.0]);
    assert!(!samples.is_empty() && bad == 0);
    assert!(samples.iter().all(|s| s.pixel == [s.previous_pixel[0] + 3, s.previous_pixel[1] - 2]));
    assert_eq!(with([9.0, 9.0, 0.0, 0.0]).0.len(), 48, "no depth: the matrices do");
    assert!(with([0.0, 0.0, 3.0, 0.0]).0.is_empty(), "hidden");
    for texel in [[f32::NAN, 0.0, 4.0, 0.0], [0.0, f32::INFINITY, 4.0, 0.0], [0.0, 0.0, f32::NAN, 0.0]] {
        assert_eq!(with(texel), (Vec::new(), 48));
    }
}

#[test]
fn the_next_candidate_is_any_pixel_but_the_sample() {
    let wall = Wall::new(EXTENT, 0.0);
    let mut seen = [0; 9];
    for frame_index in 0..64 {
        let frame = FrameConstants { frame_index, ..wall.frame };
        let before = FrameConstants { frame_index: frame_index + 1000, ..wall.frame };
        let (first, _) = wall.run(&before, &wall.inputs());
        let previous = PreviousCandidates { guide: &wall.guides.guide, candidates: &first.gradient_candidates };
        let (second, _) = wall.run(&frame, &ForwardProjectInputs { previous: Some(previous), ..wall.inputs() });
        for (sample, next) in wall.samples(&second).iter().zip(second.gradient_candidates.texels()) {
            let next_pixel = [next[0], next[1]].map(u32::from);
            assert_ne!(sample.pixel, next_pixel);
            assert_eq!([0, 1].map(|i| sample.pixel[i] / 3), [0, 1].map(|i| next_pixel[i] / 3));
            assert_eq!(next[2..], [1, 0], "the id");
            // Strata of the last row are cut to one row of pixels.
            if next_pixel[1] < 15 {
                seen[(next_pixel[0] % 3 + next_pixel[1] % 3 * 3) as usize] += 1;
            }
        }
    }
    let mean = seen.iter().sum::<i32>() / 9;
    assert!(seen.iter().all(|n| (n - mean).abs() < mean / 4), "{seen:?}");
}

#[test]
fn a_reset_has_no_samples_and_one_pixel_alternates() {
    let wall = Wall::new([1, 1], 0.0);
    let (first, second) = wall.second(wall.inputs());
    assert_eq!(first.gradient_candidates.texels(), [[0, 0, 1, 0]]);
    assert_eq!(wall.samples(&second).len(), 1);
    assert_eq!(second.gradient_candidates.texels(), [[NO_PIXEL, NO_PIXEL, 0, 0]]);
    let previous = PreviousCandidates { guide: &wall.guides.guide, candidates: &second.gradient_candidates };
    let (third, _) = wall.run(&wall.frame, &ForwardProjectInputs { previous: Some(previous), ..wall.inputs() });
    assert!(wall.samples(&third).is_empty());
    let previous = PreviousCandidates { guide: &wall.guides.guide, candidates: &first.gradient_candidates };
    let inputs = ForwardProjectInputs { previous: Some(previous), ..wall.inputs() };
    assert!(wall.samples(&wall.run(&reset(wall.frame), &inputs).0).is_empty());
}

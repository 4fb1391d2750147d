//! Mistakes that no field of the conventions can express: matrices, axes of normals, jitter, images that are missing.

use super::*;
use glam::{Mat4, Vec4};

/// Spoils both frames in one way.
struct Mistake {
    name: &'static str,
    scene: Scene,
    declared: Conventions,
    spoil: fn(&mut [Frame; 2]),
    /// The finding that must have the mistake.
    finding: &'static str,
    says: &'static str,
}

fn matrices(frames: &mut [Frame; 2], change: impl Fn(&mut Mat4, &mut Mat4, &FrameParams)) {
    for frame in frames {
        let params = frame.params;
        let [mut view, mut clip] = [params.view_from_world, params.clip_from_view].map(|m| Mat4::from_cols_array_2d(&m));
        change(&mut view, &mut clip, &params);
        (frame.params.view_from_world, frame.params.clip_from_view) = (view.to_cols_array_2d(), clip.to_cols_array_2d());
    }
}

fn row(m: &mut Mat4, row: usize, change: impl Fn(Mat4) -> Vec4) {
    let by = change(*m).to_array();
    for (column, value) in by.into_iter().enumerate() {
        m.col_mut(column)[row] = value;
    }
}

fn normals(frames: &mut [Frame; 2], signs: [f32; 3]) {
    for frame in frames {
        frame.normal = frame.normal.map(|n| [n[0] * signs[0], n[1] * signs[1], n[2] * signs[2], 0.0]);
    }
}

/// Adds `sign` times the jitter to the projection, as a host does that renders with it.
pub fn jitter_projections(frames: &mut [Frame; 2], sign: f32) {
    matrices(frames, |_, clip, params| {
        for (i, side) in EXTENT.into_iter().enumerate() {
            let ndc = sign * 2.0 * params.jitter[i] / side as f32;
            row(clip, i, |m| m.row(i) + m.row(3) * ndc);
        }
    });
}

fn mistakes() -> Vec<Mistake> {
    let (scene, declared) = (Scene::default(), Conventions::default());
    let device = Conventions { depth: DepthEncoding::Device, ..declared };
    let of = |finding, says, name, spoil| Mistake { name, scene, declared, spoil, finding, says };
    let depth = |says, name, reversed, spoil| Mistake {
        name,
        scene: Scene { encoding: device, reversed, ..scene },
        declared: device,
        spoil,
        finding: "depth and matrices",
        says,
    };
    let matrix = |says, name, spoil| of("depth and matrices", says, name, spoil);
    vec![
        matrix("exchanged", "previous and current matrices swapped", |f| {
            let [a, b] = [f[0].params, f[1].params];
            (f[0].params, f[1].params) = (b, a);
        }),
        matrix("view_from_world is transposed", "view transposed", |f| matrices(f, |view, _, _| *view = view.transpose())),
        matrix("clip_from_view is transposed", "projection transposed", |f| matrices(f, |_, clip, _| *clip = clip.transpose())),
        matrix("both matrices are transposed", "both transposed", |f| {
            matrices(f, |view, clip, _| (*view, *clip) = (view.transpose(), clip.transpose()));
        }),
        matrix("world from view", "camera transform instead of view", |f| matrices(f, |view, _, _| *view = view.inverse())),
        matrix("clip from world", "view projection instead of projection", |f| matrices(f, |view, clip, _| *clip *= *view)),
        matrix("y of clip_from_view points up", "OpenGL's y", |f| matrices(f, |_, clip, _| row(clip, 1, |m| -m.row(1)))),
        matrix("jitter has the opposite sign", "jitter negated", |f| {
            f.iter_mut().for_each(|f| f.params.jitter = f.params.jitter.map(|j| -j))
        }),
        matrix("y of the jitter points up", "y of the jitter negated", |f| f.iter_mut().for_each(|f| f.params.jitter[1] *= -1.0)),
        matrix("clip_from_view includes the jitter", "jittered projection", |f| jitter_projections(f, -1.0)),
        matrix("with the opposite sign", "jittered projection, jitter negated", |f| {
            jitter_projections(f, -1.0);
            f.iter_mut().for_each(|f| f.params.jitter = f.params.jitter.map(|j| -j));
        }),
        depth("runs the other way", "reversed depth, other projection", false, |f| {
            f.iter_mut().for_each(|f| f.depth = f.depth.map(|d| [1.0 - d[0], 0.0, 0.0, 0.0]));
        }),
        depth("runs the other way", "other depth, reversed projection", true, |f| {
            f.iter_mut().for_each(|f| f.depth = f.depth.map(|d| [1.0 - d[0], 0.0, 0.0, 0.0]));
        }),
        depth("-1..1", "OpenGL's projection", false, |f| matrices(f, |_, clip, _| row(clip, 2, |m| m.row(2) * 2.0 - m.row(3)))),
        of("normals", "y of the normals has", "y of normals negated", |f| normals(f, [1.0, -1.0, 1.0])),
        of("normals", "z of the normals has", "z of normals negated", |f| normals(f, [1.0, 1.0, -1.0])),
        of("normals", "x of the normals has", "x of normals negated", |f| normals(f, [-1.0, 1.0, 1.0])),
        of("normals", "into the surface", "normals negated", |f| normals(f, [-1.0; 3])),
        of("motion", "0 everywhere", "motion never written", |f| f[1].motion = f[1].motion.map(|_| [0.0; 4])),
        of("motion", "fits", "noise for motion", |f| {
            let noise = |v: f32| (v * 7919.0).sin() * 0.05;
            f[1].motion = f[1].depth.map(|d| [noise(d[0]), noise(d[0] + 0.5), 0.0, 0.0]);
        }),
    ]
}

#[test]
fn every_mistake_is_named_alone() {
    for Mistake { name, scene, declared, spoil, finding, says } in mistakes() {
        let mut frames = Scene { things_move: true, ..scene }.frames();
        spoil(&mut frames);
        let report = report(&declared, &frames);
        for (what, f) in report.findings() {
            let bad = matches!(f.verdict, Verdict::Mistake | Verdict::Unexplained);
            assert_eq!(bad, what == finding, "{name}, {what}:\n{report}");
            assert!(!bad || f.mistake.contains(says), "{name}: `{says}` is not said:\n{report}");
        }
        assert_eq!(report.conventions, declared, "{name}");
    }
}

#[test]
fn evidence_is_in_pixels_and_degrees() {
    let declared = Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..Conventions::default() };
    let [previous, current] = Scene::default().frames();
    let report = report(&declared, &[previous, current.clone()]);
    let Evidence { measure, declared, fitting, pixels } = report.motion.evidence[0];
    // Read with the wrong sign, motion is off by twice its length.
    let mut lengths: Vec<f32> = current
        .motion
        .texels()
        .iter()
        .filter(|m| **m != [0.0; 4])
        .map(|m| 2.0 * (m[0] * EXTENT[0] as f32).hypot(m[1] * EXTENT[1] as f32))
        .collect();
    lengths.sort_by(f32::total_cmp);
    let expected = lengths[lengths.len() / 2];
    assert_eq!(measure, Measure::Motion);
    assert!((declared / expected - 1.0).abs() < 0.05, "{declared}, {expected}");
    assert!(fitting.is_some_and(|f| f < 0.01) && pixels > 5 * EXTENT[0] as usize * EXTENT[1] as usize / 6, "{report}");
    let text = report.to_string();
    assert!(text.contains("motion: MISTAKE: the motion has the opposite sign"), "{text}");
    assert!(text.contains("change: motion_direction: previous_minus_current"), "{text}");
}

//! Every mistake is injected alone into guides that are right.

mod mistakes;
mod scene;

use super::*;
use atrous::config::{DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward};
use scene::{Camera, Frame, Scene, EXTENT};

fn report(declared: &Conventions, [previous, current]: &[Frame; 2]) -> Report {
    check(declared, &previous.guides(), &current.guides()).expect("images that fit")
}

/// Every encoding that a field of the conventions can name, one field at a time.
fn encodings() -> Vec<(&'static str, Conventions)> {
    let d = Conventions::default();
    vec![
        ("default", d),
        ("device", Conventions { depth: DepthEncoding::Device, ..d }),
        ("ray length", Conventions { depth: DepthEncoding::RayLength, ..d }),
        ("normals 0..1", Conventions { normal: NormalEncoding::XyzUnorm, ..d }),
        ("octahedral", Conventions { normal: NormalEncoding::Octahedral, ..d }),
        ("octahedral 0..1", Conventions { normal: NormalEncoding::OctahedralUnorm, ..d }),
        ("view space", Conventions { normal_space: NormalSpace::View, ..d }),
        ("pixels", Conventions { motion_unit: MotionUnit::Pixels, ..d }),
        ("ndc", Conventions { motion_unit: MotionUnit::Ndc, ..d }),
        ("sign", Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..d }),
        ("y up", Conventions { motion_y_up: true, ..d }),
        ("jittered", Conventions { motion_jittered: true, ..d }),
        ("left-handed", Conventions { view_forward: ViewForward::PositiveZ, ..d }),
    ]
}

fn agrees(name: &str, report: &Report) {
    for finding in [&report.geometry, &report.motion, &report.normals] {
        assert_eq!(finding.verdict, Verdict::Agrees, "{name}:\n{report}");
    }
    assert!(!report.complains(), "{name}:\n{report}");
}

#[test]
fn guides_as_declared_give_no_complaint() {
    for (name, encoding) in encodings() {
        for reversed in [false, true] {
            let frames = Scene { encoding, reversed, ..Scene::default() }.frames();
            let report = report(&encoding, &frames);
            agrees(name, &report);
            assert_eq!(report.conventions, encoding, "{name}");
        }
    }
}

#[test]
fn any_encoding_declared_as_any_other_is_named() {
    for (name, written) in encodings() {
        let frames = Scene { encoding: written, ..Scene::default() }.frames();
        for (declared_name, declared) in encodings() {
            // Two fields apart are two mistakes, which are found where they are in different guides; the default is in each pair.
            if name == declared_name || (name != "default" && declared_name != "default") {
                continue;
            }
            let report = report(&declared, &frames);
            let mistakes = report.findings().iter().filter(|f| f.1.verdict == Verdict::Mistake).count();
            assert_eq!(mistakes, 1, "{name}, declared as {declared_name}:\n{report}");
            assert_eq!(report.conventions, written, "{name}, declared as {declared_name}:\n{report}");
        }
    }
}

#[test]
fn what_moves_by_itself_and_what_is_not_finite_is_outvoted() {
    let mut frames = Scene { things_move: true, ..Scene::default() }.frames();
    agrees("things move", &report(&Conventions::default(), &frames));
    for (i, frame) in frames.iter_mut().enumerate() {
        for image in [&mut frame.depth, &mut frame.normal, &mut frame.motion] {
            for y in 0..8 {
                for x in 0..30 {
                    *image.get_mut(x + 20 * i as i32, y * 5).expect("inside") =
                        [[f32::NAN; 4], [f32::INFINITY; 4]][(x % 2) as usize];
                }
            }
        }
    }
    agrees("not finite", &report(&Conventions::default(), &frames));
}

#[test]
fn ids_are_not_needed_and_half_precision_is_enough() {
    let [mut previous, mut current] = Scene::default().frames();
    for frame in [&mut previous, &mut current] {
        for image in [&mut frame.depth, &mut frame.normal, &mut frame.motion] {
            *image = image.map(|texel| texel.map(|v| half::f16::from_f32(v).to_f32()));
        }
    }
    let without = |frame: &Frame| frame.surface_id.clone();
    let ids = [without(&previous), without(&current)];
    assert!(ids.iter().all(|ids| ids.texels().contains(&0)), "there is a sky");
    let mut guides = [previous.guides(), current.guides()];
    guides.iter_mut().for_each(|g| g.surface_id = None);
    agrees("half precision", &check(&Conventions::default(), &guides[0], &guides[1]).expect("images that fit"));
}

#[test]
fn parallel_projections_are_understood() {
    let device = Conventions { depth: DepthEncoding::Device, ..Conventions::default() };
    for encoding in [Conventions::default(), device] {
        let frames = Scene { encoding, orthographic: true, ..Scene::default() }.frames();
        agrees("orthographic", &report(&encoding, &frames));
        let wrong = Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..encoding };
        assert_eq!(report(&wrong, &frames).conventions, encoding);
        let wrong = Conventions { view_forward: ViewForward::PositiveZ, ..encoding };
        let report = report(&wrong, &frames);
        assert_eq!(report.conventions, encoding, "{report}");
    }
}

#[test]
fn frames_that_cannot_tell_are_said_to() {
    let still = Scene { camera: Camera::Still, things_move: true, jitter: [[0.0; 2]; 2], ..Scene::default() };
    let frames = still.frames();
    let jittered = Scene { jitter: Scene::default().jitter, ..still }.frames();
    for (name, declared) in encodings() {
        // Jitter is seen without motion, and says nothing of sign and unit.
        let with_jitter = report(&declared, &jittered);
        let expected = if declared.motion_jittered { Verdict::Mistake } else { Verdict::Inconclusive };
        assert_eq!(with_jitter.motion.verdict, expected, "{name}:\n{with_jitter}");
        let report = report(&declared, &frames);
        assert_eq!(report.motion.verdict, Verdict::Inconclusive, "{name}:\n{report}");
        assert!(report.motion.mistake.contains("nothing moves"), "{name}:\n{report}");
    }
    assert!(!report(&Conventions::default(), &frames).complains());
    // Depth and normals are seen without motion.
    let declared = Conventions { depth: DepthEncoding::RayLength, normal_space: NormalSpace::View, ..Conventions::default() };
    let report = report(&declared, &frames);
    assert_eq!(report.conventions, Conventions::default(), "{report}");
}

type Spoil = fn(&mut [Frame; 2]);

/// Jitter as a host gives it wrongly, or rightly.
const JITTERS: [(&str, Spoil); 5] = [
    ("declared", |_| ()),
    ("not declared", |frames| frames.iter_mut().for_each(|f| f.params.jitter = [0.0; 2])),
    ("negated", |frames| frames.iter_mut().for_each(|f| f.params.jitter = f.params.jitter.map(|j| -j))),
    ("exchanged", |frames| {
        let [a, b] = [0, 1].map(|i| frames[i].params.jitter);
        (frames[0].params.jitter, frames[1].params.jitter) = (b, a);
    }),
    ("in the projection", |frames| mistakes::jitter_projections(frames, -1.0)),
];

/// Whatever the matrices are, a camera that stands still shows each point at its place, but for jitter.
#[test]
fn a_camera_that_stands_still_tells_nothing_of_matrices() {
    for depth in [DepthEncoding::Linear, DepthEncoding::Device] {
        let declared = Conventions { depth, ..Conventions::default() };
        for (things_move, reversed) in [(false, false), (true, true)] {
            let scene = Scene { camera: Camera::Still, encoding: declared, things_move, reversed, ..Scene::default() };
            for (name, spoil) in JITTERS {
                let mut frames = scene.frames();
                spoil(&mut frames);
                let report = report(&declared, &frames);
                assert_eq!(report.geometry.verdict, Verdict::Inconclusive, "{depth:?}, jitter {name}:\n{report}");
                assert!(report.geometry.mistake.contains("nothing moves"), "{depth:?}, jitter {name}:\n{report}");
                assert_eq!(report.conventions.depth, depth, "jitter {name}:\n{report}");
            }
        }
    }
}

#[test]
fn exchanged_matrices_are_named_as_such() {
    for (depth, reversed) in [(DepthEncoding::Linear, false), (DepthEncoding::Device, true)] {
        let declared = Conventions { depth, ..Conventions::default() };
        for camera in [Camera::Slides, Camera::Moves, Camera::Turns] {
            for (jitter, is_kept) in [([[0.0; 2]; 2], false), (Scene::default().jitter, false), (Scene::default().jitter, true)] {
                let mut frames = Scene { camera, jitter, reversed, encoding: declared, ..Scene::default() }.frames();
                let [a, b] = [frames[0].params, frames[1].params];
                (frames[0].params, frames[1].params) = (b, a);
                if is_kept {
                    (frames[0].params.jitter, frames[1].params.jitter) = (a.jitter, b.jitter);
                }
                let report = report(&declared, &frames);
                let said = &report.geometry.mistake;
                assert!(said.contains("exchanged"), "{camera:?}, {depth:?}, {jitter:?}, kept {is_kept}:\n{report}");
            }
        }
    }
}

#[test]
fn without_jitter_nothing_is_said_of_it() {
    let frames = Scene { jitter: [[0.0; 2]; 2], ..Scene::default() }.frames();
    let declared = Conventions { motion_jittered: true, ..Conventions::default() };
    let report = report(&declared, &frames);
    agrees("no jitter", &report);
    assert!(!report.to_string().contains("jitter"), "{report}");
}

#[test]
fn motion_along_one_axis_says_nothing_of_the_other() {
    let frames = Scene { camera: Camera::Slides, jitter: [[0.0; 2]; 2], ..Scene::default() }.frames();
    for motion_y_up in [false, true] {
        let report = report(&Conventions { motion_y_up, ..Conventions::default() }, &frames);
        agrees("slides", &report);
        let other = if motion_y_up { "y of the motion points down" } else { "y of the motion points up" };
        assert_eq!(report.motion.untested, [other], "{report}");
    }
}

#[test]
fn z_of_the_motion_is_a_difference_or_a_depth() {
    let with = |motion_depth| Conventions { motion_depth, ..Conventions::default() };
    for written in [MotionDepth::Difference, MotionDepth::Absolute] {
        let mut frames = Scene { encoding: with(written), things_move: true, ..Scene::default() }.frames();
        for declared in [MotionDepth::Difference, MotionDepth::Absolute] {
            let report = report(&with(declared), &frames);
            let verdict = if declared == written { Verdict::Agrees } else { Verdict::Mistake };
            assert_eq!(report.motion_depth.verdict, verdict, "{written:?} declared as {declared:?}:\n{report}");
            assert_eq!(report.conventions, with(written));
        }
        frames[1].motion = frames[1].motion.map(|m| [m[0], m[1], -m[2], 0.0]);
        let negated = report(&with(written), &frames);
        assert!(negated.motion_depth.mistake.contains("opposite sign"), "{negated}");
        frames[1].motion = frames[1].motion.map(|m| [m[0], m[1], 123.0, 0.0]);
        let nonsense = report(&with(written), &frames);
        assert_eq!(nonsense.motion_depth.verdict, Verdict::Unexplained, "{nonsense}");
        assert_eq!(nonsense.motion.verdict, Verdict::Agrees, "{nonsense}");
    }
}

#[test]
fn what_lies_behind_the_camera_is_refuted_without_motion() {
    let mut frames = Scene::default().frames();
    frames[1].motion = frames[1].motion.map(|_| [0.0; 4]);
    let report = report(&Conventions::default(), &frames);
    assert_eq!((report.geometry.verdict, report.motion.verdict), (Verdict::Agrees, Verdict::Unexplained), "{report}");
    assert!(!report.to_string().contains("looks the other way"), "{report}");
}

#[test]
fn images_that_do_not_fit_are_errors() {
    let [previous, current] = Scene::default().frames();
    let small = Image::new([8, 8], [0.0; 4]);
    let ids = Image::new([8, 8], 1);
    let good = || [previous.guides(), current.guides()];
    type Spoiled = (&'static str, fn(&mut FrameParams));
    let spoiled: [Spoiled; 5] = [
        ("render_extent", |p| p.render_extent = [EXTENT[0] + 1, EXTENT[1]]),
        ("render_extent", |p| p.render_extent = [0, 1]),
        ("jitter", |p| p.jitter = [f32::NAN, 0.0]),
        ("view_from_world", |p| p.view_from_world = [[0.0; 4]; 4]),
        ("reset", |p| p.reset = Some(atrous::ResetReason::CameraCut)),
    ];
    for (word, spoil) in spoiled {
        let [before, mut now] = good();
        spoil(&mut now.params);
        let error = check(&Conventions::default(), &before, &now).expect_err(word).to_string();
        assert!(error.contains(word), "{error}");
    }
    let [mut before, now] = good();
    before.surface_id = Some(&ids);
    let error = check(&Conventions::default(), &before, &now).expect_err("sizes").to_string();
    assert!(error.contains("surface_id of the previous frame` was given 8x8"), "{error}");
    let [before, mut now] = good();
    now.motion = Some(&small);
    assert!(check(&Conventions::default(), &before, &now).is_err());
}

#[test]
fn garbage_is_answered() {
    let mut state = 1_u32;
    let mut bits = move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        state ^ state >> 15
    };
    for (allocated, render, before) in [([1, 1], [1, 1], [1, 1]), ([2, 1], [2, 1], [1, 1]), ([19, 11], [17, 9], [5, 11])] {
        for round in 0..20 {
            let count = (allocated[0] * allocated[1]) as usize;
            let mut image = || {
                let texels =
                    (0..count).map(|i| [0; 4].map(|_: u32| if i % 2 == 0 { f32::from_bits(bits()) } else { 4.0 })).collect();
                Image::from_texels(allocated, texels).expect("as many texels as pixels")
            };
            let images = [image(), image(), image(), image(), image()];
            let surface_id = images[0].map(|v| v[1].to_bits() & 3);
            let mut params = Scene::default().params(round % 2);
            params.view_from_world[3] = [f32::from_bits(bits() & 0x4fff_ffff), 0.0, 0.0, 1.0];
            let guides = |render_extent, i: usize| Guides {
                params: FrameParams { render_extent, ..params },
                depth: &images[i],
                normal: Some(&images[2]),
                motion: Some(&images[3]),
                surface_id: (round % 3 == 0).then_some(&surface_id),
            };
            for (_, declared) in encodings() {
                let mut previous = guides(before, 0);
                // Far beyond the image.
                previous.params.view_from_world[3] = [1e12, 0.0, 0.0, 1.0];
                if let Ok(report) = check(&declared, &previous, &guides(render, 1)) {
                    assert!(report.to_string().contains("depth and matrices"));
                }
            }
        }
    }
}

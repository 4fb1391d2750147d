use super::*;
use crate::nodes::volume_points::twin::pack_volume_point;
use crate::reference::{pack_surface_motion, test_scene::*};
use crate::{Config, FrameParams};
use glam::Vec3;

const EXTENT: [u32; 2] = [40, 30];

fn points(extent: [u32; 2], point: impl Fn(i32, i32) -> VolumePoint) -> Image<[u16; 4]> {
    paint(extent, point).map(pack_volume_point)
}

/// Motion of the pixels of a frame in which the camera moved to `to`; surfaces of every pixel at `depth` (0: none) claim to have
/// moved by 9, −9.
fn moved(before: FrameParams, now: FrameParams, depth: f32, points: &Image<[u16; 4]>) -> Image<[f32; 2]> {
    let frame = frame_with(&Config::new(EXTENT), &before, &now);
    let surface_motion = Image::new(EXTENT, pack_surface_motion([9.0, -9.0], Some((0.0, [0.0, 0.0, 1.0]))));
    let guide = guides(EXTENT, |_, _| if depth == 0.0 { Default::default() } else { surface(depth) }).guide;
    run(&frame, &guide, &surface_motion, points).map(|t| unpack_volume_motion(*t))
}

/// Runs both passes of a frame.
fn run(frame: &FrameConstants, guide: &Image<[u16; 4]>, surface_motion: &Image<[u16; 4]>, points: &Image<[u16; 4]>) -> Image<u32> {
    let mut claims = Image::new(guide.extent(), 0);
    volume_motion_claim(frame, guide, points, &mut claims);
    volume_motion_resolve(frame, points, surface_motion, &claims)
}

fn fog(linear_depth: f32) -> Image<[u16; 4]> {
    points(EXTENT, |_, _| VolumePoint { linear_depth, contribution: 1 })
}

fn at(x: f32) -> FrameParams {
    camera(EXTENT, Vec3::new(x, 0.0, 0.0))
}

#[test]
fn a_camera_at_rest_moves_nothing() {
    let still = moved(at(0.0), at(0.0), 0.0, &fog(3.0));
    assert!(still.texels().iter().all(|m| *m == [0.0; 2]));
}

#[test]
fn nearer_points_move_farther() {
    // 90 degrees from top to bottom: a point at depth z is seen 15 pixels a unit of x/z from the centre.
    for (depth, expected) in [(1.0, 3.0), (2.0, 1.5), (6.0, 0.5), (3.0, 1.0)] {
        let motion = moved(at(0.0), at(0.2), 0.0, &fog(depth));
        let found = motion.get(20, 15).expect("inside");
        assert!((found[0] - expected).abs() <= 0.5 / 64.0 + 1e-4 && found[1] == 0.0, "depth {depth}: {found:?}");
    }
}

#[test]
fn of_two_points_in_a_pixel_the_brighter_one_counts() {
    // Columns 20 at depth 1 and 18 at depth 3 move by three pixels and by one, both to column 17.
    let bright = |near: u16, far: u16| {
        points(EXTENT, move |x, _| match x {
            20 => VolumePoint { linear_depth: 1.0, contribution: near },
            18 => VolumePoint { linear_depth: 3.0, contribution: far },
            _ => VolumePoint::default(),
        })
    };
    let x = |points| moved(at(0.0), at(0.2), 0.0, &points).get(17, 10).expect("inside")[0];
    // Neighbouring steps of a factor of 2 in 128, of a luminance of 1.
    assert_eq!((x(bright(0x3f81, 0x3f80)), x(bright(0x3f80, 0x3f81))), (3.0, 1.0));
}

#[test]
fn the_motion_is_that_of_the_mean_depth_by_luminance() {
    // Neighbouring columns at depth 1 and 3, the farther one three times as bright: the mean depth is 2.5, at which 1.2 pixels are
    // moved.
    let luminance = |l: f32| (l.to_bits() >> 16) as u16;
    let points = points(EXTENT, |x, _| match x {
        20 => VolumePoint { linear_depth: 1.0, contribution: luminance(1.0) },
        19 => VolumePoint { linear_depth: 3.0, contribution: luminance(3.0) },
        _ => VolumePoint::default(),
    });
    let motion = moved(at(0.0), at(0.2), 0.0, &points);
    let x = |x| motion.get(x, 10).expect("inside")[0];
    // They land in columns 17 and 18, and are seen from one further on either side.
    assert_eq!((x(15), x(16), x(19), x(20)), (9.0, 3.0, 1.0, 9.0));
    assert!((x(17) - 1.2).abs() < 1.0 / 64.0 && x(17) == x(18), "{} {}", x(17), x(18));
}

#[test]
fn surface_motion_stays_where_no_point_lands() {
    let one = points(EXTENT, |x, y| VolumePoint { linear_depth: if (x, y) == (20, 15) { 3.0 } else { 0.0 }, contribution: 1 });
    let motion = moved(at(0.0), at(0.2), 0.0, &one);
    // It is at 19, 15 now, and counts in the 3x3 pixels around.
    for (i, m) in motion.texels().iter().enumerate() {
        let near = (18..=20).contains(&(i % 40)) && (14..=16).contains(&(i / 40));
        assert_eq!(*m, if near { [1.0, 0.0] } else { [9.0, -9.0] }, "{} {}", i % 40, i / 40);
    }
}

#[test]
fn a_surface_hides_what_lies_behind_it() {
    let surface_motion = |depth| moved(at(0.0), at(0.0), depth, &fog(3.0)).texels().iter().filter(|m| **m == [9.0, -9.0]).count();
    assert_eq!(surface_motion(2.9), 40 * 30);
    assert_eq!(surface_motion(3.1), 0);
}

#[test]
fn jitter_is_no_motion() {
    let jittered = |jitter| FrameParams { jitter, ..at(0.0) };
    let motion = moved(jittered([0.25, -0.125]), jittered([-0.25, 0.375]), 0.0, &fog(3.0));
    let landed: Vec<_> = motion.texels().iter().filter(|m| **m != [9.0, -9.0]).collect();
    assert!(landed.len() > 1000 && landed.iter().all(|m| **m == [0.0; 2]), "{:?}", landed.iter().find(|m| m[0] != 0.0));
}

#[test]
fn a_reset_frame_has_no_points() {
    let frame = reset(frame(EXTENT));
    let guides = guides(EXTENT, |_, _| surface(5.0));
    let points = fog(3.0);
    let without = run(&frame, &guides.guide, &guides.surface_motion, &fog(0.0));
    assert_eq!(run(&frame, &guides.guide, &guides.surface_motion, &points), without);
}

#[test]
fn every_motion_is_exact_as_a_half() {
    for steps in (-5000..5000).chain([1 << 20, (1 << 20) - 1, -(1 << 19) - 7]) {
        let x = representable(steps);
        assert_eq!(unpack_volume_motion(pack_volume_motion([x, -x])), [x, -x]);
        assert!((x - steps as f32 / STEPS).abs() <= x.abs() / 1024.0);
    }
}

#[test]
fn a_key_holds_the_pixel_and_what_has_room_of_the_contribution() {
    // Steps for a factor of 2 that are told apart: 128 in small pictures, 16 at 3840x2160.
    for (count, steps) in [(1_u32, 128), (40 * 30, 128), (320 * 180, 128), (1920 * 1080, 64), (3840 * 2160, 16), (1 << 30, 1)] {
        for frame_index in [0, 1, 77] {
            let keys = Keys::new(&FrameConstants { frame_index, ..frame(EXTENT) }, count);
            for index in [0, count / 3, count / 2, count - 1] {
                for contribution in [0, 1, 0x3f80, 0x7f7f] {
                    let key = keys.of(index, contribution);
                    assert!(key != 0 && keys.index_of(key) == index, "{index} of {count}: {key:x}");
                }
                let next = 0x3f80 + 128_u16.div_ceil(steps);
                let other = (index + count / 7) % count;
                assert!(steps == 1 || keys.of(index, next) > keys.of(other, 0x3f80), "{index} of {count}");
            }
        }
    }
}

#[test]
fn no_direction_always_wins_among_equal_points() {
    let [width, count] = [320, 320 * 180];
    let (mut wins, mut pairs) = ([0; 2], 0);
    for frame_index in 0..8 {
        let keys = Keys::new(&FrameConstants { frame_index, ..frame(EXTENT) }, count);
        for index in (0..count - width).step_by(7) {
            pairs += 1;
            for (wins, other) in wins.iter_mut().zip([index + 1, index + width]) {
                *wins += u32::from(keys.of(other, 0x3f80) > keys.of(index, 0x3f80));
            }
        }
    }
    for wins in wins {
        assert!(3 * wins > pairs && 3 * wins < 2 * pairs, "{wins} of {pairs}");
    }
}

//! Motion, previous depth and previous normal.

use super::*;
use crate::config::{Conventions, MotionDepth, MotionDirection, MotionUnit};
use crate::reference::projection::view_position;
use crate::reference::test_scene::*;
use crate::reference::{unpack_surface_motion, Image, SurfaceMotion, LARGEST_MOTION};
use crate::{Config, FrameParams};
use glam::{Mat4, Vec2, Vec4};

const EXTENT: [u32; 2] = [8, 6];

struct Scene<'a> {
    conventions: Conventions,
    before: FrameParams,
    now: FrameParams,
    depth: f32,
    motion: Option<[f32; 4]>,
    id: u32,
    transforms: Option<&'a [InstanceTransform]>,
}

impl Scene<'_> {
    fn new(before: FrameParams, now: FrameParams) -> Self {
        Self { conventions: Conventions::default(), before, now, depth: 5.0, motion: None, id: 1, transforms: None }
    }

    fn import(&self) -> (Image<SurfaceMotion>, Statistics) {
        let allocated = [16, 16];
        let frame = frame_with(&Config { conventions: self.conventions, ..Config::new(allocated) }, &self.before, &self.now);
        let imported = import(
            &frame,
            &ImportInputs {
                depth: &Image::new(allocated, [self.depth; 4]),
                normal: &Image::new(allocated, [1.0, 0.0, 0.0, 0.0]),
                motion: self.motion.map(|m| Image::new(allocated, m)).as_ref(),
                surface_id: Some(&Image::new(allocated, self.id)),
                albedo: None,
                roughness: None,
                object_normal: None,
                instance_transforms: self.transforms,
            },
        );
        (crop(&imported.surface_motion, self.now.render_extent).map(|t| unpack_surface_motion(*t)), imported.statistics)
    }
}

fn close(a: [f32; 2], b: Vec2, tolerance: f32) -> bool {
    Vec2::from(a).distance(b) < tolerance
}

#[test]
fn every_unit_and_sign_of_motion_gives_pixels_of_the_previous_frame() {
    let (e, before) = (Vec2::new(8.0, 6.0), Vec2::new(4.0, 12.0));
    let (jitter, previous_jitter) = (Vec2::new(0.25, -0.5), Vec2::new(-0.125, 0.375));
    let expected = Vec2::new(3.0, -2.0);
    for unit in [MotionUnit::Pixels, MotionUnit::Uv, MotionUnit::Ndc] {
        for choice in 0..8 {
            let (negated, motion_y_up, motion_jittered) = (choice & 1 != 0, choice & 2 != 0, choice & 4 != 0);
            let mut uv = expected / before;
            if motion_jittered {
                // A raster whose samples lie at centre + jitter shows x at x − jitter.
                uv -= previous_jitter / before - jitter / e;
            }
            let uv = if negated { -uv } else { uv };
            let uv = if motion_y_up { Vec2::new(uv.x, -uv.y) } else { uv };
            let v = match unit {
                MotionUnit::Pixels => uv * e,
                MotionUnit::Uv => uv,
                MotionUnit::Ndc => uv * 2.0,
            };
            let motion_direction =
                if negated { MotionDirection::CurrentMinusPrevious } else { MotionDirection::PreviousMinusCurrent };
            let motion_scale = if choice < 4 { 1.0 } else { 50.0 };
            let conventions = Conventions {
                motion_unit: unit,
                motion_direction,
                motion_y_up,
                motion_jittered,
                motion_scale,
                ..Conventions::default()
            };
            let v = v / motion_scale;
            let before = FrameParams { jitter: previous_jitter.to_array(), ..FrameParams::new([4, 12]) };
            let now = FrameParams { jitter: jitter.to_array(), ..FrameParams::new(EXTENT) };
            let scene = Scene { conventions, motion: Some([v.x, v.y, 0.0, 0.0]), ..Scene::new(before, now) };
            let (motions, statistics) = scene.import();
            assert!(
                motions.texels().iter().all(|m| close(m.motion, expected, 2e-3)),
                "{unit:?} {choice}: {:?}",
                motions.texels()[0]
            );
            assert_eq!(statistics, Statistics::default());
        }
    }
}

#[test]
fn depth_of_motion_gives_the_previous_depth() {
    let still = camera(EXTENT, Vec3::ZERO);
    for (motion_depth, z, expected) in [
        (MotionDepth::None, 99.0, 5.0),
        (MotionDepth::Difference, -1.5, 3.5),
        (MotionDepth::Absolute, 8.0, 8.0),
        (MotionDepth::Difference, -6.0, 5.0),
        (MotionDepth::Absolute, f32::NAN, 5.0),
        (MotionDepth::Absolute, f32::INFINITY, 5.0),
    ] {
        for motion_direction in [MotionDirection::PreviousMinusCurrent, MotionDirection::CurrentMinusPrevious] {
            let conventions = Conventions { motion_depth, motion_direction, ..Conventions::default() };
            let scene = Scene { conventions, motion: Some([0.0, 0.0, z, 0.0]), ..Scene::new(still, still) };
            let ratio = scene.import().0.texels()[0].depth_ratio;
            assert!((ratio - (expected / 5.0 - 1.0)).abs() < 1e-3, "{motion_depth:?} {z}: {ratio}");
        }
    }
}

/// The place where the test's camera at `position` shows a world point, pixels, and its depth: the pinhole written out.
fn pinhole(world: Vec3, position: Vec3, extent: [u32; 2]) -> (Vec2, f32) {
    let view = world - position;
    let (width, height) = (extent[0] as f32, extent[1] as f32);
    let depth = -view.z;
    (Vec2::new(width / 2.0 + view.x / depth * height / 2.0, height / 2.0 - view.y / depth * height / 2.0), depth)
}

/// The world point under a position in pixels.
fn under(position: Vec2, depth: f32, camera: Vec3, extent: [u32; 2]) -> Vec3 {
    let (half_width, half_height) = (extent[0] as f32 / 2.0, extent[1] as f32 / 2.0);
    camera + depth * Vec3::new((position.x - half_width) / half_height, -(position.y - half_height) / half_height, -1.0)
}

#[test]
fn a_moving_camera_moves_the_world() {
    let (was, is) = (Vec3::new(0.4, -0.3, 1.0), Vec3::new(0.0, 0.1, 0.2));
    let jitter = Vec2::new(0.25, -0.375);
    for previous_extent in [EXTENT, [12, 9]] {
        let now = FrameParams { jitter: jitter.to_array(), ..camera(EXTENT, is) };
        let (motions, _) = Scene::new(camera(previous_extent, was), now).import();
        let scale = Vec2::new(previous_extent[0] as f32, previous_extent[1] as f32) / Vec2::new(8.0, 6.0);
        for y in 0..6 {
            for x in 0..8 {
                let sample = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) + jitter;
                let (position, depth) = pinhole(under(sample, 5.0, is, EXTENT), was, previous_extent);
                let motion = motions.get(x, y).expect("inside");
                assert!(close(motion.motion, position - sample * scale, 3e-3), "{x} {y}: {motion:?}");
                assert!((5.0 * (1.0 + motion.depth_ratio) - depth).abs() < 5e-3);
                assert_eq!(motion.previous_normal, [1.0, 0.0, 0.0]);
            }
        }
    }
}

#[test]
fn a_still_camera_moves_nothing_whatever_the_jitter() {
    let jittered = |x: f32, y: f32| FrameParams { jitter: [x, y], ..camera(EXTENT, Vec3::new(1.0, 2.0, 3.0)) };
    for depth in [5.0, f32::INFINITY] {
        let scene = Scene { depth, ..Scene::new(jittered(0.5, -0.25), jittered(-0.375, 0.125)) };
        for motion in scene.import().0.texels() {
            assert!(close(motion.motion, Vec2::ZERO, 1e-4) && motion.depth_ratio.abs() < 1e-5, "{motion:?}");
        }
    }
}

#[test]
fn an_instance_carries_its_surface() {
    let still = camera(EXTENT, Vec3::ZERO);
    // A quarter turn about z, then a shift: +x was +y.
    let turned = Mat4::from_cols(Vec4::Y, Vec4::NEG_X, Vec4::Z, Vec4::new(0.5, 0.25, -1.0, 1.0));
    let rows = [0, 1, 2].map(|i| turned.row(i).to_array());
    let identity = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let transforms = [identity, rows, [[f32::NAN; 4]; 3]];
    let scene = Scene { transforms: Some(&transforms), ..Scene::new(still, still) };
    let (motions, _) = scene.import();
    for y in 0..6 {
        for x in 0..8 {
            let sample = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let (position, depth) = pinhole(turned.transform_point3(under(sample, 5.0, Vec3::ZERO, EXTENT)), Vec3::ZERO, EXTENT);
            let motion = motions.get(x, y).expect("inside");
            assert!(close(motion.motion, position - sample, 5e-3), "{x} {y}: {motion:?}");
            assert!((5.0 * (1.0 + motion.depth_ratio) - depth).abs() < 5e-3);
            assert_eq!(motion.previous_normal, [0.0, 1.0, 0.0]);
        }
    }
    // A bad transform and an instance that the host did not list stand still.
    for id in [2, 3, u32::MAX] {
        let (motions, _) = Scene { id, transforms: Some(&transforms), ..Scene::new(still, still) }.import();
        assert!(motions.texels().iter().all(|m| close(m.motion, Vec2::ZERO, 1e-4) && m.previous_normal == [1.0, 0.0, 0.0]));
    }
}

#[test]
fn what_was_behind_the_camera_is_off_screen() {
    let (motions, _) = Scene::new(camera(EXTENT, Vec3::new(0.0, 0.0, -20.0)), camera(EXTENT, Vec3::ZERO)).import();
    assert!(motions.texels().iter().all(|m| m.motion == [LARGEST_MOTION; 2] && m.depth_ratio == 0.0));
}

#[test]
fn the_background_turns_with_the_camera_and_ignores_its_steps() {
    let turn = Mat4::from_rotation_y(0.2);
    let now = camera(EXTENT, Vec3::ZERO);
    let before = FrameParams { view_from_world: turn.to_cols_array_2d(), ..camera(EXTENT, Vec3::ZERO) };
    let (motions, _) = Scene { depth: f32::INFINITY, ..Scene::new(before, now) }.import();
    for y in 0..6 {
        for x in 0..8 {
            let sample = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let direction = turn.transform_vector3(under(sample, 1.0, Vec3::ZERO, EXTENT));
            let (position, _) = pinhole(direction, Vec3::ZERO, EXTENT);
            let motion = motions.get(x, y).expect("inside");
            assert!(close(motion.motion, position - sample, 3e-3), "{x} {y}: {motion:?}");
        }
    }
    let stepped = Scene { depth: f32::INFINITY, ..Scene::new(camera(EXTENT, Vec3::new(3.0, -2.0, 1.0)), now) };
    assert!(stepped.import().0.texels().iter().all(|m| close(m.motion, Vec2::ZERO, 1e-4)));
}

#[test]
fn an_orthographic_background_stands_still() {
    let flat = FrameParams::new(EXTENT);
    let scene = Scene { depth: f32::INFINITY, ..Scene::new(flat, flat) };
    assert!(scene.import().0.texels().iter().all(|m| close(m.motion, Vec2::ZERO, 1e-4)));
}

#[test]
fn bad_motion_is_counted_and_replaced_by_the_matrices() {
    let (before, now) = (camera(EXTENT, Vec3::new(1.0, 0.0, 0.0)), camera(EXTENT, Vec3::ZERO));
    let without = Scene::new(before, now).import();
    assert!(without.0.texels()[0].motion[0] < -0.1);
    for bad in [[f32::NAN, 0.0, 0.0, 0.0], [0.0, f32::NEG_INFINITY, 0.0, 0.0]] {
        let with = Scene { motion: Some(bad), ..Scene::new(before, now) }.import();
        assert_eq!(with.0, without.0);
        assert_eq!(with.1[Counter::Motion], 48);
    }
}

/// A camera somewhere, turned, with so long a lens that a pixel is what it is at 1080p.
fn far_camera(position: Vec3) -> FrameParams {
    let lens = perspective(EXTENT) * Mat4::from_scale(Vec3::new(180.0, 180.0, 1.0));
    let turned = Mat4::from_rotation_y(0.7) * Mat4::from_rotation_x(-0.4);
    let view = turned * Mat4::from_translation(-position);
    FrameParams { view_from_world: view.to_cols_array_2d(), clip_from_view: lens.to_cols_array_2d(), ..FrameParams::new(EXTENT) }
}

#[test]
fn far_from_the_origin_what_stands_still_does_not_move() {
    for distance in [0.0, 1e4, 1e5, 1e6, 1e7] {
        let camera = far_camera(Vec3::new(distance, 0.3 * distance, -0.7 * distance));
        let (motions, _) = Scene::new(camera, camera).import();
        let worst = motions.texels().iter().map(|m| Vec2::from(m.motion).length()).fold(0.0, f32::max);
        assert!(worst < 0.001, "{worst} pixels at a distance of {distance}");
        assert!(motions.texels().iter().all(|m| m.depth_ratio.abs() < 1e-3));
    }
}

#[test]
fn far_from_the_origin_an_instance_moves_as_near_it() {
    let moved: InstanceTransform = [[1.0, 0.0, 0.0, 0.01], [0.0, 1.0, 0.0, -0.02], [0.0, 0.0, 1.0, 0.005]];
    let transforms = [moved; 2];
    let of = |distance: f32| {
        let camera = far_camera(Vec3::new(distance, 0.3 * distance, -0.7 * distance));
        Scene { transforms: Some(&transforms), ..Scene::new(camera, camera) }.import().0
    };
    let near = of(0.0);
    assert!(near.texels().iter().all(|m| Vec2::from(m.motion).length() > 0.5), "{:?}", near.texels()[0]);
    for distance in [1e4, 1e6] {
        for (far, near) in of(distance).texels().iter().zip(near.texels()) {
            assert!(close(far.motion, Vec2::from(near.motion), 0.01), "{far:?} {near:?} at a distance of {distance}");
        }
    }
}

/// A frame whose light has fewer pixels.
fn of_light(light: [u32; 2], light_offset: [u32; 2]) -> FrameConstants {
    let (extent, before) = ([24, 16], camera([24, 16], Vec3::ZERO));
    let config = Config { light_extent: Some(light), ..Config::new(extent) };
    frame_with(&config, &before, &FrameParams { jitter: [0.3, -0.45], light_offset, ..before })
}

#[test]
fn a_pixel_of_light_lies_where_it_was_traced() {
    for (light, offset) in [([12, 8], [0, 0]), ([12, 8], [1, 0]), ([12, 8], [1, 1]), ([24, 8], [0, 1]), ([12, 16], [1, 0])] {
        let frame = of_light(light, offset);
        assert_eq!(frame.render_extent, light);
        for p in [IVec2::new(0, 0), IVec2::new(5, 3), IVec2::new(11, 7)] {
            let (of_light, traced) = (view_position(&frame, p, 3.0), view_position(&frame.of_guides(), frame.guide_pixel(p), 3.0));
            assert!((of_light - traced).length() < 1e-5, "{light:?} {offset:?} {p}: {of_light} {traced}");
        }
    }
}

#[test]
fn a_pixel_of_light_has_the_guides_of_the_pixel_that_it_was_traced_for() {
    for (light, offset) in [([12, 8], [0, 1]), ([12, 16], [1, 0]), ([24, 16], [0, 0])] {
        let frame = of_light(light, offset);
        let depth = paint([24, 16], |x, y| [4.0 + 0.5 * x as f32 + 0.25 * y as f32; 4]);
        let (normal, motion) =
            (Image::new([24, 16], [0.0, 0.0, 1.0, 0.0]), Image::new([24, 16], [3.0 / 24.0, -5.0 / 16.0, 0.0, 0.0]));
        let imported = import(&frame, &ImportInputs { motion: Some(&motion), ..ImportInputs::new(&depth, &normal) });
        assert_eq!(imported.guide.extent(), light);
        let ratio = [24 / light[0], 16 / light[1]].map(|side| side as f32);
        for p in [IVec2::new(0, 0), IVec2::new(5, 3), IVec2::new(11, 7)] {
            let traced = frame.guide_pixel(p);
            let surface = crate::reference::unpack_guide(imported.guide.at(p));
            let z = surface.linear_depth;
            assert!((z - depth.at(traced)[0]).abs() < 1e-4 * z, "{p}");
            let moved = unpack_surface_motion(imported.surface_motion.at(p)).motion;
            assert_eq!(moved, [3.0 / ratio[0], -5.0 / ratio[1]], "{light:?}");
            let ([x, y], sum) = (surface.gradient, 0.5 * ratio[0] + 0.25 * ratio[1]);
            assert!((x + y - sum).abs() < 0.126 * sum && (x / (x + y) - 0.5 * ratio[0] / sum).abs() < 0.0157, "{surface:?}");
        }
    }
}

//! Reprojection of a pixel's surface into the previous frame: steps 3 to 5 of the stage `import`.

use super::conventions::{motion_depth, motion_is_jittered, motion_is_negated, motion_points_up, motion_unit};
use super::projection::{extent, extent_ratio, previous_sample_offset, sample_offset, Projections};
use super::surface_motion::LARGEST_MOTION;
use crate::config::{MotionDepth, MotionUnit};
use crate::FrameConstants;
use glam::{IVec2, Vec2, Vec3, Vec4, Vec4Swizzles};

/// World space of the previous frame from world space of this one: three rows of four, so that `previous = rows · (x, y, z, 1)`.
pub type InstanceTransform = [[f32; 4]; 3];

/// The transform of an instance; none: it did not move.
pub(crate) fn transform_of(transforms: &[InstanceTransform], id: u32) -> Option<&InstanceTransform> {
    transforms.get(id as usize).filter(|transform| transform.iter().flatten().all(|x| x.is_finite()))
}

/// Motion of one pixel as the host gives it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HostMotion<'a> {
    /// The texel of the motion image.
    pub texel: Option<[f32; 4]>,
    /// The transform of the pixel's instance.
    pub transform: Option<&'a InstanceTransform>,
}

/// The place of a surface in the previous frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reprojection {
    /// Pixels of the previous frame.
    pub motion: Vec2,
    /// Expected previous linear depth divided by linear depth, minus 1; 0 for the background.
    pub depth_ratio: f32,
    /// Whether the host's motion was not finite.
    pub is_bad: bool,
}

/// Motion and expected depth of a pixel at `linear_depth` (0: background).
pub(crate) fn reproject(
    frame: &FrameConstants,
    projections: &Projections,
    p: IVec2,
    linear_depth: f32,
    host: HostMotion,
) -> Reprojection {
    let transform = host.transform.map(|transform| about_eye(frame, transform));
    let carried = carry(projections.world_point(p.into(), linear_depth), transform.as_ref());
    let given = host.texel.filter(|v| v[0].is_finite() && v[1].is_finite());
    let motion = match given {
        Some(v) => motion_in_pixels(frame, [v[0], v[1]]).into(),
        None => match projections.previous_position(carried) {
            Some(position) => Vec2::from(position) - Vec2::from(projections.sample_position(p.into())) * extent_ratio(frame),
            // Behind the previous camera: a mirrored position could lie on screen, so it is sent off screen.
            None => Vec2::splat(LARGEST_MOTION),
        },
    };
    let previous_depth = match (motion_depth(frame), given) {
        (MotionDepth::Difference, Some(v)) => linear_depth + v[2],
        (MotionDepth::Absolute, Some(v)) => v[2],
        _ => projections.previous_linear_depth(carried),
    };
    let is_usable = linear_depth > 0.0 && previous_depth.is_finite() && previous_depth > 0.0;
    Reprojection {
        motion: motion.clamp(Vec2::splat(-LARGEST_MOTION), Vec2::splat(LARGEST_MOTION)),
        depth_ratio: if is_usable { previous_depth / linear_depth - 1.0 } else { 0.0 },
        is_bad: host.texel.is_some() && given.is_none(),
    }
}

/// The host's motion as pixels of the previous frame, without jitter.
pub fn motion_in_pixels(frame: &FrameConstants, motion: [f32; 2]) -> [f32; 2] {
    let (ratio, v) = (extent_ratio(frame), Vec2::from(motion));
    let v = if motion_is_negated(frame) { -v } else { v };
    let scale = match motion_unit(frame) {
        MotionUnit::Pixels => ratio,
        MotionUnit::Uv => extent(frame.previous_render_extent),
        MotionUnit::Ndc => extent(frame.previous_render_extent) * 0.5,
    };
    let v = v * (scale * frame.motion_scale);
    let v = if motion_points_up(frame) { Vec2::new(v.x, -v.y) } else { v };
    // A jittered raster shows x at x − offset: the motion in it lacks the change of the offset.
    let lacks = previous_sample_offset(frame) - sample_offset(frame) * ratio;
    (if motion_is_jittered(frame) { v + lacks } else { v }).into()
}

/// A coordinate that is carried farther is of a transform that is none: its instance counts as one that did not move.
const FARTHEST: f32 = 1e15;

/// A transform of the host's world space as one of the world seen from this frame's eye, in which [`Projections`] are: (R − 1)·eye is
/// added to its translation, which is exactly 0 where nothing turns.
pub(crate) fn about_eye(frame: &FrameConstants, transform: &InstanceTransform) -> InstanceTransform {
    let [ex, ey, ez, _] = frame.eye;
    std::array::from_fn(|i| {
        let [x, y, z, w] = transform[i];
        let less_one = |value: f32, at: usize| value - if i == at { 1.0 } else { 0.0 };
        let moved = less_one(x, 0) * ex + less_one(y, 1) * ey + less_one(z, 2) * ez;
        [x, y, z, w + moved]
    })
}

fn carry(world: [f32; 4], transform: Option<&InstanceTransform>) -> [f32; 4] {
    let point = Vec4::from(world);
    let to = transform.filter(|_| point.w != 0.0).and_then(|transform| carried(transform, point));
    to.map_or(world, |to| to.extend(point.w).into())
}

/// A point where a transform carries it; `None`: too far for a transform that is one.
pub(crate) fn carried(transform: &InstanceTransform, point: Vec4) -> Option<Vec3> {
    let to = Vec3::from(transform.map(|row| Vec4::from(row).dot(point)));
    to.abs().cmplt(Vec3::splat(FARTHEST)).all().then_some(to)
}

/// A direction as a transform turns it.
pub(crate) fn turned(transform: &InstanceTransform, direction: Vec3) -> Vec3 {
    Vec3::from(transform.map(|row| Vec4::from(row).xyz().dot(direction)))
}

/// The world normal that is expected in the previous frame.
pub(crate) fn previous_normal(normal: Vec3, transform: Option<&InstanceTransform>) -> Vec3 {
    let Some(rows) = transform else { return normal };
    let turned = turned(rows, normal);
    let length_squared = turned.length_squared();
    if length_squared.is_finite() && length_squared >= 1e-8 {
        turned / length_squared.sqrt()
    } else {
        normal
    }
}

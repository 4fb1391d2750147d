//! Motion of surfaces from the previous frame, in the encoding of the metrics: pixels, previous − current, y down.

use crate::frame::FrameInputs;
use atrous::config::{Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit};
use atrous::FrameParams;
use glam::{Mat4, Vec2, Vec3, Vec4};

/// Background, in a depth that the metrics can compare.
const FAR: f32 = 1e30;

/// Motion and depths of a frame.
#[derive(Clone, Debug, Default)]
pub struct SurfaceMotion {
    /// Motion, pixels.
    pub motion_px: Vec<[f32; 2]>,
    /// Depth that the surface had in the previous camera.
    pub previous_depth: Vec<f32>,
    /// Depth in this camera.
    pub depth: Vec<f32>,
    /// Whether a pixel shows a surface, and no background.
    pub is_surface: Vec<bool>,
    /// Ids; 0 where there are none.
    pub id: Vec<u32>,
}

/// Computes all of it. `before` are the parameters of the previous frame.
pub fn of_frame(frame: &FrameInputs, before: &FrameParams, c: &Conventions) -> SurfaceMotion {
    with_motions(frame, before, c, frame.images.get("motion"))
}

/// The same for a world in which nothing moves by itself: by depth and matrices alone.
pub fn of_still(frame: &FrameInputs, before: &FrameParams, c: &Conventions) -> SurfaceMotion {
    with_motions(frame, before, c, None)
}

fn with_motions(frame: &FrameInputs, before: &FrameParams, c: &Conventions, motions: Option<&Vec<[f32; 4]>>) -> SurfaceMotion {
    let projection = Projection::new(frame, before, c);
    let mut result = SurfaceMotion::default();
    let pixels = frame.noisy.len();
    let width = frame.params.render_extent[0] as usize;
    let depths = frame.images.get("depth");
    for i in 0..pixels {
        let at = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5) + Vec2::from(frame.params.jitter);
        let z = projection.linear_depth(at, depths.map_or(1.0, |d| d[i][0]));
        let carried = || projection.previous(at, z);
        let (motion, previous) = match motions.map(|m| m[i]) {
            Some(v) => {
                let previous = match c.motion_depth {
                    MotionDepth::Absolute => v[2],
                    MotionDepth::Difference => z + v[2],
                    MotionDepth::None => carried().1,
                };
                (projection.pixels(v), previous)
            }
            None => carried(),
        };
        result.motion_px.push(if motion.is_finite() { motion.into() } else { [0.0; 2] });
        result.previous_depth.push(if previous.is_finite() { previous } else { FAR });
        let id = frame.surface_id.as_ref().map_or(1, |ids| ids[i]);
        result.is_surface.push(z.is_finite() && z > 0.0 && z < c.background_depth && id != 0);
        result.depth.push(if z.is_finite() { z } else { FAR });
    }
    result.id = frame.surface_id.clone().unwrap_or_else(|| vec![0; pixels]);
    result
}

struct Projection<'a> {
    extent: Vec2,
    convention: &'a Conventions,
    clip_from_view: Mat4,
    view_from_clip: Mat4,
    world_from_view: Mat4,
    previous_view: Mat4,
    previous_clip: Mat4,
    jitter_change: Vec2,
}

impl<'a> Projection<'a> {
    fn new(frame: &FrameInputs, before: &FrameParams, convention: &'a Conventions) -> Self {
        let now = &frame.params;
        let matrix = |m: &[[f32; 4]; 4]| Mat4::from_cols_array_2d(m);
        let clip_from_view = matrix(&now.clip_from_view);
        Self {
            extent: Vec2::new(now.render_extent[0] as f32, now.render_extent[1] as f32),
            convention,
            clip_from_view,
            view_from_clip: clip_from_view.inverse(),
            world_from_view: matrix(&now.view_from_world).inverse(),
            previous_view: matrix(&before.view_from_world),
            previous_clip: matrix(&before.clip_from_view),
            jitter_change: Vec2::from(before.jitter) - Vec2::from(now.jitter),
        }
    }

    /// The point of the view ray at view depth 1.
    fn ray(&self, at: Vec2) -> Vec3 {
        let ndc = at / self.extent * 2.0 - 1.0;
        let point = self.view_from_clip * Vec4::new(ndc.x, ndc.y, 0.5, 1.0);
        let point = point.truncate() / point.w;
        point / point.z.abs()
    }

    fn linear_depth(&self, at: Vec2, d: f32) -> f32 {
        match self.convention.depth {
            DepthEncoding::Linear => d,
            DepthEncoding::RayLength => d / self.ray(at).length(),
            DepthEncoding::Device => {
                let p = self.clip_from_view.to_cols_array_2d();
                ((d * p[3][3] - p[3][2]) / (p[2][2] - d * p[2][3])).abs()
            }
        }
    }

    /// Motion and depth of a point of the static world.
    fn previous(&self, at: Vec2, z: f32) -> (Vec2, f32) {
        let world = self.world_from_view * (self.ray(at) * z).extend(1.0);
        let view = self.previous_view * world;
        let clip = self.previous_clip * view;
        let before = (Vec2::new(clip.x, clip.y) / clip.w * 0.5 + 0.5) * self.extent;
        (before - at, view.z.abs())
    }

    fn pixels(&self, v: [f32; 4]) -> Vec2 {
        let c = self.convention;
        let mut m = Vec2::new(v[0], v[1]);
        match c.motion_unit {
            MotionUnit::Pixels => {}
            MotionUnit::Uv => m *= self.extent,
            MotionUnit::Ndc => m *= self.extent * 0.5,
        }
        m *= c.motion_scale;
        if c.motion_direction == MotionDirection::CurrentMinusPrevious {
            m = -m;
        }
        if c.motion_y_up {
            m.y = -m.y;
        }
        if c.motion_jittered {
            // A sample lies jitter beside its pixel's centre, so a rasterised position is the true one minus jitter.
            m += self.jitter_change;
        }
        m
    }
}

//! Places on the screen and in the world, by the cameras of a frame and of the one before it, in the conventions of its files.

use atrous::config::{Conventions, DepthEncoding, MotionDirection, MotionUnit};
use atrous::FrameParams;
use glam::{Mat4, Vec2, Vec3, Vec4};

/// The cameras of a frame and of the one before it.
pub struct Projection<'a> {
    extent: Vec2,
    jitter: Vec2,
    convention: &'a Conventions,
    clip_from_view: Mat4,
    view_from_clip: Mat4,
    world_from_view: Mat4,
    previous_view: Mat4,
    previous_clip: Mat4,
    jitter_change: Vec2,
}

impl<'a> Projection<'a> {
    pub fn new(now: &FrameParams, before: &FrameParams, convention: &'a Conventions) -> Self {
        let matrix = |m: &[[f32; 4]; 4]| Mat4::from_cols_array_2d(m);
        let clip_from_view = matrix(&now.clip_from_view);
        Self {
            extent: Vec2::new(now.render_extent[0] as f32, now.render_extent[1] as f32),
            jitter: now.jitter.into(),
            convention,
            clip_from_view,
            view_from_clip: clip_from_view.inverse(),
            world_from_view: matrix(&now.view_from_world).inverse(),
            previous_view: matrix(&before.view_from_world),
            previous_clip: matrix(&before.clip_from_view),
            jitter_change: Vec2::from(before.jitter) - Vec2::from(now.jitter),
        }
    }

    /// The place of a pixel's sample.
    pub fn middle(&self, pixel: usize) -> Vec2 {
        let width = self.extent.x as usize;
        Vec2::new((pixel % width) as f32 + 0.5, (pixel / width) as f32 + 0.5) + self.jitter
    }

    /// Whether lines of sight meet in the eye.
    pub fn is_perspective(&self) -> bool {
        self.clip_from_view.w_axis.w == 0.0
    }

    /// The length of the way to a depth, as files have it.
    pub fn way(&self, pixel: usize, depth: f32) -> f32 {
        let at = self.middle(pixel);
        self.linear_depth(at, depth) * self.ray(at).length()
    }

    /// The linear depth at the end of a way.
    pub fn depth(&self, pixel: usize, way: f32) -> f32 {
        way / self.ray(self.middle(pixel)).length()
    }

    /// The width of a pixel at depth 1.
    pub fn pixel(&self) -> f32 {
        let middle = self.extent / 2.0;
        self.ray(middle + Vec2::X).distance(self.ray(middle))
    }

    /// The point of the view ray at view depth 1.
    fn ray(&self, at: Vec2) -> Vec3 {
        let ndc = at / self.extent * 2.0 - 1.0;
        let point = self.view_from_clip * Vec4::new(ndc.x, ndc.y, 0.5, 1.0);
        let point = point.truncate() / point.w;
        point / point.z.abs()
    }

    /// The linear depth of one that files have.
    pub fn linear_depth(&self, at: Vec2, d: f32) -> f32 {
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
    pub fn previous(&self, at: Vec2, z: f32) -> (Vec2, f32) {
        let world = self.world_from_view * (self.ray(at) * z).extend(1.0);
        let view = self.previous_view * world;
        let clip = self.previous_clip * view;
        let before = (Vec2::new(clip.x, clip.y) / clip.w * 0.5 + 0.5) * self.extent;
        (before - at, view.z.abs())
    }

    /// Motion in pixels, previous − current, y down, of one that files have.
    pub fn pixels(&self, v: [f32; 4]) -> Vec2 {
        let c = self.convention;
        let mut m = Vec2::new(v[0], v[1]) * self.unit() * c.motion_scale;
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

    /// The opposite of [`Self::pixels`].
    pub fn encoded(&self, mut m: Vec2) -> Vec2 {
        let c = self.convention;
        if c.motion_jittered {
            m -= self.jitter_change;
        }
        if c.motion_y_up {
            m.y = -m.y;
        }
        if c.motion_direction == MotionDirection::CurrentMinusPrevious {
            m = -m;
        }
        m / c.motion_scale / self.unit()
    }

    /// Pixels in a unit of motion.
    fn unit(&self) -> Vec2 {
        match self.convention.motion_unit {
            MotionUnit::Pixels => Vec2::ONE,
            MotionUnit::Uv => self.extent,
            MotionUnit::Ndc => self.extent * 0.5,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_comes_back_in_every_convention() {
        let now = FrameParams { jitter: [0.25, -0.5], ..FrameParams::new([40, 24]) };
        let before = FrameParams { jitter: [-0.125, 0.375], ..now };
        let plain = Conventions { motion_scale: 3.0, ..Conventions::default() };
        let motion = Vec2::new(2.5, -1.25);
        let given: Vec<Vec2> = [MotionUnit::Pixels, MotionUnit::Uv, MotionUnit::Ndc]
            .into_iter()
            .flat_map(|motion_unit| {
                let unit = Conventions { motion_unit, ..plain };
                let turned = Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..unit };
                [unit, turned, Conventions { motion_y_up: true, ..unit }, Conventions { motion_jittered: true, ..unit }]
            })
            .map(|convention| {
                let projection = Projection::new(&now, &before, &convention);
                let given = projection.encoded(motion);
                let back = projection.pixels([given.x, given.y, 0.0, 0.0]);
                assert!(back.distance(motion) < 1e-5, "{convention:?}: {back}");
                given
            })
            .collect();
        assert!(given.iter().enumerate().all(|(i, a)| given[..i].iter().all(|b| a.distance(*b) > 1e-3)), "{given:?}");
    }
}

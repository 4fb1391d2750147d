//! Pixels, depths and points under the matrices of this frame and of the previous one.

use super::conventions::{depth_encoding, forward};
use crate::config::DepthEncoding;
use crate::FrameConstants;
use glam::{IVec2, Mat2, Mat4, Vec2, Vec3, Vec4, Vec4Swizzles};

/// Offset of this frame's samples from the pixel centres, pixels: a sample of pixel p lies at `p + 0.5 + offset`, so what a
/// jittered raster shows at a position x lies at `x + offset` of the unjittered image.
pub(crate) fn sample_offset(frame: &FrameConstants) -> Vec2 {
    frame.jitter.into()
}

/// Offset of the previous frame's samples from the pixel centres, pixels.
pub(crate) fn previous_sample_offset(frame: &FrameConstants) -> Vec2 {
    frame.previous_jitter.into()
}

/// E'/E: from pixels of this frame to pixels of the previous one.
pub(crate) fn extent_ratio(frame: &FrameConstants) -> Vec2 {
    extent(frame.previous_render_extent) / extent(frame.render_extent)
}

pub(crate) fn extent([width, height]: [u32; 2]) -> Vec2 {
    Vec2::new(width as f32, height as f32)
}

/// Depths beyond it are no farther: squares of differences stay finite.
const FARTHEST: f32 = 1e15;

/// Nearer depths are none: squares of them, and sums of tolerances, are 0.
const NEAREST: f32 = 1e-30;

/// The surface point of a pixel in view space.
pub(crate) fn view_position(frame: &FrameConstants, p: IVec2, linear_depth: f32) -> Vec3 {
    let ndc = (p.as_vec2() + 0.5 + sample_offset(frame)) / extent(frame.render_extent) * 2.0 - 1.0;
    let clip = &frame.clip_from_view;
    let z = forward(frame) * linear_depth.min(FARTHEST);
    let w = clip[2][3] * z + clip[3][3];
    let axis = |i: usize| (ndc[i] * w - clip[2][i] * z - clip[3][i]) / clip[i][i];
    Vec3::new(axis(0), axis(1), z)
}

/// Scene units from one pixel to the next, across and down, where a surface faces the camera.
pub(crate) fn pixel_size(frame: &FrameConstants, linear_depth: f32) -> Vec2 {
    let clip = Mat4::from_cols_array_2d(&frame.clip_from_view);
    let w = clip.row(3).z * forward(frame) * linear_depth.min(FARTHEST) + clip.row(3).w;
    let across = Vec2::new(clip.row(0).x, clip.row(1).y);
    (2.0 * w / (extent(frame.render_extent) * across)).abs().clamp(Vec2::splat(1e-15), Vec2::splat(1e15))
}

/// Where a surface was in the world, by its place on the screen of the previous frame: pixels; centres are whole numbers.
pub(crate) fn previous_surface(frame: &FrameConstants, position: Vec2, previous_depth: f32) -> Vec3 {
    // Samples of both frames lie beside their pixels' centres.
    let sample = position + 0.5 + sample_offset(frame) * extent_ratio(frame) - previous_sample_offset(frame);
    let w = frame.previous_clip_w_scale * previous_depth + frame.previous_clip_w_offset;
    let place = Vec4::new(sample.x * w, sample.y * w, previous_depth, 1.0);
    (Mat4::from_cols_array_2d(&frame.world_from_previous_sample) * place).xyz()
}

/// The line of sight of a pixel in view space: `origin + direction·z` is its point at linear depth z.
#[derive(Clone, Copy, Debug)]
struct ViewRay {
    pub origin: Vec3,
    /// |z| is 1.
    pub direction: Vec3,
}

/// The projections of a frame and of the one before it: between pixels, depths of the host and points of the world.
#[derive(Clone, Copy, Debug)]
pub struct Projections {
    clip_from_view: Mat4,
    world_from_view: Mat4,
    previous_clip_from_world: Mat4,
    previous_view_from_world: Mat4,
    extent: Vec2,
    previous_extent: Vec2,
    sample_offset: Vec2,
    forward: f32,
    encoding: DepthEncoding,
}

impl Projections {
    /// Projections by the matrices, the jitter and the extents of both frames.
    pub fn new(frame: &FrameConstants) -> Self {
        Self {
            clip_from_view: Mat4::from_cols_array_2d(&frame.clip_from_view),
            world_from_view: Mat4::from_cols_array_2d(&frame.world_from_view),
            previous_clip_from_world: Mat4::from_cols_array_2d(&frame.previous_clip_from_world),
            previous_view_from_world: Mat4::from_cols_array_2d(&frame.previous_view_from_world),
            extent: extent(frame.render_extent),
            previous_extent: extent(frame.previous_render_extent),
            sample_offset: sample_offset(frame),
            forward: forward(frame),
            encoding: depth_encoding(frame),
        }
    }

    /// Position of the sample of a pixel in the unjittered image, pixels.
    pub fn sample_position(&self, pixel: [i32; 2]) -> [f32; 2] {
        (IVec2::from(pixel).as_vec2() + 0.5 + self.sample_offset).into()
    }

    /// The line of sight through a position in pixels. Solves `clip.xy = ndc·clip.w` for view x and y at two depths, which covers
    /// perspective, off-centre and orthographic projections alike.
    fn view_ray(&self, position: [f32; 2]) -> ViewRay {
        let ndc = Vec2::from(position) / self.extent * 2.0 - 1.0;
        let [row_x, row_y, row_w] = [0, 1, 3].map(|i| self.clip_from_view.row(i));
        let (x, y) = (row_x - ndc.x * row_w, row_y - ndc.y * row_w);
        let across = Mat2::from_cols(Vec2::new(x.x, y.x), Vec2::new(x.y, y.y));
        if across.determinant() == 0.0 {
            return ViewRay { origin: Vec3::ZERO, direction: Vec3::new(0.0, 0.0, self.forward) };
        }
        let inverse = across.inverse();
        let at = |z: f32| inverse * -Vec2::new(x.z * z + x.w, y.z * z + y.w);
        let (origin, one) = (at(0.0), at(self.forward));
        ViewRay { origin: origin.extend(0.0), direction: (one - origin).extend(self.forward) }
    }

    /// Linear depth of the host's depth, with whether it was NaN. Everything that is background is 0.
    pub fn linear_depth(&self, pixel: [i32; 2], depth: f32, background_depth: f32) -> (f32, bool) {
        if depth.is_nan() {
            return (0.0, true);
        }
        let z = match self.encoding {
            DepthEncoding::Linear => depth,
            DepthEncoding::Device => self.linear_depth_of_device(depth),
            DepthEncoding::RayLength => depth / self.view_ray(self.sample_position(pixel)).direction.length(),
        };
        let surface = z.is_finite() && z >= NEAREST && z < background_depth;
        (if surface { z } else { 0.0 }, false)
    }

    fn linear_depth_of_device(&self, d: f32) -> f32 {
        let (z, w) = (self.clip_from_view.row(2), self.clip_from_view.row(3));
        let denominator = z.z - d * w.z;
        if denominator == 0.0 {
            return f32::INFINITY;
        }
        ((d * w.w - z.w) / denominator).abs()
    }

    /// The world position of a pixel's sample at a linear depth. At depth 0, the background, it is a direction (w = 0): that of a
    /// point at infinity. All depths of an orthographic line of sight project alike, so there it is the point at depth 1.
    pub fn world_point(&self, pixel: [i32; 2], linear_depth: f32) -> [f32; 4] {
        let ray = self.view_ray(self.sample_position(pixel));
        let is_orthographic = self.clip_from_view.row(3).z == 0.0;
        let view = match linear_depth {
            z if z > 0.0 => (ray.origin + ray.direction * z).extend(1.0),
            _ if is_orthographic => (ray.origin + ray.direction).extend(1.0),
            _ => ray.direction.extend(0.0),
        };
        (self.world_from_view * view).into()
    }

    /// The world direction towards the camera: against the view axis.
    pub(crate) fn towards_camera(&self) -> [f32; 3] {
        (self.world_from_view.z_axis.xyz() * -self.forward).normalize_or(Vec3::Z).into()
    }

    /// A view-space direction in world space.
    pub fn world_direction(&self, view: [f32; 3]) -> [f32; 3] {
        self.world_from_view.transform_vector3(view.into()).into()
    }

    /// Position of a world point in the previous image, pixels; `None` beside or behind the camera.
    pub fn previous_position(&self, world: [f32; 4]) -> Option<[f32; 2]> {
        let clip = self.previous_clip_from_world * Vec4::from(world);
        let position = (clip.xy() / clip.w * 0.5 + 0.5) * self.previous_extent;
        (clip.w > 0.0 && position.is_finite()).then_some(position.into())
    }

    /// The linear depth of a world point in the previous frame's camera.
    pub fn previous_linear_depth(&self, world: [f32; 4]) -> f32 {
        (self.previous_view_from_world * Vec4::from(world)).z * self.forward
    }
}

//! A room of slanted surfaces, seen by a camera that moves and turns; its guides in any encoding.

use crate::Guides;
use atrous::config::{
    Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward,
};
use atrous::reference::Image;
use atrous::FrameParams;
use glam::{Mat4, Vec2, Vec2Swizzles, Vec3, Vec3Swizzles, Vec4Swizzles};

pub const EXTENT: [u32; 2] = [64, 36];

/// Motion in a frame of the things that move by themselves.
const STEP: Vec3 = Vec3::new(0.11, 0.07, -0.05);

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Camera {
    Still,
    /// Along its own x axis.
    Slides,
    /// About its own y axis.
    Turns,
    /// Along and about all axes.
    Moves,
}

/// The scene and its encodings.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Encodings of the guides.
    pub encoding: Conventions,
    /// Reversed depth with an infinite far plane.
    pub reversed: bool,
    pub orthographic: bool,
    pub camera: Camera,
    /// A sphere moves by itself.
    pub things_move: bool,
    /// Jitter of both frames.
    pub jitter: [[f32; 2]; 2],
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            encoding: Conventions::default(),
            reversed: false,
            orthographic: false,
            camera: Camera::Moves,
            things_move: false,
            jitter: [[0.31, -0.22], [-0.27, 0.36]],
        }
    }
}

/// The guides of a frame, which a test spoils.
#[derive(Clone, Debug)]
pub struct Frame {
    pub params: FrameParams,
    pub depth: Image<[f32; 4]>,
    pub normal: Image<[f32; 4]>,
    pub motion: Image<[f32; 4]>,
    pub surface_id: Image<u32>,
}

impl Frame {
    pub fn guides(&self) -> Guides<'_> {
        Guides {
            params: self.params,
            depth: &self.depth,
            normal: Some(&self.normal),
            motion: Some(&self.motion),
            surface_id: Some(&self.surface_id),
        }
    }
}

struct Hit {
    distance: f32,
    normal: Vec3,
    id: u32,
}

/// Walls, floor, a box's faces and two spheres; none faces the camera.
fn trace(origin: Vec3, direction: Vec3, moved: Vec3) -> Option<Hit> {
    let planes = [
        (Vec3::new(0.0, 1.0, 0.0), -1.2, 1),
        (Vec3::new(0.8, 0.1, 0.6).normalize(), -4.0, 2),
        (Vec3::new(-0.7, 0.2, 0.7).normalize(), -4.5, 3),
    ];
    let mut hits = Vec::new();
    for (normal, offset, id) in planes {
        hits.push(Hit { distance: (offset - normal.dot(origin)) / normal.dot(direction), normal, id });
    }
    for (centre, radius, id) in [(Vec3::new(-0.9, -0.3, -3.6), 0.7, 4), (Vec3::new(0.9, -0.1, -3.2) + moved, 0.6, 5)] {
        let to = origin - centre;
        let (b, c) = (to.dot(direction), to.length_squared() - radius * radius);
        let distance = -b - (b * b - c).max(0.0).sqrt();
        if b * b > c {
            hits.push(Hit { distance, normal: (to + direction * distance).normalize(), id });
        }
    }
    let ahead = hits.into_iter().filter(|h| h.distance > 0.1 && h.normal.dot(direction) < 0.0);
    // Above this height there is sky.
    let below = ahead.filter(|h| (origin + direction * h.distance).y < 1.6);
    below.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

impl Scene {
    fn view_from_world(&self, index: usize) -> Mat4 {
        let t = if self.camera == Camera::Moves { index as f32 } else { 0.0 };
        let slide = if self.camera == Camera::Slides { 0.15 * index as f32 } else { 0.0 };
        let turn = Mat4::from_rotation_y(0.25 + 0.02 * t) * Mat4::from_rotation_x(-0.2 + 0.015 * t) * Mat4::from_rotation_z(0.1);
        let world_from_view = Mat4::from_translation(Vec3::new(0.3 + 0.12 * t, 0.2 + 0.06 * t, 0.4 - 0.1 * t)) * turn;
        let about = if self.camera == Camera::Turns { Mat4::from_rotation_y(0.02 * index as f32) } else { Mat4::IDENTITY };
        self.mirror() * Mat4::from_translation(-slide * Vec3::X) * about * world_from_view.inverse()
    }

    /// The map from a view that looks along −z to the declared one.
    fn mirror(&self) -> Mat4 {
        let z = if self.encoding.view_forward == ViewForward::PositiveZ { -1.0 } else { 1.0 };
        Mat4::from_scale(Vec3::new(1.0, 1.0, z))
    }

    fn clip_from_view(&self) -> Mat4 {
        let (focal, near, far) = (1.5, 0.1, 50.0);
        let aspect = EXTENT[0] as f32 / EXTENT[1] as f32;
        let (zz, zw) = if self.reversed { (0.0, near) } else { (far / (near - far), near * far / (near - far)) };
        if self.orthographic {
            let scale = Vec3::new(0.4 / aspect, -0.4, -1.0 / far);
            return Mat4::from_scale(scale) * self.mirror();
        }
        let looks_back = Mat4::from_cols_array_2d(&[
            [focal / aspect, 0.0, 0.0, 0.0],
            [0.0, -focal, 0.0, 0.0],
            [0.0, 0.0, zz, -1.0],
            [0.0, 0.0, zw, 0.0],
        ]);
        looks_back * self.mirror()
    }

    pub fn params(&self, index: usize) -> FrameParams {
        FrameParams {
            view_from_world: self.view_from_world(index).to_cols_array_2d(),
            clip_from_view: self.clip_from_view().to_cols_array_2d(),
            jitter: self.jitter[index],
            ..FrameParams::new(EXTENT)
        }
    }

    pub fn frames(&self) -> [Frame; 2] {
        [0, 1].map(|index| self.frame(index))
    }

    fn frame(&self, index: usize) -> Frame {
        let pixels = (0..EXTENT[1]).flat_map(|y| (0..EXTENT[0]).map(move |x| Vec2::new(x as f32, y as f32)));
        let texels: Vec<_> = pixels.map(|p| self.texel(index, p)).collect();
        let image =
            |i: usize| Image::from_texels(EXTENT, texels.iter().map(|t| t.0[i]).collect()).expect("as many texels as pixels");
        Frame {
            params: self.params(index),
            depth: image(0),
            normal: image(1),
            motion: image(2),
            surface_id: Image::from_texels(EXTENT, texels.iter().map(|t| t.1).collect()).expect("as many texels as pixels"),
        }
    }

    /// Depth, normal, motion; id.
    fn texel(&self, index: usize, p: Vec2) -> ([[f32; 4]; 3], u32) {
        let (view, clip) = (self.view_from_world(index), self.clip_from_view());
        let extent = Vec2::new(EXTENT[0] as f32, EXTENT[1] as f32);
        let jitter = Vec2::from(self.jitter[index]);
        let ndc = (p + 0.5 + jitter) / extent * 2.0 - 1.0;
        let world_from_view = view.inverse();
        let on_ray = |depth: f32| (world_from_view * clip.inverse()).project_point3(ndc.extend(depth));
        let origin = on_ray(if self.reversed { 1.0 } else { 0.0 });
        let direction = (on_ray(0.5) - origin).normalize();
        let moved = if self.things_move { STEP * index as f32 } else { Vec3::ZERO };
        let Some(hit) = trace(origin, direction, moved) else {
            return ([[0.0; 4]; 3], 0);
        };
        let world = origin + direction * hit.distance;
        let depth = match self.encoding.depth {
            DepthEncoding::Linear => (view * world.extend(1.0)).z.abs(),
            DepthEncoding::Device => (clip * view).project_point3(world).z,
            DepthEncoding::RayLength => world.distance(world_from_view.w_axis.xyz()),
        };
        let before = if hit.id == 5 && self.things_move { world - STEP } else { world };
        let position = |i: usize, world: Vec3| {
            let ndc = (self.clip_from_view() * self.view_from_world(i)).project_point3(world).truncate();
            let raster = if self.encoding.motion_jittered { Vec2::from(self.jitter[i]) / extent } else { Vec2::ZERO };
            ndc * 0.5 + 0.5 - raster
        };
        // The camera of the previous frame the first one does not matter.
        let motion = if index == 0 { Vec2::ZERO } else { position(0, before) - position(1, world) };
        let previous_depth = (self.view_from_world(0) * before.extend(1.0)).z.abs();
        let z = match self.encoding.motion_depth {
            MotionDepth::None => 0.0,
            MotionDepth::Difference => previous_depth - (view * world.extend(1.0)).z.abs(),
            MotionDepth::Absolute => previous_depth,
        };
        ([[depth, 0.0, 0.0, 0.0], self.normal(view, hit.normal), self.motion(motion, z)], hit.id)
    }

    fn motion(&self, uv: Vec2, z: f32) -> [f32; 4] {
        let c = &self.encoding;
        let scale = match c.motion_unit {
            MotionUnit::Pixels => Vec2::new(EXTENT[0] as f32, EXTENT[1] as f32),
            MotionUnit::Uv => Vec2::ONE,
            MotionUnit::Ndc => Vec2::splat(2.0),
        };
        let sign = if c.motion_direction == MotionDirection::PreviousMinusCurrent { 1.0 } else { -1.0 };
        let v = uv * scale * sign;
        [v.x, if c.motion_y_up { -v.y } else { v.y }, z, 0.0]
    }

    fn normal(&self, view: Mat4, world: Vec3) -> [f32; 4] {
        let n = if self.encoding.normal_space == NormalSpace::View { view.transform_vector3(world) } else { world };
        let octahedral = || to_square(n).extend(0.0);
        let n = match self.encoding.normal {
            NormalEncoding::Xyz => n,
            NormalEncoding::XyzUnorm => n * 0.5 + 0.5,
            NormalEncoding::Octahedral => octahedral(),
            NormalEncoding::OctahedralUnorm => octahedral() * 0.5 + 0.5,
        };
        n.extend(0.0).to_array()
    }
}

/// The point of the square −1..1 for a direction: an octahedron unfolded.
fn to_square(n: Vec3) -> Vec2 {
    let e = n.xy() / n.abs().element_sum();
    if n.z < 0.0 {
        (1.0 - e.yx().abs()) * e.map(|side| 1.0_f32.copysign(side))
    } else {
        e
    }
}

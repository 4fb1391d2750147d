//! Residuals of depth, motion and normals between two frames under one geometry.

use crate::contest::{Residuals, MOTION};
use crate::geometry::Geometry;
use crate::readings::{MotionReading, NormalReading};
use crate::{at, Guides};
use atrous::config::{NormalEncoding, NormalSpace};
use atrous::reference::{decode_normal, motion_in_pixels, Projections};
use atrous::{Error, Flags, FrameConstants, FrameParams, FrameState, Setup, Tuning};
use glam::{IVec2, Vec2, Vec3, Vec4};

/// More pixels than this say nothing new.
const MOST_PIXELS: f32 = 16384.0;
/// Relative change of depth per pixel below which a position cannot be told from a depth; above the
/// losses of half precision.
const LEAST_GRADIENT: f32 = 2e-3;
/// Relative difference of depth between neighbours beyond which there is an edge between them.
const EDGE: f32 = 0.25;

/// Jitter moves a projection by two pixels at most, from one frame to the next.
const JITTER: f32 = 2.0;

/// Whether the camera stands still: of one view, and of projections that are the same but for jitter.
fn camera_stands([previous, current]: [&FrameParams; 2]) -> bool {
    let [width, height] = current.render_extent.map(|side| side as f32);
    let slack = 2.0 * JITTER / width.min(height);
    let numbers = |params: &FrameParams| params.clip_from_view.as_flattened().to_vec();
    let is_near = |(a, b): (f32, f32)| (a - b).abs() <= slack;
    previous.view_from_world == current.view_from_world && numbers(previous).into_iter().zip(numbers(current)).all(is_near)
}

/// Every n-th pixel in both directions.
fn sample([width, height]: [u32; 2]) -> Vec<IVec2> {
    let step = ((width as f32 * height as f32 / MOST_PIXELS).sqrt().ceil() as usize).max(1);
    let rows = (step / 2..height as usize).step_by(step);
    rows.flat_map(|y| (step / 2..width as usize).step_by(step).map(move |x| IVec2::new(x as i32, y as i32))).collect()
}

/// Two frames as they are given, and the pixels that are looked at.
pub(super) struct Pair<'a> {
    pub previous: &'a Guides<'a>,
    pub current: &'a Guides<'a>,
    pub pixels: Vec<IVec2>,
    /// Whatever the matrices are, a point then stays at its place, but for jitter.
    pub camera_stands: bool,
    /// Unit normals of the pixels by every encoding, in the order of the enum; `None` where there is none.
    normals: Vec<[Option<Vec3>; 4]>,
}

impl<'a> Pair<'a> {
    pub fn new(previous: &'a Guides<'a>, current: &'a Guides<'a>) -> Self {
        use NormalEncoding as E;
        let pixels = sample(current.params.render_extent);
        let decode = |p: &IVec2| {
            let texel = current.normal.map(|normals| at(normals, *p));
            let encodings = [E::Xyz, E::XyzUnorm, E::Octahedral, E::OctahedralUnorm];
            encodings.map(|e| Vec3::from(decode_normal(e, texel?)).try_normalize())
        };
        let normals = pixels.iter().map(decode).collect();
        let camera_stands = camera_stands([&previous.params, &current.params]);
        Self { previous, current, pixels, camera_stands, normals }
    }
}

/// A pair under one geometry.
pub(super) struct Scene<'a> {
    pair: &'a Pair<'a>,
    constants: [FrameConstants; 2],
    projections: [Projections; 2],
    depth_scale: f32,
    setup: Setup,
}

/// A pixel under one geometry; NaN and `None` where it says nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Distance of the depth in the previous frame from its place, pixels.
    pub depth: f32,
    /// Motion of static geometry, pixels of the previous frame. Infinite: it was behind the camera.
    pub motion: Vec2,
    /// World-space normal of the depth.
    pub normal: Option<Vec3>,
    /// Linear depth, and that of the same point in the previous frame, if it is static.
    pub depths: [f32; 2],
}

const NOTHING: Point = Point { depth: f32::NAN, motion: Vec2::NAN, normal: None, depths: [f32::NAN; 2] };

/// A pixel's motion by one reading: `scale · texel + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    scale: Vec2,
    offset: Vec2,
}

impl Affine {
    pub fn read(&self, texel: Vec2) -> Vec2 {
        self.scale * texel + self.offset
    }

    /// The texel of a host that means `motion` by this reading.
    pub fn write(&self, motion: Vec2) -> Vec2 {
        (motion - self.offset) / self.scale
    }
}

impl<'a> Scene<'a> {
    /// # Errors
    /// Names the field of the parameters that is unusable.
    pub fn new(geometry: &Geometry, pair: &'a Pair<'a>) -> Result<Self, Error> {
        let setup = |guides: &Guides| Setup { conventions: geometry.conventions, ..Setup::new(guides.depth.extent()) };
        let frame = |params: &FrameParams| FrameParams { frame_slot: 0, light_offset: [0; 2], ..*params };
        let mut state = FrameState::default();
        let first = state.begin(&setup(pair.previous), &frame(&geometry.previous), &Tuning::default())?.constants;
        let second = state.begin(&setup(pair.current), &frame(&geometry.current), &Tuning::default())?.constants;
        let projections = [Projections::new(&first), Projections::new(&second)];
        let depth_scale = geometry.depth_scale;
        Ok(Self { pair, constants: [first, second], projections, depth_scale, setup: setup(pair.current) })
    }

    /// Linear depth; 0 where there is no surface.
    fn depth(&self, frame: usize, p: IVec2) -> f32 {
        let guides = [self.pair.previous, self.pair.current][frame];
        let background = self.setup.conventions.background_depth;
        if guides.id(p) == Some(0) {
            return 0.0;
        }
        let (depth, scale) = (at(guides.depth, p)[0], self.depth_scale);
        self.projections[frame].linear_depth(p.into(), depth * scale, background * scale).0
    }

    pub fn point(&self, p: IVec2) -> Point {
        let z = self.depth(1, p);
        if z == 0.0 {
            return NOTHING;
        }
        let now = &self.projections[1];
        let world = now.world_point(p.into(), z);
        let normal = self.normal(p, z);
        let expected = now.previous_linear_depth(world);
        match now.previous_position(world).filter(|_| expected > 0.0) {
            Some(position) => {
                let [width, height] = self.constants[0].render_extent.map(|side| side as f32);
                let ratio = Vec2::new(width, height) / Vec2::from(self.constants[1].render_extent.map(|side| side as f32));
                Point {
                    depth: self.depth_residual(position.into(), expected, self.pair.current.id(p)),
                    motion: Vec2::from(position) - Vec2::from(now.sample_position(p.into())) * ratio,
                    normal,
                    depths: [z, expected],
                }
            }
            None => Point { depth: f32::INFINITY, motion: Vec2::INFINITY, normal, ..NOTHING },
        }
    }

    /// Distance from `position` to the expected depth in the previous frame, pixels. Against the gradient, so that it does not
    /// depend on how depth is encoded.
    fn depth_residual(&self, position: Vec2, expected: f32, id: Option<u32>) -> f32 {
        let at = position - Vec2::from(self.constants[0].jitter) - 0.5;
        let [width, height] = self.constants[0].render_extent.map(|side| side as f32);
        let is_within = |from: f32, to: Vec2| at.cmpge(Vec2::splat(from)).all() && at.cmplt(to).all();
        if !is_within(0.0, Vec2::new(width - 1.0, height - 1.0)) {
            // On the border, nothing can be interpolated; that is no contradiction.
            return if is_within(-1.0, Vec2::new(width, height)) { f32::NAN } else { f32::INFINITY };
        }
        let (cell, part) = (at.floor().as_ivec2(), at - at.floor());
        let corners = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE].map(|o| cell + o);
        let z = corners.map(|q| self.depth(0, q));
        let (least, most) = (z.iter().copied().fold(f32::INFINITY, f32::min), z.iter().copied().fold(0.0, f32::max));
        if least <= 0.0 || most - least > EDGE * least || corners.iter().any(|q| self.pair.previous.id(*q) != id) {
            return f32::NAN;
        }
        let [top, bottom] = [z[0] + (z[1] - z[0]) * part.x, z[2] + (z[3] - z[2]) * part.x];
        let gradient = Vec2::new(z[1] + z[3] - z[0] - z[2], z[2] + z[3] - z[0] - z[1]).length() * 0.5;
        (top + (bottom - top) * part.y - expected).abs() / gradient.max(LEAST_GRADIENT * expected)
    }

    /// The normal of the surface that the depths around a pixel make, towards the camera. Of two neighbours the one whose depth
    /// differs less.
    fn normal(&self, p: IVec2, z: f32) -> Option<Vec3> {
        let [width, height] = self.constants[1].render_extent.map(|side| side as i32);
        let point = |p: IVec2, z| Vec4::from(self.projections[1].world_point(p.into(), z)).truncate();
        let tangent = |axis: IVec2| {
            let neighbours = [axis, -axis].into_iter().filter_map(|step| {
                let q = p + step;
                let inside = q.x >= 0 && q.y >= 0 && q.x < width && q.y < height;
                let z_q = if inside && self.pair.current.id(q) == self.pair.current.id(p) { self.depth(1, q) } else { 0.0 };
                ((z_q - z).abs() <= EDGE * z).then_some((step, q, z_q))
            });
            let nearest = neighbours.min_by(|a, b| (a.2 - z).abs().total_cmp(&(b.2 - z).abs()));
            let here = point(p, z);
            nearest.map(|(step, q, z_q)| (point(q, z_q) - here) * (step.x + step.y) as f32)
        };
        let normal = tangent(IVec2::X)?.cross(tangent(IVec2::Y)?).try_normalize()?;
        let sight = point(p, z) - point(p, 0.5 * z);
        Some(if normal.dot(sight) > 0.0 { -normal } else { normal })
    }

    /// The map from texels to pixels by which a reading takes motion.
    pub fn affine(&self, reading: MotionReading) -> Affine {
        let conventions = reading.apply(&self.setup.conventions);
        let constants = FrameConstants { flags: Flags::of(&conventions, false), ..self.constants[1] };
        let read = |texel| Vec2::from(motion_in_pixels(&constants, texel));
        let offset = read([0.0; 2]);
        Affine { scale: read([1.0; 2]) - offset, offset }
    }

    pub fn has_normals(&self) -> bool {
        self.pair.current.normal.is_some()
    }

    pub fn has_motion(&self) -> bool {
        self.pair.current.motion.is_some()
    }

    /// The host's motion of a pixel, as it is stored.
    pub fn motion_texel(&self, p: IVec2) -> Option<Vec2> {
        let [x, y, ..] = at(self.pair.current.motion?, p);
        Some(Vec2::new(x, y)).filter(|v| v.is_finite())
    }

    /// z of the host's motion.
    pub fn motion_depth_texel(&self, p: IVec2) -> Option<f32> {
        self.motion_texel(p).and(self.pair.current.motion).map(|motion| at(motion, p)[2])
    }

    /// Degrees between the host's normals and those of the depth.
    pub fn normal_residuals(&self, reading: NormalReading, points: &[Point]) -> Residuals {
        let (signs, encoding) = (Vec3::from(reading.signs), reading.encoding as usize);
        let residual = |(decoded, point): (&[Option<Vec3>; 4], &Point)| match (decoded[encoding], point.normal) {
            (Some(host), Some(normal)) => {
                let host = match reading.space {
                    NormalSpace::World => host * signs,
                    NormalSpace::View => Vec3::from(self.projections[1].world_direction((host * signs).into())).normalize_or_zero(),
                };
                host.dot(normal).clamp(-1.0, 1.0).acos().to_degrees()
            }
            _ => f32::NAN,
        };
        self.pair.normals.iter().zip(points).map(residual).collect()
    }

    /// Pixels between the host's motion and that of static geometry.
    pub fn motion_residuals(&self, reading: MotionReading, points: &[Point]) -> Residuals {
        let affine = self.affine(reading);
        let residual = |(p, point): (&IVec2, &Point)| match self.motion_texel(*p) {
            Some(_) if point.motion.x.is_nan() => f32::NAN,
            Some(texel) => forgiven((affine.read(texel) - point.motion).length(), point.motion),
            None => f32::NAN,
        };
        self.pair.pixels.iter().zip(points).map(residual).collect()
    }
}

/// A residual of motion, unless half precision of long motion explains it.
fn forgiven(residual: f32, motion: Vec2) -> f32 {
    let slack = 0.003 * motion.length();
    if motion.is_finite() && residual <= MOTION.explains + slack {
        residual.min(MOTION.explains)
    } else {
        residual
    }
}

//! Where the image of what is seen in a surface was: as far behind the surface as the thing lies before it, if it is flat. \[Zimmer et al.
//! 2015\]

use super::guide::{unpack_guide, Surface};
use super::projection::{extent_ratio, sample_offset, Projections};
use super::reflection::{image_distance, mirror_share, SeenReflection};
use super::{render_rect::RenderRect, Image};
use crate::FrameConstants;
use glam::{IVec2, Vec2, Vec3, Vec4, Vec4Swizzles};

/// Pixels between normals: those of the guide are rounded to half a degree.
const REACH: i32 = 3;

/// The surface of a pixel.
#[derive(Clone, Copy)]
pub(crate) struct Mirror {
    pub p: IVec2,
    pub surface: Surface,
    /// World space.
    pub position: Vec3,
    /// From the eye, of unit length, world space.
    pub sight: Vec3,
    /// Where the surface was in the previous frame, pixels; centres are whole numbers.
    pub surface_position: Vec2,
}

/// The surfaces of a frame, with its projections.
pub(crate) struct VirtualMotion<'a> {
    frame: &'a FrameConstants,
    rect: RenderRect,
    projections: Projections,
    pub surfaces: Image<Surface>,
}

impl<'a> VirtualMotion<'a> {
    pub fn new(frame: &'a FrameConstants, guide: &Image<[u16; 4]>) -> Self {
        Self {
            frame,
            rect: RenderRect::new(frame.render_extent),
            projections: Projections::new(frame),
            surfaces: Image::compute(guide.extent(), frame.render_extent, |p| unpack_guide(guide.at(p))),
        }
    }

    /// `motion`: of the surface, pixels of the previous frame.
    pub fn mirror(&self, p: IVec2, motion: [f32; 2]) -> Mirror {
        let surface = self.surfaces.at(p);
        let position = self.world(p, surface.linear_depth);
        let sight = (self.world(p, 2.0 * surface.linear_depth) - position).normalize();
        let surface_position = (p.as_vec2() + 0.5) * extent_ratio(self.frame) + Vec2::from(motion) - 0.5;
        Mirror { p, surface, position, sight, surface_position }
    }

    /// Where the image of what is seen was, pixels; `None`: behind the camera.
    pub fn image_position(&self, mirror: &Mirror, curvature: f32, seen: SeenReflection) -> Option<Vec2> {
        self.virtual_position(mirror, image_distance(seen, curvature), mirror_share(seen.roughness))
    }

    /// Mean of the curvatures along rows and columns, 1 / scene unit; positive where the surface is convex.
    pub fn mean_curvature(&self, mirror: &Mirror) -> f32 {
        0.5 * (self.curvature_along(mirror, IVec2::X) + self.curvature_along(mirror, IVec2::Y))
    }

    fn world(&self, p: IVec2, linear_depth: f32) -> Vec3 {
        Vec4::from(self.projections.world_point(p.into(), linear_depth)).xyz()
    }

    /// That of the flatter side: where two faces meet, the other side tells of the edge. At an outline, of the side that there is.
    fn curvature_along(&self, mirror: &Mirror, axis: IVec2) -> f32 {
        match (self.curvature_towards(mirror, -REACH * axis), self.curvature_towards(mirror, REACH * axis)) {
            (Some(before), Some(behind)) if before.abs() < behind.abs() => before,
            (before, behind) => behind.or(before).unwrap_or(0.0),
        }
    }

    /// `None` where another surface is.
    fn curvature_towards(&self, mirror: &Mirror, offset: IVec2) -> Option<f32> {
        let q = mirror.p + offset;
        let tap = Some(q).filter(|q| self.rect.contains(*q)).map(|q| self.surfaces.at(q))?;
        if tap.is_background() || tap.id != mirror.surface.id {
            return None;
        }
        let way = self.world(q, tap.linear_depth) - mirror.position;
        Some((tap.unit_normal() - mirror.surface.unit_normal()).dot(way) / way.length_squared().max(1e-20))
    }

    /// Where a point of the world that stands still was on the screen; `None`: behind the camera.
    fn previous_pixel_position(&self, world: Vec3) -> Option<Vec2> {
        let at = Vec2::from(self.projections.previous_position(world.extend(1.0).into())?);
        let position = at - sample_offset(self.frame) * extent_ratio(self.frame) - 0.5;
        // What lies far outside has no pixel.
        position.abs().cmplt(Vec2::splat(1e6)).all().then_some(position)
    }

    /// Where the image at a distance behind the surface was. A surface that moves by itself takes along what is not mirrored alone.
    fn virtual_position(&self, mirror: &Mirror, distance: f32, share: f32) -> Option<Vec2> {
        let still = self.previous_pixel_position(mirror.position)?;
        let position = self.previous_pixel_position(mirror.position + mirror.sight * distance)?;
        Some(position + (mirror.surface_position - still) * (1.0 - share))
    }
}

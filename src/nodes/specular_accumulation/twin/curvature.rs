//! Curvature of surfaces, from the normals around a pixel.

use super::{Centre, Scene};
use glam::IVec2;

/// Pixels between normals: those of the guide are rounded to half a degree.
const REACH: i32 = 3;

impl Scene<'_> {
    /// Mean of the curvatures along rows and columns, 1 / scene unit; positive where the surface is convex.
    pub(super) fn mean_curvature(&self, c: &Centre) -> f32 {
        0.5 * (self.curvature_along(c, IVec2::X) + self.curvature_along(c, IVec2::Y))
    }

    /// That of the flatter side: where two faces meet, the other side tells of the edge.
    fn curvature_along(&self, c: &Centre, axis: IVec2) -> f32 {
        match (self.curvature_towards(c, -REACH * axis), self.curvature_towards(c, REACH * axis)) {
            (Some(before), Some(behind)) if before.abs() < behind.abs() => before,
            (Some(_), Some(behind)) => behind,
            _ => 0.0,
        }
    }

    /// `None` where another surface is.
    fn curvature_towards(&self, c: &Centre, offset: IVec2) -> Option<f32> {
        let q = c.p + offset;
        let tap = Some(q).filter(|q| self.rect.contains(*q)).map(|q| self.surfaces.at(q))?;
        if tap.is_background() || tap.id != c.surface.id {
            return None;
        }
        let way = self.world(q, tap.linear_depth) - c.position;
        Some((tap.unit_normal() - c.surface.unit_normal()).dot(way) / way.length_squared().max(1e-20))
    }
}

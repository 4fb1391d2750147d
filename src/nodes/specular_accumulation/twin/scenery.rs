//! A mirror and the thing in it, as their instances carry them to the previous frame.

use super::Scene;
use crate::reference::curvature::Curvature;
use crate::reference::reprojection::{about_eye, carried, turned, InstanceTransform};
use crate::reference::virtual_motion::{image_at_rest, Mirror, MirrorBefore};
use glam::Vec3;

/// A mirror and the thing in it, in the previous frame.
#[derive(Clone, Copy)]
pub(super) struct Scenery {
    pub mirror: MirrorBefore,
    pub thing: Vec3,
    /// The image of the thing as a flat mirror showed it, in the axes of the mirror.
    pub image: Vec3,
}

impl Scene<'_> {
    /// The surface of the thing is that of the pixel's own path.
    pub(super) fn scenery_before(&self, mirror: &Mirror, curvature: &Curvature, hit_distance: f32) -> Scenery {
        let direction = mirror.sight.reflect(mirror.surface.unit_normal());
        let at = |reach: f32| mirror.position + direction * reach;
        // A direction tells no more of what is farther away.
        let thing = at(hit_distance.min(1e4 * mirror.surface.linear_depth));
        let rest = Scenery { mirror: MirrorBefore::at_rest(mirror, curvature), thing, image: image_at_rest(hit_distance) };
        let moved = if hit_distance > 0.0 { self.moved(mirror, curvature, at(hit_distance)) } else { None };
        moved.unwrap_or(rest)
    }

    /// `None` where neither moves, and where a transform leaves nothing to be seen.
    fn moved(&self, mirror: &Mirror, curvature: &Curvature, thing: Vec3) -> Option<Scenery> {
        let thing_to = self.carried(self.inputs.hit_id?.at(mirror.p), thing);
        let mirror_to = self.inputs.surface_id.and_then(|ids| self.carried(ids.at(mirror.p), mirror.position));
        if thing_to.is_none() && mirror_to.is_none() {
            return None;
        }
        let thing = thing_to.map_or(thing, |(_, to)| to);
        let normal = mirror.surface.unit_normal();
        let (before, normal) = match mirror_to {
            Some((transform, position)) => {
                let sight = turned(&transform, mirror.sight).normalize();
                let across = turned(&transform, curvature.across);
                let across = (across - across.dot(sight) * sight).normalize();
                let axes = MirrorBefore { position, sight, along: sight.cross(across), across };
                (axes, turned(&transform, normal).normalize())
            }
            None => (MirrorBefore::at_rest(mirror, curvature), normal),
        };
        let image = before.axes((thing - before.position).reflect(normal));
        (image.z > 0.0 && image.is_finite()).then_some(Scenery { mirror: before, thing, image })
    }

    /// How an instance moved, in the world seen from the eye, and to where it carries a point; `None` for the background, without an entry,
    /// and for one that is not finite.
    fn carried(&self, id: u32, point: Vec3) -> Option<(InstanceTransform, Vec3)> {
        let transform = self.inputs.instance_transforms?.get(id as usize).filter(|_| id != 0)?;
        let transform = transform.iter().flatten().all(|x| x.is_finite()).then(|| about_eye(self.frame, transform))?;
        Some((transform, carried(&transform, point.extend(1.0))?))
    }

    /// Whether the thing in a mirror should have a transform that can be used, and has none.
    pub(super) fn lacks_transform(&self, mirror: &Mirror, hit_distance: f32) -> bool {
        let Some(id) = self.inputs.hit_id.filter(|_| self.inputs.instance_transforms.is_some()).map(|ids| ids.at(mirror.p)) else {
            return false;
        };
        let thing = mirror.position + mirror.sight.reflect(mirror.surface.unit_normal()) * hit_distance;
        hit_distance > 0.0 && id != 0 && self.carried(id, thing).is_none()
    }
}

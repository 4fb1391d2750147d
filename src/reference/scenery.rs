//! A mirror and the thing in it, as they were in the previous frame.

use super::curvature::Curvature;
use super::reflection::{lobe_radius, SeenReflection};
use super::reprojection::{about_eye, carried, turned, InstanceTransform};
use super::virtual_motion::{image_at_rest, Mirror, MirrorBefore};
use super::Image;
use crate::FrameConstants;
use glam::Vec3;

/// Pixels that a lobe may cover whose thing is followed: in a wider one each pixel draws another thing, and their ids would tear its light
/// apart.
const NARROW_LOBE: f32 = 1.0;

/// By what mirrors and the things in them move.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Instances<'a> {
    /// Ids of what the specular paths hit.
    pub hit_id: Option<&'a Image<u32>>,
    /// The host's own motion of the points that they hit: previous minus current place, world space. It counts before the ids.
    pub motion: Option<&'a Image<[f32; 4]>>,
    /// Ids of the mirrors.
    pub surface_id: Option<&'a Image<u32>>,
    /// Transforms by id.
    pub transforms: Option<&'a [InstanceTransform]>,
}

/// A mirror and the thing in it, in the previous frame.
#[derive(Clone, Copy)]
pub(crate) struct Scenery {
    pub mirror: MirrorBefore,
    pub thing: Vec3,
    /// The image of the thing as a flat mirror showed it, in the axes of the mirror.
    pub image: Vec3,
    /// The thing.
    pub followed: bool,
}

impl Instances<'_> {
    /// The surface of the thing is that of the pixel's own path.
    pub(crate) fn scenery_before(
        &self,
        frame: &FrameConstants,
        mirror: &Mirror,
        curvature: &Curvature,
        seen: SeenReflection,
    ) -> Scenery {
        let (hit_distance, depth) = (seen.hit_distance, mirror.surface.linear_depth);
        let direction = mirror.sight.reflect(mirror.surface.unit_normal());
        let at = |reach: f32| mirror.position + direction * reach;
        // A direction tells no more of what is farther away.
        let thing = at(hit_distance.min(1e4 * depth));
        let image = image_at_rest(hit_distance);
        let rest = Scenery { mirror: MirrorBefore::at_rest(mirror, curvature), thing, image, followed: false };
        let is_followed = hit_distance > 0.0 && lobe_radius(frame, depth, seen) <= NARROW_LOBE;
        let moved = if is_followed { self.moved(frame, mirror, curvature, at(hit_distance)) } else { None };
        moved.unwrap_or(rest)
    }

    /// `None` where neither moves, and where a transform leaves nothing to be seen.
    fn moved(&self, frame: &FrameConstants, mirror: &Mirror, curvature: &Curvature, thing: Vec3) -> Option<Scenery> {
        let by_id = || self.carried(frame, self.hit_id?.at(mirror.p), thing).map(|(_, to)| to);
        let thing_to = self.motion_at(mirror).map(|motion| thing + motion).or_else(by_id);
        if self.hit_id.is_none() && self.motion.is_none() {
            return None;
        }
        let mirror_to = self.surface_id.and_then(|ids| self.carried(frame, ids.at(frame.guide_pixel(mirror.p)), mirror.position));
        if thing_to.is_none() && mirror_to.is_none() {
            return None;
        }
        let (followed, thing) = (thing_to.is_some(), thing_to.unwrap_or(thing));
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
        (image.z > 0.0 && image.is_finite()).then_some(Scenery { mirror: before, thing, image, followed })
    }

    /// How an instance moved, in the world seen from the eye, and to where it carries a point; `None` for the background, without an entry,
    /// and for one that is not finite.
    fn carried(&self, frame: &FrameConstants, id: u32, point: Vec3) -> Option<(InstanceTransform, Vec3)> {
        let transform = self.transforms?.get(id as usize).filter(|_| id != 0)?;
        let transform = transform.iter().flatten().all(|x| x.is_finite()).then(|| about_eye(frame, transform))?;
        Some((transform, carried(&transform, point.extend(1.0))?))
    }

    fn motion_at(&self, mirror: &Mirror) -> Option<Vec3> {
        let [x, y, z, _] = self.motion?.at(mirror.p);
        Some(Vec3::new(x, y, z)).filter(|motion| motion.is_finite())
    }

    /// Whether the host's motion of the thing in a mirror is not finite.
    pub(crate) fn has_bad_motion(&self, mirror: &Mirror, hit_distance: f32) -> bool {
        hit_distance > 0.0 && self.motion.is_some() && self.motion_at(mirror).is_none()
    }

    /// Whether the thing in a mirror should have a transform that can be used, and has none.
    pub(crate) fn lacks_transform(&self, frame: &FrameConstants, mirror: &Mirror, hit_distance: f32) -> bool {
        let Some(id) = self.hit_id.filter(|_| self.transforms.is_some()).map(|ids| ids.at(mirror.p)) else {
            return false;
        };
        if self.motion_at(mirror).is_some() {
            return false;
        }
        let thing = mirror.position + mirror.sight.reflect(mirror.surface.unit_normal()) * hit_distance;
        hit_distance > 0.0 && id != 0 && self.carried(frame, id, thing).is_none()
    }
}

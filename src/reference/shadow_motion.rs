//! Where the shadow on a surface lay in the previous frame \[Zeng et al. 2021\]: where the ray from the light past the occluder, as both
//! were, met the plane of the surface.

use super::guide::Surface;
use super::projection::{extent_ratio, previous_surface, sample_offset, Projections};
use super::reprojection::{about_eye, carried, InstanceTransform};
use super::surface_motion::SurfaceMotion;
use super::Image;
use crate::FrameConstants;
use glam::{IVec2, Vec2, Vec3, Vec4, Vec4Swizzles};

/// Of a ray to a plane, cosine: where it is smaller, a shadow has no place.
const GRAZING: f32 = 1e-3;

/// By what occluders move.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Occluders<'a> {
    /// Distances of what the shadow rays met.
    pub distance: Option<&'a Image<[f32; 4]>>,
    /// Ids of it.
    pub id: Option<&'a Image<u32>>,
    /// The host's own motion of its points: previous minus current place, world space.
    pub motion: Option<&'a Image<[f32; 4]>>,
    /// Transforms by id.
    pub transforms: Option<&'a [InstanceTransform]>,
    /// Number of the light.
    pub light: usize,
}

/// A surface of this frame, and its plane in the previous one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    position: Vec3,
    position_before: Vec3,
    normal_before: Vec3,
}

/// A place in the previous frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShadowPlace {
    /// Pixels; centres are whole numbers.
    pub position: Vec2,
    pub linear_depth: f32,
}

impl Receiver {
    /// `s`: where the surface was, pixels; centres are whole numbers.
    pub(crate) fn new(
        frame: &FrameConstants,
        projections: &Projections,
        surface: &Surface,
        p: IVec2,
        motion: &SurfaceMotion,
        s: Vec2,
    ) -> Self {
        Self {
            position: Vec4::from(projections.world_point(p.into(), surface.linear_depth)).xyz(),
            position_before: previous_surface(frame, s, surface.linear_depth * (1.0 + motion.depth_ratio)),
            normal_before: motion.previous_normal.into(),
        }
    }
}

impl Occluders<'_> {
    /// The place of the shadow of an occluder that the ray of the pixel `q` met; `None` where neither it nor the light moved, or there was
    /// no shadow on the plane.
    pub(crate) fn shadow_before(
        &self,
        frame: &FrameConstants,
        projections: &Projections,
        receiver: &Receiver,
        q: IVec2,
    ) -> Option<ShadowPlace> {
        let [light, light_before] = [frame.lights, frame.previous_lights].map(|lights| Vec4::from(lights[self.light]));
        let distance = self.distance.filter(|_| light != Vec4::ZERO)?.at(q)[0];
        let occluder = receiver.position + distance * (light.xyz() - light.w * receiver.position).normalize();
        let before = self.carried(frame, q, occluder);
        if before == occluder && light == light_before {
            return None;
        }
        let ray = (light_before.w * before - light_before.xyz()).normalize();
        let cosine = ray.dot(receiver.normal_before);
        let way = (receiver.position_before - before).dot(receiver.normal_before) / cosine;
        let shadow = before + way * ray;
        let is_usable = cosine.abs() > GRAZING && way >= 0.0 && shadow.is_finite();
        is_usable.then(|| projections.previous_place(frame, shadow)).flatten()
    }

    /// Where an occluder was, by the host's motion, else by its instance.
    fn carried(&self, frame: &FrameConstants, q: IVec2, occluder: Vec3) -> Vec3 {
        if let Some(motion) = self.motion.map(|motion| Vec4::from(motion.at(q)).xyz()).filter(|motion| motion.is_finite()) {
            return occluder + motion;
        }
        let transform = self.id.and_then(|ids| self.transform(ids.at(q))).map(|transform| about_eye(frame, transform));
        transform.and_then(|transform| carried(&transform, occluder.extend(1.0))).unwrap_or(occluder)
    }

    fn transform(&self, id: u32) -> Option<&InstanceTransform> {
        let transform = self.transforms?.get(id as usize).filter(|_| id != 0)?;
        transform.iter().flatten().all(|x| x.is_finite()).then_some(transform)
    }

    /// Whether the occluder of a pixel should have a transform that can be used, and has none.
    pub(crate) fn lacks_transform(&self, p: IVec2) -> bool {
        let id = self.id.filter(|_| self.transforms.is_some()).map_or(0, |ids| ids.at(p));
        id != 0 && self.transform(id).is_none()
    }

    /// Whether the host's motion of a pixel's occluder is not finite.
    pub(crate) fn has_bad_motion(&self, p: IVec2) -> bool {
        self.motion.is_some_and(|motion| !Vec4::from(motion.at(p)).xyz().is_finite())
    }
}

impl Projections {
    /// Where a point of the world that stands still was on the screen; `None`: behind the camera, or far outside.
    fn previous_place(&self, frame: &FrameConstants, world: Vec3) -> Option<ShadowPlace> {
        let at = Vec2::from(self.previous_position(world.extend(1.0).into())?);
        let position = at - sample_offset(frame) * extent_ratio(frame) - 0.5;
        let linear_depth = self.previous_linear_depth(world.extend(1.0).into());
        position.abs().cmplt(Vec2::splat(1e6)).all().then_some(ShadowPlace { position, linear_depth })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::surface_motion::SurfaceMotion;
    use crate::reference::test_scene::{camera, frame_with, surface};
    use crate::{Config, FrameParams};

    const EXTENT: [u32; 2] = [64, 64];
    const P: IVec2 = IVec2::new(40, 23);
    const STILL: InstanceTransform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

    /// A wall that faces the camera at a depth now, and another before; its points move along the axis of sight.
    struct Wall {
        frame: FrameConstants,
        depths: [f32; 2],
        distance: f32,
    }

    impl Wall {
        fn new(lights: [[f32; 4]; 2], eye_before: Vec3, depths: [f32; 2]) -> Self {
            let params = |eye, i: usize| FrameParams { lights: [lights[i], [0.0; 4], [0.0; 4], [0.0; 4]], ..camera(EXTENT, eye) };
            let frame = frame_with(&Config::new(EXTENT), &params(eye_before, 1), &params(Vec3::ZERO, 0));
            Self { frame, depths, distance: 2.0 }
        }

        /// The point of the wall at `P`.
        fn point(&self) -> Vec3 {
            let ndc = (P.as_vec2() + 0.5) / 32.0 - 1.0;
            Vec3::new(ndc.x, -ndc.y, -1.0) * self.depths[0]
        }

        /// Where the previous frame saw a point.
        fn seen(&self, point: Vec3, eye_before: Vec3) -> Vec2 {
            let from = point - eye_before;
            Vec2::new(from.x / -from.z + 1.0, 1.0 + from.y / from.z) * 32.0 - 0.5
        }

        fn place(&self, occluders: Occluders, eye_before: Vec3) -> Option<ShadowPlace> {
            let projections = Projections::new(&self.frame);
            let [now, before] = self.depths;
            let surface = surface(now);
            let s = self.seen(self.point() - Vec3::Z * (before - now), eye_before);
            let depth_ratio = (before + eye_before.z) / now - 1.0;
            let motion = SurfaceMotion { motion: (s - P.as_vec2()).into(), depth_ratio, previous_normal: [0.0, 0.0, 1.0] };
            let receiver = Receiver::new(&self.frame, &projections, &surface, P, &motion, s);
            let distance = Image::new(EXTENT, [self.distance; 4]);
            occluders_of(occluders, &distance).shadow_before(&self.frame, &projections, &receiver, P)
        }
    }

    fn occluders_of<'a>(occluders: Occluders<'a>, distance: &'a Image<[f32; 4]>) -> Occluders<'a> {
        Occluders { distance: Some(distance), ..occluders }
    }

    #[test]
    fn a_shadow_was_where_light_past_the_occluder_met_the_wall() {
        let (sun, sun_before) = ([0.6, 0.0, 0.8, 0.0], [0.0, 0.6, 0.8, 0.0]);
        let (lamp, lamp_before) = ([1.0, 2.0, 3.0, 1.0], [0.5, 2.5, 2.0, 1.0]);
        let turned = [[0.0, -1.0, 0.0, 0.3], [1.0, 0.0, 0.0, -0.2], [0.0, 0.0, 1.0, 0.1]];
        let id = Image::new(EXTENT, 1);
        for lights in [[sun, sun], [sun, sun_before], [lamp, lamp], [lamp, lamp_before]] {
            for (eye_before, depths) in
                [(Vec3::ZERO, [5.0, 5.0]), (Vec3::new(0.4, -0.3, 0.2), [5.0, 5.0]), (Vec3::ZERO, [5.0, 6.0])]
            {
                let wall = Wall::new(lights, eye_before, depths);
                let transforms = [STILL, turned];
                let by_id = Occluders { id: Some(&id), transforms: Some(&transforms), ..Default::default() };
                let [light, light_before] = lights.map(Vec4::from);
                let occluder = wall.point() + 2.0 * (light.xyz() - light.w * wall.point()).normalize();
                let before = Vec3::from(turned.map(|row| Vec4::from(row).dot(occluder.extend(1.0))));
                let away = light_before.w * before - light_before.xyz();
                let shadow = before + away * ((-depths[1] - before.z) / away.z);
                let given = wall.place(by_id, eye_before).expect("a shadow");
                let expected = wall.seen(shadow, eye_before);
                assert!(given.position.distance(expected) < 2e-3, "{lights:?} {depths:?}: {given:?} for {expected}");
                assert!((given.linear_depth - depths[1] - eye_before.z).abs() < 1e-3, "{given:?}");
                // The host's own motion says the same.
                let motion = Image::new(EXTENT, (before - occluder).extend(0.0).into());
                let by_motion = wall.place(Occluders { motion: Some(&motion), ..Default::default() }, eye_before);
                assert!(by_motion.is_some_and(|place| place.position.distance(given.position) < 1e-3), "{by_motion:?}");
            }
        }
    }

    #[test]
    fn each_light_has_a_place_of_its_own() {
        let mut wall = Wall::new([[0.6, 0.0, 0.8, 0.0]; 2], Vec3::ZERO, [5.0, 5.0]);
        (wall.frame.lights[2], wall.frame.previous_lights[2]) = ([0.0, 0.6, 0.8, 0.0], [0.0, 0.6, 0.8, 0.0]);
        let motion = Image::new(EXTENT, [0.0, 0.0, 1.0, 0.0]);
        let place = |light| wall.place(Occluders { motion: Some(&motion), light, ..Default::default() }, Vec3::ZERO);
        let [first, third] = [0, 2].map(|light| place(light).expect("a shadow").position - wall.seen(wall.point(), Vec3::ZERO));
        // What moved along the axis of sight moved its shadow the way in which its light stands.
        assert!(first.x.abs() > 1.0 && first.y.abs() < 1e-2 && third.y.abs() > 1.0 && third.x.abs() < 1e-2, "{first} {third}");
        assert_eq!(place(1), None, "nobody told where that is");
    }

    #[test]
    fn what_has_no_motion_that_can_be_used_stands_still() {
        let wall = Wall::new([[0.6, 0.0, 0.8, 0.0]; 2], Vec3::ZERO, [5.0, 5.0]);
        let moved = [[1.0, 0.0, 0.0, 0.5], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        let transforms = [moved, moved, [[f32::NAN; 4]; 3], STILL];
        for (id, counted) in [(0, false), (2, true), (3, false), (9, true)] {
            let id = Image::new(EXTENT, id);
            let occluders = Occluders { id: Some(&id), transforms: Some(&transforms), ..Default::default() };
            assert_eq!((wall.place(occluders, Vec3::ZERO), occluders.lacks_transform(P)), (None, counted), "{:?}", id.at(P));
        }
        let (id, bad) = (Image::new(EXTENT, 1), Image::new(EXTENT, [f32::NAN, 0.0, 0.0, 0.0]));
        let by_id = Occluders { id: Some(&id), transforms: Some(&transforms), ..Default::default() };
        assert!(wall.place(by_id, Vec3::ZERO).is_some());
        let beside = Occluders { motion: Some(&bad), ..by_id };
        assert!(beside.has_bad_motion(P));
        assert_eq!(wall.place(beside, Vec3::ZERO), wall.place(by_id, Vec3::ZERO), "the id stands in for a motion that is NaN");
        // Behind the wall it cast no shadow on it.
        let behind = Image::new(EXTENT, [0.0, 0.0, -4.0, 0.0]);
        assert_eq!(wall.place(Occluders { motion: Some(&behind), ..Default::default() }, Vec3::ZERO), None);
        // Nobody told where the light is.
        assert_eq!(Wall::new([[0.0; 4]; 2], Vec3::ZERO, [5.0, 5.0]).place(by_id, Vec3::ZERO), None);
    }
}

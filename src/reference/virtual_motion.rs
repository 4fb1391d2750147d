//! Where the image of what is seen in a surface was: as far behind the surface as the thing lies before it, if it is flat. \[Zimmer et al.
//! 2015\]

use super::curvature::{Curvature, Step};
use super::guide::{unpack_guide, Surface};
use super::projection::{extent_ratio, sample_offset, Projections};
use super::reflection::mirror_share;
use super::{render_rect::RenderRect, Image};
use crate::FrameConstants;
use glam::{IVec2, Mat2, Mat4, Vec2, Vec3, Vec3Swizzles, Vec4, Vec4Swizzles};

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

/// Where the surface of a mirror was in the previous frame, with the axes of its curvature.
#[derive(Clone, Copy)]
pub(crate) struct MirrorBefore {
    pub position: Vec3,
    pub sight: Vec3,
    pub along: Vec3,
    pub across: Vec3,
}

impl MirrorBefore {
    /// Of a mirror at rest.
    pub(crate) fn at_rest(mirror: &Mirror, curvature: &Curvature) -> Self {
        Self { position: mirror.position, sight: mirror.sight, along: curvature.along, across: curvature.across }
    }

    /// A vector in the axes: along, across, sight.
    pub(crate) fn axes(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.along), v.dot(self.across), v.dot(self.sight))
    }
}

/// The image of a thing at rest before a mirror at rest, from its surface in the axes of [`MirrorBefore`].
pub(crate) const fn image_at_rest(hit_distance: f32) -> Vec3 {
    Vec3::new(0.0, 0.0, hit_distance)
}

/// The surfaces of a frame, with its projections.
pub(crate) struct VirtualMotion<'a> {
    frame: &'a FrameConstants,
    rect: RenderRect,
    projections: Projections,
    pub surfaces: Image<Surface>,
}

impl<'a> VirtualMotion<'a> {
    pub(crate) fn new(frame: &'a FrameConstants, guide: &Image<[u16; 4]>) -> Self {
        Self {
            frame,
            rect: RenderRect::new(frame.render_extent),
            projections: Projections::new(frame),
            surfaces: Image::compute(guide.extent(), frame.render_extent, |p| unpack_guide(guide.at(p))),
        }
    }

    /// `motion`: of the surface, pixels of the previous frame.
    pub(crate) fn mirror(&self, p: IVec2, motion: [f32; 2]) -> Mirror {
        let surface = self.surfaces.at(p);
        let position = self.world(p, surface.linear_depth);
        let sight = (self.world(p, 2.0 * surface.linear_depth) - position).normalize();
        let surface_position = (p.as_vec2() + 0.5) * extent_ratio(self.frame) + Vec2::from(motion) - 0.5;
        Mirror { p, surface, position, sight, surface_position }
    }

    fn world(&self, p: IVec2, linear_depth: f32) -> Vec3 {
        Vec4::from(self.projections.world_point(p.into(), linear_depth)).xyz()
    }

    /// How the surface of a pixel is curved.
    pub(crate) fn curvature(&self, mirror: &Mirror) -> Curvature {
        let steps = [IVec2::X, IVec2::Y].map(|axis| self.step_along(mirror, axis));
        Curvature::new(mirror.surface.unit_normal(), mirror.sight, steps)
    }

    /// That of the flatter side: where two faces meet, the other side tells of the edge. At an outline, the side that there is.
    fn step_along(&self, mirror: &Mirror, axis: IVec2) -> Option<Step> {
        match [-REACH * axis, REACH * axis].map(|offset| self.step_towards(mirror, offset)) {
            [Some(before), Some(behind)] if before.curvature().abs() < behind.curvature().abs() => Some(before),
            [before, behind] => behind.or(before),
        }
    }

    /// `None` where another surface is.
    fn step_towards(&self, mirror: &Mirror, offset: IVec2) -> Option<Step> {
        let q = mirror.p + offset;
        let tap = Some(q).filter(|q| self.rect.contains(*q)).map(|q| self.surfaces.at(q))?;
        if tap.is_background() || tap.id != mirror.surface.id {
            return None;
        }
        let way = self.world(q, tap.linear_depth) - mirror.position;
        Some(Step { way, turn: tap.unit_normal() - mirror.surface.unit_normal() })
    }

    /// Where a point of the world that stands still was on the screen; `None`: behind the camera.
    fn previous_pixel_position(&self, world: Vec3) -> Option<Vec2> {
        let at = Vec2::from(self.projections.previous_position(world.extend(1.0).into())?);
        let position = at - sample_offset(self.frame) * extent_ratio(self.frame) - 0.5;
        // What lies far outside has no pixel.
        position.abs().cmplt(Vec2::splat(1e6)).all().then_some(position)
    }

    /// Where the image of what is seen was, pixels: where a line of sight of the previous frame met the wave front of what is mirrored.
    /// `image`: of the thing as a flat mirror showed it, in the axes of `before`. `None`: behind the camera. Motion of the surface that
    /// `before` lacks takes along what is not mirrored alone.
    pub(crate) fn image_position(
        &self,
        mirror: &Mirror,
        curvature: &Curvature,
        before: &MirrorBefore,
        image: Vec3,
        roughness: f32,
    ) -> Option<Vec2> {
        let still = self.previous_pixel_position(before.position)?;
        let share = mirror_share(roughness);
        let (eye, scale) = self.previous_eye_from(before.position);
        let (eye, distance) = (before.axes(eye), share * image.z);
        let ahead = -eye.z;
        if ahead.is_nan() || ahead <= 0.0 {
            return None;
        }
        let behind = distance * scale;
        let total = Mat2::IDENTITY * behind + curvature.nearer(image.z) * ahead;
        let both = ahead + behind;
        let pulled = eye.xy() / both * distance + image.xy() * (share * ahead / both);
        let aside = (total * both.recip()).inverse() * pulled;
        let position = self.previous_pixel_position(before.position + aside.x * before.along + aside.y * before.across)?;
        Some(position + (mirror.surface_position - still) * (1.0 - share))
    }

    /// From a point of the world to where the lines of sight of the previous frame came from, times the w of that homogeneous point, with this
    /// w: 0 where they are parallel.
    pub(crate) fn previous_eye_from(&self, world: Vec3) -> (Vec3, f32) {
        let w = self.frame.previous_clip_w_scale;
        let place = Vec4::new(0.0, 0.0, -self.frame.previous_clip_w_offset, w);
        let eye = Mat4::from_cols_array_2d(&self.frame.world_from_previous_sample) * place;
        (eye.xyz() - world * w, w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::guide::pack_guide;
    use crate::reference::projection::view_position;
    use crate::reference::reflection::SeenReflection;
    use crate::reference::scenery::Instances;
    use crate::reference::test_scene::{camera, frame_with};
    use crate::Config;

    const EXTENT: [u32; 2] = [64, 64];
    const MIDDLE: Vec3 = Vec3::new(0.0, 0.0, -5.0);
    const RADIUS: f32 = 2.0;

    /// What is curved along the axes that count: a ball, or a pillar, which is straight along the other one.
    struct Round {
        frame: FrameConstants,
        guide: Image<[u16; 4]>,
        /// 1 of the axes that count.
        axes: Vec3,
    }

    impl Round {
        fn new(axes: Vec3, eye_before: Vec3) -> Self {
            let frame = frame_with(&Config::new(EXTENT), &camera(EXTENT, eye_before), &camera(EXTENT, Vec3::ZERO));
            let guide = Image::compute(EXTENT, EXTENT, |p| {
                let sight = view_position(&frame, p, 1.0).normalize();
                let (flat, middle) = (sight * axes, MIDDLE * axes);
                let (square, along) = (flat.length_squared(), flat.dot(middle));
                let inside = along * along - square * (middle.length_squared() - RADIUS * RADIUS);
                let position = sight * ((along - inside.max(0.0).sqrt()) / square);
                let normal = ((position - MIDDLE) * axes / RADIUS).into();
                let surface = Surface { linear_depth: -position.z, is_apart: false, normal, gradient: [0.0; 2], id: 1 };
                pack_guide(&if inside > 0.0 { surface } else { Surface::default() })
            });
            Self { frame, guide, axes }
        }

        /// The nearest point of the surface to one beside it.
        fn on_surface(&self, point: Vec3) -> Vec3 {
            let aside = point - MIDDLE;
            MIDDLE + aside * (Vec3::ONE - self.axes) + (aside * self.axes).normalize() * RADIUS
        }

        /// Where an eye sees a thing in the surface, by Fermat's principle: the way over it is the shortest.
        fn mirroring_point(&self, from: Vec3, eye: Vec3, thing: Vec3) -> Vec3 {
            let way = |point: Vec3| f64::from(point.distance(eye)) + f64::from(point.distance(thing));
            let (mut best, mut step) = (from, 0.25);
            while step > 2e-4 {
                let around =
                    [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].map(|to| self.on_surface(best + step * to));
                match around.into_iter().find(|point| way(*point) < way(best)) {
                    Some(point) => best = point,
                    None => step *= 0.5,
                }
            }
            best
        }
    }

    /// Pixels aslant of the middle, on the ball and on the pillar.
    const PIXELS: [IVec2; 4] = [IVec2::new(32, 32), IVec2::new(21, 30), IVec2::new(40, 24), IVec2::new(33, 42)];

    #[test]
    fn the_image_in_a_round_mirror_was_where_the_eye_saw_it() {
        for (axes, eye) in
            [(Vec3::ONE, Vec3::X), (Vec3::ONE, Vec3::Y), (Vec3::new(1.0, 0.0, 1.0), Vec3::X), (Vec3::new(1.0, 0.0, 1.0), Vec3::Y)]
        {
            let eye = 0.3 * eye;
            let round = Round::new(axes, eye);
            let motion = VirtualMotion::new(&round.frame, &round.guide);
            for p in PIXELS {
                let mirror = motion.mirror(p, [0.0; 2]);
                let thing = mirror.position + 4.0 * mirror.sight.reflect(mirror.surface.unit_normal());
                let at = round.mirroring_point(round.on_surface(mirror.position), eye, thing);
                let [expected, surface] =
                    [at, mirror.position].map(|point| motion.previous_pixel_position(point).expect("before the eye"));
                let curvature = motion.curvature(&mirror);
                let before = MirrorBefore::at_rest(&mirror, &curvature);
                let given = motion.image_position(&mirror, &curvature, &before, image_at_rest(4.0), 0.0).expect("before the eye");
                let error = given.distance(expected);
                assert!(error < 0.06, "{p}, {axes}, {eye}: {given} for {expected}, {} of the surface", surface.distance(expected));
            }
        }
    }

    /// The thing moves, with the eye and alone.
    #[test]
    fn what_moves_before_a_round_mirror_was_where_the_eye_saw_it() {
        let pillar = Vec3::new(1.0, 0.0, 1.0);
        for (axes, eye, way) in [
            (Vec3::ONE, Vec3::ZERO, Vec3::X),
            (Vec3::ONE, Vec3::Y, Vec3::X),
            (pillar, Vec3::ZERO, Vec3::X),
            (pillar, Vec3::X, Vec3::Y),
        ] {
            let (eye, way) = (0.3 * eye, 0.3 * way);
            let round = Round::new(axes, eye);
            let motion = VirtualMotion::new(&round.frame, &round.guide);
            let carried = [[1.0, 0.0, 0.0, way.x], [0.0, 1.0, 0.0, way.y], [0.0, 0.0, 1.0, way.z]];
            let (hit_id, transforms) = (Image::new(EXTENT, 1), [carried; 2]);
            let instances = Instances { hit_id: Some(&hit_id), transforms: Some(&transforms), ..Default::default() };
            for p in PIXELS {
                let mirror = motion.mirror(p, [0.0; 2]);
                let thing = mirror.position + 4.0 * mirror.sight.reflect(mirror.surface.unit_normal());
                let start = round.on_surface(mirror.position);
                let [expected, rest] = [thing + way, thing]
                    .map(|thing| motion.previous_pixel_position(round.mirroring_point(start, eye, thing)).expect("before the eye"));
                let curvature = motion.curvature(&mirror);
                let before = instances.scenery_before(
                    &round.frame,
                    &mirror,
                    &curvature,
                    SeenReflection { hit_distance: 4.0, roughness: 0.0 },
                );
                let given = motion.image_position(&mirror, &curvature, &before.mirror, before.image, 0.0).expect("before the eye");
                let error = given.distance(expected);
                assert!(error < 0.06, "{p}, {axes}, {eye}: {given} for {expected}, {} at rest", rest.distance(expected));
            }
        }
    }

    #[test]
    fn a_ball_is_as_curved_as_its_radius_says_and_a_plane_is_not() {
        let round = Round::new(Vec3::ONE, Vec3::ZERO);
        let motion = VirtualMotion::new(&round.frame, &round.guide);
        let mean = |p: IVec2| motion.curvature(&motion.mirror(p, [0.0; 2])).mean;
        for p in PIXELS {
            assert!((mean(p) * RADIUS - 1.0).abs() < 0.1, "{p}: {}", mean(p));
        }
        let wall = Surface { linear_depth: 4.0, is_apart: false, normal: [0.0, 0.0, 1.0], gradient: [0.0; 2], id: 1 };
        let guide = Image::new(EXTENT, pack_guide(&wall));
        let motion = VirtualMotion::new(&round.frame, &guide);
        assert_eq!(motion.curvature(&motion.mirror(IVec2::new(20, 30), [0.0; 2])).mean, 0.0);
    }

    /// On the outline one side of a row is background.
    #[test]
    fn an_outline_is_as_curved_as_the_side_that_there_is() {
        let round = Round::new(Vec3::ONE, Vec3::ZERO);
        let motion = VirtualMotion::new(&round.frame, &round.guide);
        let outline = (0..64).find(|x| !motion.surfaces.at(IVec2::new(*x, 32)).is_background()).expect("a ball");
        let curvature = motion.curvature(&motion.mirror(IVec2::new(outline, 32), [0.0; 2])).mean;
        assert!((curvature * RADIUS - 1.0).abs() < 0.2, "{curvature}");
    }
}

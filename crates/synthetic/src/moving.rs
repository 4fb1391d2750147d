//! A scene as a path tracer at one sample a pixel sees it: a camera that moves, surfaces at several depths, a fence and a lattice
//! with gaps, sky behind windows. Made for benchmarks: any size, pixel by pixel, in a fraction of a microsecond each.
//!
//! It has two frames, each the one before the other, so that alternating them is an endless camera shake with right motion vectors.
//! The gaps uncover what is behind them in every frame. Noise stays with its surface, as that of a re-shaded sample does: temporal
//! gradients are those of steady light.

use crate::scene::{camera, random, FOCAL};
use atrous::FrameParams;

/// Frames before the first one comes again.
pub const FRAMES: u32 = 2;

/// Eye of each frame.
const EYE: [[f32; 3]; 2] = [[-0.05, 0.0, 0.0], [0.05, 0.02, -0.04]];
const FLOOR: f32 = -1.2;
const FENCE: f32 = -3.0;
const LATTICE: f32 = -5.5;
const WALL: f32 = -9.0;
/// Centre and radius of each ball.
const BALLS: [[f32; 4]; 4] = [[-0.6, -0.5, -2.2, 0.35], [0.9, -0.4, -4.2, 0.8], [-1.6, 0.1, -6.5, 1.0], [2.6, 0.8, -8.0, 0.9]];
/// Surface id of the first ball; the others follow.
const FIRST_BALL: u32 = 5;

/// The inputs of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Linear; 0 is the sky.
    pub depth: f32,
    /// World.
    pub normal: [f32; 3],
    /// `uv_previous − uv_current`.
    pub motion: [f32; 2],
    /// Albedo of the primary hit.
    pub albedo: [f32; 3],
    /// 0: sky.
    pub surface_id: u32,
    /// One sample of the sun: there or not.
    pub direct: [f32; 3],
    /// One sample of light that comes by other surfaces: mostly dark, now and then bright.
    pub indirect: [f32; 3],
    /// One sample of how far a lamp is seen, 0 or 1: bands of light and of shadow, with penumbrae an eighth of the picture.
    pub visibility: f32,
    /// One sample of fog.
    pub volume: [f32; 3],
    /// Depth of that sample.
    pub scattering_depth: f32,
}

/// The scene, seen in an extent.
#[derive(Clone, Copy, Debug)]
pub struct MovingScene {
    extent: [u32; 2],
}

struct Hit {
    point: [f32; 3],
    depth: f32,
    normal: [f32; 3],
    albedo: [f32; 3],
    id: u32,
}

impl MovingScene {
    /// The scene in this extent.
    pub fn new(extent: [u32; 2]) -> Self {
        Self { extent }
    }

    /// The camera of frame `index`.
    pub fn params(&self, index: u32) -> FrameParams {
        camera(self.extent, EYE[(index % FRAMES) as usize])
    }

    /// The inputs of a pixel in frame `index`.
    pub fn pixel(&self, index: u32, x: u32, y: u32) -> Pixel {
        let frame = (index % FRAMES) as usize;
        let uv = [(x as f32 + 0.5) / self.extent[0] as f32, (y as f32 + 0.5) / self.extent[1] as f32];
        let fog = if random(x, y, 2 + index) < 0.25 { 0.4 } else { 0.0 };
        let (volume, scattering_depth) = ([fog, 0.9 * fog, 0.8 * fog], 0.5 + 6.0 * random(x, y, 100 + index));
        let Some(hit) = self.trace(frame, uv) else {
            let sky = [0.3, 0.5, 0.9];
            let (normal, motion, albedo) = ([0.0; 3], [0.0; 2], [1.0; 3]);
            return Pixel {
                depth: 0.0,
                normal,
                motion,
                albedo,
                surface_id: 0,
                direct: sky,
                indirect: [0.0; 3],
                visibility: 1.0,
                volume,
                scattering_depth,
            };
        };
        let motion = self.motion(frame, uv, &hit);
        // Frame 1 has the light of the pixel that showed this surface in frame 0, with its noise.
        let shaded = [0, 1].map(|i| ((uv[i] + motion[i] * frame as f32) * self.extent[i] as f32).floor());
        let centre = [0, 1].map(|i| (shaded[i] + 0.5) / self.extent[i] as f32);
        let earlier = if frame == 0 { None } else { self.trace(0, centre).filter(|earlier| earlier.id == hit.id) };
        let [direct, indirect, visibility] = light(earlier.as_ref().unwrap_or(&hit), shaded.map(|side| side as i32 as u32));
        Pixel {
            depth: hit.depth,
            normal: hit.normal,
            motion,
            albedo: hit.albedo,
            surface_id: hit.id,
            direct: hit.albedo.map(|a| a * direct),
            indirect: hit.albedo.map(|a| a * indirect),
            visibility,
            volume,
            scattering_depth,
        }
    }

    fn aspect(&self) -> f32 {
        self.extent[0] as f32 / self.extent[1] as f32
    }

    fn motion(&self, frame: usize, uv: [f32; 2], hit: &Hit) -> [f32; 2] {
        let before = self.project(1 - frame, hit.point);
        [before[0] - uv[0], before[1] - uv[1]]
    }

    fn project(&self, frame: usize, point: [f32; 3]) -> [f32; 2] {
        let [x, y, z]: [f32; 3] = std::array::from_fn(|i| point[i] - EYE[frame][i]);
        [0.5 + 0.5 * x / -z * FOCAL / self.aspect(), 0.5 - 0.5 * y / -z * FOCAL]
    }

    /// The nearest surface behind a point of the screen; `None` is the sky.
    fn trace(&self, frame: usize, uv: [f32; 2]) -> Option<Hit> {
        let eye = EYE[frame];
        // The depth of a point is its parameter on the ray.
        let ray = [(2.0 * uv[0] - 1.0) * self.aspect() / FOCAL, (1.0 - 2.0 * uv[1]) / FOCAL, -1.0];
        let at = |t: f32| -> [f32; 3] { std::array::from_fn(|i| eye[i] + t * ray[i]) };
        let mut nearest: Option<Hit> = None;
        let mut meet = |depth: f32, normal: [f32; 3], albedo: [f32; 3], id: u32| {
            if depth > 0.05 && nearest.as_ref().is_none_or(|n| depth < n.depth) {
                nearest = Some(Hit { point: at(depth), depth, normal, albedo, id });
            }
        };
        for (i, ball) in BALLS.into_iter().enumerate() {
            if let Some(t) = ball_depth(eye, ray, ball) {
                let p = at(t);
                let normal = std::array::from_fn(|c| (p[c] - ball[c]) / ball[3]);
                meet(t, normal, [0.8, 0.25 + 0.15 * i as f32, 0.2], FIRST_BALL + i as u32);
            }
        }
        for (z, id, albedo) in [(FENCE, 2, [0.5, 0.3, 0.15]), (LATTICE, 3, [0.7; 3]), (WALL, 4, [0.6, 0.6, 0.5])] {
            let t = eye[2] - z;
            let [x, y, _] = at(t);
            if is_solid(id, x, y) {
                meet(t, [0.0, 0.0, 1.0], albedo, id);
            }
        }
        let t = (FLOOR - eye[1]) / ray[1];
        if t > 0.0 && eye[2] - t > WALL {
            let [x, _, z] = at(t);
            let odd = ((x.floor() + z.floor()) as i32).rem_euclid(2) as f32;
            meet(t, [0.0, 1.0, 0.0], [0.2 + 0.6 * odd; 3], 1);
        }
        nearest
    }
}

/// One sample of the sun, of light that comes by other surfaces, and of the visibility of a lamp.
fn light(hit: &Hit, seed: [u32; 2]) -> [f32; 3] {
    let u = [0, 1].map(|i| random(seed[0], seed[1], i));
    let [nx, ny, nz] = hit.normal;
    let sun = (0.4 * nx + 0.8 * ny + 0.45 * nz).max(0.0);
    let band = (1.7 * hit.point[0] + 0.9 * hit.point[2]).sin();
    let direct = if u[0] < 0.5 + 0.5 * band { 2.5 * sun } else { 0.0 };
    let visibility = f32::from(u[0] < 0.5 + 2.5 * band);
    // Exponential: as wide as its mean, as one path is.
    [direct, (0.25 + 0.1 * ny) * -(1.0 - u[1]).ln(), visibility]
}

fn ball_depth(eye: [f32; 3], ray: [f32; 3], ball: [f32; 4]) -> Option<f32> {
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let o = std::array::from_fn(|i| eye[i] - ball[i]);
    let (a, b, c) = (dot(ray, ray), dot(o, ray), dot(o, o) - ball[3] * ball[3]);
    let discriminant = b * b - a * c;
    (discriminant > 0.0).then(|| (-b - discriminant.sqrt()) / a)
}

/// Whether an upright surface has something at a point of its plane, or a gap.
fn is_solid(id: u32, x: f32, y: f32) -> bool {
    let cell = |v: f32, scale: f32| (v * scale).rem_euclid(1.0) - 0.5;
    match id {
        2 => y < 0.5 && (cell(x, 2.0).abs() < 0.15 || cell(y, 2.5).abs() < 0.1),
        3 => y < 1.4 && cell(x, 1.1).hypot(cell(y, 1.1)) > 0.36,
        _ => y < 0.2 || y < 4.5 && (y > 2.6 || cell(x, 0.4).abs() > 0.35),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::pixels;
    use std::collections::BTreeMap;

    const EXTENT: [u32; 2] = [160, 90];

    #[test]
    fn every_surface_is_seen_and_everything_is_finite() {
        for index in 0..FRAMES {
            let mut seen = BTreeMap::new();
            for (x, y) in pixels(EXTENT) {
                let p = MovingScene::new(EXTENT).pixel(index, x, y);
                *seen.entry(p.surface_id).or_insert(0) += 1;
                let numbers = [p.normal, p.albedo, p.direct, p.indirect, p.volume];
                assert!(numbers.iter().flatten().chain(&p.motion).all(|v| v.is_finite()) && p.scattering_depth > 0.0, "{p:?}");
                assert_eq!(p.depth == 0.0, p.surface_id == 0, "{p:?}");
            }
            assert_eq!(seen.len(), 9, "{seen:?}");
            assert!(seen[&0] > 1500 && seen.values().all(|count| *count > 8), "{seen:?}");
        }
    }

    /// The gradient sample of a pixel, which goes to the nearest pixel of the frame after, has the noise that it had.
    #[test]
    fn noise_stays_with_its_surface() {
        let scene = MovingScene::new(EXTENT);
        for (before, now) in [(0, 1), (1, 0)] {
            let (mut same, mut all) = (0, 0);
            for (x, y) in pixels(EXTENT) {
                let old = scene.pixel(before, x, y);
                // Alternating frames: where a surface goes is where it came from.
                let to: [f32; 2] = std::array::from_fn(|i| [x, y][i] as f32 + 0.5 + old.motion[i] * EXTENT[i] as f32);
                let Some(at) = inside(to) else { continue };
                let new = scene.pixel(now, at[0], at[1]);
                if old.surface_id == new.surface_id && old.surface_id > 0 {
                    all += 1;
                    let relative = |a: f32, b: f32| (a - b).abs() <= 1e-4 * a.abs().max(b.abs());
                    let light = |p: &Pixel| [p.direct[0] / p.albedo[0], p.indirect[0] / p.albedo[0]];
                    same += u32::from(light(&old).into_iter().zip(light(&new)).all(|(a, b)| relative(a, b)));
                }
            }
            assert!(same * 100 > all * 98, "{same} of {all}");
        }
    }

    fn inside(to: [f32; 2]) -> Option<[u32; 2]> {
        let within = |i: usize| (0.0..EXTENT[i] as f32).contains(&to[i]);
        (within(0) && within(1)).then(|| to.map(|v| v as u32))
    }

    /// A pixel's motion leads to the same point of the same surface, or to what hid it.
    #[test]
    fn motion_leads_to_the_frame_before() {
        let scene = MovingScene::new(EXTENT);
        for frame in 0..2 {
            let (mut kept, mut uncovered) = (0, 0);
            for (x, y) in pixels(EXTENT) {
                let uv = [(x as f32 + 0.5) / EXTENT[0] as f32, (y as f32 + 0.5) / EXTENT[1] as f32];
                let Some(hit) = scene.trace(frame, uv) else { continue };
                let motion = scene.motion(frame, uv, &hit);
                let before = [uv[0] + motion[0], uv[1] + motion[1]];
                let Some(found) = scene.trace(1 - frame, before) else { continue };
                let distance = (0..3).map(|i| (found.point[i] - hit.point[i]).abs()).fold(0.0, f32::max);
                if distance < 2e-3 {
                    kept += 1;
                } else {
                    uncovered += 1;
                    assert!(
                        found.depth < hit.depth + EYE[0][2] - EYE[1][2] + 0.1,
                        "nothing hides {:?}: {:?}",
                        hit.point,
                        found.point
                    );
                }
            }
            let all = EXTENT[0] * EXTENT[1];
            assert!(kept > all / 2, "{kept}");
            assert!(uncovered > all / 50 && uncovered < all / 4, "{uncovered} of {all}");
        }
    }
}
